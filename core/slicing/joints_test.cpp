// Cuts by joints of finite extent, of every kind; clumps and excavations.
#include "core/slicing/joint.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "core/model/model.hpp"
#include "core/slicing/block.hpp"
#include "core/slicing/clump.hpp"
#include "core/slicing/slice.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::joints_test {
namespace {

using shapes::Random;

constexpr double volume_tolerance = 1e-12;

const Vector<3> x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

Polytope<3> cube() {
  return shapes::block<3>(shapes::cube<3>(1));
}
Polytope<2> square() {
  return shapes::block<2>(shapes::cube<2>(1));
}

template <int Dim>
std::vector<Polytope<Dim>> sliced(const Polytope<Dim>& domain, std::vector<Cut<Dim>> cuts,
                                  const SlicingLimits& limits = {}, SlicingCounters* counters = nullptr) {
  SlicingCounters own;
  return slice<Dim>(domain, cuts, limits, counters ? *counters : own);
}

std::size_t count(const std::vector<Cut<3>>& cuts) {
  return sliced<3>(cube(), cuts).size();
}

template <int Dim>
double volume(const std::vector<Polytope<Dim>>& parts) {
  double sum = 0;
  for (const Polytope<Dim>& p : parts)
    sum += p.mass.volume;
  return sum;
}

// a vertical wall at x = 0 or, turned, at y = 0, from `low` to `high`
Cut<3> wall(const Vector<3>& normal, double low, double high, int joint) {
  const Vector<3> centre(0, 0, (low + high) / 2);
  return {{normal, 0}, joint, rectangle_extent(normal, centre, 3, high - low)};
}

Cut<2> trace(const Vector<2>& normal, const Vector<2>& from, const Vector<2>& to, int joint) {
  return {{normal, normal.dot(from)}, joint, trace_extent(normal, (from + to) / 2, (to - from).norm())};
}

// ---- outlines ---------------------------------------------------------------------------------------------------

// Eqs 3.11-3.13
TEST(Extent, AxesFollowStrikeAndDip) {
  Random random(61);
  for (int i = 0; i < 100; ++i) {
    const double dip = shapes::uniform(random, 0.01, 1.5), direction = shapes::uniform(random, 0, 6.28);
    const auto axes = plane_axes(upward_normal_3d(dip, direction));
    const Vector<3> strike(std::sin(direction - std::numbers::pi / 2), std::cos(direction - std::numbers::pi / 2), 0);
    const Vector<3> down(std::sin(direction) * std::cos(dip), std::cos(direction) * std::cos(dip), -std::sin(dip));
    EXPECT_LT((axes.col(0) - strike).norm(), 1e-13);
    EXPECT_LT((axes.col(1) - down).norm(), 1e-13);
  }
  EXPECT_EQ((plane_axes(z).transpose() * plane_axes(z)), (Eigen::Matrix2d::Identity()));
  EXPECT_LT(plane_axes(upward_normal_2d(0.5, std::numbers::pi / 2))[1], 0);
  EXPECT_LT(plane_axes(upward_normal_2d(0.5, 3 * std::numbers::pi / 2))[1], 0);
}

// the outline as a prism of height 1: its volume is its area
double area(const Extent<3>& extent, const Vector<3>& normal) {
  HalfSpaces<3> planes = extent.bounds;
  const double offset = normal.dot(extent.centre);
  planes.push_back({normal, offset + 0.5});
  planes.push_back({-normal, 0.5 - offset});
  const Polytope<3> prism = shapes::block<3>(planes);
  for (const Vector<3>& v : prism.vertices)
    EXPECT_LE((v - extent.centre).norm(), std::hypot(extent.radius, 0.5) * (1 + 1e-12));
  return prism.mass.volume;
}

// Eqs 3.9, 3.10, 3.14, 3.15
TEST(Extent, OutlinesHaveTheirAreas) {
  Random random(62);
  for (int i = 0; i < 20; ++i) {
    const Vector<3> normal = upward_normal_3d(shapes::uniform(random, 0, 1.5), shapes::uniform(random, 0, 6));
    const Vector<3> point(3, -2, 1);
    EXPECT_NEAR(area(rectangle_extent(normal, point, 4, 0.5), normal), 2, 1e-12);
    const int sides = 5 + i;
    EXPECT_NEAR(area(ellipse_extent(normal, point, 3, 1, sides), normal),
                0.75 * sides * std::tan(std::numbers::pi / sides), 1e-12);
    EXPECT_NEAR(area(polygon_extent(normal, point, {{0, 0}, {0, 3}, {4, 0}}), normal), 6, 1e-12);  // clockwise
  }
  EXPECT_TRUE(polygon_extent(z, {0, 0, 0}, {{0, 0}, {2, 0}, {0.1, 0.1}, {0, 2}}).infinite());  // not convex
  EXPECT_TRUE(polygon_extent(z, {0, 0, 0}, {{0, 0}, {1, 1}, {2, 2}}).infinite());
  EXPECT_TRUE(polygon_extent(z, {0, 0, 0}, {{0, 0}, {1, 1}}).infinite());
  std::vector<Vector<2>> star;
  for (int k = 0; k < 5; ++k)
    star.emplace_back(std::cos(0.8 * std::numbers::pi * k), std::sin(0.8 * std::numbers::pi * k));
  EXPECT_TRUE(polygon_extent(z, {0, 0, 0}, star).infinite());
}

// Eq. 3.16
TEST(Extent, AJointCutsRightThroughTheBlocksThatItMeetsAndNoOther) {
  const Cut<3> floor{{z, 0}, 0};
  EXPECT_EQ(count({floor, wall(x, 0.2, 0.8, 1)}), 3u);    // inside the upper half: only this is cut
  EXPECT_EQ(count({floor, wall(x, 0, 0.8, 1)}), 3u);      // ends at the floor
  EXPECT_EQ(count({floor, wall(x, -1e-6, 0.8, 1)}), 4u);  // and a little below it
  EXPECT_EQ(count({wall(x, 0.2, 0.8, 1), floor}), 4u);    // cut first, when all is one block
  EXPECT_EQ(count({floor, wall(x, 1.5, 2, 1)}), 2u);      // outside
  // an ellipse does not fill its rectangle: near the cube's edge x = y = 1 one meets it, the other does not
  const Vector<3> centre(1.9, 1.9, 0);
  EXPECT_EQ(count({{{z, 0}, 0, rectangle_extent(z, centre, 2, 2)}}), 2u);
  EXPECT_EQ(count({{{z, 0}, 0, ellipse_extent(z, centre, 2, 2, 32)}}), 1u);
  EXPECT_EQ(count({{{z, 0}, 0, ellipse_extent(z, centre, 2.6, 2.6, 32)}}), 2u);
  // confined to a subdomain
  Cut<3> confined{{x, 0.1}, 1};
  confined.extent.bounds = {{z, -0.01}};
  EXPECT_EQ(count({floor, confined}), 3u);
}

// every joint on every block, by the oracle's program in the joint's plane
std::multiset<double> brute_force(const HalfSpaces<3>& domain, const std::vector<Cut<3>>& cuts) {
  std::vector<HalfSpaces<3>> blocks{domain};
  for (const Cut<3>& cut : cuts) {
    std::vector<HalfSpaces<3>> next;
    for (const HalfSpaces<3>& block : blocks) {
      HalfSpaces<3> all = block;
      all.insert(all.end(), cut.extent.bounds.begin(), cut.extent.bounds.end());
      const auto axes = plane_axes(cut.plane.normal);
      HalfSpaces<2> section;
      for (const HalfSpace<3>& p : all)
        section.push_back({axes.transpose() * p.normal, p.offset - p.normal.dot(cut.plane.normal) * cut.plane.offset});
      HalfSpaces<3> below = block, above = block;
      below.push_back(cut.plane);
      above.push_back({-cut.plane.normal, -cut.plane.offset});
      if (oracle::feasibility<2>(section) < -1e-9L) {
        next.push_back(shapes::block<3>(below).faces);
        next.push_back(shapes::block<3>(above).faces);
      } else {
        next.push_back(block);
      }
    }
    blocks = next;
  }
  std::multiset<double> volumes;
  for (const HalfSpaces<3>& block : blocks)
    volumes.insert(shapes::block<3>(block).mass.volume);
  return volumes;
}

// Eq. 3.16
TEST(Extent, BlocksAreThoseOfBruteForce) {
  Random random(63);
  for (int i = 0; i < 4; ++i) {
    std::vector<Cut<3>> cuts;
    for (int j = 0; j < 14; ++j) {
      const Vector<3> normal = shapes::direction<3>(random), centre = 0.9 * shapes::direction<3>(random);
      const double size = shapes::uniform(random, 0.2, 1.2);
      cuts.push_back({{normal, normal.dot(centre)}, j, ellipse_extent(normal, centre, size, size / 2, 6)});
    }
    const std::multiset<double> expected = brute_force(shapes::cube<3>(1), cuts);
    const auto blocks = sliced<3>(cube(), cuts);
    ASSERT_EQ(blocks.size(), expected.size());
    std::multiset<double> volumes;
    for (const Polytope<3>& b : blocks)
      volumes.insert(b.mass.volume);
    for (auto a = volumes.begin(), b = expected.begin(); a != volumes.end(); ++a, ++b)
      EXPECT_NEAR(*a, *b, volume_tolerance);
  }
}

TEST(CuttingOrder, BySizeAndByTurns) {
  std::vector<Cut<3>> cuts;
  for (int j = 0; j < 6; ++j)
    cuts.push_back({{z, 0}, j, rectangle_extent(z, {0, 0, 0}, 1 + j % 3, 1), j / 3});
  cuts[1].extent = {};
  const auto joints = [](std::vector<Cut<3>> list, CuttingOrder order) {
    put_in_order(list, order);
    std::vector<int> numbers;
    for (const Cut<3>& c : list)
      numbers.push_back(c.joint);
    return numbers;
  };
  EXPECT_EQ(joints(cuts, CuttingOrder::given), (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(joints(cuts, CuttingOrder::by_size), (std::vector<int>{1, 2, 5, 4, 0, 3}));
  EXPECT_EQ(joints(cuts, CuttingOrder::alternating), (std::vector<int>{0, 3, 1, 4, 2, 5}));

  // joints of one size alternate; a boundary comes before and a construction joint after all that are larger
  for (Cut<3>& c : cuts)
    c.extent = {};
  cuts[0].kind = JointKind::construction;
  cuts[5].kind = JointKind::boundary;
  cuts[5].extent = rectangle_extent(z, {0, 0, 0}, 1, 1);
  EXPECT_EQ(joints(cuts, CuttingOrder::by_size), (std::vector<int>{5, 3, 1, 4, 2, 0}));
  EXPECT_EQ(joints(cuts, CuttingOrder::given), (std::vector<int>{0, 1, 2, 3, 4, 5}));
}

// ---- limits -----------------------------------------------------------------------------------------------------

TEST(Limits, ARefusedCutLeavesTheParentBitForBit) {
  // a grid of 64 cubes, and beside each of its joints one that leaves slabs: too thin, or too flat
  std::vector<Cut<3>> sound, all;
  for (int axis = 0; axis < 3; ++axis)
    for (const double offset : {-0.5, 0.0, 0.5}) {
      const int joint = static_cast<int>(sound.size());
      sound.push_back({{Vector<3>::Unit(axis), offset}, joint});
      all.push_back(sound.back());
      all.push_back({{Vector<3>::Unit(axis), offset + 1e-3}, 100 + joint});
    }
  SlicingLimits size;
  size.smallest_inscribed_radius = 6e-4;
  SlicingLimits aspect;
  aspect.largest_aspect_ratio = 100;
  for (const SlicingLimits& limits : {size, aspect}) {
    SlicingCounters counters;
    const auto with = sliced<3>(cube(), all, limits, &counters), without = sliced<3>(cube(), sound, limits);
    ASSERT_EQ(with.size(), 64u);
    ASSERT_EQ(without.size(), 64u);
    EXPECT_GE(counters.undone, 9);
    for (std::size_t b = 0; b < with.size(); ++b) {
      EXPECT_EQ(with[b].joints, without[b].joints);
      EXPECT_EQ(with[b].vertices, without[b].vertices);
      EXPECT_EQ(with[b].mass.second_moment, without[b].mass.second_moment);
    }
  }
}

TEST(Limits, AspectIsThatOfTheBoxOrOfTheBalls) {
  SlicingLimits limits;
  const std::vector<Cut<3>> thin{{{z, 0.8}, 0}};  // 2 x 2 x 0.2: box 10, balls sqrt(2.01)/0.1 = 14.18
  for (const auto& [measure, ratio] : {std::pair(AspectMeasure::box, 10.0), std::pair(AspectMeasure::balls, 14.18)}) {
    limits.aspect_measure = measure;
    limits.largest_aspect_ratio = 1.01 * ratio;
    EXPECT_EQ(sliced<3>(cube(), thin, limits).size(), 2u);
    limits.largest_aspect_ratio = 0.99 * ratio;
    EXPECT_EQ(sliced<3>(cube(), thin, limits).size(), 1u);
  }
}

// ---- kinds, clumps, excavation ----------------------------------------------------------------------------------

TEST(Clump, HealedBlocksAreThoseThatJointsSeparate) {
  const std::vector<Cut<2>> cross{{{Vector<2>(1, 0), 0}, 0}};
  const auto bodies = [&](const Cut<2>& cut) {
    std::vector<Cut<2>> cuts = cross;
    cuts.push_back(cut);
    const auto parts = sliced<2>(square(), cuts);
    const std::vector<int> healed = bodies_of<2>(parts, cuts, true), all = bodies_of<2>(parts, cuts, false);
    EXPECT_EQ(std::set(all.begin(), all.end()).size(), parts.size());
    return std::pair(parts.size(), std::set(healed.begin(), healed.end()).size());
  };
  const Vector<2> up(0, 1);
  EXPECT_EQ(bodies(trace(up, {0, 0.2}, {1, 0.2}, 1)), std::pair(std::size_t{3}, std::size_t{3}));  // from face to face
  EXPECT_EQ(bodies(trace(up, {0, 0.2}, {0.9, 0.2}, 1)), std::pair(std::size_t{3}, std::size_t{2}));   // dangles
  EXPECT_EQ(bodies(trace(up, {-0.5, 0.2}, {1, 0.2}, 1)), std::pair(std::size_t{4}, std::size_t{3}));  // on one side

  // in space: a wall that does not reach the ground
  const std::vector<Cut<3>> walls{{{z, 0}, 0}, wall(x, 0.1, 2, 1), wall(y, -2, 0, 2)};
  const auto parts = sliced<3>(cube(), walls);
  EXPECT_EQ(parts.size(), 4u);
  const std::vector<int> healed = bodies_of<3>(parts, walls, true);
  EXPECT_EQ(std::set(healed.begin(), healed.end()).size(), 3u);
}

TEST(Clump, ConstructionJointsShapeAConcaveBody) {
  // an L of three quarters of the cube: two construction joints outline the corner that is removed
  std::vector<Cut<3>> cuts{{{x, 0}, 0}, {{z, 0}, 1}};
  for (Cut<3>& cut : cuts)
    cut.kind = JointKind::construction;
  auto parts = excavated<3>(sliced<3>(cube(), cuts), {{-x, 0}, {-z, 0}});
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(bodies_of<3>(parts, cuts, false), (std::vector<int>{0, 0, 0}));

  // exact mass: 6 m³, centroid at -1/6; moments about it are 11/3 about y and 23/6 ± 2/3 in the plane of the L
  const Body<3> body = make_body<3>(parts, 1000);
  EXPECT_NEAR(body.mass, 6000, 1e-9);
  EXPECT_LT((body.reference - Vector<3>(-1, 0, -1) / 6).norm(), 1e-15);
  EXPECT_LT((body.inertia - 1000 * Vector<3>(19 / 6.0, 11 / 3.0, 4.5)).norm(), 1e-9);

  // a rock joint between them separates
  cuts[0].kind = JointKind::rock;
  const std::vector<int> two = bodies_of<3>(parts, cuts, false);
  EXPECT_EQ(*std::max_element(two.begin(), two.end()), 1);
  cuts[0].kind = JointKind::fictitious;
  EXPECT_EQ(bodies_of<3>(parts, cuts, false), two);
}

TEST(Clump, ATunnelLeavesOneBodyOfExactVolume) {
  const Vector<3> from(-1, 0.1, 0.2), to(1, 0.1, 0.2);
  const int sides = 12;
  const HalfSpaces<3> tunnel = cylinder_region(from, to, 0.4, sides, 0.1);
  std::vector<Cut<3>> cuts;
  for (std::size_t k = 2; k < tunnel.size(); ++k) {
    cuts.push_back({tunnel[k], static_cast<int>(k)});
    cuts.back().kind = JointKind::construction;
  }
  const auto left = excavated<3>(sliced<3>(cube(), cuts), tunnel);
  EXPECT_NEAR(volume(left), 8 - 2 * sides * 0.16 * std::tan(std::numbers::pi / sides), volume_tolerance);
  const std::vector<int> body = bodies_of<3>(left, cuts, false);
  EXPECT_EQ(*std::max_element(body.begin(), body.end()), 0);

  // at any least block size: a joint may leave no smaller block, the tunnel does
  SlicingLimits large;
  large.smallest_inscribed_radius = 0.3;
  SlicingCounters counters;
  cuts.push_back({{z, 0.7}, 2 + sides});
  EXPECT_NEAR(volume(excavated<3>(slice<3>(cube(), cuts, large, counters), tunnel)), volume(left), volume_tolerance);
  EXPECT_GT(counters.undone, 0);

  const HalfSpaces<2> circle = circle_region({0.1, 0.2}, 0.4, sides);
  std::vector<Cut<2>> lines;
  for (const HalfSpace<2>& p : circle)
    lines.push_back({p, static_cast<int>(lines.size())});
  EXPECT_NEAR(volume(excavated<2>(sliced<2>(square(), lines), circle)),
              4 - sides * 0.16 * std::tan(std::numbers::pi / sides), volume_tolerance);
}

TEST(Kinds, ABoundaryJointLeavesItsSideWhole) {
  std::vector<Cut<3>> cuts{{{z, -0.5}, 7}, {{x, 0}, 1}, {{y, 0}, 2}};
  cuts[0].kind = JointKind::boundary;
  for (const JointSide side : {JointSide::below, JointSide::above}) {
    cuts[0].fixed_side = side;
    const auto parts = sliced<3>(cube(), cuts);
    ASSERT_EQ(parts.size(), 5u);
    const std::vector<int> whole = boundary_parts<3>(parts, cuts);
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_NEAR(parts[whole[0]].mass.volume, side == JointSide::below ? 2 : 6, volume_tolerance);
  }
}

TEST(Kinds, FacesInheritTheirJoint) {
  const std::vector<Cut<3>> cuts{{{z, 0}, 3}, wall(x, 0.2, 0.8, 5)};
  std::multiset<int> joints;
  for (const Polytope<3>& part : sliced<3>(cube(), cuts))
    for (const int joint : part.joints)
      if (joint != no_joint) joints.insert(joint);
  EXPECT_EQ(joints, (std::multiset<int>{3, 3, 3, 5, 5}));
}

}  // namespace
}  // namespace voussoir::joints_test
