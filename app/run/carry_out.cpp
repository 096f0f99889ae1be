#include "app/run/carry_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/base/progress_line.hpp"
#include "app/run/accuracy_on_order.hpp"
#include "app/run/error_budget.hpp"
#include "app/run/run_files.hpp"
#include "app/run/run_summary.hpp"
#include "app/run_folder/results_hash.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/results_json.hpp"
#include "core/run/block_theory.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

RunRecord record_of(const LoadedScene& scene, const RunOptions& options) {
  RunRecord record;
  record.warnings = options.warnings;
  record.title = scene.title;
  record.dimension = scene.dimension;
  record.input_hash = scene.hash;
  record.features = features();
  record.threads = options.threads;
  record.rounds = options.rounds;
  record.origins = options.origins;
  record.records = std::visit([](const auto& prepared) { return record_rows(prepared.stages); }, scene.prepared);
  return record;
}

// when the next checkpoint is due, in steps and in seconds
class CheckpointClock {
 public:
  CheckpointClock(const RunOptions& options, long long steps, double seconds) : options_(options) {
    restart(steps, seconds);
  }
  bool due(long long steps, double seconds) const {
    return (options_.checkpoint_steps > 0 && steps >= steps_ + options_.checkpoint_steps) ||
           (options_.checkpoint_seconds > 0 && seconds >= seconds_ + options_.checkpoint_seconds);
  }
  void restart(long long steps, double seconds) {
    steps_ = steps;
    seconds_ = seconds;
  }

 private:
  RunOptions options_;
  long long steps_ = 0;
  double seconds_ = 0;
};

// the run continues from where `progress` is; false: a signal stopped it, with a checkpoint
template <int Dim>
bool continue_run(const Prepared<Dim>& prepared, const std::string& scene_hash, const RunJob& job,
                  Progress<Dim>& progress, WrittenSeries& written) {
  ProgressLine line(!job.quiet);
  CheckpointClock clock(job.options, progress.state.counters.steps, progress.results.seconds);
  Watcher<Dim> watcher;
  watcher.progress = [&](const ProgressReport& report) { line.show(report); };
  write_frames(written, progress, watcher);
  watcher.ended = [&](const Progress<Dim>& now) {
    if (job.options.keep) save_end_state(job.folder, now, scene_hash);
  };
  watcher.pause = [&](const Progress<Dim>& now) {
    const bool stop = interruption() != 0;
    const long long steps = now.state.counters.steps;
    if (stop || clock.due(steps, now.results.seconds)) {
      write_tables(job.folder, now);
      save_checkpoint(job.folder, now, scene_hash);
      clock.restart(steps, now.results.seconds);
    }
    return stop;
  };
  return simulate(prepared, progress, watcher);
}

// The budget of a result, unless its search bracket by itself is wider than requested, and the refinements for the next
// round. False: a signal stopped it.
bool judge_accuracy(const LoadedScene& stated, const LoadedScene& scene, RunJob& job, Results& results,
                    std::optional<Refinement>& next) {
  if (results.outcome == Outcome::failed) return true;
  const int round = static_cast<int>(job.options.rounds.size());
  if (wants_stiffness_bar(scene) && job.options.until.empty())
    return add_stiffness_bar(scene, budget_runs(stated, round, job.options.settings), job.folder, job.options.threads,
                             job.quiet, results);
  if (!wants_budget(scene)) return true;
  const std::optional<AccuracyTarget> target = wanted_accuracy(scene);
  if (!(target && brackets_too_wide(scene, *target, results) && round + 1 < most_rounds) &&
      !add_budget(scene, budget_runs(stated, round, job.options.settings), job.folder, job.options.threads, job.quiet,
                  results))
    return false;
  if (!target) return true;
  next = refinement(scene, *target, job.options.rounds, results);
  const long long evaluations = results.counters.contact_evaluations + results.budget_evaluations;
  job.options.rounds.push_back(
      {job.options.settings, next ? next->summary : "as asked", evaluations, parts_of_bars(scene, results)});
  if (!next) {
    if (results.outcome != Outcome::done) job.options.rounds.back().told = results.message;
    return true;
  }
  if (!job.quiet)
    tell("voussoir: {}; about {:.2g} steps, {}\n", next->summary,
         next->cost * static_cast<double>(results.counters.steps), duration_text(next->cost * results.seconds));
  job.options.settings.insert(job.options.settings.end(), next->overrides.begin(), next->overrides.end());
  return true;
}

// begins or continues, and writes the results; nothing: a finer round follows
template <int Dim>
std::optional<ExitCode> carry_out_prepared(const LoadedScene& stated, const LoadedScene& scene,
                                           const Prepared<Dim>& prepared, RunJob& job) {
  std::vector<std::string> remarks;
  Progress<Dim> progress = last_progress(job.folder, prepared, scene.hash, remarks);
  tell_warnings(remarks);
  WrittenSeries written = cut_back_to(prepared, progress, job.folder);
  write_record_spectra(job.folder, prepared.stages);

  note_interruptions();
  if (!continue_run(prepared, scene.hash, job, progress, written)) {
    tell("voussoir: interrupted after step {} (t = {:.6g} s): continue with 'voussoir resume {}'\n",
         progress.state.counters.steps, progress.state.schedule.time, job.folder.string());
    return ended_by(interruption());
  }

  // results.json comes last: if it exists, everything is complete
  Results& results = progress.results;
  write_tables(job.folder, progress);
  write_monitor_spectra(job.folder, results.history, prepared.stages);
  std::optional<Refinement> next;
  if (!judge_accuracy(stated, scene, job, results, next)) {
    tell("voussoir: interrupted in the error budget: continue with 'voussoir resume {}'\n", job.folder.string());
    return ended_by(interruption());
  }
  if (next) {
    // a checkpoint of this round is none of the next
    remove_checkpoints(job.folder);
    write_options(job.folder, job.options);
    return std::nullopt;
  }
  add_block_theory(prepared, results);
  if (written.view) write_page(job.folder);
  write_results(job.folder, results_json(results, record_of(scene, job.options)));
  remove_checkpoints(job.folder);
  if (!job.quiet) {
    tell_warnings(results.warnings);
    print_summary(scene.title, results, job.options.rounds, forces_per_metre<Dim>(prepared.monitors), job.folder);
  } else if (results.outcome != Outcome::done) {
    tell("voussoir: {}: {}\n", outcome_name(results.outcome), results.message);
  }
  return exit_code(results.outcome);
}

}  // namespace

ExitCode carry_out(const LoadedScene& stated, RunJob job) {
  for (;;) {
    LoadedScene finer;
    const bool refined = !job.options.settings.empty();
    if (refined) finer = load_scene(job.folder / "scene.toml", job.options.settings, job.options.threads);
    const LoadedScene& scene = refined ? finer : stated;
    const std::optional<ExitCode> ended = std::visit(
        [&](const auto& prepared) { return carry_out_prepared(stated, scene, prepared, job); }, scene.prepared);
    if (ended) return *ended;
  }
}

void end_with(const std::string& stage, LoadedScene& scene) {
  if (stage.empty()) return;
  std::visit(
      [&](auto& prepared) {
        std::vector<std::string> names;
        for (const StagePlan& plan : prepared.stages)
          names.push_back(plan.name);
        const auto found = std::ranges::find(names, stage);
        if (found == names.end())
          throw BadInput(fmt::format("--until {}: no stage of the scene has this name; {}", one_line(stage, 60),
                                     suggestion(stage, names)));
        prepared.last_stage = static_cast<int>(found - names.begin());
      },
      scene.prepared);
}

}  // namespace voussoir
