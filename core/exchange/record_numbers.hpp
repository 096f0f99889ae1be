// Numbers of records, which may touch one another.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voussoir {

// The length of the decimal number at the begin of a text, 0 if there is none: a sign, digits with or without a point,
// and an exponent after E or D.
std::size_t record_number_length(std::string_view text);

// The value of such a number. Throws FileFault if it is beyond the range of doubles.
double record_number(std::string_view number, int line, int column);

// Appends the numbers of a line, between which there may be blanks, tabs, commas, or nothing before a sign or a point.
// Throws FileFault for anything else.
void add_record_numbers(std::string_view line, int number, std::vector<double>& values);

// the reason for a word that is no number, with its repair
std::string no_record_number(std::string_view word);

}  // namespace voussoir
