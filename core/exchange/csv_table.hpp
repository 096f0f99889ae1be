// A table of comma-separated values (RFC 4180) with a header row, every cell with its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/exchange/file_fault.hpp"

namespace voussoir {

struct CsvCell {
  std::string text;  // unquoted, without blanks around it
  int column = 0;    // of its first byte in the line
};

struct CsvRow {
  int line = 0;
  std::vector<CsvCell> cells;  // as many as the header has
};

struct CsvTable {
  int header_line = 1;
  std::vector<CsvCell> header;  // unique, none empty
  std::vector<CsvRow> rows;     // empty lines are no rows

  // place of a column, or nothing
  std::optional<std::size_t> find(std::string_view name) const;

  // Refuses a header that lacks a column that must be there, or has one that is not known.
  void check_header(const std::vector<std::string>& required, const std::vector<std::string>& optional) const;

  // a cell's text, empty where the table has no such column
  std::string text(const CsvRow& row, std::string_view column) const;
  // a cell's number; nothing where the cell is empty or the table has no such column
  std::optional<double> number(const CsvRow& row, std::string_view column) const;
  double required_number(const CsvRow& row, std::string_view column) const;
  // a complaint about a cell: "column = 'value': reason"
  [[noreturn]] void refuse(const CsvRow& row, std::string_view column, const std::string& reason) const;
};

// Cells are separated by commas; a quoted one may hold commas and doubled quotes, but no line break: a joint or a face
// is one line. Throws FileFault, also at more rows than asked for, before memory is taken for them.
CsvTable parse_csv(std::string_view text, std::size_t most_rows = 100'000);

}  // namespace voussoir
