#include "app/modes/modes_command.hpp"

#include <fmt/format.h>

#include <string>

#include "app/base/arguments.hpp"
#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/base/progress_line.hpp"
#include "app/base/run_scene.hpp"
#include "app/modes/modes_files.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/view/page.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/view.hpp"
#include "core/run/stage_in_force.hpp"
#include "core/scene/node.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr int most_modes = 10000;

struct ModesArguments {
  SceneArguments scene;
  std::string stage;
  int number = 10;
  fs::path out;
  int threads = 1;
  bool view = false;
  bool overwrite = false;
  bool quiet = false;
};

fs::path folder_of(const ModesArguments& arguments) {
  if (!arguments.out.empty()) return arguments.out;
  return fs::path("results") / (arguments.scene.scene.stem().string() + "_modes");
}

int chosen_stage(const std::vector<StagePlan>& stages, const std::string& name) {
  if (const std::optional<int> place = stage_of_modes(stages, name)) return *place;
  if (name.empty())
    throw BadInput("no stage of the scene ends at rest: add one of kind = \"settle\", or name a stage with --stage");
  std::vector<std::string> names;
  for (const StagePlan& plan : stages)
    names.push_back(plan.name);
  throw BadInput(
      fmt::format("--stage {}: no stage of the scene has this name; {}", one_line(name, 60), suggestion(name, names)));
}

template <int Dim>
ExitCode answer(const ModesArguments& arguments, const LoadedScene& scene, Prepared<Dim> prepared) {
  const int stage = chosen_stage(prepared.stages, arguments.stage);
  prepared.last_stage = stage;
  const fs::path folder = folder_of(arguments);
  std::vector<std::string> files = mode_files(arguments.number);
  files.insert(files.begin(), "modes.json");
  files.push_back("modes.pvd");
  if (arguments.view) files.insert(files.end(), {view_file, page_file});
  const ClaimedFolder claim(folder, {"modes", files}, scene.files, arguments.overwrite);
  tell_remarks(*scene.stated);
  if (!arguments.quiet) tell_warnings(scene.warnings);

  Progress<Dim> progress = initial_progress(prepared);
  {
    ProgressLine line(!arguments.quiet);
    note_interruptions();
    Watcher<Dim> watcher;
    watcher.progress = [&](const ProgressReport& report) { line.show(report); };
    watcher.pause = [](const Progress<Dim>&) { return interruption() != 0; };
    if (!simulate(prepared, progress, watcher)) return ended_by(interruption());
  }
  if (progress.results.outcome != Outcome::done) {
    tell("voussoir: no modes, as the run to stage {} is not done: {}", prepared.stages[stage].name,
         progress.results.message);
    return exit_code(progress.results.outcome);
  }
  const Modes<Dim> modes = find_modes(prepared, progress, stage, arguments.number);
  if (!modes.reason.empty()) throw BadInput("no modes: " + modes.reason);
  const Model<Dim> model = model_after(prepared, stage + 1);
  write_modes(modes, model, progress.state, prepared, modes_json(modes, model, scene), arguments.view, folder);
  if (arguments.quiet) return ExitCode::done;
  fmt::print("{}modes at the end of stage {}\n{}", scene.title.empty() ? "" : scene.title + " - ", modes.stage,
             modes_text(modes, model));
  for (const std::string& doubt : doubts_of(modes, model))
    fmt::print("  {}\n", doubt);
  fmt::print("results: {}\n", folder.string());
  return ExitCode::done;
}

ExitCode modes_command(const ModesArguments& arguments) {
  const LoadedScene scene = load_scene(arguments.scene.scene, arguments.scene.overrides, arguments.threads);
  return std::visit([&](const auto& prepared) { return answer(arguments, scene, prepared); }, scene.prepared);
}

}  // namespace

void add_modes(CLI::App& program, Action& action) {
  const auto [command, arguments] = add_command(
      program, action, "modes", "lowest natural frequencies and mode shapes of a state at rest", modes_command);
  add_scene(command, arguments.scene);
  command
      ->add_option("--stage", arguments.stage,
                   "run to the end of this stage, whose state at rest swings (default: the last that settles)")
      ->check(plain_text());
  command->add_option("--number", arguments.number, "of modes, the lowest first (default: 10)")
      ->check(CLI::Range(1, most_modes));
  add_out(command, arguments.out, "folder of the results (default: results/<scene>_modes)");
  add_threads(command, arguments.threads);
  command->add_flag("--view", arguments.view,
                    "write the interactive page view.html, in which each mode is a stage of one swing");
  add_overwrite(command, arguments.overwrite);
  command->add_flag("--quiet", arguments.quiet, "no progress, no warnings and no summary");
}

}  // namespace voussoir
