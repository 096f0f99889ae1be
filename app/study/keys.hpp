// The keys of a study, and the reading of its tables: strict, with line and repair.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/node.hpp"

namespace voussoir {

inline constexpr double largest_study_number = 1e15;

// `kind` is the table's name in the documentation
void refuse_unknown_keys(const Subject& table, std::string_view kind);

const std::string& text_of(const Subject& table, const char* key, const std::string& rule);
// none if there is no such key
std::vector<std::string> texts_of(const Subject& table, const char* key, const std::string& rule);
std::optional<double> number_of(const Subject& table, const char* key);
std::vector<Subject> tables_of(const Subject& table, const char* key);
// under `set`
std::vector<std::string> read_overrides(const Subject& table);
// under `values`, as --set takes them
std::vector<std::string> read_values(const Subject& table);

// every key of a study, in Markdown, from the table by which the reader refuses others
std::string study_documentation();

}  // namespace voussoir
