// `voussoir limit`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/base/scene_arguments.hpp"

namespace voussoir {

struct LimitArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_limit
  std::string load;                     // gravity, left, right, applied; empty: the critical friction is sought
  std::vector<std::string> properties;  // whose friction is sought; none: all
  bool factor = false;                  // the factor of safety is sought
  std::vector<std::string> joints;      // of whose joint_properties; none: of all
  bool cohesion = false;                // joints have the cohesion that their properties state
  bool overwrite = false;
  bool quiet = false;
};

// the collapse load or critical friction of a scene in the plane by rigid-block limit analysis, with its forces and
// mechanism
ExitCode limit_command(const LimitArguments& arguments);

}  // namespace voussoir
