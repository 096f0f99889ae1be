// The broad phase against an oracle that tries all pairs.
#include "core/contact/broad_phase.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/testing/shapes.hpp"

namespace voussoir::broad_phase_test {
namespace {

using shapes::Random;

using Pairs = std::vector<std::pair<int, int>>;

template <int Dim>
Pairs by_brute_force(const std::vector<Box<Dim>>& boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const Box<Dim>&a = boxes[i], &b = boxes[j];
      bool met = a.body != b.body && !(a.fixed && b.fixed);
      for (int k = 0; k < Dim; ++k)
        met = met && a.low[k] <= b.high[k] && b.low[k] <= a.high[k] && a.low[k] <= a.high[k] && b.low[k] <= b.high[k];
      if (met) pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    }
  return pairs;
}

// the search and the oracle; returns the number of pairs
template <int Dim>
int expect_all_pairs(const std::vector<Box<Dim>>& boxes, int threads = 1) {
  Pairs found;
  overlapping_pairs(boxes, threads, {}, found);
  const Pairs expected = by_brute_force(boxes);
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_TRUE(found == expected);
  return static_cast<int>(expected.size());
}

// boxes of random sizes over some decades, at random places; `flatness` of them have no extent along an axis
template <int Dim>
std::vector<Box<Dim>> scattered(Random& random, int count, double region, double decades, double flatness) {
  std::vector<Box<Dim>> boxes;
  for (int i = 0; i < count; ++i) {
    Box<Dim> box;
    const double size = shapes::power_of_ten(random, -decades, 0);
    for (int k = 0; k < Dim; ++k) {
      box.low[k] = shapes::uniform(random, 0, region);
      const bool flat = shapes::uniform(random, 0, 1) < flatness;
      box.high[k] = box.low[k] + (flat ? 0 : size * shapes::uniform(random, 0.5, 1));
    }
    box.body = i;
    box.fixed = i % 7 == 0;
    boxes.push_back(box);
  }
  return boxes;
}

// whole numbers: many boxes touch exactly, and that counts; some boxes belong to one body, some are fixed
template <int Dim>
void expect_touching(std::uint64_t seed) {
  Random random(seed);
  for (const int count : {0, 1, 2, 20, 60, 300}) {
    std::vector<Box<Dim>> boxes;
    for (int i = 0; i < count; ++i) {
      Box<Dim> box;
      for (int k = 0; k < Dim; ++k) {
        box.low[k] = shapes::integer(random, -6, 6);
        box.high[k] = box.low[k] + shapes::integer(random, 0, 3);
      }
      box.body = i / 2;
      box.fixed = i % 5 == 0;
      boxes.push_back(box);
    }
    EXPECT_GE(expect_all_pairs(boxes), count < 60 ? 0 : 10);
  }
}

TEST(BroadPhase, FindsBoxesThatTouchExactly) {
  expect_touching<3>(75);
  expect_touching<2>(76);
}

template <int Dim>
void expect_scattered(std::uint64_t seed) {
  Random random(seed);
  for (const double decades : {0.1, 1.0, 4.0})
    for (const double flatness : {0.0, 0.3, 1.0}) {
      // flat along every axis, a box is a point
      std::vector<Box<Dim>> boxes = scattered<Dim>(random, 900, 3, decades, flatness);
      EXPECT_GT(expect_all_pairs(boxes), flatness == 1 ? -1 : 10) << decades << ' ' << flatness;

      // far away, coordinates are rounded to 1e-10 m
      for (Box<Dim>& box : boxes) {
        box.low.array() += 1e6;
        box.high.array() += 1e6;
      }
      expect_all_pairs(boxes);
    }
}

TEST(BroadPhase, FindsBoxesOfMixedSizes) {
  expect_scattered<3>(77);
  expect_scattered<2>(78);
}

TEST(BroadPhase, FindsThePairsOfAPlateAndWalls) {
  Random random(79);
  std::vector<Box<3>> boxes = scattered<3>(random, 400, 6, 0.3, 0);
  for (int k = 0; k < 3; ++k) {
    Box<3> wall{Vector<3>::Constant(-10), Vector<3>::Constant(16), static_cast<int>(boxes.size()), true};
    wall.high[k] = 0.2;
    boxes.insert(boxes.begin() + 100 * k, wall);
  }
  EXPECT_GT(expect_all_pairs(boxes), 100);
}

TEST(BroadPhase, FindsAllPairsInOnePlace) {
  const int count = 200;
  std::vector<Box<3>> boxes;
  for (int i = 0; i < count; ++i)
    boxes.push_back({{1, 2, 3}, {2, 3, 4}, i, false});
  EXPECT_EQ(expect_all_pairs(boxes), count * (count - 1) / 2);
  for (Box<3>& box : boxes)
    box.high = box.low;
  EXPECT_EQ(expect_all_pairs(boxes), count * (count - 1) / 2);
}

TEST(BroadPhase, FindsTheSameOnThreeThreads) {
  Random random(81);
  const std::vector<Box<3>> boxes = scattered<3>(random, 2000, 12, 0.5, 0.1);  // enough for a team
  EXPECT_GT(expect_all_pairs(boxes, 3), 100);
}

// an absent body's box meets none, a boundless one all others
TEST(BroadPhase, HandlesInfiniteBoxes) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Random random(80);
  std::vector<Box<3>> boxes = scattered<3>(random, 200, 4, 0.1, 0);
  for (int i = 0; i < 200; i += 10) {
    boxes[i].low.setConstant(infinity);
    boxes[i].high.setConstant(-infinity);
  }
  const int among_the_rest = expect_all_pairs(boxes);
  boxes.push_back({Vector<3>::Constant(-infinity), Vector<3>::Constant(infinity), 200, false});
  EXPECT_EQ(expect_all_pairs(boxes), among_the_rest + 180);
}

}  // namespace
}  // namespace voussoir::broad_phase_test
