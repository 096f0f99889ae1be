// What implicit steps keep, for tests: energy along a run, its balance, and the work of Newton's method.
#pragma once

#include <algorithm>
#include <utility>

#include "core/implicit/mean_motion.hpp"
#include "core/step.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir {

// J: kinetic, of the springs, and of the weights against the positions of reference
template <int Dim>
double mechanical(const Prepared<Dim>& scene, const State<Dim>& state) {
  State<Dim> there = state;
  Settings settings = scene.settings;
  settings.time.integration = Integration::implicit_steps;
  there.time_step.length = 0;
  find_forces(scene.model, settings, there);
  double sum = there.ledger.energy.elastic;
  for (std::size_t b = 0; b < scene.model.bodies.size(); ++b) {
    const Body<Dim>& body = scene.model.bodies[b];
    if (body.fixed) continue;
    const Motion<Dim>& m = state.bodies.motions[b];
    sum += kinetic_energy(body, m) - body.mass * scene.model.gravity.dot(m.displacement);
  }
  return sum;
}

struct EnergyPath {
  double start = 0, most = 0, end = 0;  // J
  double growth = 0;                    // J: the most of a step
};

template <int Dim>
struct Followed {
  Progress<Dim> end;
  EnergyPath energy;
};

template <int Dim>
Followed<Dim> followed(const Prepared<Dim>& scene) {
  EnergyPath path;
  bool begun = false;
  Watcher<Dim> watcher;
  const auto look = [&](const State<Dim>& state) {
    const double now = mechanical(scene, state);
    if (!begun) path.start = path.most = now;
    if (begun) path.growth = std::max(path.growth, now - path.end);
    begun = true;
    path.end = now;
    path.most = std::max(path.most, now);
  };
  watcher.pause = [&](const Progress<Dim>& now) {
    look(now.state);
    return false;
  };
  Progress<Dim> progress = simulated(scene, watcher);
  look(progress.state);
  return {std::move(progress), path};
}

// Of every test: what implicit steps always keep, with at most seven iterations a system on the mean. Joints of 1e12
// Pa/m and more feel the rounding of their overlaps.
template <int Dim>
void expect_sound(const Progress<Dim>& end, double stiffness = 1e12) {
  EXPECT_EQ(end.results.outcome, Outcome::done) << end.results.message;
  EXPECT_EQ(end.state.counters.implicit_halved, 0);
  EXPECT_LT(end.state.ledger.energy.relative_error(), 1e-12 * std::max(1.0, 10 * stiffness / 1e12));
  EXPECT_GE(end.state.ledger.energy.flows[Source::unresolved_springs], 0);
  EXPECT_GE(end.state.ledger.energy.flows[Source::unresolved_motion], 0);
  const Counters& cost = end.state.counters;
  EXPECT_LE(cost.implicit_iterations, 7 * cost.implicit_solutions);
}

}  // namespace voussoir
