// Files of earthquake records: AT2 of the PEER database, and tables of one or two columns and more.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/ground_motion.hpp"
#include "text/file_fault.hpp"

namespace voussoir {

inline constexpr std::size_t most_record_values = 200'000;  // 1000 s at 200 values a second

// the units of a record, as scenes state them
struct RecordUnit {
  std::string_view word;
  MotionQuantity quantity;
  double size;  // in SI units
};
const std::vector<RecordUnit>& record_units();
const RecordUnit* find_record_unit(std::string_view word);  // or null

// "acceleration", "velocity", "displacement"
std::string_view word_of(MotionQuantity quantity);

// what the scene states beside the file
struct RecordLayout {
  std::optional<double> interval{};  // s, of a column without times
  std::optional<int> column{};       // that of the values, from 1
};

struct RecordFile {
  double interval = 0;                       // s
  std::vector<double> values;                // in the file's unit
  std::string unit{};                        // a word of `record_units`, if the file states its unit
  std::optional<MotionQuantity> quantity{};  // if the file states it
  std::string component{};                   // the last word of AT2's second line: an azimuth or a word
  std::vector<FileRemark> remarks{};
};

// AT2 if one of the first eight lines contains NPTS: three header lines and more, then as many numbers as NPTS says, at
// equal intervals DT; numbers may touch and lack a leading zero. Else a table: a line each, numbers between blanks,
// tabs, commas or semicolons; lines that begin with # and one line of names before the numbers are skipped; with
// semicolons, or if the interval is stated and no number has a point, commas are decimal. Times must rise in equal
// steps, to a millionth of the interval or to their last printed digit. Throws FileFault.
RecordFile read_record_file(std::string_view text, const RecordLayout& layout);

}  // namespace voussoir
