#include "app/run/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/base/bad_input.hpp"
#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/base/progress_line.hpp"
#include "app/base/run_scene.hpp"
#include "app/check/plausibility.hpp"
#include "app/run/accuracy_on_order.hpp"
#include "app/run/error_budget.hpp"
#include "app/run_folder/begin_run.hpp"
#include "app/run_folder/origin.hpp"
#include "app/run_folder/results_hash.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/view/page.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/paraview.hpp"
#include "core/output/results_json.hpp"
#include "core/output/support_table.hpp"
#include "core/output/view.hpp"
#include "core/run/stable_state.hpp"
#include "core/scene/toml_text.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

fs::path results_folder(const RunArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path("results") / arguments.scene.scene.stem();
}

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
  return record;
}

// an error bar needs two digits, and its value as many places
std::string value_text(const Value& value) {
  const std::string unit = value.unit == "1" ? "" : " " + value.unit;
  if (!std::isfinite(value.value)) return "not a finite number" + unit;
  if (!value.error_bar || *value.error_bar <= 0) return fmt::format("{:.6g}{}", value.value, unit);
  const int places = std::clamp(1 - static_cast<int>(std::floor(std::log10(*value.error_bar))), 0, 15);
  return fmt::format("{:.{}f} ± {:.{}f}{}, {}", value.value, places, *value.error_bar, places, unit,
                     value.covers == "bracket" ? "the bracket alone" : "all that the budget varied");
}

void print_budget(const Value& value) {
  constexpr double told = 0.01;  // of the bar; results.json has all
  for (const BudgetLine& line : value.budget) {
    if (!line.sensitivity && !(std::abs(line.left) >= told * value.error_bar.value_or(0) && line.left != 0)) continue;
    fmt::print("      {:+.2g}{} with {}, {}: {}\n", line.shift, value.unit == "1" ? "" : " " + value.unit, line.varied,
               line.change, line.sensitivity ? "measured, no error" : fmt::format("{:+.2g} is left", line.left));
  }
}

// bodies that came to rest somewhere else than where their stage began
void print_moved(const std::vector<MovedBody>& moved) {
  constexpr std::size_t most_moved_shown = 10;
  for (std::size_t k = 0; k < std::min(moved.size(), most_moved_shown); ++k) {
    const MovedBody& m = moved[k];
    fmt::print("  moved in stage {}: body {}{} by {:.3g} m, rests at ({:.4g}){}\n", m.stage, m.body,
               m.name.empty() ? "" : " (" + m.name + ")", m.distance, fmt::join(m.place, ", "),
               m.left_all ? ", in other contacts" : "");
  }
  if (moved.size() > most_moved_shown)
    fmt::print("  and {} more (results.json, moved)\n", moved.size() - most_moved_shown);
}

void print_summary(const LoadedScene& scene, const Results& results, const RunOptions& options,
                   const fs::path& folder) {
  const std::string message = results.message.empty() ? "" : ": " + results.message;
  fmt::print("{}{}{}\n", scene.title.empty() ? "" : scene.title + " - ", outcome_name(results.outcome), message);
  std::size_t width = 0;
  for (const auto& [name, value] : results.values)
    width = std::max(width, name.size());
  for (const auto& [name, value] : results.values) {
    fmt::print("  {:<{}}  {}{}\n", name, width, value_text(value), value.rule.empty() ? "" : "  (" + value.rule + ")");
    print_budget(value);
    if (!value.divides.empty()) fmt::print("      it {}\n", value.divides);
  }
  for (const StageResult& stage : results.stages) {
    fmt::print("  stage {}: {} after {} steps, {:.4g} s simulated\n", stage.name, stage.ended, stage.steps, stage.time);
    for (const StableState& at : results.at_last_stable_state)
      if (at.stage == stage.name && at.bonds) fmt::print("      {}: {}\n", moment_text(at), bonds_text(*at.bonds));
  }
  if (const auto& bonds = results.bonds)
    fmt::print("  bonds: {} made, {} whole, {} broken, {} removed with their blocks; {} joints have not pressed yet\n",
               bonds->made, bonds->whole, bonds->broken, bonds->removed, bonds->due);
  print_moved(results.moved);
  if (results.relief_left > 0)
    fmt::print("  let_off: a share of {:g} of the forces by which excavated rock held the rest still acts\n",
               results.relief_left);
  const Counters& counters = results.counters;
  fmt::print("  {} steps, {} contact evaluations, {}\n", counters.steps, counters.contact_evaluations,
             duration_text(results.seconds));
  for (std::size_t k = 0; k + 1 < options.rounds.size(); ++k)
    fmt::print("  round {}: {} contact evaluations; {}\n", k + 1, options.rounds[k].contact_evaluations,
               options.rounds[k].told);
  if (results.budget_evaluations > 0)
    fmt::print("  error budget: {} contact evaluations, {:.2g} times the answer's\n", results.budget_evaluations,
               static_cast<double>(results.budget_evaluations) / static_cast<double>(counters.contact_evaluations));
  fmt::print("results: {}\n", folder.string());
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    tell("voussoir: warning: {}\n", warning);
}

struct RunJob {
  fs::path folder;
  RunOptions options;
  bool quiet = false;
};

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

// The path to the answer, and the trials that were taken back; what the viewer shows has both. Those that the scene
// does not ask for are not written.
struct WrittenSeries {
  std::optional<FrameSeries> frames, trials;
  std::optional<ViewSeries> view;
};

template <int Dim>
void write_tables(const fs::path& folder, const Progress<Dim>& progress) {
  write_history_csv(folder / "history.csv", history_so_far(progress));
  write_support_tables(folder, progress.results);
}

// the run continues from where `progress` stands; false: a signal stopped it, with a checkpoint
template <int Dim>
bool go_on(const Prepared<Dim>& prepared, const std::string& scene_hash, const RunJob& job, Progress<Dim>& progress,
           WrittenSeries& written) {
  ProgressLine line(!job.quiet);
  CheckpointClock clock(job.options, progress.state.counters.steps, progress.results.seconds);
  Watcher<Dim> watcher;
  watcher.progress = [&](const ProgressReport& report) { line.show(report); };
  watcher.frame = [&](const Model<Dim>& model, const State<Dim>& state, double time) {
    if (written.frames) write_frame(*written.frames, model, state, time);
    if (written.view) add_view_frame(*written.view, model, state, {ViewMoment::Kind::frame, time, progress.stage, 0});
  };
  watcher.trial_frame = [&](const Model<Dim>& model, const State<Dim>& state, int trial) {
    if (written.trials) write_frame(*written.trials, model, state, trial);
    if (written.view)
      add_view_frame(*written.view, model, state,
                     {ViewMoment::Kind::trial, state.schedule.time, progress.stage, trial});
  };
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

// what the run so far has written beyond its checkpoint is cut off
template <int Dim>
ViewSeries cut_back_view(const Prepared<Dim>& prepared, const Progress<Dim>& progress, const fs::path& file) {
  const int frames = static_cast<int>(progress.frames.size() + progress.trial_frames.size());
  if (frames == 0) return begin_view(file, prepared);
  ViewSeries view = continue_view(file, prepared, frames + 1);
  if (view.frames == 0)
    print_warnings({fmt::format("'{}' is gone or damaged: the viewer shows the frames from here on", file.string())});
  return view;
}

template <int Dim>
WrittenSeries cut_back_to(const Prepared<Dim>& prepared, const Progress<Dim>& progress, const fs::path& folder) {
  WrittenSeries written;
  if (prepared.output.frames) {
    written.frames = cut_back(folder, progress.frames);
    written.trials = cut_back(folder, progress.trial_frames, trial_series);
    written.frames->sets = written.trials->sets = prepared.joint_sets;
    std::set<std::string> lost = written.frames->lost;
    lost.insert(written.trials->lost.begin(), written.trials->lost.end());
    if (!lost.empty())
      print_warnings({fmt::format("{} files of frames are gone, {} the first: the .pvd files leave them out",
                                  lost.size(), *lost.begin())});
  }
  if (prepared.output.view) written.view = cut_back_view(prepared, progress, folder / view_file);
  write_tables(folder, progress);
  return written;
}

// The budget of an answer, unless its bracket alone is wider than what is asked, and what to make finer for the next
// one. False: a signal stopped it.
bool judge_accuracy(const LoadedScene& stated, const LoadedScene& scene, RunJob& job, Results& results,
                    std::optional<Refinement>& next) {
  if (!wants_budget(scene) || results.outcome == Outcome::failed) return true;
  const int round = static_cast<int>(job.options.rounds.size());
  const std::optional<AccuracyTarget> target = wanted_accuracy(scene);
  if (!(target && brackets_too_wide(scene, *target, results) && round + 1 < most_rounds) &&
      !add_budget(scene, budget_runs(stated, round, job.options.settings), job.folder, job.options.threads, job.quiet,
                  results))
    return false;
  if (!target) return true;
  next = refinement(scene, *target, round + 1, results);
  const long long evaluations = results.counters.contact_evaluations + results.budget_evaluations;
  job.options.rounds.push_back({job.options.settings, next ? next->told : "as asked", evaluations});
  if (!next) {
    if (results.outcome != Outcome::done) job.options.rounds.back().told = results.message;
    return true;
  }
  if (!job.quiet)
    tell("voussoir: {}; about {:.2g} steps, {}\n", next->told, next->cost * static_cast<double>(results.counters.steps),
         duration_text(next->cost * results.seconds));
  job.options.settings.insert(job.options.settings.end(), next->overrides.begin(), next->overrides.end());
  return true;
}

// a program without the viewer leaves the page to one that has it
void write_page(const fs::path& folder) {
  if (const std::string missing = viewer_missing(); !missing.empty())
    print_warnings({fmt::format("{} is not written: {}; 'voussoir view {}' makes it where that is there", page_file,
                                missing, folder.string())});
  else
    write_file(folder / page_file, view_page(folder / view_file));
}

// begins or continues, and writes the results; nothing: a finer answer is to follow
template <int Dim>
std::optional<ExitCode> carry_out_prepared(const LoadedScene& stated, const LoadedScene& scene,
                                           const Prepared<Dim>& prepared, RunJob& job) {
  std::vector<std::string> remarks;
  Progress<Dim> progress = last_progress(job.folder, prepared, scene.hash, remarks);
  print_warnings(remarks);
  WrittenSeries written = cut_back_to(prepared, progress, job.folder);

  note_interruptions();
  if (!go_on(prepared, scene.hash, job, progress, written)) {
    tell("voussoir: interrupted after step {} (t = {:.6g} s): continue with 'voussoir resume {}'\n",
         progress.state.counters.steps, progress.state.schedule.time, job.folder.string());
    return static_cast<ExitCode>(static_cast<int>(ExitCode::signal) + interruption());
  }

  // results.json comes last: where it is, everything is
  Results& results = progress.results;
  write_tables(job.folder, progress);
  std::optional<Refinement> next;
  if (!judge_accuracy(stated, scene, job, results, next)) {
    tell("voussoir: interrupted in the error budget: continue with 'voussoir resume {}'\n", job.folder.string());
    return static_cast<ExitCode>(static_cast<int>(ExitCode::signal) + interruption());
  }
  if (next) {
    // a checkpoint of this answer is none of the next
    remove_checkpoints(job.folder);
    write_options(job.folder, job.options);
    return std::nullopt;
  }
  if (written.view) write_page(job.folder);
  write_results(job.folder, results_json(results, record_of(scene, job.options)));
  remove_checkpoints(job.folder);
  if (!job.quiet) {
    print_warnings(results.warnings);
    print_summary(scene, results, job.options, job.folder);
  } else if (results.outcome != Outcome::done) {
    tell("voussoir: {}: {}\n", outcome_name(results.outcome), results.message);
  }
  return exit_code(results.outcome);
}

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

// the place of the stage after which the run ends
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

// Where a run begins that does not begin at the start. `inputs` gains what is read for that, `options` who computed it.
std::optional<AnyProgress> begun_at(const fs::path& other, const LoadedScene& scene, std::vector<fs::path>& inputs,
                                    RunOptions& options) {
  if (other.empty()) return std::nullopt;
  std::vector<std::string> remarks;
  AnyProgress begun = progress_at_end(other, scene, remarks);
  print_warnings(remarks);
  options.origins = read_options(other).origins;
  for (const fs::path& file : files_begun_with(other))
    inputs.push_back(file);
  return begun;
}

// The first checkpoint of a run that begins at another's end: from here on it needs that folder no more.
void begin_in(const fs::path& folder, const std::string& scene_hash, const AnyProgress& begun) {
  std::visit([&](const auto& progress) { save_checkpoint(folder, progress, scene_hash); }, begun);
}

ExitCode already_complete(const ResumeArguments& arguments) {
  if (!arguments.quiet) fmt::print("'{}' is complete: nothing to do\n", arguments.folder.string());
  return ExitCode::done;
}

}  // namespace

ExitCode run_command(const RunArguments& arguments) {
  // nothing is written before the whole scene is known to be good
  RunOptions options;
  options.threads = arguments.threads;
  if (arguments.checkpoint_steps) options.checkpoint_steps = *arguments.checkpoint_steps;
  if (arguments.checkpoint_seconds) options.checkpoint_seconds = *arguments.checkpoint_seconds;
  options.until = arguments.until;
  options.keep = arguments.keep || !arguments.until.empty();
  std::vector<std::string> overrides = arguments.scene.overrides;
  if (arguments.budget) overrides.push_back("accuracy.budget=true");
  if (arguments.view) overrides.push_back("output.view=true");
  LoadedScene scene = load_scene(arguments.scene.scene, overrides, options.threads);
  if (wants_budget(scene) && !(arguments.until.empty() && arguments.begin.empty()))
    throw BadInput(fmt::format(
        "{}: a budget's runs go from the start to the last stage; leave it out, or --budget and accuracy.budget",
        arguments.until.empty() ? "--begin" : "--until"));
  end_with(options.until, scene);
  require_sane_size(scene.text, arguments.scene.scene.string() + " with all that it names");  // for it is read again
  options.scene_hash = scene.hash;
  options.warnings = assess(scene).warnings;
  if (!arguments.quiet) print_warnings(options.warnings);

  std::vector<fs::path> inputs = scene.files;
  std::optional<AnyProgress> begun = begun_at(arguments.begin, scene, inputs, options);
  add_origin(options.origins, this_origin());
  if (!wants_budget(scene)) scene.stated.reset();

  // the folder is ours alone, and says what is run before the first step
  const fs::path folder = results_folder(arguments);
  Outputs outputs = run_outputs();
  if (wants_budget(scene)) outputs.folders = budget_folders(scene);
  const ClaimedFolder claim(folder, outputs, inputs, arguments.overwrite);
  if (begun) begin_in(folder, scene.hash, *begun);
  begun.reset();
  write_file(folder / "scene.toml", scene.text);
  write_options(folder, options);
  return carry_out(scene, {folder, options, arguments.quiet});
}

ExitCode resume_command(const ResumeArguments& arguments) {
  const fs::path& folder = arguments.folder;
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw BadInput(fmt::format("'{}' is not a folder: name the folder of an interrupted run", folder.string()));
  if (!holds_results(folder) && !holds_unfinished_run(folder))
    throw BadInput(fmt::format("'{}' holds no run: 'voussoir run' makes one", folder.string()));

  // a complete run may be kept where nothing can be written
  if (holds_results(folder) && !holds_checkpoints(folder)) return already_complete(arguments);
  const FolderLock lock(folder);
  if (holds_results(folder)) {
    remove_checkpoints(folder);
    return already_complete(arguments);
  }
  RunOptions options = read_options(folder);
  if (arguments.threads) options.threads = *arguments.threads;
  LoadedScene scene = load_scene(folder / "scene.toml", {}, options.threads);
  end_with(options.until, scene);
  if (scene.hash != options.scene_hash)
    throw BadInput(
        fmt::format("'{}' is not the scene that this run began with: put it back, or start again with "
                    "'voussoir run'",
                    (folder / "scene.toml").string()));
  refuse_inputs(folder, resume_outputs(), scene.files);
  if (!holds_checkpoints(folder) && options.rounds.empty()) options.origins.clear();  // nothing of theirs is left
  if (add_origin(options.origins, this_origin())) write_options(folder, options);
  return carry_out(scene, {folder, options, arguments.quiet});
}

}  // namespace voussoir
