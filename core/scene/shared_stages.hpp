// Stages that two scenes must have in common, for a run of the one to start from the end of a run of the other.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

struct SharedStages {
  std::vector<std::string> monitors;  // the same in both, so that the rows of the other are valid for this one
  std::vector<std::string> own;       // joint properties of this scene that are not used in these stages
};

// The part of a scene that the first `stages` stages depend on, as a tree: without title, monitors, output, later
// stages, bolts that none of these stages installs, and unused joint properties.
Node shared_part(const Scene& scene, int stages);

// Throws SceneError at the first difference on which the first stages depend; `name` is the other scene in its message.
SharedStages require_shared(const Scene& scene, const Scene& other, const std::string& name, int stages);

}  // namespace voussoir
