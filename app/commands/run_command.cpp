#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/bad_input.hpp"
#include "app/commands/commands.hpp"
#include "app/commands/plausibility.hpp"
#include "app/commands/progress_line.hpp"
#include "app/run_scene.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/paraview.hpp"
#include "core/output/results_json.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

fs::path results_folder(const RunArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path("results") / arguments.scene.scene.stem();
}

void refuse_to_overwrite(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder / "results.json", error))
    throw BadInput(
        fmt::format("'{}' holds results: choose another folder with --out, or add --overwrite", folder.string()));
}

bool is_our_frame(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.extension() == ".vtp" && (name.starts_with("blocks_") || name.starts_with("contacts_"));
}

// only what a run writes; results.json first, so that a folder without it holds nothing complete
void remove_old_results(const fs::path& folder) {
  std::error_code error;
  for (const char* name : {"results.json", "history.csv", "scene.toml", "blocks.pvd", "contacts.pvd"})
    if (!fs::remove(folder / name, error) && error) throw OutputError(folder / name, error.message());
  for (const auto& entry : fs::directory_iterator(folder / "frames", error))
    if (is_our_frame(entry.path())) fs::remove(entry.path(), error);
}

RunRecord record_of(const LoadedScene& scene, const std::vector<std::string>& warnings, int threads) {
  RunRecord record;
  record.warnings = warnings;
  record.title = scene.title;
  record.dimension = scene.dimension;
  record.input_hash = scene.hash;
  record.features = features();
  record.threads = threads;
  return record;
}

// an error bar needs two digits, and its value as many places
std::string value_text(const Value& value) {
  const std::string unit = value.unit == "1" ? "" : " " + value.unit;
  if (!std::isfinite(value.value)) return "not a finite number" + unit;
  if (!value.error_bar || *value.error_bar <= 0) return fmt::format("{:.6g}{}", value.value, unit);
  const int places = std::clamp(1 - static_cast<int>(std::floor(std::log10(*value.error_bar))), 0, 15);
  return fmt::format("{:.{}f} ± {:.{}f}{}", value.value, places, *value.error_bar, places, unit);
}

void print_summary(const LoadedScene& scene, const Results& results, const fs::path& folder) {
  const std::string message = results.message.empty() ? "" : ": " + results.message;
  fmt::print("{}{}{}\n", scene.title.empty() ? "" : scene.title + " - ", outcome_name(results.outcome), message);
  std::size_t width = 0;
  for (const auto& [name, value] : results.values)
    width = std::max(width, name.size());
  for (const auto& [name, value] : results.values)
    fmt::print("  {:<{}}  {}{}\n", name, width, value_text(value), value.rule.empty() ? "" : "  (" + value.rule + ")");
  for (const StageResult& stage : results.stages)
    fmt::print("  stage {}: {} after {} steps, {:.4g} s simulated\n", stage.name, stage.ended, stage.steps, stage.time);
  const Counters& counters = results.counters;
  fmt::print("  {} steps, {} contact evaluations, {}\n", counters.steps, counters.contact_evaluations,
             duration_text(results.seconds));
  fmt::print("results: {}\n", folder.string());
}

}  // namespace

ExitCode exit_code(Outcome outcome) {
  switch (outcome) {
    case Outcome::done:
      return ExitCode::done;
    case Outcome::incomplete:
      return ExitCode::incomplete;
    case Outcome::failed:
      return ExitCode::numerical;
  }
  return ExitCode::numerical;
}

ExitCode run_command(const RunArguments& arguments) {
  // nothing is written before the whole scene is known to be good
  const LoadedScene scene = load_scene(arguments.scene.scene, arguments.scene.overrides, arguments.threads);
  const std::vector<std::string> warnings = assess(scene).warnings;
  if (!arguments.quiet)
    for (const std::string& warning : warnings)
      fmt::print(stderr, "voussoir: warning: {}\n", warning);
  const fs::path folder = results_folder(arguments);
  if (!arguments.overwrite) refuse_to_overwrite(folder);
  prepare_folder(folder);
  remove_old_results(folder);
  write_file(folder / "scene.toml", scene.text);

  // run, with a frame whenever the scene asks for one
  FrameSeries frames{folder};
  ProgressLine progress(!arguments.quiet);
  SceneWatcher watcher;
  watcher.progress = [&](const ProgressReport& report) { progress.show(report); };
  watcher.frame_2d = [&](const Model<2>& model, const State<2>& state, double time) {
    write_frame(frames, model, state, time);
  };
  watcher.frame_3d = [&](const Model<3>& model, const State<3>& state, double time) {
    write_frame(frames, model, state, time);
  };
  const Results results = simulate_scene(scene, watcher);
  progress.clear();

  // results.json comes last: where it is, everything is
  write_history_csv(folder / "history.csv", results.history);
  write_results_json(folder / "results.json", results, record_of(scene, warnings, arguments.threads));
  if (!arguments.quiet) print_summary(scene, results, folder);
  if (arguments.quiet && results.outcome != Outcome::done)
    fmt::print(stderr, "voussoir: {}: {}\n", outcome_name(results.outcome), results.message);
  return exit_code(results.outcome);
}

}  // namespace voussoir
