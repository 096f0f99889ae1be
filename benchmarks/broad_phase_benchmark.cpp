// The broad phase on boxes at constant density: the time per box should not depend on their number. And the complete
// list of neighbours of parallel slabs: its length and time should depend little on the dip.
#include <benchmark/benchmark.h>

#include <cmath>

#include "benchmarks/shapes.hpp"
#include "core/contact/broad_phase.hpp"
#include "core/model/state.hpp"
#include "core/step/neighbours.hpp"
#include "text/angle.hpp"

namespace voussoir::benchmarks {
namespace {

// about six neighbours each, as in a dense pile
constexpr double boxes_per_unit = 0.8;

// boxes of 1 m, plus the effect of a block's rotation; `mixed`: of 0.1 to 1 m, more of the small
std::vector<Box<3>> scattered(int count, bool mixed) {
  Random random(4711);
  const double side = std::cbrt(count / boxes_per_unit);
  std::vector<Box<3>> boxes;
  for (int i = 0; i < count; ++i) {
    const double size = mixed ? std::pow(10, shapes::uniform(random, -1, 0)) : shapes::uniform(random, 0.8, 1);
    Box<3> box{Vector<3>::Zero(), Vector<3>::Zero(), i, false};
    for (int k = 0; k < 3; ++k) {
      box.low[k] = shapes::uniform(random, 0, side);
      box.high[k] = box.low[k] + size;
    }
    boxes.push_back(box);
  }
  // a pile on a plate
  boxes.push_back({Vector<3>(-1, -1, -1), Vector<3>(side + 1, side + 1, 0), count, true});
  return boxes;
}

void broad_phase(benchmark::State& state, bool mixed) {
  const int count = static_cast<int>(state.range(0));
  const std::vector<Box<3>> boxes = scattered(count, mixed);
  std::vector<std::pair<int, int>> pairs;
  for (auto _ : state) {
    overlapping_pairs(boxes, 1, {}, pairs);
    benchmark::DoNotOptimize(pairs.data());
  }
  state.counters["ns_per_box"] = benchmark::Counter(static_cast<double>(state.iterations()) * count * 1e-9,
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["pairs_per_box"] = static_cast<double>(pairs.size()) / count;
}

void equal(benchmark::State& state) {
  broad_phase(state, false);
}
void mixed(benchmark::State& state) {
  broad_phase(state, true);
}

// slabs of 30 m by 30 m by 3 mm, one on top of the other
void slabs(benchmark::State& state) {
  const int count = static_cast<int>(state.range(0));
  const double dip = static_cast<double>(state.range(1)) * degree;
  const double thickness = 0.003, half = 15;  // m
  const Matrix<3> turn = Eigen::AngleAxisd(dip, Vector<3>::UnitY()).toRotationMatrix();
  const HalfSpaces<3> slab = shapes::box<3>({-half, -half, -0.5 * thickness}, {half, half, 0.5 * thickness});
  const Polytope<3> part = shapes::block<3>(shapes::placed<3>(slab, turn, Vector<3>::Zero()));
  Model<3> model;
  for (int i = 0; i < count; ++i) {
    model.bodies.push_back(make_body<3>({part}, 2600));
    model.bodies.back().reference += turn * Vector<3>(0, 0, i * thickness);
  }
  number_bodies(model);
  State<3> now = initial_state(model);
  for (auto _ : state) {
    now.bodies.listed_at.clear();
    find_neighbours(model, {}, now.bodies, now.contacts, now.counters);
  }
  state.counters["ns_per_slab"] = benchmark::Counter(static_cast<double>(state.iterations()) * count * 1e-9,
                                                     benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["pairs_per_slab"] = static_cast<double>(now.contacts.list.size()) / count;
}

BENCHMARK(slabs)->ArgsProduct({{1000, 10'000}, {0, 30, 45, 89}})->Unit(benchmark::kMillisecond);
BENCHMARK(equal)->RangeMultiplier(10)->Range(1000, 100'000)->Unit(benchmark::kMicrosecond);
BENCHMARK(mixed)->RangeMultiplier(10)->Range(1000, 100'000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace voussoir::benchmarks
