// [[repeat]]: blocks, joints and bolts that are stated once and replaced by numbered copies before anything else is
// read.
#pragma once

#include <string>

#include "core/scene/node.hpp"

namespace voussoir {

// whether an override ("blocks.stone-3.density=…") addresses a copy that does not exist yet
bool addresses_copy(const Node& scene, const std::string& override_text);

// Replaces each table that [[repeat]] names by its copies NAME-1, NAME-2, …, merges tables that the scene states under
// such names over them, and removes [[repeat]] from the tree. A scene without it is unchanged. Repeated tables are
// checked against the key table first. Throws SceneError.
void repeat_tables(Node& scene);

}  // namespace voussoir
