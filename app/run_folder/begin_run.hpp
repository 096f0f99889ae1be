// A run that begins at the end of another with the same blocks and first stages, e.g. support variants of one initial
// state.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/run/progress.hpp"

namespace voussoir {

using AnyProgress = std::variant<Progress<2>, Progress<3>>;

// The last state of the folder's run, as progress of this scene (core/run/begin.hpp). `remarks` gains doubts about it.
// Throws BadInput if the folder has no such state, SceneError if this scene differs before it, FolderInUse while the
// folder is being written.
AnyProgress progress_at_end(const std::filesystem::path& folder, const LoadedScene& scene,
                            std::vector<std::string>& remarks);

// the files that it reads in the folder
std::vector<std::filesystem::path> files_begun_with(const std::filesystem::path& folder);

}  // namespace voussoir
