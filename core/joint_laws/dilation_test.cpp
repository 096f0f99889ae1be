// Dilation and hyperbolic closure on laboratory paths against closed forms, and slip against a rise that returns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/joint_laws/dilation.hpp"
#include "core/joint_laws/joint_path.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::dilation_test {
namespace {

using shapes::Random;

// some roundings, and those of an overlap found by halving
constexpr double roundings = 1e-11;

JointProperties joint(DilationLaw law, double length) {
  JointProperties p;
  p.normal_stiffness = 10e9;
  p.shear_stiffness = 4e9;
  p.friction = 30 * degree;
  p.laws.dilation = law;
  p.dilation = 8 * degree;
  (law == DilationLaw::constant ? p.dilation_until : p.dilation_decay) = length;
  return p;
}

JointPath sheared(double slip, double surroundings, int steps) {
  JointPath path;
  path.normal_stress = 1e6;
  path.slip = slip;
  path.surroundings = surroundings;
  path.steps = steps;
  return path;
}

struct Expected {
  int step;
  double plastic, stress, shear, lifted;  // m, Pa, Pa, m
};

void expect_path(const JointProperties& p, const JointPath& path, std::initializer_list<Expected> expected,
                 double exact = roundings) {
  const std::vector<JointPathPoint> points = follow(p, path);
  const double start = points[path.steps].overlap;
  for (const Expected& e : expected) {
    const JointPathPoint& at = points[path.steps + e.step];
    EXPECT_NEAR(at.plastic_slip, e.plastic, exact * e.plastic);
    EXPECT_NEAR(at.normal_stress, e.stress, exact * e.stress);
    EXPECT_NEAR(at.shear_stress, e.shear, exact * e.stress);
    EXPECT_NEAR(start - at.overlap, e.lifted, exact * e.plastic);
  }
}

// σ = σ0 + Ke tan ψ p, p = (v - μσ0/ks)/(1 + μ Ke tan ψ/ks), Ke = kn K/(kn + K)
TEST(Dilation, ConstantNormalStiffnessIsTheClosedForm) {
  expect_path(joint(DilationLaw::constant, 4e-3), sheared(6e-3, 2e9, 120),
              {{20, 0.8276795230484e-3, 1.193871285059e6, 0.6892819078065e6, 0.09693564252941e-3},
               {60, 2.76227309971e-3, 1.647020278515e6, 0.9509076011616e6, 0.3235101392576e-3},
               {120, 5.720426951457e-3, 1.936938898016e6, 1.118292194173e6, 0.468469449008e-3}});
  const std::vector<JointPathPoint> points = follow(joint(DilationLaw::constant, 4e-3), sheared(6e-3, 2e9, 120));
  EXPECT_NEAR(points.back().dilation, -825.5196883942, 1e-9 * 825);  // the rise works on stress that grows with it
}

TEST(Dilation, EnergyOfFrictionConvergesWithTheStep) {
  const auto error = [](int steps) {
    return std::abs(
        follow(joint(DilationLaw::constant, 4e-3), sheared(6e-3, 2e9, steps)).back().dissipated / 5315.224957185 - 1);
  };
  EXPECT_LT(error(120), 2e-4);  // half of the step in which slip begins
  EXPECT_LT(error(480), 0.5 * error(120));
}

TEST(Dilation, FallingDilationIsTheClosedForm) {
  expect_path(joint(DilationLaw::falling, 2e-3), sheared(6e-3, 2e9, 60),
              {{30, 2.804680048903e-3, 1.353216316125e6, 0.7812798043867e6, (0.353216316125e6) / 2e9},
               {60, 5.791780559766e-3, 1.442586598433e6, 0.8328777609345e6, (0.442586598433e6) / 2e9}});
}

// A joint that returns to where it was mated closes again; plastic slip adds up.
TEST(Dilation, ACycleReturns) {
  JointPath path = sheared(4e-3, 0, 400);
  path.cycles = 1;
  const JointProperties p = joint(DilationLaw::constant, 3e-3);
  const double printed = 1e-9;
  expect_path(p, path,
              {{400, 3.855662433e-3, 1e6, 0.577350269190e6, 0.421622504e-3},
               {800, 11.566987298e-3, 1e6, -0.577350269190e6, 0.421622504e-3},
               {1200, 15.278312164e-3, 1e6, 0.577350269190e6, 0.020285322e-3}},
              printed);
  path.surroundings = 2e9;
  const std::vector<JointPathPoint> points = follow(p, path);
  const double stress[] = {1.702704174e6, 1.702704174e6, 1.034991907e6};
  const double shear[] = {0.983056713e6, -0.983056713e6, 0.597552856e6};
  const double plastic[] = {3.754235822e-3, 11.262707465e-3, 14.867555073e-3};
  const double given[] = {-569.760451, -569.760451, -21.362474};
  for (int leg = 0; leg < 3; ++leg) {
    const JointPathPoint& at = points[400 * (leg + 2)];
    EXPECT_NEAR(at.normal_stress, stress[leg], printed * 1e6);
    EXPECT_NEAR(at.shear_stress, shear[leg], printed * 1e6);
    EXPECT_NEAR(at.plastic_slip, plastic[leg], printed * 15e-3);
    EXPECT_NEAR(at.dilation, given[leg], printed * 600);
  }
}

// ---- the first root -------------------------------------------------------------------------------------------------

// Against the first change of sign on a fine division, on the way out, across and back.
TEST(Dilation, SlipIsTheFirstRoot) {
  Random random(59);
  for (int i = 0; i < 300; ++i) {
    const DilationLaw law = i % 2 == 0 ? DilationLaw::constant : DilationLaw::falling;
    const JointProperties p = joint(law, shapes::uniform(random, 1e-4, 3e-3));
    const OffsetPath path{shapes::uniform(random, -4e-3, 4e-3), i % 3 == 0 ? 0.0 : shapes::uniform(random, 0, 2e-3)};
    const double overlap = shapes::uniform(random, 1e-5, 3e-4),
                 before = rise_at(p, std::tan(p.dilation), path.length(0));
    const double stiffness = shapes::power_of_ten(random, 8, 10), over = shapes::uniform(random, 1.001, 20);
    const auto strength = [&](double slip) {
      const double closure = overlap + rise_at(p, std::tan(p.dilation), path.length(slip)) - before;
      return std::tan(p.friction) * std::max(p.normal_stiffness * closure, 0.0);
    };
    const double trial = over * strength(0), most = trial / stiffness;
    const auto excess = [&](double slip) { return trial - stiffness * slip - strength(slip); };
    const double slip = first_slip(p, path, {most, excess(0), 0, false, excess});
    EXPECT_NEAR(excess(slip), 0, 1e-12 * trial);
    constexpr int parts = 4000;
    for (int k = 1; k < parts && most * k / parts < slip; ++k)
      EXPECT_GT(excess(most * k / parts), -1e-12 * trial) << "an earlier root";
  }
}

// ---- extremes -------------------------------------------------------------------------------------------------------

TEST(Dilation, NeverAboveTheFrictionInForce) {
  JointProperties p = joint(DilationLaw::constant, 1);
  EXPECT_DOUBLE_EQ(dilation_in_force(p, p.friction), std::tan(p.dilation));
  EXPECT_DOUBLE_EQ(dilation_in_force(p, 5 * degree), std::tan(5 * degree));
  EXPECT_EQ(dilation_in_force(p, 0), 0);
  p.laws.friction = FrictionLaw::softening;
  p.softening_drop = std::tan(p.friction) - 0.1;
  EXPECT_NEAR(dilation_in_force(p, p.friction), 0.1, 1e-15);
  EXPECT_EQ(dilation_in_force(p, p.friction, 0.5), 0);
}

// none, and as much as friction; reversed at every step; without stress
TEST(Dilation, HostilePathsStayFinite) {
  Random random(5);
  for (const double angle : {0.0, 8.0, 30.0})
    for (const DilationLaw law : {DilationLaw::constant, DilationLaw::falling}) {
      JointProperties p = joint(law, 1e-3);
      p.dilation = angle * degree;
      JointState<3> history;
      JointRise<3> rise;
      for (int i = 0; i < 2000; ++i) {
        JointKinematics<3> k;
        k.normal = {0, 0, 1};
        const double walls = i % 7 == 0 ? 0 : shapes::uniform(random, -2e-4, 2e-4);
        k.overlap = std::max(walls + rise.rise, 0.0);
        k.area = 1;
        k.slip = {(i % 2 == 0 ? 1 : -1) * shapes::power_of_ten(random, -9, -3), shapes::uniform(random, -1e-4, 1e-4),
                  0};
        const LawForce<3> f = joint_law<3>(p, p.friction, 0, k, history, 1, {&rise, 0});
        ASSERT_TRUE(f.force.allFinite());
        EXPECT_GE(f.force[2], 0);
        EXPECT_LE(history.shear_force.norm(), std::tan(p.friction) * f.force[2] * (1 + 1e-12) + 1e-6);
        EXPECT_NEAR(rise.rise, rise_at(p, dilation_in_force(p, p.friction), rise.offset.norm()), 1e-15);
        EXPECT_LE(rise.rise, std::tan(p.dilation) * 1e-3 * (1 + 1e-12));
      }
    }
}

// ---- hyperbolic closure ---------------------------------------------------------------------------------------------

JointProperties hyperbolic(double irrecoverable) {
  JointProperties p;
  p.normal_stiffness = 10e9;
  p.shear_stiffness = 4e9;
  p.friction = 30 * degree;
  p.laws.normal = StiffnessLaw::hyperbolic;
  p.maximum_closure = 0.2e-3;
  p.irrecoverable_fraction = irrecoverable;
  return p;
}

TEST(HyperbolicClosure, LoadingIsTheClosedForm) {
  const JointProperties p = hyperbolic(0);
  const double stress[] = {0.1e6, 1e6, 5e6, 20e6},
               closure[] = {9.52380952381, 66.6666666667, 142.857142857, 181.818181818},
               tangent[] = {11.025, 22.5, 122.5, 1210};
  for (int i = 0; i < 4; ++i) {
    const double u = overlap_at(p, stress[i]);
    EXPECT_NEAR(u, 1e-6 * closure[i], 1e-11 * u);
    EXPECT_NEAR(normal_answer(p, u, false).stress, stress[i], 1e-12 * stress[i]);
    EXPECT_NEAR(normal_answer(p, u, false).stiffness, 1e9 * tangent[i], 1e-11 * 1e9 * tangent[i]);
  }
  // the energy's derivative is the stress, by series and by logarithm alike
  for (const double u : {1e-9, 1e-7, 5.9e-6, 6.1e-6, 1e-5, 1e-4, 1.9e-4}) {
    const double step = 1e-4 * u;
    const double slope =
        (normal_answer(p, u + step, false).energy - normal_answer(p, u - step, false).energy) / (2 * step);
    EXPECT_NEAR(slope, normal_answer(p, u, false).stress, 1e-5 * slope);
  }
}

TEST(HyperbolicClosure, UnloadingLosesTheClosedForm) {
  const JointProperties p = hyperbolic(0.4);
  const double most = overlap_at(p, 5e6);
  EXPECT_EQ(normal_answer(p, 57.1428571428e-6, false, most).stress, 0);
  EXPECT_GT(normal_answer(p, 57.1428571430e-6, false, most).stress, 0);
  EXPECT_NEAR(normal_answer(p, 0.9 * most, false, most).stress, 3.33333333333e6, 1e-4);
  EXPECT_NEAR(normal_answer(p, 0.7 * most, false, most).stress, 1.42857142857e6, 1e-4);
  EXPECT_NEAR(normal_answer(p, 0.5 * most, false, most).stress, 0.37037037037e6, 1e-4);
  JointPath path;
  path.normal_stress = 5e6;
  path.unload = true;
  const std::vector<JointPathPoint> points = follow(p, path);
  EXPECT_NEAR(points[path.steps].elastic, 150.6146342258, 1e-9 * 150);
  EXPECT_NEAR(points.back().crushing, 64.77626745807, 1e-9 * 65);
  EXPECT_EQ(points.back().normal_stress, 0);
}

// work against stored and lost energy on random paths: a cycle never makes energy
TEST(HyperbolicClosure, RandomPathsNeverMakeEnergy) {
  Random random(3);
  const JointProperties p = hyperbolic(0.5);
  JointState<2> history;
  JointRise<2> rise;
  double closure = 0, stress = 0, work = 0, lost = 0, stored = 0;
  for (int i = 0; i < 200000; ++i) {
    const double next = std::clamp(closure + shapes::uniform(random, -1e-7, 1e-7), 0.0, 1.9e-4);
    JointKinematics<2> k;
    k.normal = {0, 1};
    k.overlap = next;
    k.area = 1;
    k.slip = {0, 0};
    const LawForce<2> f = joint_law<2>(p, p.friction, 0, k, history, 1, {&rise, 0});
    work += 0.5 * (stress + f.force[1]) * (next - closure);
    EXPECT_GE(f.crushing, 0);
    lost += f.crushing;
    stored = f.elastic;
    closure = next;
    stress = f.force[1];
  }
  EXPECT_NEAR(work, stored + lost, 1e-3 * (stored + lost));  // the trapezoid's error in steps over a kink
}

TEST(HyperbolicClosure, BeyondTheMaximumClosureTheStressIsFinite) {
  for (const double irrecoverable : {0.0, 0.4, 0.99}) {
    const JointProperties p = hyperbolic(irrecoverable);
    double last = 0;
    for (const double u : {0.0, 1e-300, 1e-12, 1e-4, 1.99e-4, 1.998e-4, 1.999e-4, 2e-4, 2.1e-4, 1e-3, 1.0}) {
      const NormalAnswer at = normal_answer(p, u, false, u);
      EXPECT_TRUE(std::isfinite(at.stress) && std::isfinite(at.energy) && std::isfinite(at.stiffness)) << u;
      EXPECT_GE(at.stress, last);
      EXPECT_GE(stiffest_normal(p, u) * (1 + 1e-12), normal_answer(p, u, false, 0).stiffness) << u;
      last = at.stress;
    }
    // unloading from there meets the loading curve at its end, and no jump makes energy
    EXPECT_LE(normal_answer(p, 1.997e-4, false, 1).stress, normal_answer(p, 1.998e-4, false, 1).stress);
  }
}

}  // namespace
}  // namespace voussoir::dilation_test
