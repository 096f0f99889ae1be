// The scene that was run, overrides included, as a file that can be run again.
#pragma once

#include <string>

#include "core/scene/node.hpp"

namespace voussoir {

// TOML that reads back to the same tree. Keys are sorted, comments are gone.
std::string toml_text(const Node& scene);

// one value as it stands after `key =`, tables and lists on one line: what an override takes
std::string toml_value(const Node& node);

}  // namespace voussoir
