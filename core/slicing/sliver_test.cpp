// Blocks near the resolution of double precision: thin, with nearly coplanar faces, barely cut, or far away.
#include <gtest/gtest.h>

#include "core/model/model.hpp"
#include "core/slicing/block.hpp"
#include "core/slicing/slice.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::sliver_test {
namespace {

using shapes::Random;

BlockStatus status_of(const HalfSpaces<3>& planes) {
  return make_block<3>(planes, std::vector<int>(planes.size(), no_joint)).status;
}

TEST(Sliver, ATurnedSlabOrNeedleKeepsItsVolume) {
  // the planes' distances from the block's middle have an error of 1e-16 of its length: that over the thickness
  Random random(31);
  for (const double thin : {1e-3, 1e-5, 1e-7})
    for (int i = 0; i < 20; ++i) {
      const Vector<3> half(0.5, i % 2 ? 0.5 : 0.5 * thin, 0.5 * thin);
      const Polytope<3> part = shapes::block<3>(
          shapes::placed<3>(shapes::box<3>(-half, half), matrix(shapes::orientation<3>(random)), {0.3, 0.2, 0.1}));
      EXPECT_NEAR(part.mass.volume / (8 * half.prod()), 1, 1e-14 / thin);
      EXPECT_EQ(part.vertices.size(), 8u);
    }
}

// Found by fuzzing: of its six faces four have normals in one plane, so that the linear program of the ball meets bases
// that are dependent but for rounding.
TEST(Sliver, ASlabBetweenFacesOfOneZoneHoldsItsBall) {
  const HalfSpaces<3> planes{{{-1, -0, -0}, 2},
                             {{1, 0, 0}, 2},
                             {{-0, -1, -0}, 2},
                             {{0, 1, 0}, 2},
                             {{-0, -0, -1}, 2},
                             {{0, 0, 1}, 2},
                             {{1.726318359375, -1.7412109375, -1.72802734375}, 1.7410888671875},
                             {{1.696533203125, -1.7412109375, -1.6964111328125}, 1.7410888671875},
                             {{1.7410888671875, 1.7410888671875, -3.6251220703125}, 3.9998779296875},
                             {{3.9998779296875, 3.9998779296875, 3.9742431640625}, 3.96875},
                             {{-4, -4, -4}, -3.9981689453125},
                             {{-3.96875, -4, -3.9998779296875}, 1.7410888671875},
                             {{1.7410888671875, 1.7410888671875, 1.7410888671875}, 1.7410888671875}};
  const BlockResult<3> block = make_block<3>(planes, std::vector<int>(planes.size(), no_joint));
  ASSERT_EQ(block.status, BlockStatus::ok);
  EXPECT_NEAR(block.part.inscribed_radius, 1.3214498959113e-4, 1e-15) << "half the distance of its parallel faces";
  for (const HalfSpace<3>& face : block.part.faces)
    EXPECT_LE(signed_distance(face, block.part.centre), -block.part.inscribed_radius + 1e-14);
}

TEST(Sliver, NearlyCoplanarFacesAreNotCountedTwice) {
  Random random(32);
  for (double angle = 1e-2; angle > 1e-13; angle /= 10)
    for (int i = 0; i < 10; ++i) {
      HalfSpaces<3> planes = shapes::cube<3>(0.5);
      const Vector<3> normal(std::sin(angle), 0, std::cos(angle));
      planes.push_back({normal, normal.dot(Vector<3>(0, 0, 0.5))});
      const Polytope<3> part =
          shapes::block<3>(shapes::placed<3>(planes, matrix(shapes::orientation<3>(random)), Vector<3>::Zero()));
      // the wedge beyond the hinge is gone, or too thin to be seen
      EXPECT_NEAR(part.mass.volume, 1 - std::tan(angle) / 8, 1e-9) << angle;
    }
}

TEST(Sliver, ABarelyCutBlockIsWholeOrUndone) {
  Random random(33);
  for (double depth = 1e-6; depth > 1e-12; depth /= 10)
    for (int i = 0; i < 10; ++i) {
      const Polytope<3> block = shapes::block<3>(shapes::random_planes<3>(random, 5, 0.5));
      const HalfSpace<3>& face = block.faces[i % block.faces.size()];
      SlicingCounters counters;
      const auto pieces = slice<3>(block, {{{face.normal, face.offset - depth}, 0}}, {}, counters);
      double volume = 0;
      for (const Polytope<3>& p : pieces)
        volume += p.mass.volume;
      EXPECT_NEAR(volume, block.mass.volume, 1e-13);
      EXPECT_EQ(pieces.size(), counters.undone || depth < 1e-10 ? 1u : 2u);
      EXPECT_TRUE(depth < 1e-7 || counters.undone == 0);
    }
}

TEST(Sliver, TooThinOrTooFarIsRefusedByName) {
  EXPECT_EQ(status_of(shapes::box<3>({0, 0, 0}, {1, 1, 1e-7})), BlockStatus::ok);
  EXPECT_EQ(status_of(shapes::box<3>({0, 0, 0}, {1, 1, 1e-9})), BlockStatus::flat);
  EXPECT_EQ(status_of(shapes::box<3>({1e8, 0, 0}, {1e8 + 1, 1, 1})), BlockStatus::ok);
  EXPECT_EQ(status_of(shapes::box<3>({1e11, 0, 0}, {1e11 + 1, 1, 1})), BlockStatus::far);
}

TEST(Sliver, InertiaSurvivesTheDistance) {
  // coordinates at 1e7 have an error of 1e-9, and no more than that is lost
  const Vector<3> low(1e7, -2e7, 5e6);
  const Body<3> body = make_body<3>({shapes::block<3>(shapes::box<3>(low, low + Vector<3>(1, 1, 1)))}, 1);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(body.inertia[k], 1 / 6.0, 1e-7);
}

TEST(Sliver, AThousandFacesTakeNoTime) {
  Random random(34);
  HalfSpaces<3> planes;
  for (int i = 0; i < 1000; ++i)
    planes.push_back({shapes::direction<3>(random), 1});
  const Polytope<3> part = shapes::block<3>(planes);
  EXPECT_EQ(part.faces.size(), 1000u);
  EXPECT_EQ(part.vertices.size(), 1996u);  // Euler, three faces at each
  double surface = 0;
  for (int f = 0; f < 1000; ++f)
    surface += face_area<3>(part, f);
  EXPECT_NEAR(part.mass.volume, surface / 3, 1e-12);  // every face touches the unit ball
}

}  // namespace
}  // namespace voussoir::sliver_test
