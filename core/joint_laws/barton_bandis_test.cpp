// Barton and Bandis' law against closed forms, quadratures in thirty digits and hostile paths.
#include "core/joint_laws/barton_bandis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/joint_laws/joint_path.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::barton_bandis_test {
namespace {

using shapes::Random;

// JRC 10, JCS 30 MPa, 26 degrees without roughness, blocks of 0.1 m
JointProperties rough(Mobilisation mobilisation = Mobilisation::table) {
  JointProperties p;
  p.normal_stiffness = 10e9;
  p.shear_stiffness = 8e9;
  p.friction = 26 * degree;
  p.laws.friction = FrictionLaw::barton_bandis;
  p.barton_bandis.sample_jrc = 10;
  p.barton_bandis.sample_jcs = 30e6;
  p.barton_bandis.block_length = 0.1;
  p.barton_bandis.mobilisation = mobilisation;
  scale_to_blocks(p.barton_bandis);
  return p;
}

double strength(const JointProperties& p, double slip, double stress) {
  return stress * friction_answer(p, p.friction, slip, stress).coefficient;
}

#define EXPECT_RELATIVE(value, expected, error) EXPECT_NEAR(value, expected, (error)*std::abs(expected))

// ---- the law --------------------------------------------------------------------------------------------------------

TEST(BartonBandis, EnvelopeIsThePublishedOne) {
  const JointProperties p = rough(Mobilisation::none);
  const double stress[] = {0.001e6, 0.01e6, 0.1e6, 1e6, 5e6, 30e6, 60e6},
               angle[] = {70, 60.7712125472, 50.7712125472, 40.7712125472, 33.78151250384, 26, 26};
  for (int i = 0; i < 7; ++i)
    for (const double slip : {0.0, 1e-6, 1.0})
      EXPECT_RELATIVE(to_degrees(mobilised_angle(p, slip, stress[i]).angle), angle[i], 1e-12);
  EXPECT_RELATIVE(strength(p, 0, 1e6), 0.8623004373982e6, 1e-12);
  EXPECT_RELATIVE(strength(p, 0, 5e6), 3.34487240267e6, 1e-12);
  // the cap begins at JCS 10^(-(70 - φr)/JRC)
  EXPECT_RELATIVE(stress_at_largest_angle(p), 30e6 * std::pow(10, -4.4), 1e-12);
  for (const double none : {0.0, 1e-300, -1e3, 0.999 * stress_at_largest_angle(p)})
    EXPECT_RELATIVE(to_degrees(mobilised_angle(p, 0, none).angle), 70, 1e-15);
}

// the slope of the envelope at one stress: tan φ - 0.00757986 JRC/cos² φ
TEST(BartonBandis, SlopeOfTheEnvelope) {
  const JointProperties p = rough(Mobilisation::none);
  for (const double stress : {0.01e6, 0.1e6, 1e6, 5e6, 29e6}) {
    const double step = 1e-5 * stress, tangent = strength(p, 0, stress) / stress;
    const double slope = (strength(p, 0, stress + step) - strength(p, 0, stress - step)) / (2 * step);
    EXPECT_NEAR(slope, tangent - 10 * degree / std::log(10) * (1 + tangent * tangent), 1e-8);
  }
}

TEST(BartonBandis, ScaleIsThePublishedOne) {
  BartonBandis law;
  law.sample_jrc = 15;
  law.sample_jcs = 150e6;
  law.sample_length = 0.1;
  const double length[] = {1, 2}, jrc[] = {7.517808504409, 6.106357973054},
               jcs[] = {53.22200838504e6, 38.96079059301e6}, slip[] = {3.891706781513e-3, 5.781336375633e-3};
  for (int i = 0; i < 2; ++i) {
    law.block_length = length[i];
    scale_to_blocks(law);
    EXPECT_RELATIVE(law.jrc, jrc[i], 1e-12);
    EXPECT_RELATIVE(law.jcs, jcs[i], 1e-12);
    EXPECT_RELATIVE(law.peak_slip, slip[i], 1e-12);
  }
  // without a sample length both are those of the blocks
  law.sample_length = 0;
  scale_to_blocks(law);
  EXPECT_EQ(law.jrc, 15);
  EXPECT_EQ(law.jcs, 150e6);
  EXPECT_GT(law.peak_slip, slip[1]);
}

TEST(BartonBandis, MobilisationIsTheTable) {
  const JointProperties p = rough();
  const double peak = p.barton_bandis.peak_slip;
  EXPECT_RELATIVE(peak, 0.9141763792298e-3, 1e-12);
  const double x[] = {0.15, 0.3, 0.45, 0.6, 1, 2, 4, 10, 25, 50, 100};
  const double shear[] = {0.2308681911256, 0.4877325885659, 0.6137423875912, 0.7557018641939,
                          0.8623004373982, 0.7970195570914, 0.7356443541842, 0.6590181271565,
                          0.6226506665066, 0.5759313740816, 0.4877325885659};
  for (int i = 0; i < 11; ++i)
    EXPECT_RELATIVE(strength(p, x[i] * peak, 1e6), shear[i] * 1e6, 1e-12);
  EXPECT_EQ(strength(p, 0, 1e6), 0);
  EXPECT_RELATIVE(strength(p, 1e3 * peak, 1e6), shear[10] * 1e6, 1e-12);
  EXPECT_RELATIVE(to_degrees(std::atan(barton_bandis_dilation(p, mobilised_over(p, peak, peak), 1e6, 1))),
                  7.385606273598, 1e-12);
  EXPECT_EQ(barton_bandis_dilation(p, mobilised_over(p, 0, 0.3 * peak), 1e6, 1), 0);
  // its slope is that of its values
  for (const double at : {0.1, 0.4, 0.8, 1.5, 3.0, 7.0, 20.0, 60.0, 200.0}) {
    const double step = 1e-6 * peak;
    const double slope = (strength(p, at * peak + step, 1e6) - strength(p, at * peak - step, 1e6)) / (2 * step * 1e6);
    EXPECT_NEAR(friction_answer(p, p.friction, at * peak, 1e6).slope, slope, 1e-6 * std::abs(slope) + 1e-6);
  }
}

// A factor of safety divides the shear strength at each stress; the dilation keeps its angle up to the friction in
// force.
TEST(BartonBandis, TheFactorDividesTheStrength) {
  for (const Mobilisation mobilisation : {Mobilisation::none, Mobilisation::table}) {
    const JointProperties p = rough(mobilisation);
    const double peak = p.barton_bandis.peak_slip;
    for (const double factor : {0.5, 1.0, 1.7, 40.0})
      for (const double stress : {1e3, 1e5, 1e6, 1e8}) {
        const double friction = std::atan(std::tan(p.friction) / factor);  // of which the law takes no notice
        const double all = strength(p, peak, stress) / stress;
        EXPECT_RELATIVE(friction_answer(p, friction, peak, stress, factor).coefficient, all / factor, 1e-14);
        EXPECT_NEAR(barton_bandis_dilation(p, mobilised_over(p, peak, peak), stress, factor),
                    std::min(std::tan(0.5 * roughness_angle(p, stress)), all / factor), 1e-14);
      }
  }
}

// ---- paths ----------------------------------------------------------------------------------------------------------

// m: slip of the walls at which the plastic slip is `plastic`, when the shear stress then is `shear`
double slip_at(const JointProperties& p, double plastic, double shear) {
  return plastic + shear / p.shear_stiffness;
}

JointPathPoint end_of(const JointProperties& p, double stress, double slip, double surroundings, int steps) {
  JointPath path;
  path.normal_stress = stress;
  path.slip = slip;
  path.surroundings = surroundings;
  path.steps = steps;
  return follow(p, path).back();
}

// under constant load the rise is a quadrature, of which the steps are parted at the kinks of the table
TEST(BartonBandis, RiseUnderConstantLoadConvergesToTheSecondOrder) {
  const JointProperties p = rough();
  const double x[] = {1, 4, 10};
  const double stress[] = {0.25e6, 1e6, 4e6};
  const double rise[3][3] = {{0.07727611865985e-3, 0.4909974178206e-3, 1.090568839724e-3},
                             {0.05470122376147e-3, 0.3474945545174e-3, 0.7725909040605e-3},
                             {0.0323284614293e-3, 0.2053435076205e-3, 0.4568393678724e-3}};
  for (int s = 0; s < 3; ++s)
    for (int i = 0; i < 3; ++i) {
      const double plastic = x[i] * p.barton_bandis.peak_slip;
      const double slip = slip_at(p, plastic, strength(p, plastic, stress[s]));
      const auto error = [&](int steps) {
        const JointPathPoint at = end_of(p, stress[s], slip, 0, steps);
        EXPECT_RELATIVE(at.plastic_slip, plastic, 1e-9);
        EXPECT_RELATIVE(at.normal_stress, stress[s], 1e-9);
        return std::abs(at.rise / rise[s][i] - 1);
      };
      const double coarse = error(25), fine = error(200);
      EXPECT_LT(coarse, 6e-5);
      EXPECT_LT(fine, 1e-6);
      EXPECT_LT(fine, coarse / 40);  // 64 for the second order, 8 for the first
    }
}

struct Expected {
  double stress, end, shear;  // Pa: at the begin, and at the end
};

// the order of the error of the stress at the end, between two numbers of steps
void expect_second_order(const JointProperties& p, const Expected& e, double plastic, double error_at_25,
                         double error_at_200) {
  const auto error = [&](int steps) {
    const JointPathPoint at = end_of(p, e.stress, slip_at(p, plastic, e.shear), 2e9, steps);
    EXPECT_NEAR(at.plastic_slip / plastic, 1, error_at_25);
    EXPECT_NEAR(at.shear_stress / e.shear, 1, 2 * error_at_25);
    return std::abs(at.normal_stress / e.end - 1);
  };
  const double coarse = error(25), fine = error(200);
  EXPECT_LT(coarse, error_at_25) << e.stress;
  EXPECT_LT(fine, error_at_200) << e.stress;
  EXPECT_LT(fine, coarse / 40) << e.stress;  // 64 for the second order, 8 for the first
}

TEST(BartonBandis, ConstantStiffnessWithoutMobilisation) {
  const Expected all[] = {{0.1e6, 0.6639861492782e6, 0.6094899659786e6},
                          {1e6, 1.408458589545e6, 1.15214397259e6},
                          {5e6, 5.223892256152e6, 3.469598588022e6}};
  for (const Expected& e : all)
    expect_second_order(rough(Mobilisation::none), e, 2e-3, 4e-5, 7e-7);
}

TEST(BartonBandis, ConstantStiffnessWithHyperbolicClosure) {
  JointProperties p = rough(Mobilisation::none);
  p.laws.normal = StiffnessLaw::hyperbolic;
  p.maximum_closure = 0.2e-3;
  const Expected all[] = {{0.1e6, 0.6896419755876e6, 0.6293981143309e6},
                          {1e6, 1.452550335889e6, 1.182557705642e6},
                          {5e6, 5.263923348916e6, 3.491798528207e6}};
  for (const Expected& e : all)
    expect_second_order(p, e, 2e-3, 4e-5, 7e-7);
}

TEST(BartonBandis, ConstantStiffnessMobilised) {
  const JointProperties p = rough();
  const double x[] = {1, 4, 10}, stress[] = {0.1e6, 1e6, 5e6};
  const double end[3][3] = {{0.239810649597e6, 0.82350558118e6, 1.5016922029e6},
                            {1.08998219274e6, 1.53875617821e6, 2.1212432432e6},
                            {5.04777304589e6, 5.2992316743e6, 5.65297068925e6}};
  const double last[] = {0.956782993331e6, 1.31280103321e6, 3.21449618226e6};
  for (int s = 0; s < 3; ++s)
    for (int i = 0; i < 3; ++i) {
      const double plastic = x[i] * p.barton_bandis.peak_slip;
      const double shear = strength(p, plastic, end[s][i]);
      if (i == 2) EXPECT_RELATIVE(shear, last[s], 1e-10);
      expect_second_order(p, {stress[s], end[s][i], shear}, plastic, 2e-4, 4e-6);
    }
}

// ---- hostile values -------------------------------------------------------------------------------------------------

// one joint of 1 m², driven step by step
struct Specimen {
  const JointProperties& p;
  JointState<3> history{};
  JointRise<3> rise{};
  double walls = 0;  // m, by which they have come together

  LawForce<3> step(double closing, const Vector<3>& slip) {
    walls += closing;
    JointKinematics<3> k;
    k.normal = {0, 0, 1};
    k.overlap = std::max(walls + rise.rise, 0.0);
    k.area = 1;
    k.slip = slip;
    return joint_law<3>(p, p.friction, 0, k, history, 1, {&rise, 0});
  }
};

TEST(BartonBandis, WithoutRoughnessItIsCoulombs) {
  JointProperties smooth = rough(Mobilisation::table), coulomb = smooth;
  smooth.barton_bandis.sample_jrc = 0;
  scale_to_blocks(smooth.barton_bandis);
  coulomb.laws.friction = FrictionLaw::constant;
  Specimen a{smooth}, b{coulomb};
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double closing = (a.walls > 2e-4 ? -1 : 1) * shapes::uniform(random, 0, 1e-5);
    const Vector<3> slip{shapes::uniform(random, -1e-4, 1e-4), shapes::uniform(random, -1e-4, 1e-4), 0};
    const Vector<3> force = a.step(closing, slip).force, expected = b.step(closing, slip).force;
    ASSERT_LT((force - expected).norm(), 1e-9 * expected.norm() + 1e-6);
    ASSERT_EQ(a.rise.rise, 0);
  }
}

// Random paths of a thousand steps, reversed in each, with and without stress: finite, on or in the cone, never below
// the walls, and no step makes energy.
TEST(BartonBandis, HostilePathsNeverMakeEnergy) {
  Random random(7);
  for (const Mobilisation mobilisation : {Mobilisation::none, Mobilisation::table})
    for (const double jrc : {0.0, 1e-9, 10.0, 20.0})
      for (const double jcs : {1e3, 1e5, 30e6, 500e6})
        for (const double share : {0.0, 0.5, 1.0}) {
          JointProperties p = rough(mobilisation);
          p.barton_bandis.sample_jrc = jrc;
          p.barton_bandis.sample_jcs = jcs;
          p.barton_bandis.dilation_share = share;
          scale_to_blocks(p.barton_bandis);
          Specimen joint{p};
          for (int i = 0; i < 1000; ++i) {
            const double target = i % 7 == 0 ? 0 : shapes::uniform(random, -1e-4, 2e-4);
            const double size = i % 5 == 0 ? 0 : shapes::power_of_ten(random, -12, -3);
            const Vector<3> slip{(i % 2 == 0 ? 1 : -1) * size, i % 3 == 0 ? shapes::uniform(random, -1e-4, 1e-4) : 0,
                                 0};
            const LawForce<3> f = joint.step(target - joint.walls, slip);
            ASSERT_TRUE(f.force.allFinite());
            ASSERT_GE(f.force[2], 0);
            ASSERT_GE(f.friction + f.dilation, -1e-12 * std::abs(f.dilation));
            const double limit = strength(p, joint.history.plastic_slip, f.force[2]);
            ASSERT_LE(joint.history.shear_force.norm(), limit * (1 + 1e-9) + 1e-6);
            ASSERT_GE(joint.rise.rise, 0);
            ASSERT_LE(joint.rise.rise, joint.rise.rise_there * (1 + 1e-12));
            if (jrc == 0 || share == 0) ASSERT_EQ(joint.rise.rise, 0);
          }
        }
}

// A path in steps and in parts of them: the difference falls with the square of the step, if the slip turns in the
// plane of the joint with the step.
TEST(BartonBandis, PartedStepsEndInTheSameState) {
  for (const Mobilisation mobilisation : {Mobilisation::none, Mobilisation::table})
    for (const bool turns : {false, true}) {
      const JointProperties p = rough(mobilisation);
      const auto end = [&](int parts) {
        Random random(11);
        Specimen joint{p};
        joint.step(1e-4, Vector<3>::Zero());
        for (int i = 0; i < 20; ++i) {
          const double closing = shapes::uniform(random, -2e-5, 2e-5) + (1e-4 - joint.walls) / 2;
          const Vector<3> slip{shapes::uniform(random, -1e-4, 3e-4), turns ? shapes::uniform(random, -1e-4, 2e-4) : 0,
                               0};
          for (int k = 0; k < parts; ++k)
            joint.step(closing / parts, slip / parts);
        }
        return joint;
      };
      const Specimen exact = end(512);
      const auto error = [&](int parts) { return std::abs(end(parts).rise.rise / exact.rise.rise - 1); };
      EXPECT_LT(error(32), turns ? 1e-3 : 1e-5);
    }
}

// back along the secant to where it was mated, and out again along it
TEST(BartonBandis, TheRiseReturnsAlongItsSecant) {
  const JointProperties p = rough();
  JointPath path;
  path.normal_stress = 1e6;
  path.slip = 4e-3;
  path.cycles = 2;
  path.steps = 400;
  const std::vector<JointPathPoint> points = follow(p, path);
  const JointPathPoint& far = points[2 * path.steps];
  for (int i = 2 * path.steps; i <= 3 * path.steps; ++i)
    EXPECT_NEAR(points[i].rise, far.rise * std::min(std::abs(points[i].offset) / far.offset, 1.0), 0.01 * far.rise);
  const auto closest =
      std::min_element(points.begin() + 2 * path.steps, points.begin() + 4 * path.steps,
                       [](const auto& a, const auto& b) { return std::abs(a.offset) < std::abs(b.offset); });
  EXPECT_LT(closest->rise, 0.02 * far.rise);
}

// what springs and slip take is the work of the walls
TEST(BartonBandis, TheBalanceCloses) {
  for (const Mobilisation mobilisation : {Mobilisation::none, Mobilisation::table})
    for (const double surroundings : {0.0, 2e9}) {
      const JointProperties p = rough(mobilisation);
      const auto error = [&](int steps) {
        JointPath path;
        path.normal_stress = 1e6;
        path.slip = 5e-3;
        path.surroundings = surroundings;
        path.steps = steps;
        const std::vector<JointPathPoint> points = follow(p, path);
        double work = 0;
        for (std::size_t i = 1; i < points.size(); ++i)
          work += 0.5 * (points[i].normal_stress + points[i - 1].normal_stress) *
                      (points[i].overlap - points[i - 1].overlap) +
                  0.5 * (points[i].shear_stress + points[i - 1].shear_stress) * (points[i].slip - points[i - 1].slip);
        return std::abs(work - points.back().elastic - points.back().dissipated - points.back().dilation) / work;
      };
      EXPECT_LT(error(200), 1e-9);
    }
}

}  // namespace
}  // namespace voussoir::barton_bandis_test
