// The slope of blocks that slip without opening: against closed forms if there are any, and against itself.
#include "reference/slump/elastoplastic.hpp"
#include "text/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace voussoir::reference {
namespace {

LayeredSlope slope_s0() {
  return {60 * degree, 5 * degree, 4, 8, 50, 3, 2500, 9.81, 1e10, 1e10};
}

// A single block that no cross joint divides slides on its base, which here dips out of the slope, at its dip.
TEST(ElastoplasticSlope, OfOneBlockSlidesAtTheDipOfItsBase) {
  LayeredSlope slope = slope_s0();
  slope.base_dip = -20 * degree;
  slope.layers = 1;
  slope.height = 7;
  const SlopeCollapse found = elastoplastic_collapse(slope, 60 * degree, 5 * degree, 0.001 * degree);
  ASSERT_EQ(found.motion.size(), 1u);
  EXPECT_LT(found.collapses, 20 * degree);
  EXPECT_GE(found.stands, 20 * degree - 1e-7) << "the residual force in equilibrium as an angle";
  EXPECT_NEAR(found.motion[0].y / found.motion[0].x, std::tan(20 * degree), 1e-3) << "along the base";
}

// 15.34 by an independent code of the same kind
TEST(ElastoplasticSlope, TurnsItsOuterLayerAt1534) {
  const SlopeCollapse found = elastoplastic_collapse(slope_s0(), 60 * degree, 5 * degree, 0.001 * degree);
  EXPECT_NEAR(0.5 * (found.collapses + found.stands) / degree, 15.34, 0.005 + 0.0005);
  ASSERT_EQ(found.motion.size(), 21u);
  for (const SlopeBlockMotion& block : found.motion) {
    if (block.layer == 0)
      EXPECT_LT(block.turn, -0.03) << "backwards, row " << block.row;
    else
      EXPECT_LT(block.largest, 0.1) << "layer " << block.layer << ", row " << block.row;
  }
}

// neither stiffness, nor their ratio, nor the start of the search changes the angle
TEST(ElastoplasticSlope, DependsOnNoStiffnessAndNoPath) {
  constexpr double bracket = 0.005 * degree;
  const SlopeCollapse as_it_is = elastoplastic_collapse(slope_s0(), 60 * degree, 5 * degree, bracket);
  LayeredSlope other = slope_s0();
  other.normal_stiffness *= 4;
  other.shear_stiffness *= 2;
  EXPECT_NEAR(elastoplastic_collapse(other, 60 * degree, 5 * degree, bracket).stands, as_it_is.stands, bracket);
  EXPECT_NEAR(elastoplastic_collapse(slope_s0(), 30 * degree, 14.9 * degree, bracket).stands, as_it_is.stands, bracket);
}

TEST(ElastoplasticSlope, FindsItsOwnRange) {
  constexpr double bracket = 0.005 * degree;
  for (const double dip : {50, 60}) {
    LayeredSlope slope = slope_s0();
    slope.dip = dip * degree;
    const SlopeCollapse own = elastoplastic_collapse(slope, bracket);
    EXPECT_LE(own.stands - own.collapses, bracket);
    EXPECT_NEAR(own.stands, elastoplastic_collapse(slope, 60 * degree, 5 * degree, bracket).stands, bracket) << dip;
  }
}

// At every height of the top through the cells, the blocks fill the layers: as long, along the dip, as in their middle.
TEST(ElastoplasticSlope, FillsItsLayersUpToTheTop) {
  for (const double base_dip : {-10, 0, 5, 8})
    for (const double spacing : {3.1, 7.9, 16.0}) {
      LayeredSlope slope = slope_s0();
      slope.base_dip = base_dip * degree;
      slope.spacing = spacing;
      slope.layers = 5;
      const double across = slope.layers * slope.thickness;
      const double middle = 0.5 * across / std::sin(slope.dip + slope.base_dip);
      const double length = (slope.height + middle * std::sin(slope.base_dip)) / std::sin(slope.dip);
      const std::vector<double> areas = slope_block_areas(slope);
      EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), across * length, 1e-9 * across * length)
          << base_dip << ", " << spacing;
    }
}

TEST(ElastoplasticSlope, RefusesARangeOnOneSide) {
  EXPECT_THROW(elastoplastic_collapse(slope_s0(), 60 * degree, 20 * degree, degree), std::runtime_error);
  EXPECT_THROW(elastoplastic_collapse(slope_s0(), 10 * degree, 5 * degree, degree), std::runtime_error);
}

}  // namespace
}  // namespace voussoir::reference
