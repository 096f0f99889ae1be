#pragma once
// The parameters of a scene as a table, with units and meanings of the list of all keys.
#include <filesystem>
#include <string>

namespace voussoir::reports {

// Gravity, density, directions of joints (of at most eight) and properties of joints of a scene.toml; `keys` is the
// list that `voussoir docs` writes, without which units and meanings stay empty. Empty without a scene; throws
// std::runtime_error for one that is not TOML.
std::string parameter_table(const std::filesystem::path& scene, const std::filesystem::path& keys);

}  // namespace voussoir::reports
