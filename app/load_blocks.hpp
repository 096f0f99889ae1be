// For those who ask a scene for its blocks alone.
#pragma once

#include "app/run_scene.hpp"

namespace voussoir {

// As load_scene, of a scene that need not have a stage.
LoadedScene load_blocks(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

}  // namespace voussoir
