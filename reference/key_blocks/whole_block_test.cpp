#include "reference/key_blocks/whole_block.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace voussoir::reference::whole_block_test {
namespace {

const Whole3 down{0, 0, -7};

TEST(WholeBlock, WorkedValues) {
  // on a floor that dips by 45 degrees, and in a gutter of two such faces that dips by 3 in 4
  const WholeBlock slab{{{1, 0, 1}}, down};
  const std::vector<WholeMotion> slides = find_motions(slab);
  ASSERT_EQ(slides.size(), 1u);
  EXPECT_EQ(slides[0].loaded, 1);
  EXPECT_EQ(slides[0].direction, (Whole3{7, 0, -7}));
  const WholeBlock gutter{{{4, 3, 4}, {-4, 3, 4}}, down};
  const std::vector<WholeMotion> along = find_motions(gutter);
  ASSERT_EQ(along.size(), 1u);
  EXPECT_EQ(along[0].loaded, 2);
  EXPECT_EQ(along[0].direction[0], 0);
  EXPECT_EQ(3 * along[0].direction[1], -4 * along[0].direction[2]);
  // above nothing, and below a roof
  EXPECT_EQ(find_motions({{{1, 0, -1}, {-1, 0, -1}}, down}).at(0).loaded, 0);
  // level floor: removable, but nothing moves it
  EXPECT_TRUE(find_motions({{{0, 0, 1}}, down}).empty());
  EXPECT_TRUE(is_removable({{{0, 0, 1}}, down}));
}

TEST(WholeBlock, LimitsOfRemovability) {
  const std::vector<Whole3> drawer{{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}};
  EXPECT_TRUE(is_removable({drawer, down}));
  std::vector<Whole3> closed = drawer;
  closed.push_back({0, -1, 0});
  EXPECT_FALSE(is_removable({closed, down}));
  // walls that lean inwards by one in a thousand hold the block, outwards they do not
  for (const long long lean : {-1, 1})
    EXPECT_EQ(is_removable({{{0, 0, 1}, {1000, 0, lean}, {-1000, 0, lean}, {0, 1000, lean}, {0, -1000, lean}}, down}),
              lean > 0);
  EXPECT_TRUE(is_removable({{}, down}));
}

TEST(WholeBlock, ScalingAndOrderDoNotMatter) {
  const std::vector<Whole3> faces{{2, 3, -1}, {4, -6, 8}, {2, -8, 8}};
  const std::vector<WholeMotion> first = find_motions({faces, down});
  const std::vector<WholeMotion> second = find_motions({{{6, -24, 24}, {12, -18, 24}, {20, 30, -10}}, {0, 0, -70}});
  ASSERT_EQ(first.size(), 1u);
  ASSERT_EQ(second.size(), 1u);
  for (int k = 0; k < 3; ++k)  // parallel, and of one sign
    for (int l = 0; l < 3; ++l)
      EXPECT_EQ(first[0].direction[k] * second[0].direction[l], first[0].direction[l] * second[0].direction[k]);
  EXPECT_GT(first[0].direction[2] * second[0].direction[2], 0);
}

// two faces below a block that dip to one side: their line is open and goes down, but the block slides on one of them
TEST(WholeBlock, AnOpenLineNeedNotBeTheMotion) {
  const WholeBlock block{{{1, 0, 2}, {2, 1, 2}}, down};
  const std::vector<WholeMotion> motions = find_motions(block);
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0].loaded, 1);
  EXPECT_EQ(motions[0].faces[0], 0);
  const std::vector<Whole3> lines = open_lines(block);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0][1], 0);
  EXPECT_EQ(motions[0].direction[1], 0);
}

TEST(WholeBlock, RefusesBadInput) {
  EXPECT_THROW(is_removable({{{0, 0, 0}}, down}), std::invalid_argument);
  EXPECT_THROW(find_motions({{{0, 0, 1}}, {0, 0, -1001}}), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::whole_block_test
