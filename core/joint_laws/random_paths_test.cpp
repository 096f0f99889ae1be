// Every joint law on random paths of a thousand steps: the energy balance closes, heat is never negative, and steps cut
// in two end in the same state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/joint_laws/joint_law.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::random_paths_test {
namespace {

using shapes::Random;

constexpr int legs = 20, steps_of_leg = 50;  // a thousand steps

JointProperties named(const char* name) {
  JointProperties p{name, 10e9, 4e9, 30 * degree, false};
  p.dilation = 8 * degree;
  return p;
}

JointProperties rough(const char* name, Mobilisation mobilisation) {
  JointProperties p = named(name);
  p.friction = 26 * degree;
  p.laws.friction = FrictionLaw::barton_bandis;
  p.barton_bandis = {.sample_jrc = 10, .sample_jcs = 30e6, .sample_length = 0.1, .block_length = 0.1};
  p.barton_bandis.mobilisation = mobilisation;
  scale_to_blocks(p.barton_bandis);
  return p;
}

JointProperties cohesive(const char* name, CohesionLaw law) {
  JointProperties p = named(name);
  p.laws.bond = true;
  p.cohesion = 3e5;
  p.tension = 1e5;
  p.cohesion_law = law;
  p.residual_cohesion = law == CohesionLaw::softening ? 1e5 : 0;
  p.cohesion_slip = 1e-3;
  return p;
}

// Linear springs: what the forces at both ends of a step do is exactly what the springs store.
std::vector<JointProperties> laws_of_linear_springs() {
  JointProperties hardening = named("hardening"), softening = named("softening"), constant = named("constant dilation"),
                  falling = named("falling dilation");
  hardening.laws.friction = FrictionLaw::hardening;
  hardening.hardening_slip = 2e-6;
  hardening.hardening_exponent = 0.213;
  softening.laws.friction = FrictionLaw::softening;
  softening.softening_drop = 0.3;
  softening.softening_slip = 1e-3;
  constant.laws.dilation = DilationLaw::constant;
  constant.dilation_until = 1e-3;
  falling.laws.dilation = DilationLaw::falling;
  falling.dilation_decay = 5e-4;
  return {named("Coulomb"),
          hardening,
          softening,
          cohesive("plastic cohesion", CohesionLaw::plastic),
          cohesive("softening cohesion", CohesionLaw::softening),
          cohesive("brittle cohesion", CohesionLaw::brittle),
          constant,
          falling,
          rough("Barton and Bandis, envelope", Mobilisation::none),
          rough("Barton and Bandis, mobilised", Mobilisation::table)};
}

// whose stiffness depends on stress
std::vector<JointProperties> laws_of_other_springs() {
  JointProperties linear = named("linear stiffness"), power = named("power stiffness"), closure = named("closure");
  linear.laws.normal = StiffnessLaw::linear;
  linear.normal_growth = 7.4e3;
  power.laws.normal = StiffnessLaw::power;
  power.normal_stiffness = 2.1e6;
  power.normal_exponent = 0.5;
  closure.laws.normal = StiffnessLaw::hyperbolic;
  closure.maximum_closure = 1e-3;
  closure.irrecoverable_fraction = 0.4;
  return {linear, power, closure};
}

template <int Dim>
struct Corner {
  double walls = 0;                        // m, by which they have come together
  Vector<Dim> slip = Vector<Dim>::Zero();  // m
};

template <int Dim>
std::vector<Corner<Dim>> random_corners(const JointProperties& p, unsigned seed, bool opens) {
  Random random(seed);
  const double deep = overlap_at(p, 2e6);
  std::vector<Corner<Dim>> corners{{0.5 * deep, Vector<Dim>::Zero()}};
  for (int leg = 0; leg < legs; ++leg) {
    Corner<Dim> corner;
    corner.walls = deep * shapes::uniform(random, opens ? -0.5 : 0.2, 1);
    for (int axis = 0; axis + 1 < Dim; ++axis)
      corner.slip[axis] = shapes::uniform(random, -2e-3, 2e-3);
    corners.push_back(corner);
  }
  return corners;
}

template <int Dim>
struct End {
  JointState<Dim> history;
  JointRise<Dim> rise;
  double imbalance = 0;   // of work against springs and heat, over the work done and taken
  double least_heat = 0;  // J, of a step
};

// `parts`: of every step
template <int Dim>
End<Dim> walk(const JointProperties& p, const std::vector<Corner<Dim>>& corners, int parts = 1) {
  End<Dim> end;
  if (p.laws.bond) end.history.bond = Bond::whole;
  const auto step = [&](double walls, const Vector<Dim>& slip) {
    JointKinematics<Dim> k;
    k.normal = Vector<Dim>::Unit(Dim - 1);
    k.area = 1;
    k.overlap = walls + end.rise.rise;
    k.slip = slip;
    return joint_law<Dim>(p, p.friction, 0, k, end.history, 1, {p.remembers_place() ? &end.rise : nullptr, 0});
  };
  LawForce<Dim> before = step(corners[0].walls, Vector<Dim>::Zero());
  const double stored = before.elastic;
  double work = 0, spent = 0, moved = 0;
  const int steps = steps_of_leg * parts;
  for (int leg = 1; leg <= legs; ++leg) {
    const Corner<Dim>&from = corners[leg - 1], &to = corners[leg];
    const double closing = (to.walls - from.walls) / steps;
    const Vector<Dim> slip = (to.slip - from.slip) / steps;
    for (int i = 1; i <= steps; ++i) {
      const LawForce<Dim> now = step(from.walls + (to.walls - from.walls) * i / steps, slip);
      const Vector<Dim> mean = 0.5 * (before.force + now.force);
      const double done = mean[Dim - 1] * closing - mean.dot(slip), heat = now.friction + now.dilation;
      work += done;
      moved += std::abs(done);
      spent += heat + now.stiffening + now.crushing;
      end.least_heat = std::min(end.least_heat, heat);
      before = now;
    }
  }
  end.imbalance = std::abs(work - (before.elastic - stored) - spent) / moved;
  return end;
}

// of the shear force over the strength at 2 MPa, the plastic slip and the rise over the length of the path
template <int Dim>
double difference(const End<Dim>& a, const End<Dim>& b) {
  return std::max({(a.history.shear_force - b.history.shear_force).norm() / 2e6,
                   std::abs(a.history.plastic_slip - b.history.plastic_slip) / a.history.plastic_slip,
                   std::abs(a.rise.rise - b.rise.rise) / 1e-3});
}

// means over random paths in steps, in halves and in quarters of them
struct Means {
  double imbalance[3]{}, difference[2]{}, least_heat = 0;
};

template <int Dim>
Means means_of(const JointProperties& p, bool opens) {
  constexpr int paths = 10;
  Means means;
  for (int seed = 1; seed <= paths; ++seed) {
    const std::vector<Corner<Dim>> corners = random_corners<Dim>(p, seed, opens);
    End<Dim> last;
    for (int k = 0; k < 3; ++k) {
      const End<Dim> end = walk<Dim>(p, corners, 1 << k);
      means.imbalance[k] += end.imbalance / paths;
      means.least_heat = std::min(means.least_heat, end.least_heat);
      if (k > 0) means.difference[k - 1] += difference(last, end) / paths;
      last = end;
    }
  }
  return means;
}

std::vector<JointProperties> every_law() {
  std::vector<JointProperties> laws = laws_of_linear_springs();
  for (const JointProperties& p : laws_of_other_springs())
    laws.push_back(p);
  return laws;
}

// The work of the mean of the forces before and after a step, by which a run moves its bodies, is what linear springs
// store and slip and rise take, whatever the strength; of other springs the mean is exact to the square of the step.
template <int Dim>
void expect_balance() {
  for (const JointProperties& p : laws_of_linear_springs()) {
    const Means means = means_of<Dim>(p, false);
    for (const double imbalance : means.imbalance)
      EXPECT_LT(imbalance, 1e-12) << p.name;
    EXPECT_EQ(means.least_heat, 0) << p.name;
  }
  for (const JointProperties& p : laws_of_other_springs()) {
    const Means means = means_of<Dim>(p, false);
    EXPECT_LT(means.imbalance[0], 1e-5) << p.name;
    EXPECT_LT(means.imbalance[2], means.imbalance[0] / 10) << p.name;
    EXPECT_EQ(means.least_heat, 0) << p.name;
  }
}

TEST(RandomPaths, TheBalanceClosesInThePlane) {
  expect_balance<2>();
}

TEST(RandomPaths, TheBalanceClosesInSpace) {
  expect_balance<3>();
}

template <int Dim>
void expect_second_order() {
  for (const JointProperties& p : every_law()) {
    const Means means = means_of<Dim>(p, true);
    EXPECT_LT(means.imbalance[0], 1e-4) << p.name;
    EXPECT_LT(means.imbalance[2], means.imbalance[0] / 6) << p.name;
    EXPECT_EQ(means.least_heat, 0) << p.name;
  }
}

TEST(RandomPaths, JointsThatOpenBalanceToTheSquareOfTheStep) {
  expect_second_order<2>();
  expect_second_order<3>();
}

// In the plane the end of a step does not depend on its parts where laws are functions of where the joint stands; the
// rise of Barton and Bandis is added up, to the second order. In space the slip of a step has one direction, while the
// shear force turns: first order.
TEST(RandomPaths, StepsCutInTwoEndInTheSameState) {
  for (const JointProperties& p : laws_of_linear_springs()) {
    const Means plane = means_of<2>(p, false), space = means_of<3>(p, false);
    if (p.follows_barton_bandis())
      EXPECT_LT(plane.difference[1], plane.difference[0] / 3) << p.name;
    else
      EXPECT_LT(plane.difference[0], 1e-12) << p.name;
    EXPECT_LT(space.difference[0], 3e-3) << p.name;
    EXPECT_LT(space.difference[1], space.difference[0] / 1.5) << p.name;
  }
}

}  // namespace
}  // namespace voussoir::random_paths_test
