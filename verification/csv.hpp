#pragma once
// Comma-separated text as in RFC 4180: quoted fields may hold commas, doubled quotes and line ends.
#include <string>
#include <string_view>
#include <vector>

namespace voussoir::verification {

// One line without its end; fields are quoted only where they must be.
std::string csv_line(const std::vector<std::string>& fields);

// All records, the header line included; empty lines are left out. Throws std::runtime_error for an open quote.
std::vector<std::vector<std::string>> parse_csv(std::string_view text);

}  // namespace voussoir::verification
