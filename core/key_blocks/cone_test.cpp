// The cone of free directions. Random blocks against an enumeration in whole numbers: cases/key_blocks.
#include <gtest/gtest.h>

#include <cmath>

#include "core/key_blocks/direction_cone.hpp"
#include "text/angle.hpp"

namespace voussoir::cone_test {
namespace {

TEST(DirectionCone, DrawersAreRemovable) {
  // walls left and right, above and below, and behind: out at the front only
  const std::vector<Vector<3>> normals{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}};
  const Removability<3> drawer = find_removability(normals);
  EXPECT_TRUE(drawer.removable);
  EXPECT_LT((drawer.direction - Vector<3>(0, 1, 0)).norm(), 1e-9);
  EXPECT_EQ(project(normals, Vector<3>(0, 0, -1)).motion.norm(), 0);
  std::vector<Vector<3>> closed = normals;
  closed.emplace_back(0, -1, 0);
  EXPECT_FALSE(find_removability(closed).removable);
  EXPECT_TRUE(find_removability<3>({}).removable);
  EXPECT_TRUE(find_removability<2>({{0, 1}, {0, -1}}).removable);
  EXPECT_FALSE(find_removability<2>({{0, 1}, {0, -1}, {1, 0}, {-1, 0}}).removable);
}

TEST(DirectionCone, TaperIsTheAngleByWhichWallsMustTurn) {
  // a block with a free top whose four walls lean inwards by 0.3 degrees and whose floor is level
  const double lean = 0.3 * degree;
  std::vector<Vector<3>> normals{{0, 0, 1}};
  for (const Vector<3>& side : {Vector<3>(1, 0, 0), Vector<3>(-1, 0, 0), Vector<3>(0, 1, 0), Vector<3>(0, -1, 0)})
    normals.push_back(std::cos(lean) * side - std::sin(lean) * Vector<3>(0, 0, 1));
  EXPECT_FALSE(find_removability(normals).removable);
  EXPECT_NEAR(*find_taper(normals) / degree, 0.3, 1e-6);
  for (std::size_t k = 1; k < normals.size(); ++k)
    normals[k][2] *= -1;
  EXPECT_TRUE(find_removability(normals).removable);
  EXPECT_FALSE(find_taper(normals));
}

TEST(DirectionCone, InThePlaneTwoFacesHold) {
  const Vector<2> down(0, -1);
  const std::vector<Vector<2>> slope{Vector<2>(std::sin(30 * degree), std::cos(30 * degree))};
  const Projection<2> slides = project(slope, down);
  EXPECT_EQ(slides.loaded, 1);
  EXPECT_NEAR(slides.motion.norm(), 0.5, 1e-15);
  EXPECT_NEAR(slides.forces[0], std::cos(30 * degree), 1e-15);
  const std::vector<Vector<2>> notch{slope[0], Vector<2>(-std::sin(30 * degree), std::cos(30 * degree))};
  EXPECT_EQ(project(notch, down).motion.norm(), 0);
  EXPECT_EQ(project(slope, Vector<2>(0, 1)).loaded, 0);
}

}  // namespace
}  // namespace voussoir::cone_test
