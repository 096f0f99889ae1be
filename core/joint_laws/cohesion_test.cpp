// Cohesion that slip takes or leaves, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/joint_laws/joint_law.hpp"
#include "core/joint_laws/joint_path.hpp"
#include "text/angle.hpp"

namespace voussoir::cohesion_test {
namespace {

JointProperties cohesive() {
  JointProperties p{"cohesive", 2e9, 1e9, 40 * degree, false};
  p.laws.bond = true;
  p.cohesion = 0.3e6;
  return p;
}

JointPath sheared(double stress) {
  JointPath path;
  path.normal_stress = stress;
  path.slip = 4e-3;
  path.bonded = true;
  return path;
}

// c(β) = c_r + (c - c_r) e^(-β/s): at constant normal stress τ = ks u up to c + μ σ, then τ(β) at u = τ(β)/ks + β
TEST(Cohesion, CohesionFollowsItsLaw) {
  constexpr double c = 0.3e6, stress = 1e6, ks = 1e9, least = 1e-12;
  const double friction = std::tan(40 * degree) * stress;
  struct Law {
    CohesionLaw law;
    double residual, slip;
  };
  for (const Law& law : {Law{CohesionLaw::plastic, 0, 0}, Law{CohesionLaw::softening, 0, 1e-3},
                         Law{CohesionLaw::softening, 0.1e6, 5e-4}, Law{CohesionLaw::softening, 0.1e6, 0}}) {
    JointProperties p = cohesive();
    p.cohesion_law = law.law;
    p.residual_cohesion = law.residual;
    p.cohesion_slip = law.slip;
    const auto cohesion_after = [&](double slip) {
      if (law.law == CohesionLaw::plastic) return c;
      return law.residual + (law.slip > 0 ? (c - law.residual) * std::exp(-slip / law.slip) : 0);
    };
    const JointPath path = sheared(stress);
    double dissipated = 0, sheared_before = 0, plastic_before = 0;
    int slipping = 0, snapped = 0;
    for (const JointPathPoint& at : follow(p, path)) {
      if (at.slip == 0) continue;
      if (ks * at.slip <= c + friction) {
        EXPECT_EQ(at.bond, Bond::whole);
        EXPECT_NEAR(at.shear_stress, ks * at.slip, least * friction);
      } else {
        const double strength = cohesion_after(at.plastic_slip) + friction;
        EXPECT_EQ(at.bond, Bond::slipped);
        EXPECT_NEAR(at.shear_stress, strength, least * strength);
        EXPECT_NEAR(at.slip, strength / ks + at.plastic_slip, least * at.slip);
        EXPECT_NEAR(at.cohesion, cohesion_after(at.plastic_slip), least * c);
        ++slipping;
        snapped += at.snap_back;
      }
      dissipated += 0.5 * (sheared_before + at.shear_stress) * (at.plastic_slip - plastic_before);
      EXPECT_NEAR(at.dissipated, dissipated, 1e-12 * friction);
      sheared_before = at.shear_stress;
      plastic_before = at.plastic_slip;
    }
    EXPECT_GT(slipping, 50);
    EXPECT_EQ(snapped, law.law == CohesionLaw::softening && law.slip == 0 ? 1 : 0);
  }
}

// (c - c_r)/s = 3 GPa/m is more than the spring's 1: the fall is at once, to the only root
TEST(Cohesion, CohesionThatFallsFasterThanTheSpringSnapsBack) {
  JointProperties p = cohesive();
  p.cohesion_law = CohesionLaw::softening;
  p.cohesion_slip = 1e-4;
  const JointPath path = sheared(1e6);
  int snapped = 0;
  for (const JointPathPoint& at : follow(p, path)) {
    snapped += at.snap_back;
    if (at.bond == Bond::slipped) {
      EXPECT_NEAR(at.slip, at.shear_stress / 1e9 + at.plastic_slip, 1e-12 * at.slip);
    }
  }
  EXPECT_EQ(snapped, 1);
}

// A slipped bond keeps its cohesion under any load that leaves the joint closed and loses it, permanently, as soon as
// the normal force is zero; its tensile strength went with the slip.
TEST(Cohesion, OpeningTakesWhatSlipHasLeft) {
  JointProperties p = cohesive();
  p.cohesion_law = CohesionLaw::plastic;
  p.tension = 0.1e6;
  const double closed = p.tension / p.normal_stiffness;
  JointState<2> history;
  history.bond = Bond::whole;
  JointKinematics<2> k;
  k.normal = {0, 1};
  k.area = 2;
  k.overlap = closed + 1e-5;
  k.slip = {-1e-2, 0};
  const double strength = 2 * (p.cohesion + std::tan(p.friction) * 2e9 * 1e-5);
  EXPECT_NEAR(joint_law<2>(p, p.friction, 0, k, history).force[0], strength, 1e-9 * strength);
  EXPECT_EQ(history.bond, Bond::slipped);
  k.slip = {1e-2, 0};  // back and forth, then nearly unloaded
  EXPECT_NEAR(joint_law<2>(p, p.friction, 0, k, history).force[0], -strength, 1e-9 * strength);
  k.overlap = closed + 1e-12;
  EXPECT_NEAR(joint_law<2>(p, p.friction, 0, k, history).force[0], -2 * p.cohesion, 1e-6 * strength);
  EXPECT_EQ(history.bond, Bond::slipped);
  k.overlap = closed;
  EXPECT_EQ(joint_law<2>(p, p.friction, 0, k, history).force, Vector<2>::Zero());
  EXPECT_EQ(history.bond, Bond::lost);
  k.overlap = closed + 1e-5;
  const double frictional = 2 * std::tan(p.friction) * 2e9 * 1e-5;
  EXPECT_NEAR(joint_law<2>(p, p.friction, 0, k, history).force[0], -frictional, 1e-9 * strength);
}

// a factor divides c and c_r, to the bit
TEST(Cohesion, AFactorDividesBothCohesions) {
  constexpr double factor = 1.6;
  JointProperties p = cohesive();
  p.cohesion_law = CohesionLaw::softening;
  p.residual_cohesion = 0.1e6;
  p.cohesion_slip = 1e-3;
  JointProperties weaker = p;
  weaker.cohesion /= factor;
  weaker.residual_cohesion /= factor;
  JointState<3> divided, stated;
  divided.bond = stated.bond = Bond::whole;
  JointKinematics<3> k;
  k.normal = {0, 0, 1};
  k.area = 2;
  k.overlap = 1e-4;
  for (int step = 0; step < 200; ++step) {
    k.slip = {-1e-5 * (1 + step % 3), 0, 0};
    EXPECT_EQ(joint_law<3>(p, p.friction, 0, k, divided, factor).force,
              joint_law<3>(weaker, p.friction, 0, k, stated).force);
  }
  EXPECT_EQ(divided.bond, Bond::slipped);
}

// Two joints of 1 m² under one block that is pushed sideways. Brittle: the stiffer one has lost its cohesion before the
// other yields, and the pair's peak is the larger of both moments; plastic: the sum of both strengths, at any
// stiffness.
TEST(Cohesion, TwoJointsUnderOneBlockReachTheirSumOnlyIfCohesionStays) {
  constexpr double c = 0.1e6, stress = 0.2e6, stiff = 10e9, soft = 4e9;
  const double frictional = std::tan(30 * degree) * stress, strength = c + frictional;
  const double first = strength / stiff, second = strength / soft;  // m: slip at which each yields
  const auto peak = [&](CohesionLaw law) {
    JointPath path;
    path.normal_stress = stress;
    path.slip = second * (1 - 1e-12);
    path.bonded = true;
    path.steps = 1000;  // `first` is one of them
    std::vector<double> sum(path.steps + 1);
    for (const double stiffness : {stiff, soft}) {
      JointProperties p = cohesive();
      p.friction = 30 * degree;
      p.shear_stiffness = stiffness;
      p.cohesion = c;
      p.cohesion_law = law;
      const std::vector<JointPathPoint> points = follow(p, path);
      for (int i = 1; i <= path.steps; ++i)
        sum[i] += points[points.size() - 1 - path.steps + i].shear_stress;
    }
    return *std::ranges::max_element(sum);
  };
  EXPECT_NEAR(first, 21.547005383792513e-6, 1e-18);
  EXPECT_NEAR(strength + soft * first, 301.6580753730952e3, 1e-6);  // the pair as the first yields
  EXPECT_NEAR(peak(CohesionLaw::brittle), 330.9401076758503e3, 1e-3);
  EXPECT_NEAR(peak(CohesionLaw::plastic), 430.9401076758503e3, 1e-3);
}

}  // namespace
}  // namespace voussoir::cohesion_test
