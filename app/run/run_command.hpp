// `voussoir run` and `resume`. Returns its exit code; throws SceneError, BadInput, FolderInUse or OutputError, as all
// commands do.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/base/exit_codes.hpp"
#include "app/base/scene_arguments.hpp"

namespace voussoir {

struct RunArguments {
  SceneArguments scene;
  std::filesystem::path out;  // empty: results/<name of the scene's file>
  int threads = 1;
  std::optional<long long> checkpoint_steps;  // of RunOptions where they are stated
  std::optional<double> checkpoint_seconds;
  std::filesystem::path begin;  // folder of another run, at whose end this one begins; empty: at the start
  std::string until;            // the stage after which it ends, its state kept; empty: the last
  bool keep = false;            // the state at the end
  bool budget = false;          // as if the scene stated accuracy.budget
  bool view = false;            // as if the scene stated output.view
  bool overwrite = false;
  bool quiet = false;
};

struct ResumeArguments {
  std::filesystem::path folder;
  std::optional<int> threads;  // as before where they are not stated
  bool quiet = false;
};

// runs a scene and writes results.json, history.csv, scene.toml and ParaView's files
ExitCode run_command(const RunArguments& arguments);

// continues with a run that was interrupted, from its last checkpoint or from its begin; a complete one is left as it
// is
ExitCode resume_command(const ResumeArguments& arguments);

}  // namespace voussoir
