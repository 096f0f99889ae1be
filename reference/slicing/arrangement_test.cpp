// Pieces of arrangements against formulas, and the area of polygons of known area.
#include "reference/slicing/arrangement.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace voussoir::reference {
namespace {

const Box<2> square{{-1, -1}, {1, 1}};
const Box<3> cube{{-1, -1, -1}, {1, 1, 1}};

TEST(Arrangement, GridsOfParallelPlanes) {
  std::vector<Line2> lines;
  std::vector<Plane3> planes;
  for (int i = 0; i < 4; ++i) {
    const double at = -0.6 + 0.4 * i;
    lines.push_back({{1, 0}, at});
    if (i < 3) lines.push_back({{0, 1}, at});
    planes.push_back({{1, 0, 0}, at});
    if (i < 3) planes.push_back({{0, 1, 0}, at});
    if (i < 2) planes.push_back({{0, 0, 1}, at});
  }
  EXPECT_EQ(pieces(lines, square), 5 * 4);
  EXPECT_EQ(pieces(planes, cube), 5 * 4 * 3);
}

TEST(Arrangement, PlanesInGeneralPositionThatAllCrossInside) {
  // tangents of a small circle and of a small sphere about the middle: every crossing is inside
  std::vector<Line2> lines;
  std::vector<Plane3> planes;
  for (int i = 0; i < 7; ++i) {
    const double a = 0.3 + 0.41 * i, b = 0.2 + 0.9 * i;
    lines.push_back({{std::cos(a), std::sin(a)}, 0.01});
    planes.push_back({{std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)}, 0.001});
  }
  EXPECT_EQ(pieces(lines, square), 1 + 7 + 21);
  EXPECT_EQ(pieces(planes, cube), 1 + 7 + 21 + 35);
}

TEST(Arrangement, CrossingsOutsideAddNothing) {
  EXPECT_EQ(pieces({{{1, 0}, 1.5}, {{1, 1}, 1.9}, {{1, -1}, 1.9}}, square), 3);  // the last two meet at x = 1.9
  EXPECT_EQ(pieces({{{1, 1, 0}, 1.9}, {{1, -1, 0}, 1.9}, {{0, 0, 1}, 0.5}}, cube), 6);
}

TEST(Arrangement, AreaOfAChain) {
  EXPECT_NEAR(enclosed_area({{{0, 1}, 0}, {{1, 0}, 4}, {{3, 4}, 12}}), 0, 1e-14);  // three lines through a point
  EXPECT_NEAR(enclosed_area({{{0, 1}, 0}, {{3, 4}, 12}, {{1, 0}, 0}}), 6, 1e-14);
  EXPECT_NEAR(enclosed_area({{{1, 0}, 1e3}, {{0, 1}, 2}, {{1, 0}, 1e3 + 5}, {{0, 1}, 5}}), 15, 1e-12);
}

}  // namespace
}  // namespace voussoir::reference
