// The rule that names how an opening fails, on made motions.
#include "reference/tunnel/mechanism.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace voussoir::reference::mechanism_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

// 75 E, 25 E, 25 W
const std::vector<JointSet> sets{{75 * degree, true}, {25 * degree, true}, {25 * degree, false}};

std::pair<double, double> down(const JointSet& set) {
  return {set.to_right ? std::cos(set.dip) : -std::cos(set.dip), -std::sin(set.dip)};
}

// The normal of a set's joint, upwards.
std::pair<double, double> upward(const JointSet& set) {
  return {set.to_right ? std::sin(set.dip) : -std::sin(set.dip), std::cos(set.dip)};
}

// A moved block of 2 m2 at (x, y), block 0, and rock around it that stays: one block for each joint that bounds it.
struct Made {
  std::vector<BlockMotion> blocks;
  std::vector<JointStretch> joints;

  Made(double x, double y, double dx, double dy, double turn = 0) { blocks.push_back({x, y, 2, dx, dy, turn}); }

  // the joint above the block, or below it, on the side of the set's normal
  Made& bounded(int set, bool above, double length = 1) {
    const auto [nx, ny] = upward(sets[set]);
    const double sign = above ? 1 : -1;
    blocks.push_back({blocks[0].x + sign * nx, blocks[0].y + sign * ny, 2, 0, 0, 0});
    joints.push_back({0, static_cast<int>(blocks.size()) - 1, sign * nx, sign * ny, length, set});
    return *this;
  }

  Mechanism at(Place place) const { return mechanisms(blocks, joints, sets)[static_cast<int>(place)]; }
};

TEST(Mechanism, NothingMoves) {
  const Made made = Made(0, 6, 0.001, -0.01).bounded(0, true).bounded(2, true);
  for (const Mechanism& m : mechanisms(made.blocks, made.joints, sets)) {
    EXPECT_EQ(m.kind, Kind::none);
    EXPECT_EQ(m.area, 0);
  }
}

TEST(Mechanism, ASplinterIsNoMechanism) {
  Made made(0, 6, 0, -1);
  made.blocks[0].area = 0.05;
  EXPECT_EQ(made.at(Place::roof).kind, Kind::none);
  EXPECT_EQ(made.at(Place::roof).area, 0.05);
}

TEST(Mechanism, AnUnsupportedBlockFalls) {
  const Mechanism found = Made(0, 6, 0, -1).bounded(1, true).bounded(2, true, 0.2).at(Place::roof);
  EXPECT_EQ(found.kind, Kind::fall);
  EXPECT_EQ(found.area, 2);
  EXPECT_EQ(found.dy, -1);
}

TEST(Mechanism, ABlockSlidesAlongEachSet) {
  for (int set = 0; set < 3; ++set) {
    const auto [x, y] = down(sets[set]);
    for (const auto& [place, px] : {std::pair(Place::left_wall, -7.0), {Place::right_wall, 7.0}}) {
      const Mechanism found = Made(px, 0, x, y).bounded(set, false).at(place);
      EXPECT_EQ(found.kind, Kind::slide);
      EXPECT_EQ(found.first_set, set);
    }
  }
}

TEST(Mechanism, ASlideNeedsTheJointBeneathAndTheDirection) {
  const auto [x, y] = down(sets[1]);
  EXPECT_EQ(Made(-7, 0, x, y).bounded(1, true).at(Place::left_wall).kind, Kind::fall);
  EXPECT_EQ(Made(-7, 0, 0, -1).bounded(1, false).at(Place::left_wall).kind, Kind::fall);
  EXPECT_EQ(Made(-7, 0, -x, -y).bounded(1, false).at(Place::left_wall).kind, Kind::fall);
  // 14 and 16 degrees off the trace
  const auto turned = [](double degrees) {
    const double at = (-25 + degrees) * degree;
    return Made(-7, 0, std::cos(at), std::sin(at)).bounded(1, false).at(Place::left_wall).kind;
  };
  EXPECT_EQ(turned(14), Kind::slide);
  EXPECT_EQ(turned(16), Kind::fall);
  EXPECT_EQ(turned(-14), Kind::slide);
  EXPECT_EQ(turned(-16), Kind::fall);
}

// Between a joint of 25 W at its left, which rises to the right, and one of 25 E or 75 E at its right.
TEST(Mechanism, AWedgeOfEachPairThatNarrowsUpwards) {
  for (const int right : {0, 1}) {
    const Mechanism found = Made(0, 6, 0, -1).bounded(2, true).bounded(right, true).at(Place::roof);
    EXPECT_EQ(found.kind, Kind::wedge);
    EXPECT_EQ(found.first_set, 2);
    EXPECT_EQ(found.second_set, right);
  }
  // Both dip to the right: 75 E at its left is beneath it, 25 E at its right above.
  const Mechanism leaning = Made(0, 6, 0.3, -1).bounded(0, false).bounded(1, true).at(Place::roof);
  EXPECT_EQ(leaning.kind, Kind::wedge);
  EXPECT_EQ(leaning.first_set, 0);
  EXPECT_EQ(leaning.second_set, 1);
}

TEST(Mechanism, AWedgeThatWidensUpwardsIsNone) {
  EXPECT_EQ(Made(0, 6, 0, -1).bounded(1, false).bounded(2, false).at(Place::roof).kind, Kind::fall);
  EXPECT_EQ(Made(0, 6, 0, -1).bounded(1, false).bounded(0, true).at(Place::roof).kind, Kind::fall);
}

TEST(Mechanism, AShortFlankMakesNoWedge) {
  EXPECT_EQ(Made(0, 6, 0, -1).bounded(2, true, 0.2).bounded(0, true, 1).at(Place::roof).kind, Kind::fall);
}

TEST(Mechanism, ABlockThatTurnsTopples) {
  const auto [x, y] = down(sets[1]);
  EXPECT_EQ(Made(7, 0, x, y, 0.5).bounded(1, false).at(Place::right_wall).kind, Kind::topple);
  EXPECT_EQ(Made(7, 0, x, y, 0.3).bounded(1, false).at(Place::right_wall).kind, Kind::slide);
  EXPECT_EQ(Made(0, 7, 0, -1, 0.5).at(Place::roof).kind, Kind::fall);
}

TEST(Mechanism, EachPlaceForItself) {
  Made made(0, 7, 0, -1);
  made.blocks.push_back({-7, 0, 3, 0.5, -0.3, 0});
  made.blocks.push_back({7, 1, 1, -0.5, -0.5, 2});
  made.blocks.push_back({0, -7, 1, 0, 0.01, 0});
  const std::vector<Mechanism> found = mechanisms(made.blocks, made.joints, sets);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].area, 2);
  EXPECT_EQ(found[1].area, 3);
  EXPECT_EQ(found[2].kind, Kind::topple);
  EXPECT_EQ(found[3].kind, Kind::none);
}

// A joint between two moved blocks is not part of their boundary; which block is the first does not matter.
TEST(Mechanism, JointsBetweenMovedBlocksDoNotCount) {
  Made made = Made(0, 6, 0, -1).bounded(2, true).bounded(0, true);
  made.blocks.push_back({0, 7, 2, 0, -1, 0});
  const int last = static_cast<int>(made.blocks.size()) - 1;
  made.joints.push_back({0, last, 0, 1, 100, 1});
  EXPECT_EQ(made.at(Place::roof).kind, Kind::wedge);
  for (JointStretch& joint : made.joints) {
    std::swap(joint.first, joint.second);
    joint.nx = -joint.nx;
    joint.ny = -joint.ny;
  }
  EXPECT_EQ(made.at(Place::roof).kind, Kind::wedge);
}

// Mirrored, the same with left and right exchanged.
TEST(Mechanism, MirroredMotionsGiveMirroredMechanisms) {
  Made made = Made(-7, 1, 0.9, -0.4).bounded(1, false).bounded(0, true, 0.3);
  std::vector<BlockMotion> blocks = made.blocks;
  std::vector<JointStretch> joints = made.joints;
  std::vector<JointSet> mirrored = sets;
  for (BlockMotion& b : blocks)
    b.x = -b.x, b.dx = -b.dx;
  for (JointStretch& j : joints)
    j.nx = -j.nx;
  for (JointSet& s : mirrored)
    s.to_right = !s.to_right;
  const Mechanism left = made.at(Place::left_wall), right = mechanisms(blocks, joints, mirrored)[2];
  EXPECT_EQ(left.kind, right.kind);
  EXPECT_EQ(left.first_set, right.first_set);
  EXPECT_EQ(left.kind, Kind::slide);
}

TEST(Mechanism, RefusesBlocksAndSetsThatDoNotExist) {
  Made made = Made(0, 6, 0, -1).bounded(0, true);
  made.joints[0].set = 3;
  EXPECT_THROW(mechanisms(made.blocks, made.joints, sets), std::invalid_argument);
  made.joints[0] = {0, 2, 1, 0, 1, 0};
  EXPECT_THROW(mechanisms(made.blocks, made.joints, sets), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::mechanism_test
