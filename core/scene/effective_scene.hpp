// The scene that was run, overrides included, as a file that can be run again.
#pragma once

#include <string>

#include "core/scene/node.hpp"

namespace voussoir {

// TOML that reads back to the same tree. Keys are sorted, comments are dropped.
std::string toml_text(const Node& scene);

// one value as written after `key =`, tables and lists on one line, in the form of an override
std::string toml_value(const Node& node);

}  // namespace voussoir
