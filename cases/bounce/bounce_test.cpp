// Bouncing cube: overlap, rebound and duration of an impact, its error against the step, energy without damping.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"

namespace voussoir::cases {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

// as the scenes state it
constexpr double gap = 0.05, gravity = 9.81, mass = 2000, stiffness = 1e8, damping_ratio = 0.2;
const double frequency = std::sqrt(stiffness / mass);
const double drop_speed = std::sqrt(2 * gravity * gap);

// first order: see README.md
const std::string first_order =
    "the dashpot takes the velocity of half a step before and starts up to half a step early or late";

// A run seen step by step. Row i: force and height when a step begins, the velocity of the middle of the step before.
struct Flight {
  std::vector<double> time, height, velocity, force;
  double step;
  std::size_t touch = 0, release = 0;  // first rows with and after contact

  explicit Flight(const SceneRun& run, double start)
      : time(column(run, "time_s")),
        height(column(run, "cube_displacement_z_m")),
        velocity(column(run, "cube_velocity_z_m_per_s")),
        force(column(run, "cube_contact_load_z_N")),
        step(run.results.stages.front().time_step) {
    for (double& h : height)
      h += start;
    while (touch + 1 < force.size() && force[touch] == 0)
      ++touch;
    release = touch;
    while (release + 1 < force.size() && force[release] > 0)
      ++release;
  }

  double overlap() const { return -*std::min_element(height.begin() + touch, height.begin() + release); }
  double speed() const { return velocity[release]; }
  double duration() const { return (release - touch) * step; }

  // largest heights between contacts, after the first
  std::vector<double> tops() const {
    std::vector<double> tops;
    for (std::size_t i = release; i + 1 < height.size(); ++i)
      if (height[i] > height[i - 1] && height[i] >= height[i + 1] && force[i] == 0) tops.push_back(height[i]);
    return tops;
  }
};

// Falls 50 mm and rebounds on the dashpot of Eq. 6.9.
TEST(Bounce, FirstImpact) {
  CaseReport report("bounce", {"largest overlap", "restitution", "duration of contact", "rebound height"});
  const SceneRun run = cases::run("scene.toml");
  const Flight flight(run, gap);
  const reference::BounceResult expected = reference::bounce({mass, stiffness, damping_ratio, drop_speed, gravity});
  const double fraction = 2 * damping_ratio * frequency * flight.step;
  const std::string source = "Schwager & Poschel (2007): spring and dashpot (Eq. 6.9) that cannot pull, with gravity";

  report.record({"largest overlap", "m", Kind::exact, source, expected.maximum_overlap, {0, fraction}, first_order},
                flight.overlap(), cost(run));
  report.record({"restitution", "1", Kind::exact, source, expected.restitution, {0, fraction}, first_order},
                flight.speed() / drop_speed, cost(run));
  report.record({"duration of contact",
                 "s",
                 Kind::exact,
                 source,
                 expected.duration,
                 {2.5 * flight.step, 0},
                 "counted in steps, one to either side; the late velocity shortens it by 0.3 of a step"},
                flight.duration(), cost(run));
  // the contact ends while the blocks still overlap
  const double speed = expected.restitution * drop_speed;
  const double top = speed * speed / (2 * gravity) - expected.end_overlap;
  report.record({"rebound height",
                 "m",
                 Kind::exact,
                 source + ", then an arc",
                 top,
                 {0, 2.5 * fraction},
                 "twice the fraction of the speed, on an arc that starts below the surface by a fifth of its height"},
                flight.tops().front(), cost(run));
}

// Bounce after bounce: arcs and impacts of the reference in turn.
TEST(Bounce, FourthImpact) {
  CaseReport report("bounce", {"time of the fourth impact"});
  const SceneRun run = cases::run("scene.toml");
  const Flight flight(run, gap);

  std::vector<double> number, time, height;
  double start = 0, low = gap, speed = 0, touch = 0;
  for (int arc = 1; arc <= 4; ++arc) {
    const double impact = std::sqrt(speed * speed + 2 * gravity * low), fall = (speed + impact) / gravity;
    for (int i = 0; i <= 40; ++i) {
      const double t = fall * i / 40;
      number.push_back(arc);
      time.push_back(1e3 * (start + t));
      height.push_back(1e3 * (low + speed * t - 0.5 * gravity * t * t));
    }
    touch = start + fall;
    const reference::BounceResult next = reference::bounce({mass, stiffness, damping_ratio, impact, gravity});
    start = touch + next.duration;
    low = -next.end_overlap;
    speed = next.restitution * impact;
  }
  write_csv("bounce", "arcs.csv", {"arc", "time_ms", "height_mm"}, {number, time, height});

  double fourth = 0;
  int touches = 0;
  std::vector<double> shown_time, shown_height;
  for (std::size_t i = 1; i < flight.force.size(); ++i) {
    if (flight.force[i] > 0 && flight.force[i - 1] == 0 && ++touches == 4) fourth = flight.time[i];
    if (i % 100 != 0) continue;
    shown_time.push_back(1e3 * flight.time[i]);
    shown_height.push_back(1e3 * flight.height[i]);
  }
  write_csv("bounce", "height.csv", {"time_ms", "height_mm"}, {shown_time, shown_height});
  const double fraction = 2 * damping_ratio * frequency * flight.step;
  report.record({"time of the fourth impact",
                 "s",
                 Kind::exact,
                 "Schwager & Poschel (2007): arcs and impacts in turn",
                 touch,
                 {3 * fraction * touch, 0},
                 "each of three impacts adds its fraction of the speed, that is of the time in flight"},
                fourth, cost(run));
}

// The smaller the step, the closer: first order.
TEST(Bounce, ErrorAgainstStep) {
  CaseReport report("bounce", {"order of the error in the step", "restitution, extrapolated to no step"});
  const double expected = reference::bounce({mass, stiffness, damping_ratio, 1, 0}).restitution;
  report.reference("cube_velocity_z", expected, "m/s");  // it strikes at 1 m/s
  std::vector<double> steps, errors, bounds, found;
  for (const double fraction : {0.2, 0.1, 0.05, 0.025, 0.0125, 0.00625}) {
    const SceneRun run = cases::run("impact.toml", {fmt::format("time.fraction={}", fraction)});
    const Flight flight(run, 0);
    found.push_back(flight.speed());
    steps.push_back(flight.step * frequency);
    errors.push_back(std::abs(found.back() / expected - 1));
    bounds.push_back(2 * damping_ratio * steps.back());
    report.record({fmt::format("restitution without gravity, {} of the stable step", fraction),
                   "1",
                   Kind::exact,
                   "Schwager & Poschel (2007): exp(-2 z acos(z)/sqrt(1 - z2))",
                   expected,
                   {0, bounds.back()},
                   first_order},
                  found.back(), cost(run));
  }
  write_csv("bounce", "steps.csv", {"omega_dt", "error", "bound"}, {steps, errors, bounds});

  const std::size_t last = errors.size() - 1;
  report.record({"order of the error in the step",
                 "1",
                 Kind::limit,
                 "convergence: leapfrog with a late dashpot",
                 1,
                 {0.1, 0},
                 "the fraction of second order is as large as omega dt, below 0.02 for the two smallest steps; the "
                 "last force before release adds as much"},
                std::log2(errors[last - 1] / errors[last]));
  report.record({"restitution, extrapolated to no step",
                 "1",
                 Kind::limit,
                 "Schwager & Poschel (2007): exp(-2 z acos(z)/sqrt(1 - z2))",
                 expected,
                 {0, damping_ratio * steps[last - 1] * steps[last - 1]},
                 "remaining second order of the two smallest steps: z (omega dt)2"},
                2 * found[last] - found[last - 1]);
}

// Without damping the cube returns to its initial height, again and again.
TEST(Bounce, UndampedKeepsItsEnergy) {
  CaseReport report("bounce",
                    {"undamped: energy error of one bounce, largest", "undamped: energy error, largest in 20 s"});
  const SceneRun run =
      cases::run("scene.toml", {"damping.viscous_ratio=0", "time.fraction=0.05", "stage.bounce.duration_s=20"});
  const Flight flight(run, gap);
  const double half = 0.5 * frequency * flight.step, fraction = half * half;
  const std::vector<double> tops = flight.tops();
  double last = gap, one = 0, all = 0;
  for (const double top : tops) {
    one = std::max(one, std::abs(top - last) / gap);
    all = std::max(all, std::abs(top - gap) / gap);
    last = top;
  }
  const double count = static_cast<double>(tops.size());
  report.record(
      {"undamped: energy error of one bounce, largest",
       "1",
       Kind::limit,
       "conservation of energy",
       0,
       {1.1 * fraction, 0, Bound::at_most},
       "a contact that begins between two steps gains up to (omega dt/2)2 of the energy, one that ends between two "
       "loses as much; a tenth allows for gravity and for the distance of the highest row from the top"},
      one, cost(run));
  report.record({"undamped: energy error, largest in 20 s",
                 "1",
                 Kind::limit,
                 "conservation of energy",
                 0,
                 {3 * 0.42 * std::sqrt(count) * fraction, 0, Bound::at_most},
                 "three deviations of a random walk: 0.42 (omega dt/2)2 per bounce if every position in a step is "
                 "equally likely"},
                all, cost(run));
  report.report("undamped bounces in 20 s", "1", count, "0.05 of the stable step");
}

// By implicit steps of so many times 2/ω. Above one the step remains and the joint becomes stiffer.
struct ImplicitBounce {
  double stiffness, step;
  SceneRun run;
};
ImplicitBounce by_implicit_steps(double limits, double viscous_ratio) {
  const double k = stiffness * std::pow(std::max(limits, 1.0), 2), step = std::min(limits, 1.0) * 2 / frequency;
  return {k, step,
          cases::run("scene.toml", {"stage.bounce.time.integration=implicit", "stage.bounce.time.step_s=" + text(step),
                                    "damping.viscous_ratio=" + text(viscous_ratio),
                                    "joint_properties.rock.normal_stiffness=" + text(k)})};
}

// over the energy of the fall: what a run has more at any step than at its start, and what the first impact leaves
struct EnergyOfBounce {
  double gained = 0, left = 0;
};
EnergyOfBounce energy_of(const ImplicitBounce& bounce) {
  constexpr double after_first = 0.2;  // s: the impacts are at 0.1 and 0.3 s if nothing is lost
  const std::vector<double> time = column(bounce.run, "time_s"), moved = column(bounce.run, "cube_displacement_z_m"),
                            speed = column(bounce.run, "cube_velocity_z_m_per_s");
  const double fall = mass * gravity * gap;
  EnergyOfBounce found;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const double height = gap + moved[i], overlap = std::max(-height, 0.0);
    const double energy =
        0.5 * mass * speed[i] * speed[i] + mass * gravity * height + 0.5 * bounce.stiffness * overlap * overlap;
    found.gained = std::max(found.gained, energy / fall - 1);
    if (time[i] <= after_first) found.left = energy / fall;
  }
  return found;
}

// The same by implicit steps: the bounce of the joint where they resolve it, and no energy at any step.
TEST(Bounce, ByImplicitSteps) {
  CaseReport report("bounce", {"largest overlap, implicit steps", "rebound height, implicit steps"});
  constexpr double limits = 0.01;
  const SceneRun run = by_implicit_steps(limits, damping_ratio).run;
  const std::vector<double> moved = column(run, "cube_displacement_z_m");
  const auto lowest = std::min_element(moved.begin(), moved.begin() + moved.size() / 4);
  const auto surface = std::find_if(lowest, moved.end(), [](double d) { return d > -gap; });
  const auto back = std::find_if(surface, moved.end(), [](double d) { return d < -gap; });
  const reference::BounceResult expected = reference::bounce({mass, stiffness, damping_ratio, drop_speed, gravity});
  const double speed = expected.restitution * drop_speed, fraction = 4 * limits * limits;
  const std::string source = "Schwager & Poschel (2007): spring and dashpot (Eq. 6.9) that cannot pull, with gravity";
  const std::string second_order =
      "a step of second order errs by (omega dt)2 at most in speed, where force begins and ends, too";
  report.record({"largest overlap, implicit steps",
                 "m",
                 Kind::exact,
                 source,
                 expected.maximum_overlap,
                 {0, fraction},
                 second_order},
                -gap - *lowest, cost(run));
  report.record({"rebound height, implicit steps",
                 "m",
                 Kind::exact,
                 source + ", then an arc",
                 speed * speed / (2 * gravity) - expected.end_overlap,
                 {0, 2.5 * fraction},
                 second_order + "; twice that on an arc that starts below the surface"},
                gap + *std::max_element(surface, back), cost(run));
  std::vector<double> steps, left, gained;
  for (const double of_limit : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e3, 1e4}) {
    const ImplicitBounce undamped = by_implicit_steps(of_limit, 0);
    const EnergyOfBounce energy = energy_of(undamped);
    steps.push_back(of_limit);
    left.push_back(energy.left);
    gained.push_back(energy.gained);
    if (of_limit != 0.1 && of_limit != 10 && of_limit != 1e4) continue;
    report.record(
        {fmt::format("undamped: energy gained by implicit steps of {} of the limit", of_limit),
         "1",
         Kind::limit,
         "conservation of energy",
         0,
         {1e-12, 0, Bound::at_most},
         "the work of a step is the change of the springs' energy and its loss: rounding of some hundred steps"},
        energy.gained, cost(undamped.run));
  }
  write_csv("bounce", "implicit.csv", {"limits", "left", "gained"}, {steps, left, gained});
}

}  // namespace
}  // namespace voussoir::cases
