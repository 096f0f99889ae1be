// The measurements of a free fall (fall_scene.hpp), by the case and by the benchmark of twenty thousand blocks.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "core/run/simulate.hpp"

namespace voussoir::shapes {

// J
inline double kinetic_energy(const Model<3>& model, const State<3>& state) {
  double sum = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    const Motion<3>& m = state.bodies.motions[b];
    sum += 0.5 * model.bodies[b].mass * m.velocity.squaredNorm();
    sum += 0.5 * m.angular_momentum.cwiseAbs2().cwiseQuotient(model.bodies[b].inertia).sum();
  }
  return sum;
}

// as a fraction of the energy released by the fall
inline double kinetic_fraction(const Model<3>& model, const State<3>& state) {
  return kinetic_energy(model, state) / -state.ledger.energy.potential();
}

// the largest penetration of any block's corner into the plate or beyond a wall's face, m
inline double deepest_corner(const Model<3>& model, const State<3>& state, double width) {
  double deepest = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<3>& body = model.bodies[b];
    if (body.fixed) continue;
    const Vector<3> centroid = model.origin + body.reference + state.bodies.motions[b].displacement;
    const Matrix<3> axes = matrix(state.bodies.motions[b].rotation);
    for (const Polytope<3>& part : body.parts)
      for (const Vector<3>& v : part.vertices) {
        const Vector<3> x = centroid + axes * v;
        deepest = std::max({deepest, -x[0], x[0] - width, -x[1], x[1] - width, -x[2]});
      }
  }
  return deepest;
}

// radius of the bluntest block's potential particle, m
inline double largest_potential_radius(const Model<3>& model, double fraction) {
  double bluntest = 0;
  for (const Body<3>& body : model.bodies)
    if (!body.fixed) bluntest = std::max(bluntest, body.size);
  return fraction * bluntest;
}

// energy unaccounted for in the balances, as fractions of the energy released by the fall
struct EnergyErrors {
  double motion, contacts;
};
inline EnergyErrors energy_errors(const State<3>& state) {
  const double work = -state.ledger.energy.potential();
  return {std::abs(state.ledger.energy.motion_error) / work, std::abs(state.ledger.energy.contact_error) / work};
}

// requirements of a fall
inline constexpr double at_rest = 1e-6;  // kinetic energy in equilibrium, as a fraction of that of the drop
inline constexpr double energy_balanced =
    1e-3;  // the contacts' energy balance, and that of the motion, which have only rounding
inline constexpr double motion_closed = 1e-10;

struct FallFindings {
  EnergyErrors before{INFINITY, INFINITY}, end{};  // before the damping starts; at the end
  double kinetic = 0;                              // fraction, at the end
  double deepest = 0;                              // m, over all frames
  Counters counters;
  double time = 0, seconds = 0;  // simulated; wall clock
};

// Falls until almost all motion has ended, disregarding single blocks, or until the scene ends. `frame` is called at
// the begin, at the times of the scene's output, and at the end.
inline FallFindings fall_until_rest(const Prepared<3>& scene, double width,
                                    const std::function<void(const State<3>&)>& frame = {},
                                    const std::function<void(const ProgressReport&)>& report = {}) {
  constexpr int steps_between_looks = 100;
  FallFindings found;
  Watcher<3> watcher;
  watcher.progress = report;
  const auto look = [&](const State<3>& state) {
    found.deepest = std::max(found.deepest, deepest_corner(scene.model, state, width));
    if (frame) frame(state);
  };
  look(scene.state);
  watcher.frame = [&](const Model<3>&, const State<3>& state, double) { look(state); };
  long long next_look = 0;
  watcher.pause = [&](const Progress<3>& now) {
    if (now.stage == 0) return false;
    if (!std::isfinite(found.before.contacts)) found.before = energy_errors(now.state);
    if (now.state.counters.steps < next_look) return false;
    next_look = now.state.counters.steps + steps_between_looks;
    return kinetic_fraction(scene.model, now.state) < at_rest;
  };
  const auto start = std::chrono::steady_clock::now();
  Progress<3> progress = initial_progress(scene);
  simulate(scene, progress, watcher);
  found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  found.end = energy_errors(progress.state);
  found.kinetic = kinetic_fraction(scene.model, progress.state);
  look(progress.state);
  found.counters = progress.state.counters;
  found.time = progress.state.schedule.time;
  return found;
}

}  // namespace voussoir::shapes
