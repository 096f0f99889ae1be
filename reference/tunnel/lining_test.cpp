#include "reference/tunnel/lining.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/ode.hpp"

namespace voussoir::reference::lining_test {
namespace {

constexpr double pi = std::numbers::pi;

SoftLining boon_lining(double interface_stiffness) {
  return {5, 662175, 0.385e9, 25e9, 0.3, interface_stiffness, 0};
}

RingLining boon_ring(double horizontal_ratio) {
  return {5, 662175, horizontal_ratio, 2 * 0.385e9 * 1.2, 0.2, 25e9, 0.3, 0.3 * 0.3 * 0.3 / 12, 0};
}

// Eqs 5.14 and H.6
TEST(SoftLining, BoonHoopForces) {
  EXPECT_NEAR(lining_hoop_force(boon_lining(1e6)) / 1e3, 21.29, 0.006);
  EXPECT_NEAR(lining_hoop_force(boon_lining(0.1e9)) / 1e3, 1084.3, 0.06);
  EXPECT_NEAR(lining_hoop_force(boon_lining(1e9)) / 1e3, 1985.7, 0.06);
}

// Eqs H.1-H.6 as three springs that share one pressure: iterate on the pressure instead of solving.
TEST(SoftLining, CompatibilityOfDisplacements) {
  const SoftLining l = boon_lining(0.1e9);
  double low = 0, high = l.in_situ_pressure;
  for (int i = 0; i < 200; ++i) {
    const double p = (low + high) / 2;
    const double ground = (l.in_situ_pressure - p) * l.radius / (2 * l.shear_modulus);
    const double support =
        p * l.radius * l.radius / (l.lining_modulus * l.lining_thickness) + p / l.interface_stiffness;
    (ground > support ? low : high) = p;
  }
  EXPECT_NEAR(lining_hoop_force(l), low * l.radius, 1e-8);
}

TEST(SoftLining, LimitsAndScaling) {
  SoftLining l = boon_lining(1e30);
  l.lining_modulus = 1e30;
  EXPECT_NEAR(lining_hoop_force(l), l.in_situ_pressure * l.radius, 1e-6);  // rigid: the whole pressure
  l.lining_modulus = 1e-10;
  EXPECT_NEAR(lining_hoop_force(l), 0, 1e-6);
  SoftLining large = boon_lining(0.1e9 / 10);  // lengths by 10, stresses as before
  large.radius *= 10, large.lining_thickness *= 10;
  EXPECT_NEAR(lining_hoop_force(large), 10 * lining_hoop_force(boon_lining(0.1e9)), 1e-6);
  l.lining_thickness = 0;
  EXPECT_THROW(lining_hoop_force(l), std::invalid_argument);
}

// Ground held at R: plain rock integrated inwards from there, and the lining's pressure from the wall's two conditions,
// displacement = pressure times the support's flexibility, stress decrease = p0 - pressure.
TEST(SoftLining, HeldGroundByIntegration) {
  for (const double held : {7.0, 35.0})
    for (const double interface : {1e6, 0.1e9, 1e9}) {
      SoftLining l = boon_lining(interface);
      l.fixed_radius = held, l.ground_poisson_ratio = 0.4;
      const auto wall = integrate_ode(
          [](double r, const double* u, double* slope) {
            slope[0] = u[1];
            slope[1] = u[0] / (r * r) - u[1] / r;
          },
          {0, -1}, held, l.radius);
      const double nu = 0.4;
      const double stress = 2 * l.shear_modulus * ((1 - nu) * wall[1] + nu * wall[0] / l.radius) / (1 - 2 * nu);
      const double flexibility =
          l.radius * l.radius / (l.lining_modulus * l.lining_thickness) + 1 / l.interface_stiffness;
      // inward wall -factor u = flexibility p, factor stress = p0 - p
      const double factor = l.in_situ_pressure / (stress - wall[0] / flexibility);
      EXPECT_NEAR(lining_hoop_force(l) / (-factor * wall[0] / flexibility * l.radius), 1, 1e-9);
      EXPECT_LT(lining_hoop_force(l), lining_hoop_force(boon_lining(interface)));
      l.fixed_radius = 1e8;
      EXPECT_NEAR(lining_hoop_force(l), lining_hoop_force(boon_lining(interface)), 1e-6);
    }
  SoftLining inside = boon_lining(1e6);
  inside.fixed_radius = 4;
  EXPECT_THROW(lining_hoop_force(inside), std::invalid_argument);
}

// --- Einstein & Schwartz

// The same problem from an Airy function outside the hole and a thin ring, as a linear system in the amplitudes of the
// tractions and displacements; angle t from the springline, tension positive, displacement outward and
// counter-clockwise.
//   ground: phi = (A r^-2 + B) cos 2t;  ring: EA (v'' + u')/R^2 = -q,  EA (v' + u)/R^2 + EI/R^4 (u'''' + 2u'' + u) = p
RingLiningForces by_airy_function(const RingLining& l, LiningContact contact) {
  const double r = l.radius, nu = l.ground_poisson_ratio, two_g = l.ground_modulus / (1 + nu);
  const double plane = 1 - l.lining_poisson_ratio * l.lining_poisson_ratio;
  const double axial = l.lining_modulus * l.lining_area / plane, bending = l.lining_modulus * l.lining_inertia / plane;
  const double mean = l.vertical_stress * (1 + l.horizontal_ratio) / 2,
               wave = l.vertical_stress * (1 - l.horizontal_ratio) / 2;
  RingLiningForces forces;

  // n = 0: the ring's uniform shrinkage meets the ground's
  const double ring_stiffness = axial / (r * r) + bending / (r * r * r * r), ground_stiffness = two_g / r;
  forces.thrust_mean = mean * r * ring_stiffness / (ring_stiffness + ground_stiffness);

  // n = 2, unknowns scaled to stresses: A/R^4, B/R^2 (ground), p, q (radial p cos 2t and shear q sin 2t at the wall),
  // and 2G u/R, 2G v/R (ring)
  const double hoop = axial / (r * two_g), curl = 9 * bending / (r * r * r * two_g);
  Eigen::Matrix<double, 6, 6> m;
  Eigen::Matrix<double, 6, 1> right;
  right << -wave, wave, 0, 0, 0, 0;
  m.row(0) << -6, -4, -1, 0, 0, 0;  // in-situ stress (wave, -wave) plus the Airy stress is the wall's
  m.row(1) << -6, -2, 0, -1, 0, 0;
  m.row(2) << 0, 0, -1, 0, hoop + curl, 2 * hoop;  // the ring, pulled outward by p and along t by q
  m.row(3) << 0, 0, 0, 1, -2 * hoop, -4 * hoop;
  m.row(4) << 2, 4 * (1 - nu), 0, 0, -1, 0;  // radial displacements meet
  if (contact == LiningContact::no_slip)
    m.row(5) << 2, -2 * (1 - 2 * nu), 0, 0, 0, -1;  // and so do the tangential ones
  else
    m.row(5) << 0, 0, 0, 1, 0, 0;
  const Eigen::Matrix<double, 6, 1> x = m.fullPivLu().solve(right);
  const double pull = x(2), u = x(4) * r / two_g;

  // Statics of the ring: u > 0 at the springline bends it more there (hogging) and less at the crown (sagging); the
  // thrust from the radial balance T + M''/R = -pull R of the hogging moment.
  const double hogging = 3 * bending / (r * r) * u;
  forces.moment_wave = hogging;
  forces.thrust_wave = -pull * r + 4 * hogging / r;
  return forces;
}

TEST(RingLining, IndependentElasticSolution) {
  for (const double k : {0.3, 0.5, 1.0, 1.5})
    for (const double nu : {0.0, 0.2, 0.37, 0.49})
      for (const double modulus : {1e6, 1e8, 1e10, 1e13})
        for (const double thickness : {0.05, 0.3, 1.0})
          for (const LiningContact contact : {LiningContact::full_slip, LiningContact::no_slip}) {
            RingLining l = boon_ring(k);
            l.ground_poisson_ratio = nu;
            l.lining_poisson_ratio = 0.15;
            l.lining_modulus = modulus;
            l.lining_area = thickness;
            l.lining_inertia = std::pow(thickness, 3) / 12;
            const RingLiningForces closed = ring_lining(l, contact), other = by_airy_function(l, contact);
            const double size = l.vertical_stress * l.radius;
            EXPECT_NEAR(closed.thrust_mean, other.thrust_mean, 1e-9 * size);
            EXPECT_NEAR(closed.thrust_wave, other.thrust_wave, 1e-7 * size) << int(contact) << " nu " << nu;
            EXPECT_NEAR(closed.moment_wave, other.moment_wave, 1e-7 * size * l.radius) << int(contact) << " nu " << nu;
          }
}

TEST(RingLining, HydrostaticIsTheAxisymmetricLining) {
  const RingLining ring = boon_ring(1);
  for (const LiningContact contact : {LiningContact::full_slip, LiningContact::no_slip}) {
    const RingLiningForces forces = ring_lining(ring, contact);
    EXPECT_EQ(forces.moment_wave, 0);
    EXPECT_EQ(forces.thrust_wave, 0);
    // the ring's bending adds I/(A R^2) = t^2/(12 R^2) to its hoop stiffness, 0.03 %
    const double thin = lining_hoop_force(boon_lining(1e30));
    EXPECT_NEAR(forces.thrust_mean, thin, thin * 0.09 / 300);
  }
  RingLining thin = ring;
  thin.lining_inertia *= 1e-6;
  const double exact = lining_hoop_force(boon_lining(1e30));
  EXPECT_NEAR(ring_lining(thin, LiningContact::no_slip).thrust_mean, exact, 1e-8 * exact);
}

TEST(RingLining, StiffnessLimits) {
  RingLining l = boon_ring(0.5);
  const double nu = l.ground_poisson_ratio, wave = l.vertical_stress * 0.25 * l.radius;
  // no bending stiffness, full slip: no moment, no wave of thrust
  l.lining_inertia = 1e-14;
  EXPECT_NEAR(ring_lining(l, LiningContact::full_slip).moment_wave, 0, 1e-6 * wave * l.radius);
  // rigid in bending, full slip: (1 - K)/2 (3 - 4 nu)/(5 - 6 nu)
  l.lining_inertia = 1e9;
  EXPECT_NEAR(ring_lining(l, LiningContact::full_slip).moment_wave / (wave * l.radius), (3 - 4 * nu) / (5 - 6 * nu),
              1e-8);
  // No lining at all: no force.
  l = boon_ring(0.5);
  l.lining_modulus = 1e-6;
  for (const LiningContact contact : {LiningContact::full_slip, LiningContact::no_slip}) {
    EXPECT_NEAR(ring_lining(l, contact).thrust_mean, 0, 1e-9 * wave);
    EXPECT_NEAR(ring_lining(l, contact).thrust_wave, 0, 1e-9 * wave);
  }
}

TEST(RingLining, SymmetrySignsAndScaling) {
  for (const LiningContact contact : {LiningContact::full_slip, LiningContact::no_slip}) {
    const RingLiningForces low = ring_lining(boon_ring(0.5), contact);
    EXPECT_GT(moment_at(low, 0), 0);                       // the crown sags
    EXPECT_GT(thrust_at(low, pi / 2), thrust_at(low, 0));  // the thrust is larger at the springline
    EXPECT_NEAR(moment_at(low, 0.3), moment_at(low, pi - 0.3), 1e-6);
    EXPECT_NEAR(thrust_at(low, 0.3), thrust_at(low, -0.3), 1e-6);

    // the axes exchanged: vertical stress 0.5 P at K = 2 is P at K = 0.5 turned by a right angle
    RingLining turned = boon_ring(2);
    turned.vertical_stress *= 0.5;
    const RingLiningForces other = ring_lining(turned, contact);
    EXPECT_NEAR(moment_at(other, 0.3), moment_at(low, 0.3 + pi / 2), 1e-6);
    EXPECT_NEAR(thrust_at(other, 0.3), thrust_at(low, 0.3 + pi / 2), 1e-5);

    RingLining large = boon_ring(0.5);
    large.radius *= 10, large.lining_area *= 10, large.lining_inertia *= 1000;
    EXPECT_NEAR(ring_lining(large, contact).moment_wave, 100 * low.moment_wave, 1e-6 * std::abs(low.moment_wave));
    EXPECT_NEAR(ring_lining(large, contact).thrust_wave, 10 * low.thrust_wave, 1e-6 * std::abs(low.thrust_wave));
  }
  RingLining bad = boon_ring(0.5);
  bad.ground_poisson_ratio = 0.5;
  EXPECT_THROW(ring_lining(bad, LiningContact::no_slip), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::lining_test
