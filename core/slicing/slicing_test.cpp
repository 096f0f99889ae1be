// Blocks from planes, and blocks from joints, against counts, volumes and enumeration.
#include "core/slicing/slice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "core/slicing/block.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::slicing_test {
namespace {

using shapes::Random;

// volumes of well-shaped blocks have three to four digits less than a double
constexpr double volume_tolerance = 1e-12;

// slices of random joints may be needles, whose own volume is less exact than that of the domain
constexpr double sliver_tolerance = 1e-9;

// at 1e6 m from the origin coordinates of 1 m blocks are given to 1e-10
constexpr double far_origin_tolerance = 1e-8;

template <int Dim>
std::vector<Polytope<Dim>> cut(const Polytope<Dim>& domain, const std::vector<HalfSpace<Dim>>& planes,
                               SlicingCounters* counters = nullptr, const SlicingLimits& limits = {}) {
  std::vector<Cut<Dim>> cuts;
  for (const HalfSpace<Dim>& p : planes)
    cuts.push_back({p, static_cast<int>(cuts.size())});
  SlicingCounters own;
  return slice<Dim>(domain, cuts, limits, counters ? *counters : own);
}

template <int Dim>
double total_volume(const std::vector<Polytope<Dim>>& blocks) {
  double sum = 0;
  for (const Polytope<Dim>& b : blocks)
    sum += b.mass.volume;
  return sum;
}

template <int Dim>
HalfSpaces<Dim> random_joints(Random& random, int count, double spread) {
  HalfSpaces<Dim> planes;
  for (int i = 0; i < count; ++i)
    planes.push_back({shapes::direction<Dim>(random), shapes::uniform(random, -spread, spread)});
  return planes;
}

template <int Dim>
HalfSpaces<Dim> axis_joints(int per_axis) {
  HalfSpaces<Dim> planes;
  for (int axis = 0; axis < Dim; ++axis)
    for (int i = 1; i < per_axis; ++i)
      planes.push_back({Vector<Dim>::Unit(axis), static_cast<double>(i)});
  return planes;
}

// ---- blocks from planes ---------------------------------------------------------------------------------------------

template <int Dim>
BlockStatus status_of(const HalfSpaces<Dim>& planes) {
  return make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint)).status;
}

TEST(MakeBlock, NamesTheFault) {
  EXPECT_EQ(status_of<3>(shapes::cube<3>(1)), BlockStatus::ok);
  HalfSpaces<3> open = shapes::cube<3>(1);
  open.pop_back();
  EXPECT_EQ(status_of<3>(open), BlockStatus::open);
  EXPECT_EQ(status_of<2>({{Vector<2>(1, 0), 1}, {Vector<2>(-1, 0), 1}}), BlockStatus::open);
  EXPECT_EQ(status_of<3>(shapes::box<3>({0, 0, 0}, {1, 1, 0})), BlockStatus::empty);
  EXPECT_EQ(status_of<3>(shapes::box<3>({0, 0, 1}, {1, 1, 0})), BlockStatus::empty);
  EXPECT_EQ(status_of<2>(shapes::box<2>({0, 1}, {1, 0})), BlockStatus::empty);

  HalfSpaces<3> bad = shapes::cube<3>(1);
  bad[4].normal.setZero();
  EXPECT_EQ(make_block<3>(bad, std::vector<int>(6, no_joint)).status, BlockStatus::bad_plane);
  EXPECT_EQ(make_block<3>(bad, std::vector<int>(6, no_joint)).plane, 4);
  bad = shapes::cube<3>(1);
  bad[2].offset = std::numeric_limits<double>::infinity();
  EXPECT_EQ(make_block<3>(bad, std::vector<int>(6, no_joint)).plane, 2);
}

// Eq. 3.8
TEST(MakeBlock, NormalisesAndDropsRedundantPlanes) {
  Random random(21);
  for (int i = 0; i < 50; ++i) {
    const HalfSpaces<3> needed = shapes::block<3>(shapes::random_planes<3>(random, 6, 1)).faces;
    const Polytope<3> expected = shapes::block<3>(needed);
    HalfSpaces<3> planes = needed;
    for (int k = 0; k < 6; ++k)
      planes.push_back({shapes::direction<3>(random), 2.2});  // beyond every corner
    for (const Vector<3>& v : expected.vertices) {
      Vector<3> out = Vector<3>::Zero();  // a direction in which this corner is the farthest point
      for (const HalfSpace<3>& f : expected.faces)
        if (std::abs(signed_distance<3>(f, v)) < 1e-9) out += f.normal;
      out.normalize();
      planes.push_back({out, out.dot(v) + 1e-6});
    }
    for (HalfSpace<3>& p : planes) {
      const double length = shapes::power_of_ten(random, -3, 3);
      p.normal *= length;
      p.offset *= length;
    }
    shapes::shuffle(planes, random);
    const Polytope<3> part = shapes::block<3>(planes);
    EXPECT_EQ(part.faces.size(), needed.size());
    EXPECT_NEAR(part.mass.volume, expected.mass.volume, volume_tolerance);
    for (const HalfSpace<3>& f : part.faces)
      EXPECT_NEAR(f.normal.norm(), 1, 1e-15);
  }
}

TEST(MakeBlock, OfEqualPlanesTheLastOneStays) {
  HalfSpaces<3> planes = shapes::cube<3>(1);
  planes.push_back(planes[0]);
  planes.push_back({2 * planes[3].normal, 2 * planes[3].offset});
  BlockResult<3> r = make_block<3>(planes, {10, 11, 12, 13, 14, 15, 16, 17});
  ASSERT_EQ(r.status, BlockStatus::ok);
  std::sort(r.part.joints.begin(), r.part.joints.end());
  EXPECT_EQ(r.part.joints, (std::vector<int>{11, 12, 14, 15, 16, 17}));
}

// x + y <= 1 and x + y >= 1, whose unit normals and offsets round: the region between them is rounding, no block
TEST(MakeBlock, PlanesThatOnlyTouchMakeNoBlock) {
  HalfSpaces<2> planes = shapes::cube<2>(1.5);
  planes.push_back({{0.4234619140625, 0.4234619140625}, 0.4234619140625});
  planes.push_back({{-3.9058837890625, -3.7808837890625}, 2.861083984375});
  planes.push_back({{-1.4810791015625, 3.974365234375}, -3.9949951171875});
  planes.push_back({{-4, -4}, -4});
  EXPECT_EQ(make_block<2>(planes, std::vector<int>(planes.size(), no_joint)).status, BlockStatus::empty);
}

TEST(MakeBlock, RegularShapesWithManyEqualBallsSucceed) {
  // planes tangent to one ball leave the LP's optimum degenerate, at any orientation
  Random random(22);
  int failures = 0;
  for (int i = 0; i < 600; ++i) {
    const Vector<2> shift2 = 3 * shapes::normal_vector<2>(random);
    const Vector<3> shift3 = 3 * shapes::normal_vector<3>(random);
    const Matrix<2> turn2 = matrix(shapes::orientation<2>(random));
    const Matrix<3> turn3 = matrix(shapes::orientation<3>(random));
    const int sides = 3 + i % 30;
    failures += status_of<2>(shapes::placed<2>(shapes::regular_polygon(sides, 1), turn2, shift2)) != BlockStatus::ok;
    failures += status_of<3>(shapes::placed<3>(shapes::pyramid(sides, 1, 2), turn3, shift3)) != BlockStatus::ok;
    failures +=
        status_of<3>(shapes::placed<3>(shapes::platonic_solids(1)[i % 5].planes, turn3, shift3)) != BlockStatus::ok;
    failures += status_of<3>(shapes::placed<3>(shapes::box<3>({-1, -1e-3, -1e-3}, {1, 1e-3, 1e-3}), turn3,
                                               {0, 0, 0})) != BlockStatus::ok;
  }
  EXPECT_EQ(failures, 0);
}

TEST(HullPlanes, GiveBackTheBlock) {
  Random random(23);
  for (int i = 0; i < 30; ++i) {
    const Polytope<3> part = shapes::block<3>(shapes::random_planes<3>(random, 6, 1));
    std::vector<Vector<3>> points = part.vertices;
    for (int k = 0; k < 5; ++k)
      points.push_back(0.3 * shapes::direction<3>(random));
    shapes::shuffle(points, random);
    int hidden = -1;
    const Polytope<3> again = shapes::block<3>(hull_planes<3>(points, &hidden));
    EXPECT_EQ(hidden, 5);
    EXPECT_EQ(again.faces.size(), part.faces.size());
    EXPECT_NEAR(again.mass.volume, part.mass.volume, sliver_tolerance);

    const Polytope<2> flat = shapes::block<2>(shapes::random_planes<2>(random, 5, 1));
    std::vector<Vector<2>> corners = flat.vertices;
    corners.push_back(0.5 * (flat.vertices[flat.loops[0][0]] + flat.vertices[flat.loops[0][1]]));  // on an edge
    const Polytope<2> flat_again = shapes::block<2>(hull_planes<2>(corners, &hidden));
    EXPECT_EQ(hidden, 1);
    EXPECT_NEAR(flat_again.mass.volume, flat.mass.volume, sliver_tolerance);
  }
  EXPECT_TRUE(hull_planes<3>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).size() < 4);
}

// ---- counts ---------------------------------------------------------------------------------------------------------

TEST(Slice, ParallelJointsMakeOneBlockMore) {
  Random random(24);
  for (int n = 0; n < 20; ++n) {
    const Vector<3> normal = shapes::direction<3>(random);
    HalfSpaces<3> planes;
    for (int i = 0; i < n; ++i)
      planes.push_back({normal, -0.9 + 1.8 * i / std::max(n - 1, 1)});
    shapes::shuffle(planes, random);
    const std::vector<Polytope<3>> blocks = cut<3>(shapes::block<3>(shapes::cube<3>(1)), planes);
    EXPECT_EQ(static_cast<int>(blocks.size()), n + 1);
    EXPECT_NEAR(total_volume<3>(blocks), 8, 8 * volume_tolerance);
  }
}

TEST(Slice, PlanesThroughALineMakeTwiceTheirNumber) {
  Random random(25);
  for (int n = 1; n < 12; ++n) {
    HalfSpaces<3> planes;
    HalfSpaces<2> lines;
    const double turn = shapes::uniform(random, 0, 1);
    for (int i = 0; i < n; ++i) {
      const double angle = turn + std::numbers::pi * i / n;
      planes.push_back({Vector<3>(std::cos(angle), std::sin(angle), 0), 0});
      lines.push_back({Vector<2>(std::cos(angle), std::sin(angle)), 0});
    }
    EXPECT_EQ(static_cast<int>(cut<3>(shapes::block<3>(shapes::cube<3>(1)), planes).size()), 2 * n);
    EXPECT_EQ(static_cast<int>(cut<2>(shapes::block<2>(shapes::cube<2>(1)), lines).size()), 2 * n);
  }
}

// every combination of sides whose region has an interior
template <int Dim>
int count_regions(const HalfSpaces<Dim>& domain, const HalfSpaces<Dim>& joints) {
  int count = 0;
  for (int sides = 0; sides < 1 << joints.size(); ++sides) {
    HalfSpaces<Dim> region = domain;
    for (std::size_t k = 0; k < joints.size(); ++k) {
      const double sign = sides >> k & 1 ? -1 : 1;
      region.push_back({sign * joints[k].normal, sign * joints[k].offset});
    }
    count += oracle::feasibility<Dim>(region) < -1e-9L;
  }
  return count;
}

TEST(Slice, GeneralPlanesMakeTheBlocksOfEnumeration) {
  Random random(26);
  for (int i = 0; i < 4; ++i) {
    const HalfSpaces<3> planes = random_joints<3>(random, 4, 0.8);
    EXPECT_EQ(static_cast<int>(cut<3>(shapes::block<3>(shapes::cube<3>(1)), planes).size()),
              count_regions<3>(shapes::cube<3>(1), planes));
    const HalfSpaces<2> lines = random_joints<2>(random, 6, 0.8);
    EXPECT_EQ(static_cast<int>(cut<2>(shapes::block<2>(shapes::cube<2>(1)), lines).size()),
              count_regions<2>(shapes::cube<2>(1), lines));
  }
}

TEST(Slice, AnIntegerGridIsExact) {
  for (const int n : {2, 5}) {
    const Vector<3> high = Vector<3>::Constant(n);
    const std::vector<Polytope<3>> cubes = cut<3>(shapes::block<3>(shapes::box<3>({0, 0, 0}, high)), axis_joints<3>(n));
    ASSERT_EQ(static_cast<int>(cubes.size()), n * n * n);
    for (const Polytope<3>& c : cubes) {
      EXPECT_EQ(c.faces.size(), 6u);
      EXPECT_EQ(c.vertices.size(), 8u);
      EXPECT_NEAR(c.mass.volume, 1, volume_tolerance);
    }
    const std::vector<Polytope<2>> squares =
        cut<2>(shapes::block<2>(shapes::box<2>({0, 0}, Vector<2>::Constant(n))), axis_joints<2>(n));
    ASSERT_EQ(static_cast<int>(squares.size()), n * n);
    // canonical order: by x first
    for (int i = 0; i < n * n; ++i)
      EXPECT_NEAR(squares[i].mass.centroid[0], i / n + 0.5, volume_tolerance);
  }
}

TEST(Slice, AnOctahedronCutAlongItsPlanesIsEightTetrahedra) {
  const std::vector<Polytope<3>> blocks =
      cut<3>(shapes::block<3>(shapes::platonic_solids(1)[2].planes),
             {{Vector<3>::UnitX(), 0}, {Vector<3>::UnitY(), 0}, {Vector<3>::UnitZ(), 0}});
  ASSERT_EQ(blocks.size(), 8u);
  for (const Polytope<3>& b : blocks) {
    EXPECT_EQ(b.faces.size(), 4u);
    EXPECT_NEAR(b.mass.volume, std::pow(3, 1.5) / 6, volume_tolerance);
  }
}

TEST(Slice, ACubeCutAcrossItsDiagonalShowsAHexagon) {
  const double edge = 2;
  const HalfSpace<3> diagonal{Vector<3>(1, 1, 1).normalized(), 0};
  const std::vector<Polytope<3>> halves = cut<3>(shapes::block<3>(shapes::cube<3>(edge / 2)), {diagonal});
  ASSERT_EQ(halves.size(), 2u);
  for (const Polytope<3>& h : halves) {
    EXPECT_NEAR(h.mass.volume, 4, volume_tolerance);
    EXPECT_EQ(h.faces.size(), 7u);
    for (std::size_t f = 0; f < h.faces.size(); ++f) {
      if (h.joints[f] == no_joint) continue;
      EXPECT_EQ(h.loops[f].size(), 6u);
      EXPECT_NEAR(face_area<3>(h, static_cast<int>(f)), 3 * std::sqrt(3.0) / 4 * edge * edge, volume_tolerance);
    }
  }
}

// ---- properties -----------------------------------------------------------------------------------------------------

// Eq. 3.7
TEST(Slice, TouchingPlanesCutNothing) {
  const Polytope<3> cube = shapes::block<3>(shapes::cube<3>(1));
  SlicingCounters counters;
  const double s3 = std::sqrt(3.0), s2 = std::sqrt(2.0);
  EXPECT_EQ(cut<3>(cube,
                   {
                       {Vector<3>(1, 0, 0), 1},
                       {Vector<3>(0, 0, 1), -1},               // faces
                       {Vector<3>(1, 1, 0).normalized(), s2},  // edge
                       {Vector<3>(1, 1, 1).normalized(), s3},
                       {Vector<3>(0, 1, 0), 7}  // corner, outside
                   },
                   &counters)
                .size(),
            1u);
  EXPECT_EQ(counters.cuts, 0);
  EXPECT_EQ(cut<2>(shapes::block<2>(shapes::cube<2>(1)), {{Vector<2>(1, 1).normalized(), s2}}).size(), 1u);
}

template <int Dim>
void expect_volume_and_memory(Random& random, int joints) {
  const Polytope<Dim> domain = shapes::block<Dim>(shapes::random_planes<Dim>(random, 4, 1));
  const HalfSpaces<Dim> planes = random_joints<Dim>(random, joints, 0.7);
  const std::vector<Polytope<Dim>> blocks = cut<Dim>(domain, planes);
  EXPECT_GT(static_cast<int>(blocks.size()), joints);
  EXPECT_NEAR(total_volume<Dim>(blocks), domain.mass.volume, volume_tolerance * domain.mass.volume);

  // a face with the number of a joint lies on it; each joint's faces, seen from below and above, have the same area
  std::vector<double> net(planes.size(), 0);
  for (const Polytope<Dim>& b : blocks)
    for (std::size_t f = 0; f < b.faces.size(); ++f) {
      if (b.joints[f] == no_joint) continue;
      const HalfSpace<Dim>& plane = planes[b.joints[f]];
      const double side = b.faces[f].normal.dot(plane.normal);
      EXPECT_NEAR(std::abs(side), 1, 1e-14);
      EXPECT_NEAR(b.faces[f].offset, side * plane.offset, 1e-14);
      net[b.joints[f]] += side * face_area<Dim>(b, static_cast<int>(f));
    }
  for (const double n : net)
    EXPECT_NEAR(n, 0, sliver_tolerance);
}

TEST(Slice, KeepsTheVolumeAndRemembersJoints) {
  Random random(27);
  for (int i = 0; i < 5; ++i) {
    expect_volume_and_memory<3>(random, 8);
    expect_volume_and_memory<2>(random, 20);
  }
}

template <int Dim>
void expect_same_blocks(const std::vector<Polytope<Dim>>& a, const std::vector<Polytope<Dim>>& b, double factor,
                        const Vector<Dim>& shift, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  // matched by nearest centroid: rounding may swap neighbours in the canonical order
  for (const Polytope<Dim>& block : a) {
    const Vector<Dim> centroid = factor * block.mass.centroid + shift;
    double nearest = 1e300;
    const Polytope<Dim>* match = nullptr;
    for (const Polytope<Dim>& other : b)
      if ((other.mass.centroid - centroid).norm() < nearest) {
        nearest = (other.mass.centroid - centroid).norm();
        match = &other;
      }
    EXPECT_LT(nearest, tolerance * factor);
    EXPECT_EQ(match->faces.size(), block.faces.size());
    EXPECT_EQ(match->vertices.size(), block.vertices.size());
    EXPECT_NEAR(match->mass.volume, std::pow(factor, Dim) * block.mass.volume, tolerance * std::pow(factor, Dim));
  }
}

template <int Dim>
void expect_invariance(std::uint64_t seed, int joints) {
  Random random(seed);
  HalfSpaces<Dim> planes = random_joints<Dim>(random, joints, 0.7);
  const Vector<Dim> none = Vector<Dim>::Zero();
  const std::vector<Polytope<Dim>> blocks = cut<Dim>(shapes::block<Dim>(shapes::cube<Dim>(1)), planes);

  // 1 mm and 10 km
  for (const double factor : {1e-3, 1e4})
    expect_same_blocks<Dim>(
        blocks, cut<Dim>(shapes::block<Dim>(shapes::cube<Dim>(factor)), shapes::scaled<Dim>(planes, factor)), factor,
        none, sliver_tolerance);

  // another place
  const Vector<Dim> shift = 1e6 * shapes::direction<Dim>(random);
  const HalfSpaces<Dim> domain = shapes::placed<Dim>(shapes::cube<Dim>(1), Matrix<Dim>::Identity(), shift);
  expect_same_blocks<Dim>(
      blocks, cut<Dim>(shapes::block<Dim>(domain), shapes::placed<Dim>(planes, Matrix<Dim>::Identity(), shift)), 1,
      shift, far_origin_tolerance);

  // another order
  shapes::shuffle(planes, random);
  expect_same_blocks<Dim>(blocks, cut<Dim>(shapes::block<Dim>(shapes::cube<Dim>(1)), planes), 1, none,
                          sliver_tolerance);
}

TEST(Slice, DependsOnNeitherUnitNorOriginNorOrder3D) {
  expect_invariance<3>(28, 7);
}
TEST(Slice, DependsOnNeitherUnitNorOriginNorOrder2D) {
  expect_invariance<2>(29, 15);
}

TEST(Slice, UndoesCutsThatLeaveSlivers) {
  const Polytope<3> cube = shapes::block<3>(shapes::cube<3>(1));
  for (const double limit : {0.04, 0.06}) {
    SlicingCounters counters;
    const std::vector<Polytope<3>> blocks = cut<3>(cube, {{Vector<3>::UnitX(), 0.9}}, &counters, {limit});
    const bool kept = limit < 0.05;  // the slice is 0.1 thick
    EXPECT_EQ(blocks.size(), kept ? 2u : 1u);
    EXPECT_EQ(counters.cuts, kept ? 1 : 0);
    EXPECT_EQ(counters.undone, kept ? 0 : 1);
  }
}

TEST(Slice, GivesUpBeyondTheMostBlocks) {
  SlicingCounters counters;
  SlicingLimits limits;
  limits.most_blocks = 20;
  cut<3>(shapes::block<3>(shapes::cube<3>(4)), axis_joints<3>(3), &counters, limits);
  EXPECT_TRUE(counters.given_up);
  limits.most_blocks = 27;
  EXPECT_EQ(cut<3>(shapes::block<3>(shapes::cube<3>(4)), axis_joints<3>(3), &(counters = {}), limits).size(), 27u);
  EXPECT_FALSE(counters.given_up);
}

TEST(Slice, ThinSlabsAreBlocksToo) {
  const double thin = 1e-6;
  const std::vector<Polytope<3>> blocks =
      cut<3>(shapes::block<3>(shapes::cube<3>(1)), {{Vector<3>::UnitZ(), 0}, {Vector<3>::UnitZ(), thin}});
  ASSERT_EQ(blocks.size(), 3u);
  double thinnest = 8;
  for (const Polytope<3>& b : blocks)
    thinnest = std::min(thinnest, b.mass.volume);
  EXPECT_NEAR(thinnest, 4 * thin, sliver_tolerance * thin);
}

}  // namespace
}  // namespace voussoir::slicing_test
