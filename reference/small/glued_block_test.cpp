#include "reference/small/glued_block.hpp"

#include <gtest/gtest.h>

namespace voussoir::reference::glued_block_test {
namespace {

// by hand: 1 x 0.5 m of 2500 kg/m3 weigh 12 262.5 N, their moment is 6 131.25 N m
TEST(GluedBlock, HasTheValuesOfAWorkedExample) {
  const GluedBlock block;
  EXPECT_NEAR(glued_edge_tension(block), 147150, 1e-6);
  EXPECT_NEAR(glued_rotation(block), 5.886e-4, 1e-12);
  EXPECT_NEAR(glued_drop(block), 2.4525e-5 + 2.943e-4, 1e-12);
}

// by summing springs: n parts, each with its own, about the middle of the face
TEST(GluedBlock, OnPartsOfTheFaceIsASumOfSprings) {
  const GluedBlock block;
  for (const int n : {2, 8, 64}) {
    const double part = block.height / n, moment = block.density * block.gravity * block.height / 2;
    double stiffness = 0;
    for (int k = 0; k < n; ++k) {
      const double arm = (k + 0.5) * part - block.height / 2;
      stiffness += block.normal_stiffness * part * arm * arm;
    }
    const double outermost = (block.height - part) / 2;
    EXPECT_NEAR(glued_part_tension(block, n), block.normal_stiffness * outermost * moment / stiffness, 1e-6) << n;
  }
  EXPECT_NEAR(glued_part_tension(block, 1000000), glued_edge_tension(block), 1);
}

TEST(GluedBlock, ScalesWithItsLengths) {
  GluedBlock small, large;
  large.length = 3 * small.length;
  large.height = 3 * small.height;
  EXPECT_NEAR(glued_edge_tension(large), 3 * glued_edge_tension(small), 1e-6);
  EXPECT_NEAR(glued_rotation(large), glued_rotation(small), 1e-15);
}

}  // namespace
}  // namespace voussoir::reference::glued_block_test
