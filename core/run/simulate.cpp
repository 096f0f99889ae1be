#include "core/run/simulate.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <span>

#include "core/model/state_hash.hpp"
#include "core/run/doubts.hpp"
#include "core/run/execute_stage.hpp"
#include "core/run/history.hpp"
#include "core/run/stable_state.hpp"
#include "core/run/stage_changes.hpp"

namespace voussoir {
namespace {

template <int Dim>
void add_final_results(const StageInForce<Dim>& stage, Progress<Dim>& progress) {
  const Prepared<Dim>& scene = stage.scene;
  const State<Dim>& state = progress.state;
  Results& results = progress.results;
  std::ranges::move(doubts_of_level(scene.accuracy_level, results), std::back_inserter(results.warnings));
  const std::vector<Column> columns = monitor_columns<Dim>(scene.monitors);
  const std::vector<double> values = monitor_values<Dim>(
      scene.monitors, stage.model, with_forces(stage, state, results.outcome == Outcome::failed), progress.ends);
  for (std::size_t k = 0; k < columns.size(); ++k)
    results.values.push_back({columns[k].name, {values[k], columns[k].unit, {}, "at the end"}});
  results.counters = state.counters;
  count_all_bonds(scene, state, results);
  results.state_hash = state_hash(stage.model, state);
  results.energy = state.ledger.energy;
  for (const ReliefLoad<Dim>& load : state.loads.relief)
    if (stage.model.bodies[load.body].present)
      results.forces_remaining = std::max(results.forces_remaining, load.share);
  const auto begun = std::span(scene.stages).first(std::min<std::size_t>(stage.place + 1, scene.stages.size()));
  if (std::string doubts = doubts_of(state.ledger.energy, begun, scene.settings); !doubts.empty())
    results.warnings.push_back(std::move(doubts));
  if (std::string doubts = doubts_of_implicit_steps(state.ledger.energy); !doubts.empty())
    results.warnings.push_back(std::move(doubts));
}

// stage after stage; false: interrupted
template <int Dim>
bool execute_all(const Prepared<Dim>& scene, Progress<Dim>& progress, const Watcher<Dim>& watcher) {
  Model<Dim> model = model_after(scene, progress.stage);  // of the stage, like the settings
  Settings settings;
  const int last = scene.last_stage.value_or(static_cast<int>(scene.stages.size()) - 1);
  while (progress.stage <= last) {
    enter_stage(scene, model, settings, progress);
    const StageInForce<Dim> stage{scene, progress.stage, model, settings};
    if (!progress.stage_under_way) begin_stage(stage, progress);
    const std::optional<StageOutcome> done = execute_stage(stage, watcher, progress);
    if (!done) return false;
    end_stage(stage, *done, watcher, progress);
    if (progress.results.outcome != Outcome::done) break;
    ++progress.stage;
  }
  if (watcher.ended) watcher.ended(progress);
  add_final_results(StageInForce<Dim>{scene, progress.stage, model, settings}, progress);
  return true;
}

}  // namespace

template <int Dim>
Progress<Dim> initial_progress(const Prepared<Dim>& scene) {
  Progress<Dim> progress;
  progress.state = scene.state;
  progress.results.history.columns = history_columns(scene);
  return progress;
}

template <int Dim>
bool simulate(const Prepared<Dim>& scene, Progress<Dim>& progress, const Watcher<Dim>& watcher) {
  using Clock = std::chrono::steady_clock;
  const auto count_seconds = [&, before = progress.results.seconds, began = Clock::now()] {
    progress.results.seconds = before + std::chrono::duration<double>(Clock::now() - began).count();
  };
  Watcher<Dim> timed = watcher;
  if (watcher.pause)
    timed.pause = [&](const Progress<Dim>& now) {
      count_seconds();
      return watcher.pause(now);
    };
  const bool done = execute_all(scene, progress, timed);
  count_seconds();
  return done;
}

template <int Dim>
History history_so_far(const Progress<Dim>& progress) {
  History history = progress.results.history;
  history.rows.insert(history.rows.end(), progress.record.rows.begin(), progress.record.rows.end());
  return history;
}

template History history_so_far<2>(const Progress<2>&);
template History history_so_far<3>(const Progress<3>&);
template Progress<2> initial_progress(const Prepared<2>&);
template Progress<3> initial_progress(const Prepared<3>&);
template bool simulate<2>(const Prepared<2>&, Progress<2>&, const Watcher<2>&);
template bool simulate<3>(const Prepared<3>&, Progress<3>&, const Watcher<3>&);

}  // namespace voussoir
