#include "reference/vaiont/slide_in_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace voussoir::reference::slide_in_space_test {
namespace {

// a wedge of rock on a plane that dips by 45 degrees to the north, under level ground, cut off by the gorge
TEST(SlideInSpace, OfOnePlaneIsAPrism) {
  const SlideInSpace prism{
      0, 10, 0, 40, {{45, 0, {0, 0, 20}}}, {{0, 10, 0, 40, {{0, 0, {0, 0, 10}}}}}, {89.99, 0, {0, 30, 0}}};
  // below z = 10 and above z = 20 - y: y from 10 to 30, up to 20 m thick
  const SlideVolumes found = slide_volumes(prism, 0.05, 5);
  EXPECT_NEAR(found.all, 10 * 20 * 20 / 2.0, 2);
  EXPECT_NEAR(found.below, 10 * 15 * 15 / 2.0, 2);
  EXPECT_NEAR(found.plan, 200, 1);
  EXPECT_NEAR(found.thickest, 20, 0.1);
}

TEST(SlideInSpace, TurnsWithItsDipDirection) {
  const DippingPlane east{30, 90, {0, 0, 100}}, north{30, 0, {0, 0, 100}};
  EXPECT_NEAR(east.elevation(10, 7), 100 - 10 * std::tan(std::acos(-1.0) / 6), 1e-12);
  EXPECT_NEAR(north.elevation(7, 10), east.elevation(10, 7), 1e-12);
}

// as stated beside the reconstruction, from another grid; the errors of both are some 0.02 %
TEST(SlideInSpace, HasTheVolumesOfVaiont) {
  const SlideInSpace slide = vaiont_in_space();
  EXPECT_NEAR(slide_volumes(slide, 5).all, 272.46e6, 0.1e6);
  EXPECT_NEAR(slide_volumes(slide, 5, 710).below, 110.39e6, 0.05e6);
  EXPECT_NEAR(slide_volumes(slide, 5, 600).below, 43.54e6, 0.03e6);
  EXPECT_NEAR(slide_volumes(slide, 5, 460).below, 4.30e6, 0.01e6);
  EXPECT_NEAR(slide_volumes(vaiont_in_space(3400), 5).all, (272.46 + 47.24) * 1e6, 0.2e6);
  EXPECT_NEAR(slide_volumes(slide, 5).plan, 2.005e6, 0.003e6);
  EXPECT_NEAR(slide_volumes(slide, 5).thickest, 323, 1.5);
}

}  // namespace
}  // namespace voussoir::reference::slide_in_space_test
