// The table of derivatives as text, CSV, JSON and a figure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/derivatives/derivative_table.hpp"

namespace voussoir {

inline constexpr const char* derivatives_csv_file = "derivatives.csv";
inline constexpr const char* derivatives_svg_file = "derivatives.svg";

// at most 20 lines of rows, and why there is no table if there is none
std::string derivatives_text(const DerivativeTable& table);
std::string derivatives_csv(const DerivativeTable& table);
// the changes of the answer by usual changes of the keys, as bars: a tornado diagram
std::string derivatives_svg(const DerivativeTable& table);
// a JSON file's text with the object `derivatives` added at its end
std::string with_derivatives(const std::string& json, const DerivativeTable& table);

void write_derivatives(const DerivativeTable& table, const std::filesystem::path& folder);

}  // namespace voussoir
