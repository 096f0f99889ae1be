#include "text/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

#include "text/plain_text.hpp"

namespace voussoir {
namespace {

// whether a spreadsheet takes it for a formula
bool begins_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos;
}

std::string_view behind_apostrophes(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of('\''), text.size()));
}

bool is_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

// the text that a cell represents
std::string meant(std::string text) {
  if (text.starts_with('\'') && begins_formula(behind_apostrophes(text))) text.erase(0, 1);
  return text;
}

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

std::vector<CsvCell> cells_of(std::string_view line, int number, std::size_t most_columns) {
  std::vector<CsvCell> cells;
  std::size_t at = 0;
  while (true) {
    if (cells.size() == most_columns)
      throw FileFault(number, static_cast<int>(at) + 1,
                      "more than " + std::to_string(most_columns) + " columns; is this a table of this kind?");
    const std::size_t begin = std::min(line.find_first_not_of(" \t", at), line.size());
    if (begin < line.size() && line[begin] == '"') {
      at = begin;
      std::string text = quoted_cell(line, number, at);
      const std::size_t behind = std::min(line.find_first_not_of(" \t", at), line.size());
      if (behind < line.size() && line[behind] != ',')
        throw FileFault(number, static_cast<int>(behind) + 1,
                        "text behind a closed quote; write a comma between cells");
      cells.push_back({meant(std::move(text)), static_cast<int>(begin) + 1});
      at = behind;
    } else {
      const std::size_t end = std::min(line.find(',', at), line.size());
      cells.push_back({meant(trimmed(line.substr(at, end - at))), static_cast<int>(begin) + 1});
      at = end;
    }
    if (at >= line.size()) return cells;
    ++at;
  }
}

// letters and digits alone, so that "Dip dir." is dipdir
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const unsigned char c : name)
    if (std::isalnum(c)) plain += static_cast<char>(std::tolower(c));
  return plain;
}

// insertions, removals and exchanges of letters between two names (Levenshtein)
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(
          row[j + 1], std::min({row[j + 1] + 1, row[j] + 1, diagonal + static_cast<std::size_t>(a[i] != b[j])}));
  }
  return row.back();
}

// the column that a foreign name most likely means: by its usual names, without its unit, within two edits
std::string meant_column(const std::string& name, const std::vector<std::string>& columns,
                         const std::map<std::string, std::string>& usual) {
  constexpr std::size_t most_edits = 2, shortest = 4;  // in a name of so many letters
  const std::string plain = plain_name(name);
  const auto holds = [&](const std::string& column) {
    return std::find(columns.begin(), columns.end(), column) != columns.end();
  };
  if (const auto at = usual.find(plain); at != usual.end() && holds(at->second)) return at->second;
  for (const std::string& column : columns)
    if (plain == plain_name(column) || plain == plain_name(column.substr(0, column.rfind('_')))) return column;
  for (std::size_t edits = 1; edits <= most_edits && plain.size() >= shortest; ++edits)
    for (const std::string& column : columns)
      if (edits_between(plain, plain_name(column)) == edits) return column;
  return {};
}

constexpr const char* comment_line = "a comment; a table has only a header and rows: remove this line";

bool is_comment(std::string_view line) {
  return line[line.find_first_not_of(" \t")] == '#';
}

// refuses the headers of other programs, with the reason
void refuse_other_headers(std::string_view line, int number) {
  if (is_comment(line)) throw FileFault(number, 0, comment_line);
  if (line.starts_with("sep="))
    throw FileFault(number, 0,
                    shown(line) +
                        " is an instruction to spreadsheets and no header: remove this line; columns are separated by "
                        "commas here");
  for (const auto& [separator, word] : {std::pair{';', "semicolons"}, {'\t', "tabs"}})
    if (line.find(',') == std::string_view::npos && line.find(separator) != std::string_view::npos)
      throw FileFault(number, static_cast<int>(line.find(separator)) + 1,
                      fmt::format("columns are separated by {}; separate them by commas, and write decimals with a "
                                  "point (a spreadsheet: save as CSV in English notation)",
                                  word));
}

// a row with one cell more for each number whose decimals are behind a comma
bool may_hold_decimal_commas(const std::vector<CsvCell>& cells, std::size_t columns) {
  return cells.size() > columns && std::all_of(cells.begin(), cells.end(), [](const CsvCell& cell) {
           return cell.text.empty() || is_number(cell.text);
         });
}

std::optional<std::size_t> place_of(const std::vector<CsvCell>& header, std::string_view name) {
  const auto at = std::find_if(header.begin(), header.end(), [&](const CsvCell& cell) { return cell.text == name; });
  if (at == header.end()) return {};
  return at - header.begin();
}

}  // namespace

std::string csv_cell(const std::string& text) {
  std::string cell = printable(text);
  const std::string_view rest = behind_apostrophes(cell);
  if (begins_formula(rest) && (rest.size() < cell.size() || !is_number(cell))) cell.insert(cell.begin(), '\'');
  if (cell.find_first_of(",;#") == std::string::npos && !cell.starts_with('"') && cell == trimmed(cell)) return cell;
  std::string quoted = "\"";
  for (const char character : cell)
    quoted += character == '"' ? std::string("\"\"") : std::string(1, character);
  return quoted + "\"";
}

std::string csv_cell(double number) {
  return std::isfinite(number) ? fmt::format("{}", number) : std::string();
}

std::string csv_cell(std::optional<double> number) {
  return number ? csv_cell(*number) : std::string();
}

std::string csv_line(const std::vector<std::string>& texts) {
  std::string line;
  for (std::size_t k = 0; k < texts.size(); ++k)
    line += (k > 0 ? "," : "") + csv_cell(texts[k]);
  return line;
}

CsvReader::CsvReader(std::string_view text, std::size_t most_columns) : lines_(text), most_columns_(most_columns) {
  CsvRow first;
  if (!next_cells(first)) throw FileFault(1, 0, "is empty; the first row names the columns");
  header_line_ = first.line;
  if (std::any_of(first.cells.begin(), first.cells.end(), [](const CsvCell& cell) { return is_number(cell.text); }))
    throw FileFault(first.line, 0, "the header is missing: the first row names the columns, here it has numbers");
  for (const CsvCell& cell : first.cells) {
    if (cell.text.empty())
      throw FileFault(first.line, cell.column, "a column without a name; the first row is the header");
    if (find(cell.text))
      throw FileFault(first.line, cell.column,
                      "column " + shown(cell.text) + " occurs twice in the header; remove one");
    header_.push_back(cell);
  }
}

std::optional<std::size_t> CsvReader::find(std::string_view name) const {
  return place_of(header_, name);
}

bool CsvReader::next_cells(CsvRow& row) {
  while (lines_.next()) {
    if (lines_.line().find_first_not_of(" \t") == std::string_view::npos) continue;
    if (header_.empty()) refuse_other_headers(lines_.line(), lines_.number());
    row = {lines_.number(), cells_of(lines_.line(), lines_.number(), most_columns_)};
    return true;
  }
  return false;
}

bool CsvReader::next(CsvRow& row) {
  if (!next_cells(row)) return false;
  if (row.cells.size() == header_.size()) return true;
  if (is_comment(lines_.line())) throw FileFault(row.line, 0, comment_line);
  throw FileFault(row.line, 0,
                  "has " + std::to_string(row.cells.size()) + " cells, but the header has " +
                      std::to_string(header_.size()) +
                      (may_hold_decimal_commas(row.cells, header_.size())
                           ? "; were decimals written with a comma? write 3.5, not 3,5"
                           : "; leave a cell empty but keep its comma"));
}

CsvTable parse_csv(std::string_view text, std::size_t most_rows) {
  CsvReader reader(text);
  CsvTable table{reader.header_line(), reader.header(), {}};
  for (CsvRow row; reader.next(row);) {
    if (table.rows.size() == most_rows)
      throw FileFault(row.line, 0, "more than " + std::to_string(most_rows) + " rows; divide the file");
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view name) const {
  return place_of(header, name);
}

void CsvTable::check_header(const std::vector<std::string>& required, const std::vector<std::string>& optional,
                            const std::map<std::string, std::string>& usual) const {
  std::vector<std::string> columns = required;
  columns.insert(columns.end(), optional.begin(), optional.end());
  const auto holds = [](const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  for (const CsvCell& cell : header)
    if (const std::string meant = meant_column(cell.text, columns, usual);
        !holds(required, cell.text) && !holds(optional, cell.text))
      throw FileFault(
          header_line, cell.column,
          "no such column as " + shown(cell.text) + (meant.empty() ? ";" : fmt::format("; did you mean {}?", meant)) +
              fmt::format(" there are {} and, if needed, {}", fmt::join(required, ", "), fmt::join(optional, ", ")));
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
