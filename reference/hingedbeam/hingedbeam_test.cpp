#include "reference/hingedbeam/hingedbeam.hpp"

#include <gsl/gsl_multimin.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "reference/hingedbeam/overlap.hpp"

using namespace voussoir::reference;

namespace {

const HingedBeam beam;

// infinite walls; their ends are too far away to have an effect
const HingeAbutment wall{.below = 10, .above = 10, .thickness = 1};
const HingeAbutment aligned;

HingedBeamModel model_of(const HingeAbutment& abutment, HingeNormal normal, HingePoint point = HingePoint::centroid) {
  return {beam, abutment, point, normal};
}

// published to three decimals of a kN and five of a radian
constexpr double kilonewtons = 5.1e-4, radians = 5.1e-6;

struct Published {
  HingeAbutment abutment;
  HingeNormal normal;
  double weight, rotation;  // kN, rad: the peak
  double at[4];             // kN at .06, .10, .16, .20
};

TEST(HingedBeam, ClosedFormHasItsPublishedPeak) {
  const HingedBeamLoad peak = hinged_beam_second_order_peak(beam);
  EXPECT_NEAR(peak.weight / 1e3, 37.027, kilonewtons);
  EXPECT_NEAR(peak.rotation, 0.117755, 1.1e-6);
  EXPECT_NEAR(peak.thrust / 1e3, 149.32, 5.1e-3);
}

TEST(HingedBeam, TrueArmNormalAndAbutmentsHaveTheirPublishedNumbers) {
  const Published published[] = {
      {wall, HingeNormal::horizontal, 36.634, 0.11717, {28.694, 35.963, 32.869, 23.553}},
      {wall, HingeNormal::mean, 36.895, 0.11726, {28.841, 36.208, 33.094, 23.676}},
      {aligned, HingeNormal::mean, 36.588, 0.11590, {28.785, 35.996, 32.483, 22.773}},
  };
  for (const Published& p : published) {
    const HingedBeamModel model = model_of(p.abutment, p.normal);
    const HingedBeamState peak = hinged_beam_peak(model);
    EXPECT_NEAR(peak.weight / 1e3, p.weight, kilonewtons);
    EXPECT_NEAR(peak.rotation, p.rotation, radians);
    const double rotations[] = {0.06, 0.10, 0.16, 0.20};
    for (int i = 0; i < 4; ++i)
      EXPECT_NEAR(hinged_beam_equilibrium(model, rotations[i]).weight / 1e3, p.at[i], kilonewtons) << rotations[i];
  }
}

// Eqs E.1 and E.2: with level forces on tall walls clipping is the closed form, but for the weight's arm
TEST(HingedBeam, ClippingAgreesWithTheClosedForm) {
  for (const double rotation : {0.001, 0.02, 0.1, 0.2, 0.3}) {
    const HingedBeamLoad closed = hinged_beam_second_order(beam, rotation);
    const HingedBeamState s = hinged_beam_equilibrium(model_of(wall, HingeNormal::horizontal), rotation);
    const double corner = 0.5 * (beam.length * std::cos(rotation) + beam.depth * std::sin(rotation) - beam.length);
    EXPECT_NEAR(s.thrust, closed.thrust, 1e-8 * closed.thrust);
    EXPECT_NEAR(s.weight * (0.5 * beam.length + corner / 3), closed.weight * 0.5 * beam.length, 1e-8 * closed.thrust);
    EXPECT_NEAR(s.x, 0.5 * beam.length, 1e-9 * beam.length);
  }
}

TEST(HingedBeam, FirstOrderIsTheTangentAndHasNoPeak) {
  const double small = 1e-6;
  const HingedBeamLoad first = hinged_beam_first_order(beam, small), second = hinged_beam_second_order(beam, small);
  EXPECT_NEAR(second.weight / first.weight, 1, 1e-5);
  EXPECT_NEAR(second.thrust / first.thrust, 1, 1e-5);
  EXPECT_GT(hinged_beam_first_order(beam, 0.3).weight, 2 * hinged_beam_second_order_peak(beam).weight);
}

TEST(HingedBeam, CornersAreLevelAtGoodmansLimit) {
  const double limit = hinged_beam_geometric_limit(beam);
  EXPECT_NEAR(limit, 0.321751, 5.1e-7);
  EXPECT_NEAR(beam.depth * std::cos(limit) - beam.length * std::sin(limit), 0, 1e-15);
}

// forces and moments of the returned equilibrium, written out independently
TEST(HingedBeam, EquilibriumHolds) {
  for (const HingePoint point : {HingePoint::centroid, HingePoint::analytic_centre})
    for (const HingeAbutment& abutment : {wall, aligned}) {
      const HingedBeamModel model = model_of(abutment, HingeNormal::mean, point);
      const HingedBeamState s = hinged_beam_equilibrium(model, 0.12);
      const double c = std::cos(0.06), t = std::sin(0.06);
      EXPECT_NEAR(s.normal_force * c + s.shear_force * t, s.thrust, 1e-8 * s.thrust);
      EXPECT_NEAR(s.shear_force * c - s.normal_force * t, s.weight, 1e-8 * s.thrust);
    }
}

TEST(HingedBeam, ForcesScaleWithStiffnessAndSize) {
  HingedBeamModel model = model_of(aligned, HingeNormal::mean, HingePoint::analytic_centre);
  const double weight = hinged_beam_equilibrium(model, 0.1).weight;
  model.beam.stiffness *= 3;
  EXPECT_NEAR(hinged_beam_equilibrium(model, 0.1).weight, 3 * weight, 1e-7 * weight);
  model.beam.length *= 10;
  model.beam.depth *= 10;
  model.abutment.thickness *= 10;
  EXPECT_NEAR(hinged_beam_equilibrium(model, 0.1).weight, 30 * weight, 1e-6 * weight);
}

// a stiff joint rolls without slip; with tall walls the height does not matter
TEST(HingedBeam, ThePathEndsInTheEquilibriumAtItsHeight) {
  const HingedBeamModel tall = model_of(wall, HingeNormal::mean);
  const std::vector<HingedBeamState> path = hinged_beam_path(tall, 1e9, 0.15, 30);
  for (const HingedBeamState& s : path)
    EXPECT_NEAR(s.weight, hinged_beam_equilibrium(tall, s.rotation).weight, 1e-6 * s.weight);

  const HingedBeamModel ends = model_of(aligned, HingeNormal::mean);
  const double fine = hinged_beam_path(ends, 1e9, 0.15, 200).back().weight;
  EXPECT_NEAR(hinged_beam_path(ends, 1e9, 0.15, 400).back().weight, fine, 1e-4 * fine);
  // a soft joint lets the corner sink below the abutment's edge, and the beam supports less
  EXPECT_LT(hinged_beam_path(ends, 1e8, 0.15, 100).back().weight, fine);
}

TEST(HingedBeam, APathHasTheShearForceOfItsDisplacement) {
  const HingedBeamModel tall = model_of(wall, HingeNormal::horizontal);
  const double stiffness = 1e7, rotation = 0.1;
  const std::vector<HingedBeamState> path = hinged_beam_path(tall, stiffness, rotation, 400);
  // the block's material at the hinge has gone down by T/Ks in total: integrate it from the positions returned
  double moved = 0, x = 0.5 * beam.length, y = 0, turned = 0;
  for (const HingedBeamState& s : path) {
    const double corner = 0.5 * (beam.length * std::cos(s.rotation) + beam.depth * std::sin(s.rotation) - beam.length);
    const double arm = 0.5 * (s.x + x) + corner / 3;  // from the hinge, at depth corner/3 in the wall, to the centroid
    moved += (s.y - y) + (s.rotation - turned) * arm;
    x = s.x, y = s.y, turned = s.rotation;
  }
  EXPECT_NEAR(path.back().shear_force, -stiffness * moved, 2e-4 * path.back().shear_force);
}

TEST(HingedBeam, ASampledCurveHasThePeakOfItsParabola) {
  std::vector<HingedBeamLoad> curve;
  for (const double t : {0.0, 0.3, 0.4, 0.6, 1.0})
    curve.push_back({t, 5 - (t - 0.45) * (t - 0.45), 2 * t});
  const HingedBeamLoad peak = peak_of(curve);
  EXPECT_NEAR(peak.rotation, 0.45, 1e-12);
  EXPECT_NEAR(peak.weight, 5, 1e-12);
  EXPECT_NEAR(peak.thrust, 0.9, 1e-12);
  curve.resize(3);
  EXPECT_THROW(peak_of(curve), std::domain_error);
}

// ---- the analytic centre

struct Program {
  Planes a, b;
};

double minus_sum(const gsl_vector* at, void* data) {
  const auto& program = *static_cast<const Program*>(data);
  const double sum = sum_of_logarithms(program.a, program.b, {gsl_vector_get(at, 0), gsl_vector_get(at, 1)});
  return std::isfinite(sum) ? -sum : 1e300;
}

// by Nelder and Mead, which uses neither gradient nor Hessian
Point searched(const Program& program, Point start, double size) {
  gsl_multimin_function f{&minus_sum, 2, const_cast<Program*>(&program)};
  gsl_vector *x = gsl_vector_alloc(2), *steps = gsl_vector_alloc(2);
  gsl_vector_set(x, 0, start.x);
  gsl_vector_set(x, 1, start.y);
  gsl_vector_set_all(steps, size);
  gsl_multimin_fminimizer* search = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
  gsl_multimin_fminimizer_set(search, &f, x, steps);
  for (int i = 0; i < 2000 && gsl_multimin_fminimizer_size(search) > 1e-11; ++i)
    gsl_multimin_fminimizer_iterate(search);
  const Point found{gsl_vector_get(search->x, 0), gsl_vector_get(search->x, 1)};
  gsl_multimin_fminimizer_free(search);
  gsl_vector_free(steps);
  gsl_vector_free(x);
  return found;
}

Planes rectangle(Point low, Point high) {
  return {{{1, 0}, high.x}, {{-1, 0}, -low.x}, {{0, 1}, high.y}, {{0, -1}, -low.y}};
}

TEST(AnalyticCentre, OfATriangleIsItsCentroid) {
  const double s = std::sqrt(0.5);
  const Planes corner{{{-1, 0}, 0}, {{0, -1}, 0}}, cut{{{s, s}, 3 * s}};
  const Point centre = analytic_centre(corner, cut, {0.1, 0.1});
  EXPECT_NEAR(centre.x, 1, 1e-10);
  EXPECT_NEAR(centre.y, 1, 1e-10);
}

TEST(AnalyticCentre, OfTwoRectanglesHasItsClosedForm) {
  const Planes a = rectangle({0, 0}, {1, 1}), b = rectangle({0.5, 0}, {1.5, 1});
  // along x: slacks 1 - x, x, 1.5 - x, x - 0.5, symmetric about 0.75; along y two equal pairs
  const Point centre = analytic_centre(a, b, {0.6, 0.1});
  EXPECT_NEAR(centre.x, 0.75, 1e-12);
  EXPECT_NEAR(centre.y, 0.5, 1e-12);
}

TEST(AnalyticCentre, AgreesWithASearchWithoutDerivatives) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> turn(0.01, 0.3);
  for (int i = 0; i < 20; ++i) {
    const double t = turn(random), c = std::cos(t), s = std::sin(t);
    const Planes wall_faces = rectangle({-0.138, -0.03}, {0, 0.03});
    const Planes block{{{c, -s}, 0.136}, {{-c, s}, 0.0015}, {{s, c}, 0.02}, {{-s, -c}, 0.024}};
    const Polygon region = clipped(wall_faces, block);
    ASSERT_GE(region.size(), 3u);
    const Point start = centroid_of(region), centre = analytic_centre(wall_faces, block, start);
    const Point other = searched({wall_faces, block}, start, 1e-4);
    // the sum is flat at its maximum: a search by values alone sees half of the digits
    EXPECT_NEAR(centre.x, other.x, 1e-9);
    EXPECT_NEAR(centre.y, other.y, 1e-8);
    EXPECT_GE(sum_of_logarithms(wall_faces, block, centre), sum_of_logarithms(wall_faces, block, other) - 1e-13);
  }
}

TEST(AnalyticCentre, RefusesAStartOutside) {
  EXPECT_THROW(analytic_centre(rectangle({0, 0}, {1, 1}), {}, {2, 0}), std::domain_error);
}

}  // namespace
