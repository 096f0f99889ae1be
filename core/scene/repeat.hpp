// [[repeat]]: blocks, joints and bolts that are stated once and made into numbered copies before anything else is read.
#pragma once

#include <string>

#include "core/scene/node.hpp"

namespace voussoir {

// whether an override ("blocks.stone-3.density=…") addresses a copy that is yet to be made
bool addresses_copy(const Node& scene, const std::string& override_text);

// Replaces each table that [[repeat]] names by its copies NAME-1, NAME-2, …, lays tables that the scene states under
// such names over them, and takes [[repeat]] out of the tree. A scene without it stays as it is. What is repeated is
// held against the key table first. Throws SceneError.
void repeat_tables(Node& scene);

}  // namespace voussoir
