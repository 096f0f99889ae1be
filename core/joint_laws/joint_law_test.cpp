// Laws beyond the plain one: closed forms, one stress path per law by hand, tangents, and dissipation on random paths.
#include "core/joint_laws/joint_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "core/joint_laws/joint_path.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::joint_law_test {
namespace {

using shapes::Random;

// roundings of a few functions, relative
constexpr double rounding = 1e-13;
// required accuracy of a path against its closed form, relative
constexpr double closed_form = 1e-10;

// ---- the laws of thesis 4.12 and 6.3 --------------------------------------------------------------------------------

JointProperties plain() {
  return {"plain", 10e9, 1e9, 40 * degree, false};
}
JointProperties linear() {  // Eqs 4.10-4.12
  JointProperties p{"linear", 4e9, 1e8, 40 * degree, false};
  p.laws.normal = p.laws.shear = StiffnessLaw::linear;
  p.normal_growth = 7.4e4;
  p.shear_growth = 9.7e4;
  return p;
}
JointProperties power() {  // Eqs 4.13, 4.17
  JointProperties p{"power", 2.1e6, 1.9e6, 40 * degree, false};
  p.laws.normal = p.laws.shear = StiffnessLaw::power;
  p.normal_exponent = 0.75;
  p.shear_exponent = 0.7;
  return p;
}
JointProperties hardened() {  // Eqs 4.14, 4.16-4.18
  JointProperties p{"hardened", 2e9, 1.9e6, 40 * degree, false};
  p.laws.normal = StiffnessLaw::linear;
  p.laws.shear = StiffnessLaw::power;
  p.laws.friction = FrictionLaw::hardening;
  p.normal_growth = 3.7e4;
  p.shear_exponent = 0.7;
  p.hardening_slip = 2e-6;
  p.hardening_exponent = 0.213;
  return p;
}
JointProperties softened() {  // Eq. 6.7
  JointProperties p{"softened", 2e9, 1e8, 20 * degree, false};
  p.laws.friction = FrictionLaw::softening;
  p.softening_drop = 0.059266;
  p.softening_slip = 0.35;
  return p;
}
JointProperties bonded_joint() {  // Eqs 6.3-6.6
  JointProperties p{"bonded", 2e9, 1e9, 40 * degree, false};
  p.laws.bond = true;
  p.tension = 0.076e6;
  p.cohesion = 0.787e6;
  return p;
}
std::vector<JointProperties> every_law() {
  JointProperties brittle = linear();  // several laws together
  brittle.name = "brittle";
  brittle.laws.friction = FrictionLaw::softening;
  brittle.laws.bond = true;
  brittle.softening_drop = 0.3;
  brittle.softening_slip = 1e-4;
  brittle.tension = 1e5;
  brittle.cohesion = 3e5;
  JointProperties cohesive = softened();
  cohesive.name = "cohesive";
  cohesive.laws.bond = true;
  cohesive.tension = 1e4;
  cohesive.cohesion = 3e5;
  cohesive.cohesion_law = CohesionLaw::softening;
  cohesive.residual_cohesion = 1e5;
  cohesive.cohesion_slip = 1e-2;
  return {plain(), linear(), power(), hardened(), softened(), bonded_joint(), brittle, cohesive};
}

// ---- normal
// ----------------------------------------------------------------------------------------------------------

// Eqs 4.12 and 4.13 by hand, 6.5 and 6.6; all by differences
TEST(NormalLaw, StressIsTheIntegralOfItsStiffness) {
  // by hand: Eq. 4.12 gives 4e9/7.4e4 (e^0.74 - 1) = 59 243.8... at 10 µm; Eq. 4.13 integrated (0.25·2.1e6 u)^4
  EXPECT_NEAR(normal_answer(linear(), 1e-5, false).stress, 4e9 / 7.4e4 * (std::exp(0.74) - 1), closed_form * 6e4);
  EXPECT_NEAR(normal_answer(power(), 1e-5, false).stress, std::pow(0.25 * 2.1e6 * 1e-5, 4), closed_form * 760);
  EXPECT_DOUBLE_EQ(normal_answer(plain(), 1e-5, false).stress, 1e5);
  EXPECT_DOUBLE_EQ(normal_answer(bonded_joint(), 1e-5, false).stress, 0);      // below the offset of 38 µm
  EXPECT_NEAR(normal_answer(bonded_joint(), 0, true).stress, -0.076e6, 1e-9);  // its strength, at no overlap
  EXPECT_NEAR(normal_answer(bonded_joint(), 1e-4, false).stress, 2e9 * 62e-6, 1e-8);

  for (const JointProperties& p : every_law())
    for (double u = 1e-9; u < 3e-4; u *= 1.7) {
      const NormalAnswer at = normal_answer(p, u, true);
      // six-point central differences of energy and stress
      const double h = 1e-3 * u;
      const auto slope = [&](const std::function<double(double)>& f) {
        return (45 * (f(u + h) - f(u - h)) - 9 * (f(u + 2 * h) - f(u - 2 * h)) + f(u + 3 * h) - f(u - 3 * h)) /
               (60 * h);
      };
      const double of_energy = slope([&](double x) { return normal_answer(p, x, true).energy; });
      const double of_stress = slope([&](double x) { return normal_answer(p, x, true).stress; });
      EXPECT_NEAR(of_energy, at.stress, 1e-9 * (std::abs(at.stress) + at.energy / u)) << p.name << " at " << u;
      EXPECT_NEAR(of_stress, at.stiffness, 1e-9 * (at.stiffness + std::abs(at.stress) / u)) << p.name << " at " << u;
      if (at.stress > 0) {
        EXPECT_NEAR(overlap_at(p, at.stress), u, 1e-12 * u + 1e-17) << p.name;
      }
    }
}

// Eqs 4.10, 4.11, 4.13, 4.17
TEST(NormalLaw, StatedStiffnessFollowsFromTheStress) {
  const NormalAnswer l = normal_answer(linear(), 4e-5, false), w = normal_answer(power(), 4e-5, false);
  EXPECT_NEAR(l.stiffness, 4e9 + 7.4e4 * l.stress, rounding * l.stiffness);
  EXPECT_NEAR(w.stiffness, 2.1e6 * std::pow(w.stress, 0.75), rounding * w.stiffness);
  EXPECT_NEAR(shear_stiffness_at(linear(), 2e6), 1e8 + 9.7e4 * 2e6, 1);
  EXPECT_NEAR(shear_stiffness_at(power(), 2e6), 1.9e6 * std::pow(2e6, 0.7), 1e-3);
  EXPECT_EQ(shear_stiffness_at(power(), -1), 0);
}

// ---- shear under constant normal stress
// -------------------------------------------------------------------------------

JointPath sheared(double stress, double slip) {
  JointPath path;
  path.normal_stress = stress;
  path.slip = slip;
  return path;
}

TEST(ShearLaw, ElasticThenAtTheConstantStrength) {
  for (const JointProperties& p : {plain(), linear(), power()})
    for (const double stress : {1e4, 1e6, 2e7}) {
      const double ks = shear_stiffness_at(p, stress), strength = std::tan(p.friction) * stress;
      for (const JointPathPoint& at : follow(p, sheared(stress, 3 * strength / ks))) {
        EXPECT_NEAR(at.shear_stress, std::min(ks * at.slip, std::tan(p.friction) * at.normal_stress),
                    closed_form * strength)
            << p.name;
        if (at.slip > 0) {
          EXPECT_NEAR(at.plastic_slip, std::max(at.slip - strength / ks, 0.0), closed_form * strength / ks) << p.name;
        }
      }
    }
}

// Eqs 4.16, 4.18, 6.7, F.1-F.8. Hardening and softening: plastic slip β and strength μ(β)σ with s = τ/ks + β in closed
// form through β
TEST(ShearLaw, HardeningAndSofteningFollowTheirCurves) {
  for (const JointProperties& p : {hardened(), softened()})
    for (const double stress : {1e5, 1e6, 5e6}) {
      const double ks = shear_stiffness_at(p, stress);
      const bool hardens = p.laws.friction == FrictionLaw::hardening;
      const double scale = hardens ? 2e-6 * std::pow(stress, 0.213) : 0.35;
      const auto strength = [&](double beta) {
        return stress * (hardens ? std::tan(40 * degree) * (1 - std::exp(-beta / scale))
                                 : std::tan(20 * degree) - 0.059266 * (1 - std::exp(-beta / 0.35)));
      };
      const double first = hardens ? 0 : strength(0) / ks;  // slip at which it yields
      const std::vector<JointPathPoint> points = follow(p, sheared(stress, first + 3 * scale));
      for (const JointPathPoint& at : points) {
        if (at.slip <= first * (1 + 1e-12)) continue;
        EXPECT_NEAR(at.shear_stress, strength(at.plastic_slip), closed_form * stress) << p.name;
        EXPECT_NEAR(at.slip, at.shear_stress / ks + at.plastic_slip, closed_form * at.slip) << p.name;
        EXPECT_FALSE(at.snap_back);
      }
      // the same for any steps: the state after one step is that after two hundred
      JointPath once = sheared(stress, first + 3 * scale);
      once.steps = 1;
      EXPECT_NEAR(follow(p, once).back().shear_stress, points.back().shear_stress, closed_form * stress) << p.name;
    }
}

// dτ/ds = ks while it sticks, and ks h / (ks + h) with h = σ dμ/dβ while it slips, which is negative as it softens
TEST(ShearLaw, TangentIsThatOfTheCurve) {
  constexpr double stress = 1e6;
  for (const JointProperties& p : {plain(), linear(), hardened(), softened()}) {
    const double ks = shear_stiffness_at(p, stress);
    const double reach = p.laws.friction == FrictionLaw::softening   ? 1
                         : p.laws.friction == FrictionLaw::hardening ? 1e-4
                                                                     : 2e-2;
    JointPath path = sheared(stress, reach);
    path.steps = 20000;
    const std::vector<JointPathPoint> points = follow(p, path);
    for (std::size_t i = path.steps + 2; i + 1 < points.size(); i += 97) {
      const bool stuck = points[i + 1].plastic_slip == points[i - 1].plastic_slip;
      if (!stuck && points[i].plastic_slip == points[i - 1].plastic_slip) continue;  // yields in between
      const double h = stress * friction_answer(p, p.friction, points[i].plastic_slip, stress).slope;
      const double found =
          (points[i + 1].shear_stress - points[i - 1].shear_stress) / (points[i + 1].slip - points[i - 1].slip);
      EXPECT_NEAR(found, stuck ? ks : ks * h / (ks + h), 1e-5 * ks) << p.name << " at " << points[i].slip;
    }
  }
}

// Eqs 6.3 and 6.4
TEST(ShearLaw, CohesionIsLostAtTheFirstSlip) {
  const JointProperties p = bonded_joint();
  JointPath path = sheared(1e6, 3e-3);
  path.bonded = true;
  const double friction = std::tan(40 * degree) * 1e6;
  bool intact = true;
  for (const JointPathPoint& at : follow(p, path)) {
    if (at.slip == 0) continue;
    intact = intact && 1e9 * at.slip <= friction + 0.787e6;
    EXPECT_EQ(at.bond == Bond::whole, intact);
    EXPECT_NEAR(at.shear_stress, intact ? 1e9 * at.slip : friction, closed_form * friction);
  }
  EXPECT_FALSE(intact);
}

// Eqs 6.3-6.6
TEST(ShearLaw, TensionAndSlipBreakTheSameBond) {
  const JointProperties p = bonded_joint();
  JointState<2> history;
  JointKinematics<2> k;
  k.normal = {0, 1};
  k.area = 2;
  k.slip.setZero();
  k.overlap = 1e-5;  // 28 µm below the offset
  history.bond = Bond::whole;
  EXPECT_NEAR(joint_law<2>(p, p.friction, 0, k, history).force[1], -2 * 2e9 * 28e-6, 1e-6);
  EXPECT_EQ(history.bond, Bond::whole);
  // a dashpot that pulls beyond the strength breaks it, and a broken bond does not pull
  k.closing_speed = -1;
  EXPECT_EQ(joint_law<2>(p, p.friction, 1e6, k, history).force[1], 0);
  EXPECT_EQ(history.bond, Bond::lost);
  // slip under tension: the strength c A + tan φ F is less than without load; beyond it there is none
  history.bond = Bond::whole;
  k.closing_speed = 0;
  k.slip = {-1e-3, 0};  // the trial is 2 MN, the strength 1.574 - 0.094 MN
  const JointForce<2> torn = joint_law<2>(p, p.friction, 0, k, history);
  EXPECT_EQ(history.bond, Bond::lost);
  EXPECT_EQ(torn.force, Vector<2>::Zero());
  EXPECT_EQ(history.shear_force, Vector<2>::Zero());
}

// A factor divides friction, its softening drop and cohesion: the joint behaves as one of that strength, and with a
// factor of 1 as without one, to the bit. Tensile strength is not divided.
TEST(ShearLaw, AFactorDividesTheFullShearStrength) {
  constexpr double factor = 1.6;
  JointProperties p = softened();
  p.laws.bond = true;
  p.cohesion = 1e5;
  p.tension = 1e3;
  JointProperties weaker = p;
  weaker.friction = std::atan(std::tan(p.friction) / factor);
  weaker.cohesion /= factor;
  weaker.softening_drop /= factor;
  JointState<2> divided, stated, plain, of_one;
  for (JointState<2>* history : {&divided, &stated, &plain, &of_one})
    history->bond = Bond::whole;
  JointKinematics<2> k;
  k.normal = {0, 1};
  k.area = 2;
  k.overlap = 1e-4;
  bool broken = false;
  for (int step = 0; step < 400; ++step) {
    k.slip = {-1e-4 * (1 + step % 3), 0};
    const Vector<2> force = joint_law<2>(p, weaker.friction, 0, k, divided, factor).force;
    EXPECT_EQ(force, joint_law<2>(weaker, weaker.friction, 0, k, stated).force) << step;
    EXPECT_EQ(divided.plastic_slip, stated.plastic_slip);
    EXPECT_EQ(joint_law<2>(p, p.friction, 0, k, plain).force, joint_law<2>(p, p.friction, 0, k, of_one, 1).force);
    broken = broken || divided.bond == Bond::lost;
  }
  EXPECT_TRUE(broken);
  EXPECT_GT(divided.plastic_slip, 0.02) << "softening has set in";
}

TEST(ShearLaw, SnapBackIsReported) {
  JointProperties p = softened();
  p.softening_slip = 1e-4;  // 0.059 of 10 MPa over 0.1 mm: 5.9 GPa/m, more than the spring's 0.1
  const std::vector<JointPathPoint> points = follow(p, sheared(10e6, 0.05));
  int snapped = 0;
  for (const JointPathPoint& at : points)
    snapped += at.snap_back;
  EXPECT_GE(snapped, 1);
  EXPECT_NEAR(points.back().shear_stress, 10e6 * (std::tan(20 * degree) - 0.059266), 1e-3);
}

TEST(ShearLaw, ConstantNormalStiffnessRaisesTheStress) {
  for (const JointProperties& p : every_law()) {
    JointPath path = sheared(1e6, 2e-4);
    path.surroundings = 5e9;
    path.dilation = 0.1;
    const std::vector<JointPathPoint> points = follow(p, path);
    const double start = points[path.steps].overlap;
    for (const JointPathPoint& at : points)
      if (at.slip > 0) {  // joint and surroundings share the rise
        EXPECT_NEAR(at.normal_stress, 1e6 + 5e9 * (0.1 * at.slip - (at.overlap - start)), closed_form * 1e6) << p.name;
      }
    EXPECT_GT(points.back().normal_stress, 1.02e6) << p.name;
  }
}

// ---- energy
// -----------------------------------------------------------------------------------------------------------

// Random paths in all laws: dissipation is never negative, and the work of the forces on the joint is stored,
// dissipated or counted as stiffening. The latter up to the error of the trapezoid rule: small steps.
TEST(JointEnergy, DissipationIsNeverNegative) {
  Random random(41);
  constexpr int paths = 100000, length = 8;
  int slid = 0;
  const std::vector<JointProperties> laws = every_law();
  for (int i = 0; i < paths; ++i) {
    const JointProperties& p = laws[i % laws.size()];
    JointState<3> history;
    if (p.laws.bond && i % 2) history.bond = Bond::whole;
    JointKinematics<3> k;
    k.normal = {0, 0, 1};
    k.area = shapes::power_of_ten(random, -2, 1);
    for (int step = 0; step < length; ++step) {
      k.overlap = shapes::power_of_ten(random, -7, -3.5);
      const double slip = shapes::power_of_ten(random, -8, -2), way = shapes::uniform(random, 0, 2 * std::numbers::pi);
      k.slip = {slip * std::cos(way), slip * std::sin(way), 0};
      const double before = history.plastic_slip;
      const JointForce<3> answer = joint_law<3>(p, p.friction, 0, k, history);
      ASSERT_GE(answer.friction, 0) << p.name << " path " << i;
      ASSERT_GE(history.plastic_slip, before);
      const double coefficient =
          friction_answer(p, p.friction, history.plastic_slip, answer.force[2] / k.area).coefficient;
      const double cohesion = cohesion_answer(p, history.bond, history.bond_slip).stress * k.area;
      ASSERT_LE(history.shear_force.norm(),
                (cohesion + coefficient * std::max(answer.force[2], 0.0)) * (1 + 1e-9) + 1e-300)
          << p.name;
      slid += history.plastic_slip > before;
    }
  }
  EXPECT_GT(slid, paths);
}

TEST(JointEnergy, WorkIsStoredDissipatedOrCounted) {
  for (const JointProperties& p : {plain(), linear(), hardened(), softened()}) {
    // closes, shears, closes more under shear, shears back and opens
    const double deep = overlap_at(p, 2e6), ks = shear_stiffness_at(p, 1e6), reach = 1.5e6 / ks;
    const double corners[][2] = {{0, 0},        {0.5 * deep, 0}, {0.5 * deep, reach},
                                 {deep, reach}, {deep, -reach},  {0.7 * deep, 0}};
    double errors[2];
    for (int fine = 0; fine < 2; ++fine) {
      const int steps = fine ? 4000 : 1000;
      JointState<2> history;
      Vector<2> force = Vector<2>::Zero();
      double work = 0, lost = 0, stiffening = 0, elastic = 0, largest_energy = 0;
      for (std::size_t leg = 1; leg < std::size(corners); ++leg)
        for (int i = 1; i <= steps; ++i) {
          const double fraction = static_cast<double>(i) / steps;
          const double du = (corners[leg][0] - corners[leg - 1][0]) / steps,
                       ds = (corners[leg][1] - corners[leg - 1][1]) / steps;
          JointKinematics<2> k;
          k.normal = {0, 1};
          k.area = 1;
          k.overlap = corners[leg - 1][0] + fraction * (corners[leg][0] - corners[leg - 1][0]);
          k.slip = {ds, 0};
          const JointForce<2> answer = joint_law<2>(p, p.friction, 0, k, history);
          // the joint pushes along +y as it closes, and against the slip
          work += 0.5 * (force[1] + answer.force[1]) * du - 0.5 * (force[0] + answer.force[0]) * ds;
          force = answer.force;
          lost += answer.friction;
          stiffening += answer.stiffening;
          elastic = answer.elastic;
          largest_energy = std::max(largest_energy, work);
        }
      errors[fine] = std::abs(elastic + lost + stiffening - work) / largest_energy;
    }
    EXPECT_LT(errors[1], 2e-4) << p.name;
    if (errors[0] > 1e-9) {
      EXPECT_LT(errors[1], 0.5 * errors[0]) << p.name;
    }
  }
}

}  // namespace
}  // namespace voussoir::joint_law_test
