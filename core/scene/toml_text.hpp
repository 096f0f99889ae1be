// TOML text to a tree; the only file that uses the TOML library.
#pragma once

#include <string_view>

#include "core/scene/node.hpp"

namespace voussoir {

// Refuses a text that is larger than a scene may be, before memory is allocated for it.
void require_sane_size(std::string_view text, const std::string& source);

// the whole text of a scene file; syntax errors name the line
Node parse_toml(std::string_view text, const std::shared_ptr<const std::string>& source);

// One value as written after `key =`; a bare word is a text. Every node gets the given place.
Node parse_toml_value(std::string_view text, const Place& place);

}  // namespace voussoir
