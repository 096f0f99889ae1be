// `voussoir slice`.
#pragma once

#include <filesystem>

#include "app/base/exit_codes.hpp"
#include "app/base/scene_arguments.hpp"

namespace voussoir {

struct SliceArguments {
  SceneArguments scene;
  std::filesystem::path out;
  bool view = false;                              // view.html
  bool report = false;                            // on the joint sets, and joints.csv
  bool planes = false, stl = false, obj = false;  // further formats of the blocks
  bool overwrite = false;
};

// cuts the blocks and writes them with a table of their sizes; on request in other formats, and a report on the joints
ExitCode slice_command(const SliceArguments& arguments);

}  // namespace voussoir
