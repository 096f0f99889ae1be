// Against quadratures in thirty digits.
#include "reference/small/rough_joint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace voussoir::reference::rough_joint_test {
namespace {

constexpr double degree = std::numbers::pi / 180;
const RoughJoint sample{10, 30e6, 26 * degree};
constexpr double springs = 1 / (1 / 10e9 + 1 / 2e9), shear_stiffness = 8e9;

// the slip at which the plastic slip is a given one
double total(const RoughJoint& joint, double plastic, double stress) {
  return plastic + stress * std::tan(friction_at(joint, plastic, stress)) / shear_stiffness;
}

TEST(RoughJoint, BetweenSpringsWithoutMobilisation) {
  const double start[] = {0.1e6, 1e6, 5e6}, normal[] = {0.6639861492782e6, 1.408458589545e6, 5.223892256152e6},
               shear[] = {0.6094899659786e6, 1.15214397259e6, 3.469598588022e6};
  for (int k = 0; k < 3; ++k) {
    const ShearedJoint found =
        shear_between_springs(sample, start[k], springs, shear_stiffness, total(sample, 2e-3, normal[k]));
    EXPECT_NEAR(found.plastic_slip, 2e-3, 1e-9 * 2e-3);
    EXPECT_NEAR(found.normal_stress, normal[k], 1e-9 * normal[k]);
    EXPECT_NEAR(found.shear_stress, shear[k], 1e-9 * shear[k]);
  }
}

TEST(RoughJoint, BetweenSpringsMobilised) {
  const RoughJoint joint = of_block(sample, 0.1, 0.1);
  EXPECT_NEAR(joint.peak_slip, 0.9141763792298e-3, 1e-15);
  const double times[] = {1, 4, 10}, normal[] = {1.08998219274e6, 1.53875617821e6, 2.1212432432e6};
  for (int k = 0; k < 3; ++k) {
    const double plastic = times[k] * joint.peak_slip;
    const ShearedJoint found =
        shear_between_springs(joint, 1e6, springs, shear_stiffness, total(joint, plastic, normal[k]));
    EXPECT_NEAR(found.normal_stress, normal[k], 1e-7 * normal[k]);
  }
}

TEST(RoughJoint, OfABlockIsLessRough) {
  const RoughJoint block = of_block({15, 150e6, 26 * degree}, 0.1, 1);
  EXPECT_NEAR(block.jrc, 7.517808504409, 1e-12 * 8);
  EXPECT_NEAR(block.jcs, 53.22200838504e6, 1e-12 * 54e6);
  EXPECT_NEAR(block.peak_slip, 3.891706781513e-3, 1e-12);
}

TEST(RoughJoint, TiltsToItsEnvelope) {
  for (const double weight : {200.0, 2000.0, 20e3}) {
    const double angle = tilt_angle(sample, weight), stress = weight * std::cos(angle);
    EXPECT_NEAR(angle / degree, std::min(70.0, 26 + 10 * std::log10(30e6 / stress)), 1e-10);
  }
}

}  // namespace
}  // namespace voussoir::reference::rough_joint_test
