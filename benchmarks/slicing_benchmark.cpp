// Cutting a cube by three joint sets of n joints each: (n+1)³ blocks.
#include <benchmark/benchmark.h>

#include "benchmarks/shapes.hpp"
#include "core/slicing/slice.hpp"

namespace voussoir::benchmarks {
namespace {

void three_sets(benchmark::State& state) {
  HalfSpaces<3> planes;
  for (int k = 0; k < 3; ++k) {
    planes.push_back({Vector<3>::Unit(k), 0.5});
    planes.push_back({-Vector<3>::Unit(k), 0.5});
  }
  const Polytope<3> domain = make_block<3>(planes, std::vector<int>(6, no_joint)).part;
  Random random(7);
  std::vector<Cut<3>> cuts;
  const int n = static_cast<int>(state.range(0));
  for (int set = 0; set < 3; ++set)
    for (int i = 0; i < n; ++i) {
      const Vector<3> normal = (Vector<3>::Unit(set) + 0.05 * shapes::direction<3>(random)).normalized();
      cuts.push_back({{normal, (i + 1.0) / (n + 1) - 0.5}, static_cast<int>(cuts.size())});
    }
  std::size_t blocks = 0;
  for (auto _ : state) {
    SlicingCounters counters;
    blocks = slice<3>(domain, cuts, {}, counters).size();
  }
  state.counters["blocks"] = static_cast<double>(blocks);
  state.SetItemsProcessed(state.iterations() * static_cast<long long>(blocks));
}

BENCHMARK(three_sets)->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace voussoir::benchmarks
