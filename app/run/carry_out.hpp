// A run in its folder, from its last checkpoint or from its begin to results.json, and again with refined settings as
// long as the scene requests it.
#pragma once

#include <filesystem>
#include <string>

#include "app/base/exit_codes.hpp"
#include "app/base/run_scene.hpp"
#include "app/run_folder/run_folder.hpp"

namespace voussoir {

struct RunJob {
  std::filesystem::path folder;  // holds scene.toml and the options
  RunOptions options;
  bool quiet = false;
};

ExitCode carry_out(const LoadedScene& stated, RunJob job);

// Ends the scene with this stage, if one is named. Throws BadInput if there is none of this name.
void end_with(const std::string& stage, LoadedScene& scene);

}  // namespace voussoir
