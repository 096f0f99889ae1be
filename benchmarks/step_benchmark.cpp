// A complete step: of a settled pile, n cubes stacked on a fixed one; and of contacts with almost no force.
#include <benchmark/benchmark.h>

#include <limits>

#include "benchmarks/shapes.hpp"
#include "core/run/run.hpp"
#include "core/step.hpp"

namespace voussoir::benchmarks {
namespace {

// n cubes that overlap by a given depth on a fixed one
Model<3> cubes(int n, double overlap, double stiffness) {
  const Polytope<3> cube = platonic(1);
  const double side = 1 / std::sqrt(3.0);
  Model<3> model;
  for (int i = 0; i <= n; ++i) {
    Body<3> body = make_body<3>({cube}, 2000);
    body.reference = {0, 0, i * (side - overlap)};
    body.fixed = i == 0;
    model.bodies.push_back(body);
  }
  JointProperties rock;
  rock.normal_stiffness = rock.shear_stiffness = stiffness;
  rock.friction = 0.6;
  model.properties.push_back(rock);
  number_bodies(model);
  return model;
}

void stack(benchmark::State& state) {
  Model<3> model = cubes(static_cast<int>(state.range(0)), 0, 1e9);
  model.gravity = {0, 0, -9.81};
  State<3> now = initial_state(model);
  const Settings settings;
  RunGoal goal;
  goal.step_limit = 200;
  run(model, settings, goal, {}, now);
  const Counters before = now.counters;
  for (auto _ : state)
    step(model, settings, now);
  const double steps = static_cast<double>(now.counters.steps - before.steps);
  state.counters["contacts_per_step"] =
      static_cast<double>(now.counters.contact_evaluations - before.contact_evaluations) / steps;
  state.counters["newton_per_contact"] =
      static_cast<double>(now.counters.newton_iterations - before.newton_iterations) /
      std::max(1.0, static_cast<double>(now.counters.contact_evaluations - before.contact_evaluations));
}

BENCHMARK(stack)->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

// Ten contacts whose forces are tiny: of 1e-4 N, or of 1e-311 N, a denormal number. The two must take the same time, or
// a rock mass that is almost at rest would be slow. (An overlap cannot be denormal: below 1e-13 of the size there is no
// contact.)
void tiny_forces(benchmark::State& state) {
  const bool denormal = state.range(0) == 1;
  const Model<3> model = cubes(10, 1e-6, denormal ? 1e-304 : 1e3);
  State<3> now = initial_state(model);
  Settings settings;
  settings.time.step = 1e-6;
  for (auto _ : state)
    step(model, settings, now);
  double force = 0;
  for (const Contact<3>& c : now.contacts.list)
    force = std::max(force, c.force.cwiseAbs().maxCoeff());
  state.counters["denormal"] = force > 0 && force < std::numeric_limits<double>::min();
}

BENCHMARK(tiny_forces)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace voussoir::benchmarks
