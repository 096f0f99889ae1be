// Files of joints and blocks that a scene names: read as the tables that the scene could have stated itself, so that
// checks, overrides, the scene's hash and a resumed run treat both alike.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

// Files that were read besides the scene's own text, and remarks on them for the user (file, line, text).
struct FilesRead {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> remarks;
  std::vector<std::string> renamed{};  // keys that were stated under an earlier name (core/scene/renamed_keys.hpp)
};

// The file that a scene names under a key: a regular file in its folder, links resolved. SceneError otherwise.
std::filesystem::path file_beside(const Node& stated, std::string_view key, const std::filesystem::path& folder);

// [[joints]] of `joints_file` (CSV) and [[blocks]] of `blocks_file` (CSV of planes, STL, OBJ); every value has its
// place in the file. SceneError names file, line, column and reason.
Node tables_of_files(const Node& scene, const std::filesystem::path& folder, FilesRead& read);

}  // namespace voussoir
