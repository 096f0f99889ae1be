// What the page of joints shows, by viewer/src/report/joints.js. `voussoir slice --report` keeps it as joints.json
// beside its page; the page of `voussoir import` has it without blocks and without quantities.
//
//   schema, schema_version, title, program, input_hash (of a slice), dimension, domain (m³, in the plane m²)
//   notes     sentences on how it was measured
//   report    of an import: the lines that it prints
//   sets      name (empty: joints without a set), drawn (else listed one by one), normals,
//             of a slice also rows (quantity, unit, stated, measured, error), frequency_per_m, spacings_m
//   blocks    of a slice: count, total, smallest, largest, shares, by_number, by_size
// Curves are points of a cumulative distribution: a value and the share up to it, %.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace voussoir {

inline constexpr const char *joints_data_file = "joints.json", *joints_schema = "voussoir.joints";

// unit normals, rounded as a figure needs them: to a tenth of a second of arc
nlohmann::ordered_json short_normals(const std::vector<std::vector<double>>& normals);

// as text of a file or a page: bytes that are no UTF-8 are replaced
std::string json_text(const nlohmann::ordered_json& data);

}  // namespace voussoir
