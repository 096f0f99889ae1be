// The scene a command works on, and the keys stated on the command line.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace voussoir {

struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  // key=value
};

}  // namespace voussoir
