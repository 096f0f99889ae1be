// `voussoir export`.
#pragma once

#include <filesystem>
#include <string>

#include "app/base/exit_codes.hpp"
#include "app/base/scene_arguments.hpp"

namespace voussoir {

struct ExportArguments {
  SceneArguments scene;
  std::string format;         // 3dec, yade
  std::filesystem::path out;  // a file
  bool overwrite = false;
};

// a scene's blocks, joints and properties as text for another program
ExitCode export_command(const ExportArguments& arguments);

}  // namespace voussoir
