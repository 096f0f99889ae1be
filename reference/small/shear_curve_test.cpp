#include "reference/small/shear_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace voussoir::reference::shear_curve_test {
namespace {

const ShearCurve curve{2e6, 5e10, 0.6};
constexpr double scale = 4e-5, drop = 0.3;

TEST(ShearCurve, WorkedValues) {
  EXPECT_DOUBLE_EQ(perfectly_plastic_shear(curve, 1e-5), 5e5);
  EXPECT_DOUBLE_EQ(perfectly_plastic_shear(curve, 1e-3), 2e6 * std::tan(0.6));
}

// the inverse: slip by shear stress, with the logarithm in place of the search
TEST(ShearCurve, InvertsTheSlipAtAStress) {
  for (const double fraction : {0.01, 0.3, 0.7, 0.99}) {
    const double hard = fraction * 2e6 * std::tan(0.6);
    const double hard_slip = hard / 5e10 - scale * std::log1p(-fraction);
    EXPECT_NEAR(hardening_shear(curve, scale, hard_slip), hard, 1e-12 * hard);
    const double soft = 2e6 * (std::tan(0.6) - fraction * drop);
    const double soft_slip = soft / 5e10 - scale * std::log1p(-fraction);
    EXPECT_NEAR(softening_shear(curve, drop, scale, soft_slip), soft, 1e-12 * soft);
  }
}

TEST(ShearCurve, Limits) {
  EXPECT_NEAR(hardening_shear(curve, 1e-12, 1e-3), 2e6 * std::tan(0.6), 1e-6);
  EXPECT_NEAR(hardening_shear(curve, scale, 40 * scale + 1e-4), 2e6 * std::tan(0.6), 1);
  EXPECT_DOUBLE_EQ(softening_shear(curve, drop, scale, 1e-5), 5e5);
  EXPECT_NEAR(softening_shear(curve, drop, scale, 1e-2), 2e6 * (std::tan(0.6) - drop), 1e-3);
}

}  // namespace
}  // namespace voussoir::reference::shear_curve_test
