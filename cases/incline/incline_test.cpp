// Block on an incline: the angle at which it begins to slide, its motion, its equilibrium above; in space and in the
// plane.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// as scene.toml and plane.toml state it: the joint cuts the middle of a cube or square with sides of 2 m
constexpr double dip = 30, sliding_friction = 20;
constexpr double gravity = 9.81, density = 2000, shear_stiffness = 1e8;
constexpr int settle = 1, critical = 2, slide = 3;

struct Variant {
  std::string scene, name, test;
  int dimension;
  double volume, area;  // m3, m2; per metre in the plane
};

void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

const double across = 2 / std::cos(dip * degree);
const Variant space{"scene.toml", "3-D", "Space", 3, 4, 2 * across};
const Variant plane{"plane.toml", "2-D", "Plane", 2, 2, across};

reference::Incline incline(double friction_deg) {
  return {dip * degree, friction_deg * degree, gravity, 0};
}

// times and distances of one stage, from the end of the stage before (from the start of the scene for the first)
struct Path {
  std::vector<double> time, distance;
};

Path path(const SceneRun& run, int stage, int dimension) {
  Path path;
  const std::vector<double> time = column(run, "time_s", stage);
  path.time.assign(time.size(), 0);
  path.distance.assign(time.size(), 0);
  const double start = stage == 1 ? 0 : column(run, "time_s", stage - 1).back();
  for (const char* axis : {"x", "y", "z"}) {
    if (axis[0] - 'x' == dimension) break;
    const std::string name = std::string("block_displacement_") + axis + "_m";
    const std::vector<double> here = column(run, name, stage);
    const double before = stage == 1 ? 0 : column(run, name, stage - 1).back();
    for (std::size_t i = 0; i < here.size(); ++i)
      path.distance[i] = std::hypot(path.distance[i], here[i] - before);
  }
  for (std::size_t i = 0; i < time.size(); ++i)
    path.time[i] = time[i] - start;
  return path;
}

class InclineIn : public testing::TestWithParam<Variant> {};

// Bisection finds the dip; below it the block slides with constant acceleration.
TEST_P(InclineIn, SlidesAtTheDipByNewtonsLaw) {
  const Variant& v = GetParam();
  CaseReport report("incline", {"critical friction, " + v.name, "distance after 0.5 s, " + v.name});
  const SceneRun run = cases::run(v.scene);
  const double expected = reference::incline_critical_friction(incline(0)) / degree;
  if (v.dimension == 3) report.reference("critical_friction", expected, "deg");
  report.record(
      {"critical friction, " + v.name,
       "deg",
       Kind::exact,
       "Coulomb (1785): the dip",
       expected,
       {0.005, 0},
       "half the bracket of 0.01; the unbalanced force in equilibrium, 1e-6 of the contact force, is worth 0.00005"},
      value(run, "critical_friction"), cost(run));

  const Path sliding = path(run, slide, v.dimension);
  const double step = run.results.stages[slide - 1].time_step, end = sliding.time.back();
  std::vector<double> closed_form;
  for (const double t : sliding.time)
    closed_form.push_back(reference::incline_distance(incline(sliding_friction), t));
  report.record({"distance after 0.5 s, " + v.name,
                 "m",
                 Kind::exact,
                 "Newton: g (sin - cos tan) t2/2",
                 closed_form.back(),
                 {0, 2 * step / end},
                 "velocities are half a step behind: half a step at the start would be dt/t in the distance; as much "
                 "again for the overlap, which grows as the joint's area shrinks"},
                sliding.distance.back(), cost(run));
  write_csv("incline", v.dimension == 3 ? "slide.csv" : "slide_plane.csv", {"time_s", "distance_m", "closed_form_m"},
            {sliding.time, sliding.distance, closed_form});
}

// The same slide by implicit steps, before which the joint carried more than friction now allows: it slips at once.
TEST_P(InclineIn, SlidesByImplicitSteps) {
  const Variant& v = GetParam();
  CaseReport report("incline");
  const SceneRun run = cases::run(v.scene, {"stage.slide.time.integration=implicit"});
  const Path sliding = path(run, slide, v.dimension);
  const double expected = reference::incline_distance(incline(sliding_friction), sliding.time.back());
  const double length = 2 / std::cos(dip * degree), row = 0.005, speed = 2 * expected / sliding.time.back();
  const double friction = std::cos(dip * degree) * std::tan(sliding_friction * degree),
               of_net = friction / (std::sin(dip * degree) - friction);
  report.record(
      {"distance after 0.5 s by implicit steps, " + v.name,
       "m",
       Kind::exact,
       "Newton: g (sin - cos tan) t2/2",
       expected,
       {0, of_net * speed * row / length},
       "friction of a step is that of its mean overlap; of the joint's length a step of 5 ms loses 0.2 %, and friction "
       "is 1.7 times the force that accelerates"},
      sliding.distance.back(), cost(run));
}

// Applied slowly at a high friction angle, the weight only compresses and shears the joint.
TEST_P(InclineIn, SettlesElastically) {
  const Variant& v = GetParam();
  CaseReport report("incline");
  const SceneRun run = cases::run(v.scene);
  const double weight = density * v.volume * gravity, angle = dip * degree;
  const double expected = weight / (shear_stiffness * v.area) * std::hypot(std::sin(angle), 0.1 * std::cos(angle));
  report.record({"settlement, " + v.name,
                 "m",
                 Kind::exact,
                 "equilibrium: two springs: W sin/(ks A) along, W cos/(kn A) across",
                 expected,
                 {0, 6e-5},
                 "sheared by 85 micrometres the joint loses up to 5e-5 of its area; equilibrium leaves 1e-6"},
                path(run, settle, v.dimension).distance.back(), cost(run));
}

// One degree above the dip the block does not move, damped or not.
TEST_P(InclineIn, IsInEquilibriumAboveTheDip) {
  const Variant& v = GetParam();
  CaseReport report("incline");
  const SceneRun run = cases::run(v.scene, {"stage.slide.friction_deg=31"});
  const double elastic = path(run, settle, v.dimension).distance.back();
  double farthest = 0;
  const Path resting = path(run, slide, v.dimension);
  for (const double d : resting.distance)
    farthest = std::max(farthest, d);
  report.record({"distance in 0.5 s at 31 deg, " + v.name,
                 "m",
                 Kind::limit,
                 "Coulomb (1785): equilibrium",
                 0,
                 {1e-5 * elastic, 0, Bound::at_most},
                 "effect of the unbalanced force, 1e-6 of the contact force: oscillation by twice that fraction of the "
                 "elastic displacement in each of three directions"},
                farthest, cost(run));
  write_csv("incline", v.dimension == 3 ? "rest.csv" : "rest_plane.csv", {"time_s", "distance_m"},
            {resting.time, resting.distance});
}

// slope of log y over log x by least squares
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  const double count = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / count;
    mean_y += std::log(y[i]) / count;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (std::log(x[i]) - mean_x) * (std::log(x[i]) - mean_x);
    xy += (std::log(x[i]) - mean_x) * (std::log(y[i]) - mean_y);
  }
  return xy / xx;
}

// Friction lowered at a constant rate finds an angle that is too low, by the power 2/3 of the rate.
TEST(Incline, TheBiasOfARateIsTheOnePredicted) {
  CaseReport report("incline", {"slope of the bias over the rate", "bias at 0.1 deg/s", "bias at 3 deg/s"});
  constexpr double failure_displacement = 0.01, local_damping = 0.7;
  const std::vector<double> rates{3, 1, 0.3, 0.1};
  std::vector<double> found, predicted;
  for (const double rate : rates) {
    const SceneRun run = cases::run("rate.toml", {"stage.critical.rate_deg_per_s=" + fmt::format("{}", rate)});
    const double bias = reference::incline_rate_bias(incline(0), failure_displacement, rate * degree, local_damping);
    predicted.push_back(bias / degree);
    found.push_back(dip - value(run, "critical_friction"));
    report.record({fmt::format("bias at {} deg/s", rate),
                   "deg",
                   Kind::exact,
                   "closed form: (6 X cos r2/((1-a) g))^(1/3), friction falling linearly",
                   predicted.back(),
                   {0, 0.01 + bias * std::tan(dip * degree) / 6},
                   "the next term is tan(dip) bias/6; the joint deforms by 1e-5 of the 0.01 m before it slips, and a "
                   "step moves the angle by less than 0.001 deg: the remainder is a margin"},
                  found.back(), cost(run));
  }
  report.record({"slope of the bias over the rate",
                 "1",
                 Kind::exact,
                 "closed form: the power of the rate in the formula",
                 2.0 / 3,
                 {0.05, 0},
                 "as demanded; the next term alone would give 0.002"},
                slope_of(rates, found));
  write_csv("incline", "rates.csv", {"rate_deg_per_s", "bias_deg", "formula_deg"}, {rates, found, predicted});
}

// Two rates, extrapolated, need no formula.
TEST(Incline, TwoRatesFindTheDip) {
  CaseReport report("incline", {"critical friction, two rates", "its error as a fraction of its error bar"});
  const SceneRun run = cases::run("two_rates.toml");
  const Value found = *run.results.find("critical_friction");
  report.record({"critical friction, two rates",
                 "deg",
                 Kind::exact,
                 "Coulomb (1785): the dip",
                 dip,
                 {0.01, 0},
                 "1 % of the bias of the slower rate, 0.4, and the step in time; the next term of the bias is less"},
                found.value, cost(run));
  report.record({"its error as a fraction of its error bar",
                 "1",
                 Kind::limit,
                 "promise: definition of an error bar",
                 1,
                 {0, 0, Bound::at_most},
                 "no margin: the bar is the claim"},
                std::abs(found.value - dip) / *found.error_bar);
}

INSTANTIATE_TEST_SUITE_P(Both, InclineIn, testing::Values(space, plane),
                         [](const auto& chosen) { return chosen.param.test; });

}  // namespace
}  // namespace voussoir::cases
