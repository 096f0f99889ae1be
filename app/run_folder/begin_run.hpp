// A run that begins at the end of another with the same blocks and first stages: many supports share one generation.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "app/base/run_scene.hpp"
#include "core/run/progress.hpp"

namespace voussoir {

using AnyProgress = std::variant<Progress<2>, Progress<3>>;

// Where the run of the folder has left off, as progress of this scene (core/run/begin.hpp). `remarks` gains what is
// doubtful. Throws BadInput where the folder holds no such end, SceneError where this scene is not the same up to
// there, FolderInUse while the folder is being written.
AnyProgress progress_at_end(const std::filesystem::path& folder, const LoadedScene& scene,
                            std::vector<std::string>& remarks);

// what that reads in the folder
std::vector<std::filesystem::path> files_begun_with(const std::filesystem::path& folder);

}  // namespace voussoir
