// The contact kernel per polyhedron type: touching pairs cold and warm, separated pairs.
#include <benchmark/benchmark.h>

#include "benchmarks/shapes.hpp"

namespace voussoir::benchmarks {
namespace {

constexpr int pair_count = 200;
constexpr double overlap = 0.5e-4, gap = -0.01;  // of the size

struct Workload {
  Polytope<3> part;
  std::vector<Pair<3>> pairs;
  std::vector<Contact<3>> contacts;
  std::vector<Contact<3>*> slots;
};

void prepare(Workload& work, int kind, double depth) {
  Random random(20130 + kind);
  work.part = platonic(kind);
  for (int i = 0; i < pair_count; ++i)
    work.pairs.push_back(pair_at(work.part, depth, random));
  work.contacts.resize(pair_count);
  for (Contact<3>& c : work.contacts)
    work.slots.push_back(&c);
}

void resolve(benchmark::State& state, double depth, bool warm) {
  Workload work;
  prepare(work, static_cast<int>(state.range(0)), depth);
  const ContactSettings settings;
  const Solvers<3> solvers;
  KernelCounters counters;
  narrow_phase<3>(work.pairs, settings, solvers, work.slots, counters);
  counters = {};
  for (auto _ : state) {
    if (!warm)
      for (Contact<3>& c : work.contacts)
        c.proof = {};
    narrow_phase<3>(work.pairs, settings, solvers, work.slots, counters);
    benchmark::DoNotOptimize(work.contacts.data());
  }
  const double evaluations = static_cast<double>(state.iterations()) * pair_count;
  state.SetItemsProcessed(state.iterations() * pair_count);
  state.counters["ns_per_pair"] =
      benchmark::Counter(evaluations * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["newton"] = static_cast<double>(counters.newton_iterations) / evaluations;
  state.counters["pivots"] = static_cast<double>(counters.lp_pivots) / evaluations;
  state.counters["planes"] = 2.0 * static_cast<double>(work.part.faces.size());
  state.SetLabel(platonic_name(static_cast<int>(state.range(0))));
}

void touching_cold(benchmark::State& state) {
  resolve(state, overlap, false);
}
void touching_warm(benchmark::State& state) {
  resolve(state, overlap, true);
}
void separated_cold(benchmark::State& state) {
  resolve(state, gap, false);
}
void separated_warm(benchmark::State& state) {
  resolve(state, gap, true);
}

BENCHMARK(touching_cold)->DenseRange(0, 4);
BENCHMARK(touching_warm)->DenseRange(0, 4);
BENCHMARK(separated_cold)->DenseRange(0, 4);
BENCHMARK(separated_warm)->DenseRange(0, 4);

}  // namespace
}  // namespace voussoir::benchmarks
