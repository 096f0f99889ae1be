// Block theory on the joint sets of Table 4.1, 99,758 blocks: contacts, verdicts, pairs, rounds; a block judged again,
// under another load and cut by other planes.
#include <benchmark/benchmark.h>

#include "core/key_blocks/recut.hpp"
#include "core/key_blocks/survey.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

const Model<3>& mass() {
  static const Model<3> model = prepare<3>(read_scene(VOUSSOIR_SOURCE_DIR "/cases/slicing/table_4_1_persistent.toml",
                                                      {"joint_sets.A.intensity=0.54", "joint_sets.B.intensity=0.54",
                                                       "joint_sets.C.intensity=0.54"}))
                                    .model;
  return model;
}

const Assembly<3>& assembly() {
  static const Assembly<3> made = make_assembly(mass(), initial_water(mass()), {});
  return made;
}

void contacts(benchmark::State& state) {
  mass();
  for (auto _ : state)
    benchmark::DoNotOptimize(find_rock_contacts(mass()).list.size());
  state.counters["contacts"] = static_cast<double>(assembly().contacts.list.size());
}

void verdicts(benchmark::State& state) {
  assembly();
  for (auto _ : state)
    benchmark::DoNotOptimize(judge_all<3>(assembly(), {}).size());
}

void pairs(benchmark::State& state) {
  const std::vector<BoltedVerdict<3>> single = judge_all<3>(assembly(), {});
  long moving = 0;
  for (auto _ : state)
    moving = find_clusters<3>(assembly(), single, {}).moving_pairs;
  state.counters["moving"] = static_cast<double>(moving);
}

void rounds(benchmark::State& state) {
  assembly();
  std::size_t count = 0;
  for (auto _ : state)
    count = fail_in_rounds<3>(assembly(), FailureRule::below_factor, 1, {}).rounds.size();
  state.counters["rounds"] = static_cast<double>(count);
}

// another load on each block that moves, as of water or strength that change
void judged_again(benchmark::State& state) {
  const std::vector<BoltedVerdict<3>> single = judge_all<3>(assembly(), {});
  std::vector<Block<3>> blocks;
  for (int b = 0; b < static_cast<int>(single.size()) && blocks.size() < 1000; ++b)
    if (moves(single[b].verdict.kind)) gather<3>(assembly(), std::array{b}, {}, blocks.emplace_back());
  std::size_t next = 0;
  for (auto _ : state) {
    const Block<3>& block = blocks[next++ % blocks.size()];
    benchmark::DoNotOptimize(judge<3>(block, 1.1 * block.stated.force, mass().gravity).motion);
  }
}

// cut by planes that have turned by a thousandth of a degree, and judged
void recut_and_judged(benchmark::State& state) {
  HalfSpaces<3> planes;
  for (const Joint<3>& joint : mass().joints) {
    const Vector<3> turned = joint.plane.normal + 2e-5 * perpendicular(joint.plane.normal);
    planes.push_back({turned.normalized(), joint.plane.offset});
  }
  Recutter<3> recutter(assembly());
  Block<3> block;
  const int bodies = static_cast<int>(mass().bodies.size());
  int next = 0;
  double cut = 0, attempts = 0;
  for (auto _ : state) {
    next = (next + 37) % bodies;
    ++attempts;
    if (!recutter.recut(next, planes, block)) continue;
    ++cut;
    benchmark::DoNotOptimize(judge<3>(block, block.stated.force, mass().gravity).motion);
  }
  state.counters["cut"] = cut / attempts;
}

BENCHMARK(contacts)->Unit(benchmark::kMillisecond);
BENCHMARK(verdicts)->Unit(benchmark::kMillisecond);
BENCHMARK(pairs)->Unit(benchmark::kMillisecond);
BENCHMARK(rounds)->Unit(benchmark::kMillisecond);
BENCHMARK(judged_again)->Unit(benchmark::kMicrosecond);
BENCHMARK(recut_and_judged)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace voussoir
