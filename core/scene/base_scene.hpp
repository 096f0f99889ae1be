// `base = "other.toml"`: a scene that states only the differences from another one.
#pragma once

#include <filesystem>
#include <vector>

#include "core/scene/node.hpp"
#include "core/scene/scene_files.hpp"

namespace voussoir {

// The scene's tree merged over its base's, and that over its own base's. Tables are merged key by key, tables of a list
// by their name (one of another kind or method replaces the base's); every other value replaces the base's.
// The base is in the scene's folder or below.
Node with_base(Node scene, const std::filesystem::path& folder, FilesRead& read);

// One tree over another, by the same rules.
void lay_over(Node& base, const Node& scene);

}  // namespace voussoir
