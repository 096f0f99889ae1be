// The friction divided in a search for a factor of safety.
#pragma once

#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// A factor of safety divides the friction that its own stage states, else that of the joint_properties. If an earlier
// stage has given a joint of the search another angle, so that either could be meant, and the search's stage states
// none, the scene is refused (SceneError), with both angles and the line to add.
void check_divided_strength(const std::vector<PropertiesSpec>& properties, const std::vector<StageSpec>& stages);

}  // namespace voussoir
