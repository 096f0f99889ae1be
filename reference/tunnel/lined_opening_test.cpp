// A lined opening under unequal stresses, by the network of an isotropic jointed mass and by an annulus of elastic
// rock: thrust and moment that vary around the ring.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "reference/tunnel/isotropic_mass.hpp"
#include "reference/tunnel/lining.hpp"

using namespace voussoir::reference::network;

namespace voussoir::reference::lined_opening_test {
namespace {

using std::numbers::pi;

struct LinedOpening {
  double radius = 5, fixed_radius = 35, vertical = 662175, k0 = 0.5;
  IsotropicModuli rock = isotropic_moduli(1, 5e9, 0.5e9);
  double axial = 7.5e9, bending = 56.25e6, interface = 0;  // in both directions
};

// Michell's stress function (A r^-2 + B + C r^2 + D r^4) cos 2t of rock that is held at R, a thin ring inside, and an
// interface between them whose displacement is traction over K_L in both directions. t from the springline; tension
// positive, displacements outward and counter-clockwise. Unknowns as stresses at the wall: A/a^4, B/a^2, C, D a^2, the
// tractions p cos 2t, q sin 2t there, and 2G/a times the ring's u cos 2t, v sin 2t.
RingLiningForces by_stress_function(const LinedOpening& o) {
  const double a = o.radius, nu = o.rock.poisson_ratio, two_g = 2 * o.rock.shear_modulus,
               wave = o.vertical * (1 - o.k0) / 2;
  const double hoop = o.axial / (a * two_g), curl = 9 * o.bending / (a * a * a * two_g),
               gives = two_g / (o.interface * a);
  const double out = o.fixed_radius / a;
  // 2G u/r and 2G v/r at out times the radius
  const auto radial = [&](double x) {
    return Eigen::RowVector4d(2 * std::pow(x, -4), 4 * (1 - nu) * std::pow(x, -2), -2, -4 * nu * x * x);
  };
  const auto tangential = [&](double x) {
    return Eigen::RowVector4d(2 * std::pow(x, -4), -2 * (1 - 2 * nu) * std::pow(x, -2), 2, (6 - 4 * nu) * x * x);
  };
  Eigen::Matrix<double, 8, 8> m = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> right = Eigen::Matrix<double, 8, 1>::Zero();
  m.row(0) << -6, -4, -2, 0, -1, 0, 0, 0;  // in-situ stress there, (wave, -wave), plus the stress function's
  m.row(1) << -6, -2, 2, 6, 0, -1, 0, 0;
  right(0) = -wave, right(1) = wave;
  m.row(2).head<4>() = radial(out);
  m.row(3).head<4>() = tangential(out);
  m.row(4) << 0, 0, 0, 0, -1, 0, hoop + curl, 2 * hoop;
  m.row(5) << 0, 0, 0, 0, 0, 1, -2 * hoop, -4 * hoop;
  m.row(6).head<4>() = radial(1);  // wall - ring = traction over the interface
  m.row(6)(4) = -gives, m.row(6)(6) = -1;
  m.row(7).head<4>() = tangential(1);
  m.row(7)(5) = -gives, m.row(7)(7) = -1;
  const Eigen::Matrix<double, 8, 1> x = m.fullPivLu().solve(right);
  const double hogging = 3 * o.bending / (a * a) * (x(6) * a / two_g);
  SoftLining mean{a, o.vertical * (1 + o.k0) / 2, o.rock.shear_modulus, o.axial / 0.3, 0.3, o.interface, 0};
  mean.fixed_radius = o.fixed_radius, mean.ground_poisson_ratio = nu;
  return {lining_hoop_force(mean), -x(4) * a + 4 * hogging / a, hogging};
}

// Rock that is held far away and a stiff interface: the relative stiffness solution, but for I/(A a²) = 3e-4, by which
// the ring's bending adds to its hoop stiffness in one and not in the other.
TEST(LinedOpening, StressFunctionOfRockHeldFarAway) {
  LinedOpening o;
  o.fixed_radius = 1e4, o.interface = 1e15;
  const double g = o.rock.shear_modulus, nu = o.rock.poisson_ratio;
  const RingLiningForces held = by_stress_function(o);
  const RingLiningForces endless = ring_lining(
      {o.radius, o.vertical, o.k0, 2 * g * (1 + nu), nu, 25e9, 0.3, 0.3 * 0.3 * 0.3 / 12, 0}, LiningContact::no_slip);
  EXPECT_NEAR(held.moment_wave / endless.moment_wave, 1, 2e-3);
  EXPECT_NEAR(held.thrust_wave / endless.thrust_wave, 1, 2e-3);
  EXPECT_NEAR(held.thrust_mean / endless.thrust_mean, 1, 2e-3);
}

RingLiningForces by_network(const LinedOpening& o, double relative_spacing) {
  OpeningNetwork built =
      build({o.radius, o.fixed_radius, 96, relative_spacing * o.radius, 0.1, {0.13, 0.55, 0.77}, o.rock, 2});
  constexpr double deep = 1e7;  // m: stress that is uniform to 1e-6
  relieve(built.network.blocks, built.wall, {deep, o.vertical / deep, o.k0, 0});
  add_ring(built, o.axial, o.bending, o.interface);
  const Solution solution = solve(built.network);
  RingLiningForces forces;
  const double count = static_cast<double>(solution.beams.size());
  for (std::size_t i = 0; i < solution.beams.size(); ++i) {
    const double node = 2 * pi * static_cast<double>(i) / count + pi / 2, middle = node + pi / count;  // from the crown
    forces.thrust_mean += solution.beams[i].thrust / count;
    forces.thrust_wave -= 2 * solution.beams[i].thrust * std::cos(2 * middle) / count;
    forces.moment_wave += 2 * solution.beams[i].start_moment * std::cos(2 * node) / count;
  }
  return forces;
}

// Blocks of a fifth of the radius: within 15 %, and nearer than blocks twice as large, to first order or faster.
TEST(LinedOpening, UnequalStresses) {
  for (const double interface : {0.1e9, 1e9}) {
    LinedOpening o;
    o.interface = interface;
    const RingLiningForces rock = by_stress_function(o), fine = by_network(o, 0.2), coarse = by_network(o, 0.4);
    const auto compare = [&](double RingLiningForces::*part) {
      const double error = std::abs(fine.*part / (rock.*part) - 1);
      EXPECT_LT(error, 0.15);
      EXPECT_LT(error, 0.75 * std::abs(coarse.*part / (rock.*part) - 1));  // half, and the scatter of one mass
    };
    compare(&RingLiningForces::thrust_mean);
    compare(&RingLiningForces::thrust_wave);
    compare(&RingLiningForces::moment_wave);
  }
}

}  // namespace
}  // namespace voussoir::reference::lined_opening_test
