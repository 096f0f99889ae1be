// What two scenes must have in common for a run of the one to begin at the end of a run of the other.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

struct SharedStages {
  std::vector<std::string> monitors;  // the same in both, so that the rows of the other hold for this one
  std::vector<std::string> own;       // joint properties of this scene that nothing used within these stages
};

// The part of a scene that the first `stages` stages depend on, as a tree: without title, monitors, output, later
// stages, bolts that none of these stages installs and joint properties that no joint uses.
Node shared_part(const Scene& scene, int stages);

// Throws SceneError at the first thing on which the first stages of the two depend and which differs; `name` stands for
// the other scene in it.
SharedStages require_shared(const Scene& scene, const Scene& other, const std::string& name, int stages);

}  // namespace voussoir
