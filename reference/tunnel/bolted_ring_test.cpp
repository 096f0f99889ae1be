#include "reference/tunnel/bolted_ring.hpp"
#include "text/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using voussoir::degree;

namespace voussoir::reference::bolted_ring_test {
namespace {

// Boon (2013), section 5.4: D 10 m, centre 25 m deep at 2700 kg/m3, 0.2 GN/m per joint, s_mean 0.77 m, unit thickness.
BoltedRing boon_ring(double shear_modulus, double poisson_ratio) {
  return {5, 662175, shear_modulus, poisson_ratio, 0.2e9, 0.77, 7, 5 * 11.25 * degree, 1};
}

// Eqs 5.3 and G.3
TEST(BoltedRing, BoonWallBoltForces) {
  EXPECT_NEAR(bolted_ring_at(boon_ring(0.385e9, 0.2), 5).bolt_force / 1e3, 113.27, 0.006);
  EXPECT_NEAR(bolted_ring_at(boon_ring(1.604e9, 0.2), 5).bolt_force / 1e3, 30.55, 0.006);
  EXPECT_NEAR(bolted_ring_at(boon_ring(0.527e9, 0.37), 5).bolt_force / 1e3, 88.85, 0.006);
}

TEST(BoltedRing, ClosedFormAgreesWithTheDifferentialEquation) {
  for (const double shear_modulus : {0.05e9, 0.385e9, 1.604e9, 50e9})
    for (const double poisson_ratio : {0.0, 0.2, 0.37, 0.49})
      for (const double distance : {5.0, 6.0, 8.0, 11.9, 12.0, 13.0, 40.0}) {
        const BoltedRing ring = boon_ring(shear_modulus, poisson_ratio);
        const BoltedRingState closed = bolted_ring_at(ring, distance), ode = bolted_ring_at_by_ode(ring, distance);
        EXPECT_NEAR(closed.convergence, ode.convergence, 1e-9 * closed.convergence);
        EXPECT_NEAR(closed.bolt_force, ode.bolt_force, 1e-9 * closed.bolt_force);
        EXPECT_NEAR(closed.radial_stress, ode.radial_stress, 1e-9 * ring.in_situ_pressure);
        EXPECT_NEAR(closed.hoop_stress, ode.hoop_stress, 1e-9 * ring.in_situ_pressure);
      }
}

// Equilibrium of the total stresses, by differences of the returned stresses: no equation of the code is used.
TEST(BoltedRing, StressesAreInEquilibrium) {
  const BoltedRing ring = boon_ring(0.385e9, 0.2);
  EXPECT_NEAR(bolted_ring_at(ring, 5).radial_stress, 0, 1e-6);
  EXPECT_NEAR(bolted_ring_at(ring, 5e4).radial_stress, 662175, 1e-2);
  for (const double r : {5.5, 7.0, 11.0, 14.0}) {
    const double h = 1e-4;
    const double slope =
        (bolted_ring_at(ring, r + h).radial_stress - bolted_ring_at(ring, r - h).radial_stress) / (2 * h);
    const BoltedRingState here = bolted_ring_at(ring, r);
    const double rock_and_bolts = here.radial_stress, hoop = here.hoop_stress;  // bolts have no hoop stress
    EXPECT_NEAR(slope + (rock_and_bolts - hoop) / r, 0, 1e-6 * 662175);
    // Hooke's law (Eqs 5.10 and 5.11) in the rock alone: hoop strain u/r from the stresses
    const double bolts = -here.bolt_force / (ring.tangential_spacing * ring.longitudinal_spacing * r / ring.radius);
    const double rock = here.radial_stress - 662175 - (r <= 12 ? bolts : 0);
    const double strain = ((1 - 0.2) * (hoop - 662175) - 0.2 * rock) / (2 * 0.385e9);
    EXPECT_NEAR(strain, here.convergence / r, 1e-9);
  }
  // at the bolts' end only the bolts' own stress jumps
  const BoltedRingState inner = bolted_ring_at(ring, 12), outer = bolted_ring_at(ring, 12 + 1e-9);
  EXPECT_NEAR(inner.radial_stress, outer.radial_stress, 1e-3);
  EXPECT_NEAR(inner.convergence, outer.convergence, 1e-11);
}

TEST(BoltedRing, NoBoltsIsThePlainOpening) {
  BoltedRing ring = boon_ring(0.385e9, 0.3);
  for (const double stiffness : {0.0, 1e-290, 1e-6, 1e-3}) {
    ring.bolt_stiffness = stiffness;
    for (const double r : {5.0, 8.0, 20.0}) {
      const BoltedRingState state = bolted_ring_at(ring, r);
      EXPECT_NEAR(state.convergence, 662175 * 25 / (2 * 0.385e9 * r), 1e-12);
      EXPECT_NEAR(state.radial_stress, 662175 * (1 - 25 / (r * r)), 1e-5);
      EXPECT_NEAR(state.hoop_stress, 662175 * (1 + 25 / (r * r)), 1e-5);
    }
  }
  ring = boon_ring(0.385e9, 0.3);
  ring.bolt_length = 0;
  EXPECT_NEAR(bolted_ring_at(ring, 6).convergence, 662175 * 25 / (2 * 0.385e9 * 6), 1e-12);
}

// Held at R: the closed form against integration from R inwards; R to infinity; u(R) = 0; no bolts: Lamé's annulus.
TEST(BoltedRing, HeldAtARadius) {
  for (const double shear_modulus : {0.2e9, 1.6e9})
    for (const double poisson_ratio : {0.0, 0.37, 0.45})
      for (const double held : {12.5, 20.0, 35.0, 400.0})
        for (const double distance : {5.0, 8.0, 12.0, 12.3}) {
          BoltedRing ring = boon_ring(shear_modulus, poisson_ratio);
          ring.fixed_radius = held;
          const BoltedRingState closed = bolted_ring_at(ring, distance), ode = bolted_ring_at_by_ode(ring, distance);
          EXPECT_NEAR(closed.convergence, ode.convergence, 1e-8 * closed.convergence);
          EXPECT_NEAR(closed.bolt_force, ode.bolt_force, 1e-8 * closed.bolt_force);
          EXPECT_NEAR(closed.radial_stress, ode.radial_stress, 1e-8 * ring.in_situ_pressure);
          EXPECT_NEAR(closed.hoop_stress, ode.hoop_stress, 1e-8 * ring.in_situ_pressure);
        }
  const BoltedRing endless = boon_ring(0.385e9, 0.2);
  BoltedRing ring = endless;
  double error[2];
  for (const int further : {0, 1}) {
    ring.fixed_radius = further ? 2e4 : 1e4;
    error[further] = bolted_ring_at(endless, 5).bolt_force - bolted_ring_at(ring, 5).bolt_force;
    EXPECT_NEAR(bolted_ring_at(ring, ring.fixed_radius).convergence, 0, 1e-15);
  }
  EXPECT_NEAR(error[0] / error[1], 4, 1e-3);  // falls as (a/R)²
  EXPECT_LT(std::abs(error[1]), 1e-6 * bolted_ring_at(endless, 5).bolt_force);

  // plain rock: u = B (1/r - r/R²), its radial stress 2G ((1 - nu) u' + nu u/r)/(1 - 2 nu) cancels p0 at the wall
  ring.bolt_stiffness = 0, ring.fixed_radius = 35;
  const double a = 5, held = 35, nu = 0.2, two_g = 2 * 0.385e9;
  const double slope = -1 / (a * a) - 1 / (held * held), value = 1 / a - a / (held * held);
  const double factor = 662175 / two_g * (1 - 2 * nu) / ((1 - nu) * slope + nu * value / a);
  EXPECT_NEAR(bolted_ring_at(ring, 5).convergence, -factor * value, 1e-15);
  EXPECT_NEAR(662175 * a / (2 * modulus_of_held_rock(0.385e9, nu, a, held)), -factor * value, 1e-15);
  EXPECT_NEAR(modulus_of_held_rock(0.385e9, nu, a, 1e7), 0.385e9, 1);
  EXPECT_EQ(modulus_of_held_rock(0.385e9, nu, a, endless.fixed_radius), 0.385e9);
}

TEST(BoltedRing, MeanForceIsTheIntegral) {
  BoltedRing ring = boon_ring(0.385e9, 0.3);
  ring.fixed_radius = 35;
  double sum = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i)
    sum += bolted_ring_at(ring, 5 + 7 * (i + 0.5) / steps).bolt_force / steps;
  EXPECT_NEAR(mean_bolt_force(ring), sum, 1e-6 * sum);  // midpoint rule, second order in 1/2000
}

TEST(BoltedRing, ScalesWithLengthAndPressure) {
  const BoltedRing ring = boon_ring(0.385e9, 0.2);
  const BoltedRingState base = bolted_ring_at(ring, 6);
  BoltedRing large = ring;  // lengths by 10; force per bolt by 100, so stiffness times spacing by 100
  large.radius = 50, large.bolt_length = 70, large.tangential_spacing *= 10, large.longitudinal_spacing = 10;
  large.mean_joint_spacing *= 10, large.bolt_stiffness *= 10;
  EXPECT_NEAR(bolted_ring_at(large, 60).convergence, 10 * base.convergence, 1e-13);
  EXPECT_NEAR(bolted_ring_at(large, 60).bolt_force, 100 * base.bolt_force, 1e-5);
  BoltedRing pressed = ring;
  pressed.in_situ_pressure *= 3;
  EXPECT_NEAR(bolted_ring_at(pressed, 6).bolt_force, 3 * base.bolt_force, 1e-6);
  // twice as many bolts of half the stiffness
  BoltedRing dense = ring;
  dense.tangential_spacing /= 2, dense.bolt_stiffness /= 2;
  EXPECT_NEAR(bolted_ring_at(dense, 6).convergence, base.convergence, 1e-15);
  EXPECT_NEAR(bolted_ring_at(dense, 6).bolt_force, base.bolt_force / 2, 1e-7);
}

TEST(BoltedRing, RefusesBadInput) {
  BoltedRing ring = boon_ring(0.385e9, 0.5);
  EXPECT_THROW(bolted_ring_at(ring, 5), std::invalid_argument);
  ring = boon_ring(0.385e9, 0.2);
  EXPECT_THROW(bolted_ring_at(ring, 4.9), std::invalid_argument);
  ring.fixed_radius = 11.9;  // within the bolts
  EXPECT_THROW(bolted_ring_at(ring, 5), std::invalid_argument);
  ring.fixed_radius = 20;
  EXPECT_THROW(bolted_ring_at(ring, 20.1), std::invalid_argument);
  ring.tangential_spacing = 0;
  EXPECT_THROW(bolted_ring_at_by_ode(ring, 5), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::bolted_ring_test
