#include "reference/key_blocks/judged_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::judged_mass_test {
namespace {

// a box turned about y: x falls by `dip`
MassBlock box(Vector3 low, Vector3 high, double dip, bool fixed) {
  const double c = std::cos(dip), s = std::sin(dip);
  const auto turned = [&](double x, double y, double z) { return Vector3{c * x + s * z, y, -s * x + c * z}; };
  MassBlock block;
  block.fixed = fixed;
  block.volume = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
  for (int axis = 0; axis < 3; ++axis)
    for (const bool top : {false, true}) {
      MassFace face;
      Vector3 outward{};
      outward[axis] = top ? 1 : -1;
      face.outward = turned(outward[0], outward[1], outward[2]);
      for (int k = 0; k < 4; ++k) {
        Vector3 corner{};
        corner[axis] = top ? high[axis] : low[axis];
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        corner[u] = k == 1 || k == 2 ? high[u] : low[u];
        corner[v] = k >= 2 ? high[v] : low[v];
        face.corners.push_back(turned(corner[0], corner[1], corner[2]));
      }
      block.faces.push_back(face);
    }
  return block;
}

// two boxes in a row on a plane that dips along x
JudgedMass row(double dip, double friction, bool wall) {
  BlockMass mass;
  mass.load = {0, 0, -25e3};
  mass.tan_friction = std::tan(friction);
  mass.blocks = {box({-5, -5, -1}, {5, 5, 0}, dip, true), box({0, 0, 0}, {1, 1, 2}, dip, false),
                 box({1, 0, 0}, {3, 1, 1}, dip, false)};
  if (wall) mass.blocks.push_back(box({3, -5, 0}, {4, 5, 2}, dip, true));
  return JudgedMass(mass);
}

TEST(JudgedMass, WorkedValues) {
  const JudgedMass mass = row(30 * degree, 20 * degree, false);
  ASSERT_EQ(mass.contacts().size(), 3u);
  double area = 0;
  for (const MassContact& contact : mass.contacts())
    area += contact.area;
  EXPECT_NEAR(area, 1 + 2 + 1, 1e-12);
  const JudgedBlock lower = mass.judge({2});
  EXPECT_EQ(lower.verdict, MassVerdict::one_face);
  EXPECT_NEAR(lower.factor, std::tan(20 * degree) / std::tan(30 * degree), 1e-12);
  EXPECT_NEAR(lower.direction[2], -0.5, 1e-12);
  EXPECT_EQ(mass.judge({1}).verdict, MassVerdict::stable);  // held by the other
  EXPECT_NEAR(mass.judge({1, 2}).factor, lower.factor, 1e-12);
  EXPECT_EQ(mass.pairs(), (std::vector<std::pair<int, int>>{{1, 2}}));
  EXPECT_EQ(mass.rounds(1), (std::vector<std::vector<int>>{{2}, {1}}));
  EXPECT_TRUE(mass.rounds(0.5).empty());
}

TEST(JudgedMass, AWallHoldsTheRow) {
  const JudgedMass mass = row(30 * degree, 20 * degree, true);
  EXPECT_EQ(mass.judge({2}).verdict, MassVerdict::stable);
  EXPECT_EQ(mass.judge({1, 2}).verdict, MassVerdict::stable);
  EXPECT_TRUE(mass.rounds(1).empty());
  // without the wall it goes
  EXPECT_EQ(mass.judge({2}, {0, 0, 0, 1}).verdict, MassVerdict::one_face);
}

TEST(JudgedMass, ABoxAmongBoxesIsEnclosedOrTapered) {
  BlockMass mass;
  mass.load = {0, 0, -25e3};
  mass.blocks = {box({0, 0, 0}, {1, 1, 1}, 0, false)};
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      Vector3 low{0, 0, 0}, high{1, 1, 1};
      low[axis] += side;
      high[axis] += side;
      mass.blocks.push_back(box(low, high, 0, true));
    }
  EXPECT_EQ(JudgedMass(mass).judge({0}).verdict, MassVerdict::enclosed);
  mass.blocks.back() = box({0, 0, 1}, {0.5, 1, 2}, 0, true);  // half of its roof
  EXPECT_EQ(JudgedMass(mass).judge({0}).verdict, MassVerdict::tapered);
  mass.blocks.pop_back();
  EXPECT_EQ(JudgedMass(mass).judge({0}).verdict, MassVerdict::stable);
  mass.blocks.erase(mass.blocks.begin() + 5);  // its floor
  EXPECT_EQ(JudgedMass(mass).judge({0}).verdict, MassVerdict::falls);
}

TEST(JudgedMass, RefusesBadInput) {
  EXPECT_THROW(JudgedMass(BlockMass{}), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::judged_mass_test
