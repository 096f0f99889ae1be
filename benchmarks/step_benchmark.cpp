// A whole step of a settled pile: n cubes stacked on a fixed one.
#include <benchmark/benchmark.h>

#include "benchmarks/shapes.hpp"
#include "core/run.hpp"
#include "core/step.hpp"

namespace voussoir::benchmarks {
namespace {

void stack(benchmark::State& state) {
  const Polytope<3> cube = platonic(1);
  const double side = 1 / std::sqrt(3.0);
  Model<3> model;
  const int n = static_cast<int>(state.range(0));
  for (int i = 0; i <= n; ++i) {
    Body<3> body = make_body<3>({cube}, 2000);
    body.reference = {0, 0, i * side};
    body.fixed = i == 0;
    model.bodies.push_back(body);
  }
  model.gravity = {0, 0, -9.81};
  JointProperties rock;
  rock.normal_stiffness = rock.shear_stiffness = 1e9;
  rock.friction = 0.6;
  model.properties.push_back(rock);
  number_bodies(model);
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

}  // namespace
}  // namespace voussoir::benchmarks
