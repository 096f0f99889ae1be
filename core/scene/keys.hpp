// The table of all keys of a scene, its rows in keys/. The reader refuses everything else; the documentation prints it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/key_row.hpp"
#include "core/scene/node.hpp"

namespace voussoir {

std::span<const KeyRow> key_rows();
std::span<const KeyRow> key_rows(std::string_view group);

const KeyRow* find_row(const Groups& groups, std::string_view key);
std::vector<std::string> keys_of(const Groups& groups);

// whether the key applies in this table, by the value of the key that its row's condition names
bool key_applies(const Node& table, const Groups& groups, const KeyRow& row);

// "be greater than 0 and at most 1", "lie between 0 and 90 deg"
std::string range_text(const KeyRow& row);

// "500 to 8000 kg/m³", "0 or 1.6 to 90 deg", "at most 100 m/s"; empty when everything is plausible
std::string plausible_text(const KeyRow& row);

// Checks every value of a tree against the table; throws SceneError at the first that does not fit.
void check_keys(const Node& scene);

// why the key of an earlier version at this path is gone; empty: there was none
std::string_view former_key(std::string_view path);

// 2 or 3, checked
int scene_dimension(const Node& scene);

}  // namespace voussoir
