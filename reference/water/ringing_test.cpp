#include "reference/water/ringing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "text/angle.hpp"

using voussoir::degree;

namespace voussoir::reference::ringing_test {
namespace {

RingingBlock block(double shear_stiffness) {
  return {2000, 35 * degree, 40 * degree, 1e7, shear_stiffness, 9.81};
}

// Second derivation: leapfrog in short steps with the joint's force returned to its strength, normal motion included.
double slip_by_steps(const RingingBlock& b, double time) {
  const double dt = 2e-6, c = std::cos(b.incline), s = std::sin(b.incline);
  double overlap = 0.5 * b.mass * b.gravity * c / b.normal_stiffness, closing = 0;
  double force = 0.5 * b.mass * b.gravity * s, speed = 0, slip = 0;
  for (double t = 0; t < time; t += dt) {
    const double normal = b.normal_stiffness * overlap, strength = normal * std::tan(b.friction_angle);
    const double over = std::abs(force) - strength;
    if (over > 0) {
      slip += over / b.shear_stiffness;
      force = std::copysign(strength, force);
    }
    closing += dt * (b.gravity * c - normal / b.mass);
    speed += dt * (b.gravity * s - force / b.mass);
    overlap += dt * closing;
    force += b.shear_stiffness * speed * dt;
  }
  return slip;
}

TEST(RingingBlock, WorkedValues) {
  EXPECT_NEAR(ringing_slip(block(2.5e6), 0.5), 24.483672e-3, 5e-10);
  EXPECT_NEAR(ringing_slip(block(2.5e6), 1), 52.731288e-3, 5e-10);
}

TEST(RingingBlock, ByShortSteps) {
  for (const double shear : {1e6, 2.5e6, 6e6})
    EXPECT_NEAR(ringing_slip(block(shear), 0.5), slip_by_steps(block(shear), 0.5),
                2e-4 * slip_by_steps(block(shear), 0.5));
}

TEST(RingingBlock, Limits) {
  // both vibrations equal: the shear force keeps its ratio to the normal one
  EXPECT_EQ(ringing_slip(block(1e7), 1), 0);
  EXPECT_EQ(ringing_slip(block(2.5e6), 0), 0);
  // so much friction that the largest shear force never exceeds it, even at the smallest contact force
  RingingBlock held = block(2.5e6);
  held.friction_angle = std::atan(3.001 * std::tan(35 * degree));
  EXPECT_EQ(ringing_slip(held, 1), 0);
  // slip is irreversible
  double last = 0;
  for (double time = 0; time < 0.6; time += 0.05) {
    EXPECT_GE(ringing_slip(block(2.5e6), time), last);
    last = ringing_slip(block(2.5e6), time);
  }
}

TEST(RingingBlock, Scaling) {
  // four times gravity at half the time: the same positions
  RingingBlock quick = block(4 * 2.5e6);
  quick.normal_stiffness *= 4;
  quick.gravity *= 4;
  EXPECT_NEAR(ringing_slip(quick, 0.5), ringing_slip(block(2.5e6), 1), 1e-9);
  RingingBlock heavy = block(2.5e7);
  heavy.mass *= 10;
  heavy.normal_stiffness *= 10;
  EXPECT_NEAR(ringing_slip(heavy, 1), ringing_slip(block(2.5e6), 1), 1e-9);
}

TEST(RingingBlock, RefusesValuesOutOfRange) {
  RingingBlock steep = block(2.5e6);
  steep.incline = 41 * degree;
  EXPECT_THROW(ringing_slip(steep, 1), std::invalid_argument);
  EXPECT_THROW(ringing_slip(block(0), 1), std::invalid_argument);
  EXPECT_THROW(ringing_slip(block(1e6), -1), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::ringing_test
