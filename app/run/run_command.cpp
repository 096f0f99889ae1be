#include "app/run/run_command.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <variant>

#include "app/base/arguments.hpp"
#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/check/assess.hpp"
#include "app/derivatives/derivative_files.hpp"
#include "app/run/carry_out.hpp"
#include "app/run/error_budget.hpp"
#include "app/run/memory_needed.hpp"
#include "app/run/run_derivative_table.hpp"
#include "app/run_folder/begin_run.hpp"
#include "app/run_folder/origin.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "core/scene/toml_text.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  SceneArguments scene;
  fs::path out;  // empty: results/<name of the scene's file>
  int threads = 1;
  std::optional<long long> checkpoint_steps;  // of RunOptions if stated
  std::optional<double> checkpoint_seconds;
  fs::path begin;              // folder of another run, at whose end this one begins; empty: none
  std::string until;           // the stage after which it ends, its state kept; empty: the last
  bool keep = false;           // the state at the end
  bool budget = false;         // as if the scene stated accuracy.budget
  bool view = false;           // as if the scene stated output.view
  bool derivatives = false;    // of the answer, by the numbers of the scene
  std::string derivatives_of;  // a monitored value at rest; empty: the default answer
  bool overwrite = false;
  bool quiet = false;
};

fs::path results_folder(const RunArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path("results") / arguments.scene.scene.stem();
}

RunOptions options_of(const RunArguments& arguments) {
  RunOptions options;
  options.threads = arguments.threads;
  if (arguments.checkpoint_steps) options.checkpoint_steps = *arguments.checkpoint_steps;
  if (arguments.checkpoint_seconds) options.checkpoint_seconds = *arguments.checkpoint_seconds;
  options.until = arguments.until;
  options.keep = arguments.keep || !arguments.until.empty();
  return options;
}

bool wants_derivatives(const RunArguments& arguments) {
  return arguments.derivatives || !arguments.derivatives_of.empty();
}

LoadedScene scene_of(const RunArguments& arguments) {
  std::vector<std::string> overrides = arguments.scene.overrides;
  if (arguments.budget) overrides.push_back("accuracy.budget=true");
  if (arguments.view) overrides.push_back("output.view=true");
  LoadedScene scene = load_scene(arguments.scene.scene, overrides, arguments.threads);
  if (wants_budget(scene) && !(arguments.until.empty() && arguments.begin.empty()))
    throw BadInput(
        fmt::format("{}: a budget's runs cover all stages; leave it out, or leave out --budget and accuracy.budget",
                    arguments.until.empty() ? "--begin" : "--until"));
  end_with(arguments.until, scene);
  if (wants_derivatives(arguments) && !(arguments.until.empty() && arguments.begin.empty()))
    throw BadInput(fmt::format("{}: derivatives are those of all stages; leave it out, or leave out --derivatives",
                               arguments.until.empty() ? "--begin" : "--until"));
  return scene;
}

// The state at which a run begins if not at the start. `inputs` gains the files read for it, `options` its origins.
std::optional<AnyProgress> begun_at(const fs::path& other, const LoadedScene& scene, std::vector<fs::path>& inputs,
                                    RunOptions& options) {
  if (other.empty()) return std::nullopt;
  std::vector<std::string> remarks;
  AnyProgress begun = progress_at_end(other, scene, remarks);
  tell_warnings(remarks);
  options.origins = read_options(other).origins;
  for (const fs::path& file : files_begun_with(other))
    inputs.push_back(file);
  return begun;
}

// The first checkpoint of a run that begins at another's end: from here on it no longer needs that folder.
void begin_in(const fs::path& folder, const std::string& scene_hash, const AnyProgress& begun) {
  std::visit([&](const auto& progress) { save_checkpoint(folder, progress, scene_hash); }, begun);
}

bool uses_newton(const LoadedScene& scene) {
  return std::visit([](const auto& prepared) { return asks_for_newton(prepared.settings.statics, prepared.stages); },
                    scene.prepared);
}

ExitCode run_command(const RunArguments& arguments) {
  // nothing is written before the complete scene is known to be valid
  RunOptions options = options_of(arguments);
  LoadedScene scene = scene_of(arguments);
  require_sane_size(scene.text, arguments.scene.scene.string() + " with all that it names");  // it is read again
  options.scene_hash = scene.hash;
  Assessment assessment = assess(scene);
  options.warnings = std::move(assessment.warnings);
  require_memory(arguments.scene.scene.string(), assessment.forecast.memory, available_memory(), uses_newton(scene));
  if (!arguments.quiet) tell_warnings(options.warnings);

  std::vector<fs::path> inputs = scene.files;
  std::optional<AnyProgress> begun = begun_at(arguments.begin, scene, inputs, options);
  add_origin(options.origins, this_origin());
  const bool repeats = wants_budget(scene) || wants_stiffness_bar(scene);
  const bool differentiates = wants_derivatives(arguments);
  if (differentiates) require_answer(scene, arguments.derivatives_of);
  if (!repeats && !differentiates) scene.stated.reset();

  // the folder is locked, and records the run before the first step
  const fs::path folder = results_folder(arguments);
  Outputs outputs = run_outputs();
  if (repeats) outputs.folders = budget_folders(scene);
  if (differentiates) outputs.files.insert(outputs.files.end(), {derivatives_csv_file, derivatives_svg_file});
  const ClaimedFolder claim(folder, outputs, inputs, arguments.overwrite);
  if (begun) begin_in(folder, scene.hash, *begun);
  begun.reset();
  write_file(folder / "scene.toml", scene.text);
  write_options(folder, options);
  const ExitCode ended = carry_out(scene, {folder, options, arguments.quiet});
  if (differentiates && ended == ExitCode::done && interruption() == 0)
    add_run_derivatives(scene, arguments.derivatives_of, folder, arguments.quiet);
  return ended;
}

}  // namespace

void add_run(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "run", "run a scene and write its results", run_command);
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of the results (default: results/<scene>)");
  add_threads(command, arguments.threads);
  command
      ->add_option("--checkpoint-steps", arguments.checkpoint_steps,
                   "steps between checkpoints (default: by time alone)")
      ->check(finite(0, largest_argument));
  command
      ->add_option("--checkpoint-seconds", arguments.checkpoint_seconds,
                   "wall clock between checkpoints; 0: none (default: 300)")
      ->check(finite(0, largest_argument));
  command
      ->add_option("--until", arguments.until,
                   "end after this stage and keep its last state, so that other runs can begin there")
      ->check(plain_text());
  command->add_flag("--keep", arguments.keep, "keep the state at the end, so that other runs can begin there");
  command
      ->add_option(
          "--begin", arguments.begin,
          "folder of a run of the same blocks and first stages that kept its end: begin there, with the results "
          "of the whole run")
      ->check(plain_text())
      ->type_name("FOLDER");
  command->add_flag(
      "--budget", arguments.budget,
      "error budget: vary numerical settings one at a time in additional runs; every value then lists their "
      "effects, and its error bar covers them (accuracy.budget)");
  command->add_flag("--derivatives", arguments.derivatives,
                    "what moves the answer of the last search, or else of the first monitored displacement: its "
                    "derivative by every number of the scene, with error bar, from Newton's method's own tangent "
                    "(derivatives.csv, derivatives.svg)");
  command->add_option("--derivatives-of", arguments.derivatives_of, "the same of this monitored value at the end")
      ->check(plain_text());
  command->add_flag("--view", arguments.view,
                    "write the interactive 3-D page view.html, with the frames that ParaView would get "
                    "(output.view)");
  add_overwrite(command, arguments.overwrite);
  command->add_flag("--quiet", arguments.quiet, "no progress and no summary");
}

}  // namespace voussoir
