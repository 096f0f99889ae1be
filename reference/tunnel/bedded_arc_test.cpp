// The bedded arc: against the energy of a chain of short pieces, on a bed without friction, far from its ends, and
// scaled.
#include "reference/tunnel/bedded_arc.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace voussoir::reference::bedded_arc_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

BeddedArc invert() {
  return {5, 59 * degree, 25e9 * 0.3, 25e9 * 0.027 / 12, 1e9, 1e8, 2400 * 9.81 * 0.3};
}

// Half the arc as n intervals with nodes of w and u: the energy's integrals by differences, its minimum by a linear
// system. Symmetric at the lowest point; beyond the end there is nothing.
MemberForces by_differences(const BeddedArc& arc, int n) {
  const double h = arc.half_angle / n, a = arc.radius;
  const auto w = [](int i) { return 2 * std::abs(i); };
  const auto u = [](int i) { return 2 * std::abs(i) + 1; };
  const auto sign = [](int i) { return i < 0 ? -1.0 : 1.0; };  // u is odd
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * n + 2);
  const auto add = [&](const Eigen::VectorXd& strain, double weight) {
    stiffness += weight * strain * strain.transpose();
  };
  const auto zero = [&] { return Eigen::VectorXd(Eigen::VectorXd::Zero(2 * n + 2)); };
  const auto bending_at = [&](int i) {
    Eigen::VectorXd strain = zero();
    for (const auto& [place, factor] : {std::pair(i - 1, 1.0), {i, -2.0}, {i + 1, 1.0}})
      strain[w(place)] += factor / (h * h * a * a);
    strain[u(i + 1)] += 1 / (2 * h * a * a);
    strain[u(i - 1)] -= sign(i - 1) / (2 * h * a * a);
    return strain;
  };
  const auto axial_in = [&](int i) {  // between nodes i and i + 1
    Eigen::VectorXd strain = zero();
    strain[w(i)] = strain[w(i + 1)] = 0.5 / a;
    strain[u(i + 1)] -= 1 / (h * a);
    strain[u(i)] += 1 / (h * a);
    return strain;
  };
  for (int i = 0; i <= n; ++i) {
    const double length = (i == 0 || i == n ? 0.5 : 1) * h * a, angle = i * h;
    stiffness(w(i), w(i)) += arc.normal_stiffness * length;
    stiffness(u(i), u(i)) += arc.shear_stiffness * length;
    load[w(i)] -= arc.weight * std::cos(angle) * length;
    load[u(i)] -= arc.weight * std::sin(angle) * length;
    if (i < n) add(axial_in(i), arc.axial_stiffness * h * a);
    if (i < n) add(bending_at(i), arc.bending_stiffness * length);
  }
  stiffness(1, 1) += 1e6 * arc.axial_stiffness;  // u = 0 at the lowest point
  const Eigen::VectorXd moved = stiffness.ldlt().solve(load);
  return {-arc.bending_stiffness * bending_at(0).dot(moved), arc.axial_stiffness * axial_in(0).dot(moved)};
}

TEST(BeddedArc, MinimisesItsEnergy) {
  for (const double shear : {1e6, 1e8, 3e9}) {
    BeddedArc arc = invert();
    arc.shear_stiffness = shear;
    const MemberForces exact = bedded_arc(arc, 0), coarse = by_differences(arc, 100), fine = by_differences(arc, 200);
    EXPECT_NEAR((4 * fine.thrust - coarse.thrust) / 3, exact.thrust, 2e-4 * std::abs(exact.thrust)) << shear;
    EXPECT_NEAR((4 * fine.moment - coarse.moment) / 3, exact.moment, 2e-3 * std::abs(exact.moment)) << shear;
  }
}

TEST(BeddedArc, SlidesOnASmoothBed) {
  BeddedArc arc = invert();
  arc.shear_stiffness = 1;
  arc.normal_stiffness = 1e12;
  for (const double angle : {0.0, 0.3, 0.6, 0.9})
    EXPECT_NEAR(bedded_arc(arc, angle).thrust, sliding_arc_thrust(arc, angle), 2e-3 * sliding_arc_thrust(arc, 0));
}

TEST(BeddedArc, HasFreeEndsAndTwoSides) {
  const BeddedArc arc = invert();
  const MemberForces end = bedded_arc(arc, arc.half_angle), middle = bedded_arc(arc, 0);
  EXPECT_NEAR(end.thrust, 0, 1e-9 * std::abs(middle.thrust));
  EXPECT_NEAR(end.moment, 0, 1e-9 * std::abs(middle.moment));
  EXPECT_DOUBLE_EQ(bedded_arc(arc, 0.4).thrust, bedded_arc(arc, -0.4).thrust);
}

// if both stiffnesses are equal it sinks without deformation
TEST(BeddedArc, HasNoForcesOnABedOfEqualStiffnesses) {
  BeddedArc arc = invert();
  arc.shear_stiffness = arc.normal_stiffness;
  const double scale = sliding_arc_thrust(arc, 0);
  EXPECT_NEAR(bedded_arc(arc, 0.2).thrust, 0, 1e-9 * scale);
  EXPECT_NEAR(bedded_arc(arc, 0.2).moment, 0, 1e-9 * scale * arc.radius);
}

TEST(BeddedArc, Scales) {
  BeddedArc arc = invert(), large = arc;
  large.radius *= 3;  // lengths × 3, stresses × 3: EA × 9, EI × 81, K × 1, γ × 3
  large.axial_stiffness *= 9;
  large.bending_stiffness *= 81;
  large.weight *= 3;
  EXPECT_NEAR(bedded_arc(large, 0.4).thrust, 9 * bedded_arc(arc, 0.4).thrust, 1e-9 * bedded_arc(large, 0).thrust);
  EXPECT_NEAR(bedded_arc(large, 0.4).moment, 27 * bedded_arc(arc, 0.4).moment,
              1e-9 * std::abs(bedded_arc(large, 0).moment));
}

}  // namespace
}  // namespace voussoir::reference::bedded_arc_test
