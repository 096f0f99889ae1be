// Potential particles in motion: a ball that bounces, a damped impact, a square that rolls over its round corner.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/case_tools.hpp"
#include "reference/potential_particles/motion.hpp"
#include "reference/small/small.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::motion_test {
namespace {

using verification::CaseReport;
using verification::Kind;

// as the scenes state it
constexpr double gravity = 9.81, ball_radius = 0.5, ball_density = 2000, ball_stiffness = 1e8, gap = 0.05;
const double ball_mass = ball_density * 4 / 3 * std::numbers::pi * std::pow(ball_radius, 3);
constexpr double square_density = 2500, square_stiffness = 1e9, inner_half = 0.4;

double eigenfrequency() {
  return std::sqrt(ball_stiffness / ball_mass);
}

// From top to top: downward zeros of the velocity. In free flight the velocity is linear in time, so interpolation
// between rows is exact.
TEST(PotentialParticles, ABallBouncesWithThePeriodOfItsSpring) {
  CaseReport report("potential_particles", {"ball on a plate: period"});
  const SceneRun run = cases::run("scene.toml");
  const std::vector<double> time = column(run, "time_s"), velocity = column(run, "ball_velocity_z_m_per_s");
  std::vector<double> tops;
  for (std::size_t i = 1; i < time.size(); ++i)
    if (velocity[i - 1] > 0 && velocity[i] <= 0)
      tops.push_back(time[i - 1] + (time[i] - time[i - 1]) * velocity[i - 1] / (velocity[i - 1] - velocity[i]));
  ASSERT_GE(tops.size(), 3u);
  const double periods = static_cast<double>(tops.size()) - 1;
  const double half_step = 0.5 * eigenfrequency() * run.results.stages.front().time_step;
  report.record(
      {"ball on a plate: period",
       "s",
       Kind::exact,
       "Newton: 2 v/g + (2/w)(pi - atan(w v/g))",
       reference::ball_period({ball_mass, ball_stiffness, gravity}, gap),
       {0, 0.55 * half_step * half_step * (periods + 2) / 2},
       "a bounce changes the energy by at most 1.1 (omega dt/2)2 (case bounce), the time in flight by half of "
       "it; the mean of n periods after one bounce collects (n + 2)/2 of that"},
      (tops.back() - tops.front()) / periods, cost(run));
}

TEST(PotentialParticles, ADampedImpactHasTheRestitutionOfTheClosedForm) {
  CaseReport report("potential_particles");
  constexpr double damping_ratio = 0.2;
  const double expected = reference::bounce({ball_mass, ball_stiffness, damping_ratio, 1, 0}).restitution;
  for (const double fraction : {0.1, 0.0125}) {
    const SceneRun run = cases::run("impact.toml", {fmt::format("time.fraction={}", fraction)});
    const double step = run.results.stages.front().time_step;
    report.record({fmt::format("ball on a plate: restitution, {} of the stable step", fraction),
                   "1",
                   Kind::exact,
                   "Schwager & Poschel (2007): exp(-2 z acos(z)/sqrt(1 - z2))",
                   expected,
                   {0, 2 * damping_ratio * eigenfrequency() * step},
                   "the dashpot takes the velocity of half a step before and starts up to half a step early or late"},
                  column(run, "ball_velocity_z_m_per_s").back(), cost(run));
  }
}

// The time at which a column first reaches a value, between rows
double time_of(const std::vector<double>& time, const std::vector<double>& values, double reached) {
  const auto at = std::find_if(values.begin(), values.end(), [&](double v) { return v >= reached; });
  if (at == values.begin() || at == values.end()) throw std::runtime_error("the square does not roll that far");
  const auto i = at - values.begin();
  const double fraction = (reached - values[i - 1]) / (values[i] - values[i - 1]);
  return time[i - 1] + fraction * (time[i] - time[i - 1]);
}

TEST(PotentialParticles, ARoundedSquareRollsOverItsCorner) {
  CaseReport report("potential_particles");
  std::vector<std::vector<double>> path(3), theory(3);
  for (const double r : {0.01, 0.1, 0.3}) {
    const reference::RoundedSquare square = reference::rounded_square(inner_half + r, r);
    const double start = std::atan(1.0 / 7), mass = square_density * square.area;
    const reference::RollingCorner body{mass, square_density * square.inertia, square.arm, r, start, gravity};
    const double overlap = mass * gravity / square_stiffness;
    const double top = 1 - reference::centroid_height(body, start) + overlap;
    const SceneRun run = cases::run("rolling.toml", {fmt::format("blocks.square.corner_radius={}", r),
                                                     fmt::format("blocks.plate.box.max=[4, {}]", top - 0.1)});
    const std::vector<double> time = column(run, "time_s");
    std::vector<double> turned = column(run, "square_rotation_deg");
    for (double& t : turned)
      t = -t;
    for (const double lean : {10.0, 20.0, 30.0})
      report.record({fmt::format("rolling over a corner of {} m: time to lean by {:.0f} deg more", r, lean),
                     "s",
                     Kind::exact,
                     "conservation of energy, by quadrature: it rotates about its point of contact",
                     reference::rolling_time(body, start + lean * degree),
                     {0, overlap / (square.arm * start) + overlap / r},
                     "the corner deforms by its overlap, W/k, which moves the pivot against the first lean, and "
                     "shortens the arc on which it rolls"},
                    time_of(time, turned, lean), cost(run));
    for (std::size_t i = 0; i < time.size() && turned[i] < 36; i += 10) {
      path[0].push_back(r);
      path[1].push_back(time[i]);
      path[2].push_back(turned[i]);
    }
    for (double lean = 0; lean <= 36; lean += 0.5) {
      theory[0].push_back(r);
      theory[1].push_back(reference::rolling_time(body, start + lean * degree));
      theory[2].push_back(lean);
    }
  }
  write_csv("potential_particles", "rolling.csv", {"radius", "time_s", "turned_deg"}, path);
  write_csv("potential_particles", "rolling_theory.csv", {"radius", "time_s", "turned_deg"}, theory);
}

}  // namespace
}  // namespace voussoir::cases::motion_test
