#include "core/exchange/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/exchange/text_scan.hpp"

namespace voussoir {
namespace {

// no table of ours has a tenth of it; a line of commas must not become a million columns
constexpr std::size_t most_columns = 200;

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return std::string(text.substr(begin, text.find_last_not_of(" \t") - begin + 1));
}

// one quoted cell from its opening quote on; leaves `at` behind the closing one
std::string quoted_cell(std::string_view line, int number, std::size_t& at) {
  const std::size_t opened = at++;
  std::string text;
  while (true) {
    const std::size_t quote = line.find('"', at);
    if (quote == std::string_view::npos)
      throw FileFault(number, static_cast<int>(opened) + 1, "the quote is not closed in this line; add the second \"");
    text += line.substr(at, quote - at);
    at = quote + 1;
    if (at >= line.size() || line[at] != '"') return text;
    text += '"';
    ++at;
  }
}

std::vector<CsvCell> cells_of(std::string_view line, int number) {
  std::vector<CsvCell> cells;
  std::size_t at = 0;
  while (true) {
    if (cells.size() == most_columns)
      throw FileFault(number, static_cast<int>(at) + 1,
                      "more than " + std::to_string(most_columns) + " columns; is this a table of joints or planes?");
    const std::size_t begin = std::min(line.find_first_not_of(" \t", at), line.size());
    if (begin < line.size() && line[begin] == '"') {
      at = begin;
      std::string text = quoted_cell(line, number, at);
      const std::size_t behind = std::min(line.find_first_not_of(" \t", at), line.size());
      if (behind < line.size() && line[behind] != ',')
        throw FileFault(number, static_cast<int>(behind) + 1,
                        "text behind a closed quote; write a comma between cells");
      cells.push_back({std::move(text), static_cast<int>(begin) + 1});
      at = behind;
    } else {
      const std::size_t end = std::min(line.find(',', at), line.size());
      cells.push_back({trimmed(line.substr(at, end - at)), static_cast<int>(begin) + 1});
      at = end;
    }
    if (at >= line.size()) return cells;
    ++at;
  }
}

bool is_number(std::string_view text) {
  double number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && error == std::errc() && stop == text.data() + text.size();
}

constexpr const char* comment_line = "a comment; a table has a header and rows and nothing else: remove this line";

bool is_comment(std::string_view line) {
  return line[line.find_first_not_of(" \t")] == '#';
}

// what other programs write for a header, named by what it is
void refuse_other_headers(std::string_view line, int number) {
  if (is_comment(line)) throw FileFault(number, 0, comment_line);
  for (const auto& [separator, word] : {std::pair{';', "semicolons"}, {'\t', "tabs"}})
    if (line.find(',') == std::string_view::npos && line.find(separator) != std::string_view::npos)
      throw FileFault(number, static_cast<int>(line.find(separator)) + 1,
                      fmt::format("columns are separated by {}; separate them by commas, and write decimals with a "
                                  "point (a spreadsheet: save as CSV in English notation)",
                                  word));
}

// a row with one cell more for each number whose decimals stand behind a comma
bool may_hold_decimal_commas(const std::vector<CsvCell>& cells, std::size_t columns) {
  return cells.size() > columns && std::all_of(cells.begin(), cells.end(), [](const CsvCell& cell) {
           return cell.text.empty() || is_number(cell.text);
         });
}

}  // namespace

CsvTable parse_csv(std::string_view text, std::size_t most_rows) {
  CsvTable table;
  LineReader reader(text);
  while (reader.next()) {
    const std::string_view line = reader.line();
    const int number = reader.number();
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    if (table.header.empty()) refuse_other_headers(line, number);
    std::vector<CsvCell> cells = cells_of(line, number);
    if (table.header.empty()) {
      table.header_line = number;
      if (std::any_of(cells.begin(), cells.end(), [](const CsvCell& cell) { return is_number(cell.text); }))
        throw FileFault(number, 0, "the header is missing: the first row names the columns, here it holds numbers");
      for (const CsvCell& cell : cells) {
        if (cell.text.empty())
          throw FileFault(number, cell.column, "a column without a name; the first row is the header");
        if (table.find(cell.text))
          throw FileFault(number, cell.column,
                          "column " + shown(cell.text) + " stands twice in the header; remove one");
        table.header.push_back(cell);
      }
      continue;
    }
    if (cells.size() != table.header.size() && is_comment(line)) throw FileFault(number, 0, comment_line);
    if (cells.size() != table.header.size())
      throw FileFault(number, 0,
                      "has " + std::to_string(cells.size()) + " cells where the header has " +
                          std::to_string(table.header.size()) +
                          (may_hold_decimal_commas(cells, table.header.size())
                               ? "; were decimals written with a comma? write 3.5, not 3,5"
                               : "; leave a cell empty but keep its comma"));
    if (table.rows.size() == most_rows)
      throw FileFault(number, 0, "more than " + std::to_string(most_rows) + " rows; divide the file");
    table.rows.push_back({number, std::move(cells)});
  }
  if (table.header.empty()) throw FileFault(1, 0, "is empty; the first row names the columns");
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view name) const {
  const auto at = std::find_if(header.begin(), header.end(), [&](const CsvCell& cell) { return cell.text == name; });
  if (at == header.end()) return {};
  return at - header.begin();
}

void CsvTable::check_header(const std::vector<std::string>& required, const std::vector<std::string>& optional) const {
  const auto holds = [](const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  for (const CsvCell& cell : header)
    if (!holds(required, cell.text) && !holds(optional, cell.text))
      throw FileFault(header_line, cell.column,
                      "no such column as " + shown(cell.text) +
                          fmt::format("; there are {} and, where needed, {}", fmt::join(required, ", "),
                                      fmt::join(optional, ", ")));
  for (const std::string& name : required)
    if (!find(name))
      throw FileFault(header_line, 0,
                      fmt::format("the header lacks the column {}; it needs {}", name, fmt::join(required, ", ")));
}

std::string CsvTable::text(const CsvRow& row, std::string_view column) const {
  const auto place = find(column);
  return place ? row.cells[*place].text : std::string();
}

std::optional<double> CsvTable::number(const CsvRow& row, std::string_view column) const {
  const auto place = find(column);
  if (!place || row.cells[*place].text.empty()) return {};
  const CsvCell& cell = row.cells[*place];
  return number_of({cell.text, row.line, cell.column}, std::string(column));
}

double CsvTable::required_number(const CsvRow& row, std::string_view column) const {
  const auto value = number(row, column);
  if (!value) refuse(row, column, "must be a finite decimal number; the cell is empty");
  return *value;
}

void CsvTable::refuse(const CsvRow& row, std::string_view column, const std::string& reason) const {
  const auto place = find(column);
  if (!place) throw FileFault(header_line, 0, "the header lacks the column " + std::string(column) + ": " + reason);
  const CsvCell& cell = row.cells[*place];
  throw FileFault(row.line, cell.column, std::string(column) + " = " + shown(cell.text) + ": " + reason);
}

}  // namespace voussoir
