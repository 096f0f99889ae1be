// For any joints, the blocks tile the domain: no gaps, no overlaps, the right number, and the same blocks
// for any order of persistent joints and any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numbers>

#include "core/slicing/block.hpp"
#include "core/slicing/clump.hpp"
#include "core/slicing/slice.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::tiling_test {
namespace {

using shapes::Random;

// of the domain's volume, summed with compensation
constexpr double volume_tolerance = 1e-12;

template <int Dim>
std::vector<Cut<Dim>> persistent(const HalfSpaces<Dim>& planes) {
  std::vector<Cut<Dim>> cuts;
  for (const HalfSpace<Dim>& p : planes)
    cuts.push_back({p, static_cast<int>(cuts.size())});
  return cuts;
}

template <int Dim>
Polytope<Dim> cube(double half) {
  return shapes::block<Dim>(shapes::cube<Dim>(half));
}

template <int Dim>
std::vector<Polytope<Dim>> sliced(const Polytope<Dim>& domain, const std::vector<Cut<Dim>>& cuts, int threads = 1) {
  SlicingCounters counters;
  SlicingLimits limits;
  limits.threads = threads;
  return slice<Dim>(domain, cuts, limits, counters);
}

template <int Dim>
double volume_error(const std::vector<Polytope<Dim>>& blocks, double volume) {
  long double sum = 0;
  for (const Polytope<Dim>& b : blocks)
    sum += b.mass.volume;
  return std::abs(static_cast<double>(sum / volume) - 1);
}

// seeded squares of three sets, as many of each; every third has no end
std::vector<Cut<3>> mixed_joints(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Cut<3>> cuts;
  for (int i = 0; i < count; ++i) {
    const Vector<3> normal = (Vector<3>::Unit(i % 3) + 0.2 * shapes::direction<3>(random)).normalized();
    const Vector<3> centre(shapes::uniform(random, -1, 1), shapes::uniform(random, -1, 1),
                           shapes::uniform(random, -1, 1));
    Cut<3> cut{{normal, normal.dot(centre)}, i};
    if (i % 4) cut.extent = rectangle_extent(normal, centre, 0.8, 0.5);
    cuts.push_back(cut);
  }
  return cuts;
}

bool same_bits(const Vector<3>& a, const Vector<3>& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0;
}

void expect_same_bits(const std::vector<Polytope<3>>& a, const std::vector<Polytope<3>>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].faces.size(), b[i].faces.size());
    ASSERT_EQ(a[i].vertices.size(), b[i].vertices.size());
    for (std::size_t f = 0; f < a[i].faces.size(); ++f)
      ASSERT_TRUE(same_bits(a[i].faces[f].normal, b[i].faces[f].normal) &&
                  a[i].faces[f].offset == b[i].faces[f].offset && a[i].loops[f] == b[i].loops[f]);
    for (std::size_t v = 0; v < a[i].vertices.size(); ++v)
      ASSERT_TRUE(same_bits(a[i].vertices[v], b[i].vertices[v]));
    ASSERT_EQ(a[i].mass.volume, b[i].mass.volume);
  }
}

// ---- counts -----------------------------------------------------------------------------------------------------

TEST(Tiling, TenThousandParallelJoints) {
  Random random(41);
  const int n = 10'000;
  const Vector<3> normal(0.36, 0.48, 0.8);  // exactly unit but for rounding
  HalfSpaces<3> planes;
  for (int i = 0; i < n; ++i)
    planes.push_back({normal, -0.9 + 1.8 * i / (n - 1)});
  shapes::shuffle(planes, random);
  const auto blocks = sliced<3>(cube<3>(1), persistent<3>(planes));
  EXPECT_EQ(static_cast<int>(blocks.size()), n + 1);
  EXPECT_LE(volume_error(blocks, 8), volume_tolerance);
}

TEST(Tiling, TenThousandJointsThroughALine) {
  Random random(42);
  const int n = 10'000;
  HalfSpaces<2> lines;
  for (int i = 0; i < n; ++i) {
    const double angle = 0.1 + std::numbers::pi * i / n;
    lines.push_back({Vector<2>(std::cos(angle), std::sin(angle)), 0});
  }
  shapes::shuffle(lines, random);
  EXPECT_EQ(static_cast<int>(sliced<2>(cube<2>(1), persistent<2>(lines)).size()), 2 * n);

  // in space a tenth as many: the full number is in the benchmark
  HalfSpaces<3> planes;
  for (int i = 0; i < n; i += 10)
    planes.push_back({Vector<3>(lines[i].normal[0], lines[i].normal[1], 0), 0});
  EXPECT_EQ(planes.size() * 2, sliced<3>(cube<3>(1), persistent<3>(planes)).size());
}

TEST(Tiling, PlanesThroughAPoint) {
  for (const int n : {3, 8, 20}) {
    Random random(43);
    HalfSpaces<3> planes;
    const Vector<3> point(0.1, -0.2, 0.3);
    for (int i = 0; i < n; ++i) {
      const Vector<3> normal = shapes::direction<3>(random);
      planes.push_back({normal, normal.dot(point)});
    }
    const auto blocks = sliced<3>(cube<3>(1), persistent<3>(planes));
    EXPECT_EQ(static_cast<int>(blocks.size()), n * (n - 1) + 2);
    EXPECT_LE(volume_error(blocks, 8), volume_tolerance);
  }
}

bool line_meets_cube(const HalfSpace<3>& a, const HalfSpace<3>& b) {
  const Vector<3> along = a.normal.cross(b.normal);
  Matrix<3> rows;
  rows << a.normal.transpose(), b.normal.transpose(), along.transpose();
  const Vector<3> point = rows.inverse() * Vector<3>(a.offset, b.offset, 0);
  double from = -1e300, to = 1e300;
  for (int k = 0; k < 3; ++k) {
    const double p = (-1 - point[k]) / along[k], q = (1 - point[k]) / along[k];
    from = std::max(from, std::min(p, q));
    to = std::min(to, std::max(p, q));
  }
  return from < to;
}

// In a convex domain: one, and one for every plane, every line of two and every point of three planes inside it.
int cells_in_cube(const HalfSpaces<3>& planes) {
  int count = 1;
  const int n = static_cast<int>(planes.size());
  for (int i = 0; i < n; ++i) {
    count += std::abs(planes[i].offset) < planes[i].normal.lpNorm<1>();
    for (int j = i + 1; j < n; ++j) {
      count += line_meets_cube(planes[i], planes[j]);
      for (int k = j + 1; k < n; ++k) {
        Matrix<3> rows;
        rows << planes[i].normal.transpose(), planes[j].normal.transpose(), planes[k].normal.transpose();
        const Vector<3> point = rows.inverse() * Vector<3>(planes[i].offset, planes[j].offset, planes[k].offset);
        count += point.cwiseAbs().maxCoeff() < 1;
      }
    }
  }
  return count;
}

TEST(Tiling, PlanesInGeneralPosition) {
  for (const int n : {1, 5, 12, 24}) {
    Random random(44);
    HalfSpaces<3> planes;
    for (int i = 0; i < n; ++i)
      planes.push_back({shapes::direction<3>(random), shapes::uniform(random, -0.8, 0.8)});
    const auto blocks = sliced<3>(cube<3>(1), persistent<3>(planes));
    EXPECT_EQ(static_cast<int>(blocks.size()), cells_in_cube(planes));
    EXPECT_LE(volume_error(blocks, 8), volume_tolerance);
  }
}

// ---- no gaps, no overlaps ---------------------------------------------------------------------------------------

TEST(Tiling, BlocksShareNoInterior) {
  const std::vector<Cut<3>> cuts = mixed_joints(45, 40);
  const auto blocks = sliced<3>(cube<3>(1), cuts);
  ASSERT_GT(blocks.size(), 60u);
  EXPECT_LE(volume_error(blocks, 8), volume_tolerance);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    for (std::size_t j = i + 1; j < blocks.size(); ++j) {
      HalfSpaces<3> both = blocks[i].faces;
      both.insert(both.end(), blocks[j].faces.begin(), blocks[j].faces.end());
      // faces of one plane, seen from both sides, leave only rounding between them
      EXPECT_GE(solve_feasibility<3>(both, {}).value, -1e-15);
    }
}

template <int Dim>
void expect_faces_match(const std::vector<Polytope<Dim>>& blocks, const std::vector<Cut<Dim>>& cuts) {
  std::vector<double> seen(blocks.size() * cuts.size(), 0);
  for (const SharedFace& face : shared_faces<Dim>(blocks, cuts)) {
    seen[face.below * cuts.size() + face.joint] += face.area;
    seen[face.above * cuts.size() + face.joint] += face.area;
  }
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (std::size_t f = 0; f < blocks[b].faces.size(); ++f) {
      if (blocks[b].joints[f] == no_joint) continue;
      EXPECT_NEAR(seen[b * cuts.size() + blocks[b].joints[f]], face_area<Dim>(blocks[b], static_cast<int>(f)), 1e-9);
    }
}

TEST(Tiling, EveryFaceOfAJointIsCoveredFromTheOtherSide) {
  const std::vector<Cut<3>> cuts = mixed_joints(46, 60);
  expect_faces_match<3>(sliced<3>(cube<3>(1), cuts), cuts);

  Random random(47);
  std::vector<Cut<2>> traces;
  for (int i = 0; i < 60; ++i) {
    const Vector<2> normal = shapes::direction<2>(random);
    const Vector<2> centre(shapes::uniform(random, -1, 1), shapes::uniform(random, -1, 1));
    traces.push_back({{normal, normal.dot(centre)}, i, trace_extent(normal, centre, 0.7)});
  }
  expect_faces_match<2>(sliced<2>(cube<2>(1), traces), traces);
}

// ---- order and threads ------------------------------------------------------------------------------------------

TEST(Tiling, PersistentJointsInAnyOrderMakeTheSameBits) {
  Random random(48);
  std::vector<Cut<3>> cuts;
  for (Cut<3>& cut : mixed_joints(49, 24)) {
    cut.extent = {};
    cuts.push_back(cut);
  }
  const auto blocks = sliced<3>(cube<3>(1), cuts);
  ASSERT_GT(blocks.size(), 500u);
  for (int i = 0; i < 3; ++i) {
    shapes::shuffle(cuts, random);
    expect_same_bits(blocks, sliced<3>(cube<3>(1), cuts));
  }
}

TEST(Tiling, AnyNumberOfThreadsMakesTheSameBits) {
  const std::vector<Cut<3>> cuts = mixed_joints(50, 120);
  const auto blocks = sliced<3>(cube<3>(1), cuts);
  for (const int threads : {2, 3, 8})
    expect_same_bits(blocks, sliced<3>(cube<3>(1), cuts, threads));
}

// in place of Eq. 3.17
TEST(Tiling, CullingChangesNothingButTheNumberOfPrograms) {
  const std::vector<Cut<3>> cuts = mixed_joints(51, 120);
  SlicingLimits limits;
  SlicingCounters culled, tried;
  const auto blocks = slice<3>(cube<3>(1), cuts, limits, culled);
  limits.culling = false;
  expect_same_bits(blocks, slice<3>(cube<3>(1), cuts, limits, tried));
  EXPECT_LT(5 * culled.lp_solves, tried.lp_solves);
}

// ---- degenerate joints ------------------------------------------------------------------------------------------

// A cube turned in space and a joint that cuts 10^-k off its corner, edge or face: a piece of the right volume, or no
// piece, and no volume lost.
void expect_clean_cut(const Vector<3>& towards, double depth, const Matrix<3>& turn, double piece) {
  const Polytope<3> domain = shapes::block<3>(shapes::placed<3>(shapes::cube<3>(1), turn, {0.3, 0.2, 0.1}));
  const Vector<3> normal = turn * towards.normalized();
  const double reach = towards.lpNorm<1>() / towards.norm();
  const HalfSpace<3> joint{normal, normal.dot(Vector<3>(0.3, 0.2, 0.1)) + reach - depth};
  const auto blocks = sliced<3>(domain, persistent<3>({joint, joint}));  // the second coincides with the first
  EXPECT_LE(volume_error(blocks, 8), 1e-15 * 16);
  ASSERT_LE(blocks.size(), 2u);
  // below twice 1e-8 of its extent a piece is flat, below 1e-14 it is the rounding of coordinates
  EXPECT_TRUE(blocks.size() == 2 || depth < 2e-7) << towards.transpose() << " " << depth;
  EXPECT_TRUE(blocks.size() == 1 || depth > 1e-14) << towards.transpose() << " " << depth;
  if (blocks.size() < 2) return;
  const double volume = std::min(blocks[0].mass.volume, blocks[1].mass.volume);
  // the plane's place is exact to 1e-16: that over the depth
  EXPECT_NEAR(volume / piece, 1, 4e-15 / depth) << towards.transpose() << " " << depth;
}

TEST(Tiling, JointsNearACornerAnEdgeAndAFace) {
  Random random(52);
  for (int k = 1; k <= 17; ++k)
    for (int i = 0; i < 4; ++i) {
      const Matrix<3> turn = i ? matrix(shapes::orientation<3>(random)) : Matrix<3>(Matrix<3>::Identity());
      const double depth = std::pow(10, -k);
      expect_clean_cut({1, 1, 1}, depth, turn, std::sqrt(3) / 2 * depth * depth * depth);
      expect_clean_cut({1, 1, 0}, depth, turn, 2 * depth * depth);
      expect_clean_cut({1, 0, 0}, depth, turn, 4 * depth);
    }
}

}  // namespace
}  // namespace voussoir::tiling_test
