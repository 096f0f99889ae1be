// `--set key=value`: changes a scene's tree before it is read.
#pragma once

#include <string>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

// "joints.A.dip=65": tables of a list by their name or, counted from 1, their number. A legal key that the file does
// not state is added; an unknown key or name is a SceneError that lists the existing ones. Keys that it states under an
// earlier name get the present one, and a line in `renamed`.
void apply_override(Node& scene, const std::string& text, const std::string& file, std::vector<std::string>& renamed);

}  // namespace voussoir
