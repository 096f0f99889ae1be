// The joint law: the friction cone, rotation of the shear force, and energy.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::law_test {
namespace {

using shapes::Random;

constexpr double pi = std::numbers::pi;

// a few roundings, relative to the forces
constexpr double rounding = 1e-14;

// 1e4 rotations of one force, each with a few roundings of its length
constexpr double carry_tolerance = 1e-12;

const JointProperties joint{"joint", 2e9, 1e9, 0.5, false};

template <int Dim>
JointKinematics<Dim> pressed(const Vector<Dim>& normal, double overlap, const Vector<Dim>& slip) {
  JointKinematics<Dim> k;
  k.normal = normal;
  k.overlap = overlap;
  k.area = 0.7;
  k.slip = slip - normal.dot(slip) * normal;
  return k;
}

// ---- the cone -------------------------------------------------------------------------------------------------------

template <int Dim>
void expect_return_to_the_cone(std::uint64_t seed) {
  Random random(seed);
  for (int decade = 0; decade <= 12; ++decade)
    for (int i = 0; i < 20; ++i) {
      const Vector<Dim> n = shapes::direction<Dim>(random);
      const double overlap = shapes::power_of_ten(random, -9, -2), friction = shapes::uniform(random, 0.05, 1.5);
      JointKinematics<Dim> k = pressed<Dim>(n, overlap, Vector<Dim>::Zero());
      const double normal_force = joint.normal_stiffness * k.area * overlap, limit = std::tan(friction) * normal_force;
      // a slip whose trial is 1 to 10 times 10^decade the limit
      const Vector<Dim> across = perpendicular(n);
      const double trial = limit * std::pow(10, decade) * shapes::uniform(random, 1.01, 10);
      k.slip = -trial / (joint.shear_stiffness * k.area) * across;

      Vector<Dim> shear = Vector<Dim>::Zero();
      const JointForce<Dim> f = elastic_coulomb<Dim>(joint, std::tan(friction), 0, k, shear);
      EXPECT_NEAR(shear.norm(), limit, rounding * limit);
      EXPECT_NEAR(shear.dot(across), limit, 10 * rounding * limit);  // along the trial's direction
      EXPECT_NEAR(f.plastic_slip, (trial - limit) / (joint.shear_stiffness * k.area), 10 * rounding * k.slip.norm());
      EXPECT_NEAR(f.force.dot(n), normal_force, 10 * rounding * (normal_force + limit));
    }
}

// Eqs 4.7-4.9
TEST(Coulomb, ReturnsToTheConeFromAnywhere3D) {
  expect_return_to_the_cone<3>(31);
}
TEST(Coulomb, ReturnsToTheConeFromAnywhere2D) {
  expect_return_to_the_cone<2>(32);
}

// Eqs 4.1-4.3, 4.5, 4.6
TEST(Coulomb, IsElasticInsideTheCone) {
  const Vector<3> n(0, 0, 1);
  Vector<3> shear(3, -4, 0);
  const JointKinematics<3> k = pressed<3>(n, 1e-3, {1e-6, 2e-6, 0});
  const JointForce<3> f = elastic_coulomb<3>(joint, std::tan(0.5), 0, k, shear);
  const double ks = joint.shear_stiffness * k.area;
  EXPECT_NEAR((shear - Vector<3>(3 - 1e-6 * ks, -4 - 2e-6 * ks, 0)).norm(), 0, rounding * ks);
  EXPECT_EQ(f.plastic_slip, 0);
  EXPECT_NEAR(f.force[2], joint.normal_stiffness * k.area * 1e-3, rounding * joint.normal_stiffness);
  EXPECT_EQ(f.force[0], shear[0]);
}

TEST(Coulomb, WithoutFrictionThereIsNoShear) {
  Vector<3> shear(1, 0, 0);
  const JointForce<3> f = elastic_coulomb<3>(joint, 0, 0, pressed<3>({0, 0, 1}, 1e-3, {1e-3, 0, 0}), shear);
  EXPECT_EQ(shear.norm(), 0);
  EXPECT_GT(f.plastic_slip, 0);
  // no shear stiffness: nothing to return, nothing to divide by
  JointProperties smooth = joint;
  smooth.shear_stiffness = 0;
  shear = {1, 0, 0};
  EXPECT_TRUE(
      std::isfinite(elastic_coulomb<3>(smooth, 0, 0, pressed<3>({0, 0, 1}, 1e-3, {1e-3, 0, 0}), shear).plastic_slip));
  shear.setZero();
  const Vector<3> unloaded =
      elastic_coulomb<3>(joint, std::tan(0.5), 0, pressed<3>({0, 0, 1}, 0, {0, 0, 0}), shear).force;
  EXPECT_EQ(unloaded.norm(), 0);
}

TEST(Coulomb, NeverPulls) {
  Random random(33);
  int held_back = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector<3> n = shapes::direction<3>(random);
    JointKinematics<3> k = pressed<3>(n, shapes::power_of_ten(random, -8, -2), 1e-3 * shapes::normal_vector<3>(random));
    k.closing_speed = shapes::uniform(random, -10, 10);
    Vector<3> shear = Vector<3>::Zero();
    const double dashpot = shapes::power_of_ten(random, 0, 8);
    const double expected = joint.normal_stiffness * k.area * k.overlap + dashpot * k.closing_speed;
    const JointForce<3> f = elastic_coulomb<3>(joint, std::tan(0.5), dashpot, k, shear);
    const double largest = std::abs(expected) + f.force.norm();
    EXPECT_NEAR(f.force.dot(n), std::max(expected, 0.0), 10 * rounding * largest);
    // the limit follows the total normal force, damping included
    EXPECT_LE(shear.norm(), std::tan(0.5) * std::max(expected, 0.0) * (1 + rounding));
    held_back += expected < 0;
  }
  EXPECT_GT(held_back, 100);
}

// work put in = elastic energy + dissipation, with an excess due to the step's size that is never negative
template <int Dim>
void expect_energy_on_random_paths(std::uint64_t seed) {
  Random random(seed);
  for (int path = 0; path < 20; ++path) {
    const Vector<Dim> n = shapes::direction<Dim>(random);
    const double friction = shapes::uniform(random, 0.1, 1.2), overlap = shapes::power_of_ten(random, -6, -3);
    Vector<Dim> shear = Vector<Dim>::Zero();
    double work = 0, dissipated = 0, slid = 0;
    for (int step = 0; step < 500; ++step) {
      const double size = shapes::power_of_ten(random, -3, 1) * overlap;
      const JointKinematics<Dim> k = pressed<Dim>(n, overlap, size * shapes::direction<Dim>(random));
      const JointForce<Dim> f = elastic_coulomb<Dim>(joint, std::tan(friction), 0, k, shear);
      EXPECT_GE(f.plastic_slip, 0);
      EXPECT_LE(f.plastic_slip, k.slip.norm() + 10 * rounding * (overlap + size));
      work -= shear.dot(k.slip);
      dissipated += shear.norm() * f.plastic_slip;
      slid += f.plastic_slip;
    }
    const double elastic = shear.squaredNorm() / (2 * joint.shear_stiffness * 0.7);
    EXPECT_GT(slid, 0);
    EXPECT_GE(work, elastic + dissipated - 1e-10 * dissipated);
  }
}

TEST(Coulomb, CreatesNoEnergyOnRandomPaths3D) {
  expect_energy_on_random_paths<3>(34);
}
TEST(Coulomb, CreatesNoEnergyOnRandomPaths2D) {
  expect_energy_on_random_paths<2>(35);
}

TEST(Coulomb, APathInAPlaneIsTheSameInBothDimensions) {
  Random random(36);
  Vector<2> flat = Vector<2>::Zero();
  Vector<3> solid = Vector<3>::Zero();
  for (int i = 0; i < 200; ++i) {
    const double slip = shapes::uniform(random, -1, 1) * 1e-4, overlap = shapes::uniform(random, 0, 1) * 1e-4;
    const Vector<2> f2 =
        elastic_coulomb<2>(joint, std::tan(0.6), 0, pressed<2>({0, 1}, overlap, {slip, 0}), flat).force;
    const Vector<3> f3 =
        elastic_coulomb<3>(joint, std::tan(0.6), 0, pressed<3>({0, 1, 0}, overlap, {slip, 0, 0}), solid).force;
    EXPECT_NEAR((f2 - f3.head<2>()).norm(), 0, rounding * 1e6);
    EXPECT_EQ(f3[2], 0);
  }
}

// ---- rotation of the shear force ------------------------------------------------------------------------------------

// turn about a unit axis by Rodrigues' formula
Vector<3> rotated(const Vector<3>& v, const Vector<3>& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * axis.cross(v) + (1 - std::cos(angle)) * axis.dot(v) * axis;
}

// in place of Eq. 4.4
TEST(Carried, AFullTurnOfTheNormalBringsTheShearBack) {
  Random random(37);
  for (const int steps : {5, 12, 360, 10'000}) {
    const Vector<3> axis = shapes::direction<3>(random), start = perpendicular(axis);
    const double mix = shapes::uniform(random, 0, 2 * pi);
    const Vector<3> first = 1e5 * (std::cos(mix) * axis + std::sin(mix) * axis.cross(start));
    Vector<3> shear = first, normal = start;
    for (int i = 1; i <= steps; ++i) {
      const Vector<3> next = rotated(start, axis, 2 * pi * i / steps);
      shear = carried(shear, normal, next, 0);
      EXPECT_NEAR(shear.dot(next), 0, carry_tolerance * 1e5);
      normal = next;
    }
    EXPECT_NEAR(shear.norm(), first.norm(), carry_tolerance * first.norm());
    EXPECT_LT((shear - first).norm(), 10 * carry_tolerance * first.norm());
  }
}

TEST(Carried, AroundAConeItTurnsByTheEnclosedSolidAngle) {
  // rotation without spin is parallel transport: round a spherical polygon the force turns by the polygon's excess
  for (const int steps : {5, 12, 100})
    for (const double opening : {0.1, 0.6, 1.2}) {
      const auto corner = [&](int i) {
        const double angle = 2 * pi * i / steps;
        return Vector<3>(std::sin(opening) * std::cos(angle), std::sin(opening) * std::sin(angle), std::cos(opening));
      };
      // right triangle of a regular polygon: cos(circumradius) = cot(pi/N) cot(corner angle / 2)
      const double half_corner = std::atan(1 / (std::cos(opening) * std::tan(pi / steps)));
      const double excess = steps * 2 * half_corner - (steps - 2) * pi;
      const Vector<3> first = perpendicular(corner(0));
      Vector<3> shear = first;
      for (int i = 0; i < steps; ++i)
        shear = carried(shear, corner(i), corner(i + 1), 0);
      EXPECT_LT((shear - rotated(first, corner(0), excess)).norm(), 10 * carry_tolerance);
    }
}

TEST(Carried, FollowsTheSpinAboutTheNormal) {
  const Vector<3> n = Vector<3>(1, 2, -2) / 3;
  const Vector<3> first = 7 * perpendicular(n);
  for (const int steps : {1, 7, 1000}) {
    Vector<3> shear = first;
    for (int i = 0; i < steps; ++i)
      shear = carried(shear, n, n, 2.5 / steps);
    EXPECT_LT((shear - rotated(first, n, 2.5)).norm(), 10 * carry_tolerance);
  }
}

// in place of Eq. 4.4
TEST(Carried, TurnsWithAPairThatTurnsAsOneBody) {
  // first order at worst in the step, and no change of length
  Random random(38);
  for (int i = 0; i < 20; ++i) {
    const Vector<3> axis = shapes::direction<3>(random), start = shapes::direction<3>(random);
    const Vector<3> first = perpendicular(start);
    const double angle = 1.5;
    double error[2];
    for (int refined = 0; refined < 2; ++refined) {
      const int steps = refined ? 2000 : 200;
      Vector<3> shear = first, normal = start;
      for (int k = 1; k <= steps; ++k) {
        const Vector<3> next = rotated(start, axis, angle * k / steps);
        shear = carried(shear, normal, next, angle / steps * axis.dot(next));
        normal = next;
      }
      EXPECT_NEAR(shear.norm(), 1, carry_tolerance);
      error[refined] = (shear - rotated(first, axis, angle)).norm();
    }
    EXPECT_LT(error[0], 2.0 / 200);
    EXPECT_LT(error[1], std::max(0.15 * error[0], 10 * carry_tolerance));
  }
}

TEST(Carried, InThePlaneItKeepsItsSideOfTheNormal) {
  Vector<2> shear = 3 * perpendicular(Vector<2>(1, 0)), normal(1, 0);
  for (int i = 1; i <= 360; ++i) {
    const Vector<2> next(std::cos(2 * pi * i / 360), std::sin(2 * pi * i / 360));
    shear = carried(shear, normal, next, 0);
    EXPECT_NEAR((shear - 3 * perpendicular(next)).norm(), 0, carry_tolerance);
    normal = next;
  }
}

TEST(Carried, AnOppositeNormalGivesAFiniteForceInThePlane) {
  const Vector<3> n(0, 0, 1);
  const Vector<3> shear = carried(Vector<3>(3, 4, 0), n, Vector<3>(-n), 0);
  EXPECT_NEAR(shear.norm(), 5, rounding * 5);
  EXPECT_EQ(carried(Vector<3>(0, 0, 0), n, Vector<3>(1, 0, 0), 0.1), Vector<3>(0, 0, 0));
}

}  // namespace
}  // namespace voussoir::law_test
