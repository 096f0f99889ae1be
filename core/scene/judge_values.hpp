// Stated values of a scene that look like a mistake of unit or sign. None of them is an error: each warning is one line
// with file, line, key and value.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Every value outside the usual range of its key (scene/keys.hpp); then checks of several values together: the
// direction of gravity, swapped stiffnesses, sizes of blocks, coordinates next to zero, planes and joints that miss the
// domain.
template <int Dim>
std::vector<std::string> judge_values(const Scene& scene, const Prepared<Dim>& prepared);

// "all 60 joints of 'joints.csv' are infinite …; they cut 9096 blocks", if a table of joints states no size. Empty for
// other scenes, and if infinite joints are intended.
std::string endless_joints(const Scene& scene, std::size_t blocks);

// for each of the model's properties, whether a face that may meet another has them
template <int Dim>
std::vector<bool> properties_of_faces(const Model<Dim>& model);

}  // namespace voussoir
