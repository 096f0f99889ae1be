// Free rotation of a box near its middle axis: against Jacobi's elliptic functions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using verification::CaseReport;
using verification::Kind;

// as scene.toml states it
const reference::FreeRotation box{reference::box_inertia(2000 * 3 * 2 * 1, {3, 2, 1}), {0.1, 2, 0.1}};
constexpr double duration = 45, steepest = 2;  // s, rad/s2: largest angular acceleration of this motion

struct Tumble {
  std::vector<double> time;
  std::vector<Eigen::Vector3d> spin;                                   // rad/s, axes of the box
  double largest_error = 0, largest_momentum = 0, largest_energy = 0;  // rad/s; relative; relative
};

// the monitors give world axes; the rotation vector transforms them to the axes of the box
Tumble tumble(const SceneRun& run) {
  const auto vectors = [&](const std::string& name, const std::string& unit) {
    std::vector<Eigen::Vector3d> list;
    const auto x = column(run, name + "_x_" + unit), y = column(run, name + "_y_" + unit),
               z = column(run, name + "_z_" + unit);
    for (std::size_t i = 0; i < x.size(); ++i)
      list.emplace_back(x[i], y[i], z[i]);
    return list;
  };
  const auto spins = vectors("box_angular_velocity", "rad_per_s"), turns = vectors("box_rotation", "deg");
  const Eigen::Vector3d inertia(box.inertia.data()), start(box.angular_velocity.data());
  const Eigen::Vector3d momentum = inertia.cwiseProduct(start);
  Tumble t;
  t.time = column(run, "time_s");
  for (std::size_t i = 0; i < spins.size(); ++i) {
    const double angle = degree * turns[i].norm();
    const Eigen::Matrix3d axes =
        Eigen::AngleAxisd(angle, angle > 0 ? Eigen::Vector3d(turns[i].normalized()) : Eigen::Vector3d::UnitX())
            .toRotationMatrix();
    t.spin.push_back(axes.transpose() * spins[i]);
    const std::array<double, 3> exact = reference::free_rotation(box, t.time[i]);
    t.largest_error = std::max(t.largest_error, (t.spin.back() - Eigen::Vector3d(exact.data())).norm());
    const Eigen::Vector3d now = axes * inertia.cwiseProduct(t.spin.back());
    t.largest_momentum = std::max(t.largest_momentum, (now - momentum).norm() / momentum.norm());
    const double energy = t.spin.back().dot(inertia.cwiseProduct(t.spin.back())), energy_at_start = start.dot(momentum);
    t.largest_energy = std::max(t.largest_energy, std::abs(energy - energy_at_start) / energy_at_start);
  }
  return t;
}

// time between the first and the last downward zero of the middle spin, over their number
double period_of(const Tumble& t) {
  std::vector<double> zeros;
  for (std::size_t i = 1; i < t.time.size(); ++i) {
    const double before = t.spin[i - 1][1], here = t.spin[i][1];
    if (before > 0 && here <= 0)
      zeros.push_back(t.time[i - 1] + (t.time[i] - t.time[i - 1]) * before / (before - here));
  }
  return (zeros.back() - zeros.front()) / static_cast<double>(zeros.size() - 1);
}

TEST(FreeRotation, FollowsEuler) {
  CaseReport report("free_rotation", {"angular velocity, largest error", "angular momentum, largest change", "period",
                                      "order of the error in the step"});
  const SceneRun run = cases::run("scene.toml");
  const Tumble found = tumble(run);
  const double period = reference::free_rotation_period(box);
  const double turn = 2 * run.results.stages.front().time_step;  // rad in a step
  const double fraction = turn * turn / 12;

  // for the study
  report.reference("box_angular_velocity_x", reference::free_rotation_in_space(box, duration)[0], "rad/s");
  report.record({"angular velocity, largest error",
                 "rad/s",
                 Kind::exact,
                 "Euler (1758), Jacobi's elliptic functions",
                 0,
                 {fraction * duration * steepest, 0},
                 "a step of second order rotates at a rate wrong by (omega dt)2/12; over 45 s that shifts a curve "
                 "whose slope is 2 rad/s2 at most"},
                found.largest_error, cost(run));
  report.record({"angular momentum, largest change",
                 "1",
                 Kind::exact,
                 "identity: no moment acts",
                 0,
                 {1e-12, 0},
                 "4000 steps of 5 rotations, each rounded to 1e-16: a random walk of 2e-14, at worst 4e-12"},
                found.largest_momentum, cost(run));
  report.record({"period",
                 "s",
                 Kind::exact,
                 "Euler (1758): 4 K/lambda",
                 period,
                 {0, 2 * fraction},
                 "the rate is wrong by (omega dt)2/12; as much again for zeros between rows"},
                period_of(found), cost(run));

  // half the step: a quarter of the error
  const SceneRun fine = cases::run("scene.toml", {"time.step_s=0.0025"});
  const Tumble half = tumble(fine);
  report.record({"order of the error in the step",
                 "1",
                 Kind::limit,
                 "convergence: symmetric splitting, second order",
                 2,
                 {0.05, 0},
                 "the next term is of fourth order"},
                std::log2(found.largest_error / half.largest_error), cost(fine));

  std::vector<std::vector<double>> columns(7);
  columns[0] = found.time;
  for (std::size_t i = 0; i < found.time.size(); ++i) {
    const std::array<double, 3> exact = reference::free_rotation(box, found.time[i]);
    for (int k = 0; k < 3; ++k) {
      columns[1 + k].push_back(found.spin[i][k]);
      columns[4 + k].push_back(exact[k]);
    }
  }
  write_csv("free_rotation", "spin.csv",
            {"time_s", "x_rad_per_s", "y_rad_per_s", "z_rad_per_s", "exact_x", "exact_y", "exact_z"}, columns);
}

// the numbers that the problem files ask: at the end, and the largest changes
TEST(FreeRotation, EndsAsEulerSays) {
  const char* const axes[] = {"long", "middle", "short"};
  const auto name_of = [&](int k) { return std::string("angular velocity along the ") + axes[k] + " axis, 45 s"; };
  CaseReport report("free_rotation", {name_of(0), name_of(1), name_of(2), "kinetic energy, largest change"});
  const SceneRun run = cases::run("scene.toml");
  const Tumble found = tumble(run);
  const double turn = 2 * run.results.stages.front().time_step;  // rad in a step
  const double fraction = turn * turn / 12;
  const std::array<double, 3> exact = reference::free_rotation(box, duration);
  for (int k = 0; k < 3; ++k)
    report.record({name_of(k),
                   "rad/s",
                   Kind::exact,
                   "Euler (1758), Jacobi's elliptic functions",
                   exact[k],
                   {fraction * duration * steepest, 0},
                   "as the largest error: a rate wrong by (omega dt)2/12 over 45 s"},
                  found.spin.back()[k], cost(run));
  report.record({"kinetic energy, largest change",
                 "1",
                 Kind::exact,
                 "identity: no moment acts",
                 0,
                 {fraction, 0},
                 "a symmetric step of second order keeps an energy that is (omega dt)2/12 off and does not drift"},
                found.largest_energy, cost(run));
}

// Midpoint rule with Cayley's rotation: Euler's equations in the axes of the box, whose rate is wrong by as much.
TEST(FreeRotation, ByImplicitSteps) {
  CaseReport report(
      "free_rotation",
      {"angular velocity, largest error, implicit steps", "angular momentum, largest change, implicit steps",
       "kinetic energy, largest change, implicit steps", "order of the error in the step, implicit steps"});
  const auto by_steps = [](double step) {
    return cases::run("scene.toml", {"time.integration=implicit", "time.step_s=" + text(step)});
  };
  constexpr double step = 0.005;
  const SceneRun run = by_steps(step);
  const Tumble found = tumble(run), half = tumble(by_steps(0.5 * step));
  const double turn = 2 * step;  // rad in a step
  report.record({"angular velocity, largest error, implicit steps",
                 "rad/s",
                 Kind::exact,
                 "Euler (1758), Jacobi's elliptic functions",
                 0,
                 {turn * turn / 12 * duration * steepest, 0},
                 "the midpoint rule rotates at a rate wrong by (omega dt)2/12; over 45 s that shifts a curve whose "
                 "slope is 2 rad/s2 at most"},
                found.largest_error, cost(run));
  const auto constant = [&](const std::string& of, double change) {
    report.record({of + ", largest change, implicit steps",
                   "1",
                   Kind::exact,
                   "identity: no moment acts",
                   0,
                   {1e-12, 0},
                   "9000 steps, each solved and rounded to 1e-16: at worst 1e-12"},
                  change, cost(run));
  };
  constant("angular momentum", found.largest_momentum);
  constant("kinetic energy", found.largest_energy);
  report.record({"order of the error in the step, implicit steps",
                 "1",
                 Kind::limit,
                 "convergence: midpoint rule, second order",
                 2,
                 {0.05, 0},
                 "the next term is of fourth order"},
                std::log2(found.largest_error / half.largest_error));

  std::vector<double> turns, implicit_errors, explicit_errors;
  for (const double h : {0.04, 0.02, 0.01, step, 0.5 * step}) {
    turns.push_back(2 * h);
    implicit_errors.push_back(h == step         ? found.largest_error
                              : h == 0.5 * step ? half.largest_error
                                                : tumble(by_steps(h)).largest_error);
    explicit_errors.push_back(tumble(cases::run("scene.toml", {"time.step_s=" + text(h)})).largest_error);
  }
  write_csv("free_rotation", "steps.csv", {"omega_dt", "implicit", "explicit"},
            {turns, implicit_errors, explicit_errors});
}

}  // namespace
}  // namespace voussoir::cases
