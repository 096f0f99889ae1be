#include "core/output/history_csv.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/output/atomic_file.hpp"

namespace voussoir {
namespace {

template <class Cell>
void append_row(std::string& text, const std::vector<Cell>& cells) {
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) text += ',';
    text += csv_cell(cells[k]);
  }
  text += '\n';
}

}  // namespace

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char character : text)
    quoted += character == '"' ? std::string("\"\"") : std::string(1, character);
  return quoted + "\"";
}

std::string csv_cell(double number) {
  return std::isfinite(number) ? fmt::format("{}", number) : std::string();
}

std::string history_csv(const History& history) {
  std::string text;
  append_row(text, history.columns);
  for (const std::vector<double>& row : history.rows)
    append_row(text, row);
  return text;
}

void write_history_csv(const std::filesystem::path& path, const History& history) {
  write_file(path, history_csv(history));
}

}  // namespace voussoir
