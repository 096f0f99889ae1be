// TOML text to a tree; the only place that knows the TOML library.
#pragma once

#include <string_view>

#include "core/scene/node.hpp"

namespace voussoir {

// Refuses a text that claims more than a scene may hold, before memory is taken for it.
void require_sane_size(std::string_view text, const std::string& source);

// the whole text of a scene file; syntax errors name the line
Node parse_toml(std::string_view text, const std::shared_ptr<const std::string>& source);

// One value as it stands after `key =`; a bare word is a text. Every node gets the given place.
Node parse_toml_value(std::string_view text, const Place& place);

}  // namespace voussoir
