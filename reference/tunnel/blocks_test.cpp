#include "reference/tunnel/blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace voussoir::reference::network;

namespace voussoir::reference::blocks_test {
namespace {

constexpr double pi = std::numbers::pi;

Polygon regular(int sides, double radius) {
  Polygon polygon;
  for (int i = 0; i < sides; ++i)
    polygon.push_back({radius * std::cos(2 * pi * (i + 0.3) / sides), radius * std::sin(2 * pi * (i + 0.3) / sides)});
  return polygon;
}

double area_of(const std::vector<Block>& blocks) {
  double sum = 0;
  for (const Block& block : blocks)
    sum += area(block);
  return sum;
}

double length_of(const std::vector<Face>& faces) {
  double sum = 0;
  for (const Face& face : faces)
    sum += std::hypot(face.end[0] - face.start[0], face.end[1] - face.start[1]);
  return sum;
}

// Bricks: partial faces, and the ground that is longer than all of them.
TEST(NetworkBlocks, FacesInPart) {
  std::vector<Block> blocks{{{box(-5, -1, 5, 0)}, {true, true, true}},
                            {{box(0, 0, 2, 1)}},
                            {{box(2, 0, 4, 1)}},
                            {{box(1, 1, 3, 2)}},
                            {{box(4.001, 0, 5, 1)}}};
  const std::vector<Face> found = faces(blocks, 1e-6);
  ASSERT_EQ(found.size(), 6u);
  EXPECT_NEAR(length_of(found), 2 + 2 + 0.999 + 1 + 1 + 1, 1e-12);
  for (const Face& face : found) {
    EXPECT_LT(face.first, face.second);
    const Point from = centroid(blocks[face.first]), to = centroid(blocks[face.second]);
    EXPECT_GT(face.normal[0] * (to[0] - from[0]) + face.normal[1] * (to[1] - from[1]), 0);
  }
  blocks[1].held = blocks[2].held = {true, true, true};
  EXPECT_EQ(faces(blocks, 1e-6).size(), 3u);  // no springs between two held blocks
  EXPECT_EQ(faces(blocks, 2e-3).size(), 4u);  // the gap of a millimetre counts as closed
}

TEST(NetworkBlocks, CellsOfAFace) {
  const Face face{0, 1, {0, 0}, {3, 0}, {0, -1}};
  const std::vector<Spring> two = springs({face}, 2, 1, 1);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_NEAR(two[0].at[0], 0.75, 1e-15);
  EXPECT_NEAR(two[1].at[0], 2.25, 1e-15);
  EXPECT_NEAR(two[0].spread, 1.5 * 1.5 / 12, 1e-15);
  EXPECT_EQ(springs({face}, 2, 1, 1, false)[0].spread, 0);
  EXPECT_THROW(springs({face}, 0, 1, 1), std::invalid_argument);
}

// Lines in general position through a box: 1 + lines + crossings pieces, no area lost, and every inner edge a face.
TEST(NetworkBlocks, CutByLines) {
  const std::vector<Line> lines{{{1, 0.3}, 0.2}, {{-0.4, 2}, -0.1}, {{1, 1}, 0.9}};
  const std::vector<Block> blocks = one_each(cut(box(-2, -2, 2, 2), lines, 1e-9));
  EXPECT_EQ(blocks.size(), 7u);
  EXPECT_NEAR(area_of(blocks), 16, 1e-12);
  double perimeter = 0;
  for (const Block& block : blocks)
    for (std::size_t i = 0; i < block.parts[0].size(); ++i) {
      const Point &a = block.parts[0][i], &b = block.parts[0][(i + 1) % block.parts[0].size()];
      perimeter += std::hypot(b[0] - a[0], b[1] - a[1]);
    }
  EXPECT_NEAR(2 * length_of(faces(blocks, 1e-9)), perimeter - 16, 1e-11);
}

// Spacing s at right angles: blocks of s by s. Three sets at 60°: any two cross sin 60°/s² times per area, and every
// crossing is a corner of one block, on an area whose rim matters less and less. Two thirds of that if all three meet
// in points, which they do if the outer shifts add up to the middle one.
TEST(NetworkBlocks, PersistentSets) {
  const std::vector<Block> squares =
      one_each(cut(box(-4, -4, 4, 4), persistent_sets({0, pi / 2}, {0.5, 0.5}, 1, 6), 1e-9));
  EXPECT_EQ(squares.size(), 81u);
  const std::vector<Block> three = one_each(cut(
      box(-20, -20, 20, 20), persistent_sets({0.1, 0.1 + pi / 3, 0.1 + 2 * pi / 3}, {0.1, 0.45, 0.2}, 1, 29), 1e-9));
  EXPECT_NEAR(static_cast<double>(three.size()), 1600 * 3 * std::sin(pi / 3), 0.06 * 1600 * 3 * std::sin(pi / 3));
  EXPECT_NEAR(area_of(three), 1600, 1e-9);
  EXPECT_THROW(persistent_sets({0}, {}, 1, 2), std::invalid_argument);
}

TEST(NetworkBlocks, Opening) {
  const Polygon outline = regular(48, 3);
  const std::vector<Line> lines = persistent_sets({0.2, 1.3, 2.2}, {0.1, 0.4, 0.8}, 0.7, 12);
  const std::vector<Block> blocks = take_out(cut(box(-8, -8, 8, 8), lines, 1e-9), outline, 1e-9);
  const Block opening{{outline}};
  EXPECT_NEAR(area_of(blocks), 256 - area(opening), 1e-9);
  const std::vector<Face> around = wall(blocks, outline, 1e-8);
  EXPECT_NEAR(length_of(around), 2 * 48 * 3 * std::sin(pi / 48), 1e-6);
  for (std::size_t i = 1; i < around.size(); ++i) {  // the next begins where this ends, seen from inside
    EXPECT_NEAR(around[i].end[0], around[i - 1].start[0], 1e-7);
    EXPECT_NEAR(around[i].end[1], around[i - 1].start[1], 1e-7);
  }
  // no block is in two places: its parts are connected by faces
  for (const Block& block : blocks) {
    std::vector<Block> parts = one_each(block.parts);
    EXPECT_GE(faces(parts, 1e-9).size() + 1, parts.size());
  }
}

// A block that bulges into the opening on both sides of a neck is divided.
TEST(NetworkBlocks, BlockPartedByTheOpening) {
  const std::vector<Block> blocks = take_out({box(-3, -0.5, 3, 0.5)}, box(-1, -2, 1, 2), 1e-9);
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_NEAR(area(blocks[0]), 2, 1e-12);
  const std::vector<Block> notched = take_out({box(-3, -0.5, 3, 0.5)}, box(-1, 0, 1, 2), 1e-9);
  ASSERT_EQ(notched.size(), 1u);
  EXPECT_NEAR(area(notched[0]), 5, 1e-12);
}

// The sum of the relief loads is the weight of the removed rock, through its centroid, and at each wall the stress
// there.
TEST(NetworkBlocks, ReliefLoadsAreTheWeightOfTheRemovedRock) {
  Polygon outline = regular(12, 3);
  for (Point& corner : outline)
    corner = {corner[0] + 0.7, corner[1] - 1.2};
  std::vector<Block> blocks =
      take_out(cut(box(-8, -8, 8, 8), persistent_sets({0.2, 1.3}, {0.1, 0.4}, 1.1, 12), 1e-9), outline, 1e-9);
  relieve(blocks, wall(blocks, outline, 1e-8), {25, 26e3, 0.6, 1e5}, 0.5);
  double up = 0, right = 0, moment = 0, largest = 0;
  for (const Block& block : blocks) {
    const Point at = centroid(block);
    right += block.load[0];
    up += block.load[1];
    moment += block.load[2] + at[0] * block.load[1] - at[1] * block.load[0];
    largest = std::max(largest, std::abs(block.load[0]));
  }
  const Block gone{{outline}};
  EXPECT_GT(largest, 1e4);
  EXPECT_NEAR(right, 0, 1e-4);
  EXPECT_NEAR(up, 0.5 * 26e3 * area(gone), 1e-2);
  EXPECT_NEAR(moment, up * centroid(gone)[0], 1e-1);

  std::vector<Block> pair{{{box(-2, -1, -1, 1)}}, {{box(1, -1, 2, 1)}}};
  relieve(pair, wall(pair, box(-1, -1, 1, 1), 1e-9), {0, 0, 1, 1e5});
  EXPECT_NEAR(pair[0].load[0], 2e5, 1e-6);  // into the opening
  EXPECT_NEAR(pair[1].load[0], -2e5, 1e-6);
}

TEST(NetworkBlocks, BoltsCrossFaces) {
  const std::vector<Block> blocks =
      one_each({box(0, 0, 1, 1), box(1, 0, 2, 1), box(2, 0, 2.05, 1), box(2.05, 0, 4, 1)});
  const std::vector<Bolt> bolts = bolts_across(faces(blocks, 1e-9), {3.5, 0.5}, {0.2, 0.4}, 1e8, 0.0336);
  ASSERT_EQ(bolts.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(bolts[i].first, 3 - i);
    EXPECT_EQ(bolts[i].second, 2 - i);
    EXPECT_LT(bolts[i].axis[0], 0);
  }
  const auto apart = [](const Bolt& b) {
    return std::hypot(b.second_anchor[0] - b.first_anchor[0], b.second_anchor[1] - b.first_anchor[1]);
  };
  EXPECT_NEAR(apart(bolts[2]), 2 * 0.0336, 1e-12);
  EXPECT_NEAR(apart(bolts[0]), 0.0336 + 0.025 * std::hypot(3.3, 0.1) / 3.3, 1e-12);  // the thin block: its middle
}

TEST(NetworkBlocks, TiesAtCornersAndJoints) {
  // a wall of two blocks on one side of a square opening, one on the next
  const Polygon opening = box(0, 0, 2, 2);
  const std::vector<Block> blocks = one_each({box(0, -1, 0.5, 0), box(0.5, -1, 2, 0), box(2, 0, 3, 2)});
  Lining lining{{}, false, 1e9, 1e7, {}};
  for (const Point& at : {Point{0, 0}, {0.5, 0}, {1, 0}, {2, 0}, {2, 1}})
    lining.nodes.push_back({at});
  tie_to_wall(lining, wall(blocks, opening, 1e-9), 1e9, 1e8, 1e-9);
  ASSERT_EQ(lining.ties.size(), 7u);
  const int node[] = {0, 1, 1, 2, 3, 3, 4}, block[] = {0, 0, 1, 1, 1, 2, 2};
  const double length[] = {0.25, 0.25, 0.25, 0.75, 0.5, 0.5, 0.5};
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(lining.ties[i].node, node[i]);
    EXPECT_EQ(lining.ties[i].block, block[i]);
    EXPECT_NEAR(lining.ties[i].length, length[i], 1e-12);
  }
  lining.nodes.push_back({{1, 1}});
  lining.ties.clear();
  EXPECT_THROW(tie_to_wall(lining, wall(blocks, opening, 1e-9), 1e9, 1e8, 1e-9), std::invalid_argument);
}

// Nodes on a hundred rays to an outline of twelve sides: beams cut the corners, every node is tied to the side on which
// it is.
TEST(NetworkBlocks, RingOnRays) {
  Polygon outline = regular(12, 5);
  const std::vector<Block> blocks =
      take_out(cut(box(-9, -9, 9, 9), persistent_sets({0.2, 1.3, 2.2}, {0.1, 0.4, 0.8}, 0.7, 13), 1e-9), outline, 1e-9);
  Lining lining{{}, true, 1e9, 1e7, {}};
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * pi * (i + 0.4) / 100;
    const double from_middle = std::remainder(angle - 2 * pi * 0.8 / 12, pi / 6),
                 r = 5 * std::cos(pi / 12) / std::cos(from_middle);
    lining.nodes.push_back({{r * std::cos(angle), r * std::sin(angle)}});
  }
  tie_to_wall(lining, wall(blocks, outline, 1e-8), 1e9, 1e9, 1e-8);
  EXPECT_EQ(lining.ties.size(), 100u);
  double tied = 0, around = 0;
  for (int i = 0; i < 100; ++i) {
    const Point &here = lining.nodes[i].at, &next = lining.nodes[(i + 1) % 100].at;
    around += std::hypot(next[0] - here[0], next[1] - here[1]);
    tied += lining.ties[i].length;
    EXPECT_EQ(lining.ties[i].node, i);
    EXPECT_LT(lining.ties[i].normal[0] * here[0] + lining.ties[i].normal[1] * here[1], -5 * std::cos(pi / 12) + 1e-9);
  }
  EXPECT_NEAR(tied, around, 1e-9);
}

}  // namespace
}  // namespace voussoir::reference::blocks_test
