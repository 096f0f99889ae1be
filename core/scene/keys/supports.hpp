// The tables of supports that stages install, and their rows in the top of a scene.
#pragma once

#include "core/scene/keys/tables.hpp"

namespace voussoir::keys {

std::vector<KeyRow> support_rows();
std::vector<KeyTable> support_keys();

}  // namespace voussoir::keys
