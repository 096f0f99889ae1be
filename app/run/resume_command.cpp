#include "app/run/resume_command.hpp"

#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "app/base/arguments.hpp"
#include "app/run/carry_out.hpp"
#include "app/run_folder/origin.hpp"
#include "app/run_folder/run_folder.hpp"
#include "core/base/bad_input.hpp"

namespace voussoir {
namespace {

struct ResumeArguments {
  std::filesystem::path folder;
  std::optional<int> threads;  // as before if not stated
  bool quiet = false;
};

ExitCode already_complete(const ResumeArguments& arguments) {
  if (!arguments.quiet) fmt::print("'{}' is complete: nothing to do\n", arguments.folder.string());
  return ExitCode::done;
}

ExitCode resume_command(const ResumeArguments& arguments) {
  const std::filesystem::path& folder = arguments.folder;
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw BadInput(fmt::format("'{}' is not a folder: name the folder of an interrupted run", folder.string()));
  if (!holds_results(folder) && !holds_unfinished_run(folder))
    throw BadInput(fmt::format("'{}' contains no run: 'voussoir run' makes one", folder.string()));

  // the folder of a complete run may be read-only
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
    throw BadInput(other_scene(folder / "scene.toml", options.scene_hash, "start again with 'voussoir run'"));
  refuse_inputs(folder, resume_outputs(), scene.files);
  if (!holds_checkpoints(folder) && options.rounds.empty())
    options.origins.clear();  // no state of earlier processes is left
  if (add_origin(options.origins, this_origin())) write_options(folder, options);
  return carry_out(scene, {folder, options, arguments.quiet});
}

}  // namespace

void add_resume(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "resume", "continue an interrupted run", resume_command);
  command->add_option("folder", arguments.folder, "the folder of its results")
      ->required()
      ->check(plain_text())
      ->type_name("FOLDER");
  command->add_option("--threads", arguments.threads, "number of threads (default: as before)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", arguments.quiet, "no progress and no summary");
}

}  // namespace voussoir
