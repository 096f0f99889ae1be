// Tables of comma-separated values (RFC 4180) with a header row: the one reader, and the one writer of a cell.
//
// A row is one line: a quoted cell may contain commas and doubled quotes, but no line break. A text that a spreadsheet
// would compute, because it begins with = + - or @ and is no number, is written behind an apostrophe, which the reader
// removes again; so every text comes back unchanged.
//
// Other readers of these tables: to gnuplot and numpy.loadtxt (quotechar='"') a # outside of quotes begins a comment,
// so a text that contains one is quoted; gnuplot does not know doubled quotes, so a text is not quoted because of
// quotes within it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/file_fault.hpp"
#include "text/text_scan.hpp"

namespace voussoir {

// a text as a cell; characters that are no plain text are replaced (printable)
std::string csv_cell(const std::string& text);
// a number as a cell, with the fewest digits that read back to the same number; empty when it is not finite
std::string csv_cell(double number);
std::string csv_cell(std::optional<double> number);
// texts as a line, without its end
std::string csv_line(const std::vector<std::string>& texts);

struct CsvCell {
  std::string text;  // unquoted, without blanks around it
  int column = 0;    // of its first byte in the line
};

struct CsvRow {
  int line = 0;
  std::vector<CsvCell> cells;  // as many as the header has
};

// Row by row, so that a long table takes no memory. Throws FileFault, also for a header of more columns than permitted.
class CsvReader {
 public:
  explicit CsvReader(std::string_view text, std::size_t most_columns = 200);

  int header_line() const { return header_line_; }
  const std::vector<CsvCell>& header() const { return header_; }  // unique, none empty
  // place of a column, or nothing
  std::optional<std::size_t> find(std::string_view name) const;
  // false at the end; empty lines are no rows
  bool next(CsvRow& row);

 private:
  bool next_cells(CsvRow& row);

  LineReader lines_;
  std::size_t most_columns_;
  int header_line_ = 1;
  std::vector<CsvCell> header_;
};

struct CsvTable {
  int header_line = 1;
  std::vector<CsvCell> header;  // unique, none empty
  std::vector<CsvRow> rows;

  // place of a column, or nothing
  std::optional<std::size_t> find(std::string_view name) const;

  // Refuses a header that lacks a required column, or has an unknown one. `usual` are names that other
  // programs give to columns: letters and digits in lower case, and the column.
  void check_header(const std::vector<std::string>& required, const std::vector<std::string>& optional,
                    const std::map<std::string, std::string>& usual = {}) const;

  // a cell's text, empty if the table has no such column
  std::string text(const CsvRow& row, std::string_view column) const;
  // a cell's number; nothing if the cell is empty or the table has no such column
  std::optional<double> number(const CsvRow& row, std::string_view column) const;
  double required_number(const CsvRow& row, std::string_view column) const;
  // an error about a cell: "column = 'value': reason"
  [[noreturn]] void refuse(const CsvRow& row, std::string_view column, const std::string& reason) const;
};

// The entire table. Throws FileFault, also for more rows than permitted, before memory is taken for them.
CsvTable parse_csv(std::string_view text, std::size_t most_rows = 100'000);

}  // namespace voussoir
