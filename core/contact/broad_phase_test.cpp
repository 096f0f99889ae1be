// The broad phase against all pairs.
#include "core/contact/broad_phase.hpp"

#include <gtest/gtest.h>

#include "core/testing/shapes.hpp"

namespace voussoir {
namespace {

using shapes::Random;

template <int Dim>
void expect_all_pairs(std::uint64_t seed) {
  Random random(seed);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Box<Dim>> boxes;
    for (int i = 0; i < 60; ++i) {
      Box<Dim> box;
      // whole numbers: many boxes touch exactly, and that counts
      for (int k = 0; k < Dim; ++k) {
        box.low[k] = shapes::integer(random, 0, 12);
        box.high[k] = box.low[k] + shapes::integer(random, 0, 3);
      }
      box.body = i / 2;
      box.fixed = i % 5 == 0;
      boxes.push_back(box);
    }
    std::vector<std::pair<int, int>> expected;
    for (int i = 0; i < 60; ++i)
      for (int j = i + 1; j < 60; ++j) {
        bool meet = boxes[i].body != boxes[j].body && !(boxes[i].fixed && boxes[j].fixed);
        for (int k = 0; k < Dim; ++k)
          meet = meet && boxes[i].low[k] <= boxes[j].high[k] && boxes[j].low[k] <= boxes[i].high[k];
        if (meet) expected.push_back({i, j});
      }
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(overlapping_pairs<Dim>(boxes), expected);
  }
}

TEST(BroadPhase, FindsAllPairsInOrder) {
  expect_all_pairs<3>(75);
  expect_all_pairs<2>(76);
}

}  // namespace
}  // namespace voussoir
