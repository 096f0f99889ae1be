#include "app/study/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/base/row_ranges.hpp"

namespace voussoir {
namespace {

constexpr std::size_t most_kinds = 8;

// without its numbers, which a sweep changes
std::string kind_of(std::string_view text) {
  std::string kind;
  for (const char c : text)
    if (std::string_view("0123456789.+-").find(c) == std::string_view::npos) kind += c;
  return kind;
}

}  // namespace

void add_row(std::vector<RowWarning>& all, int row, const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings) {
    const std::string kind = kind_of(text);
    auto place = std::ranges::find(all, kind, &RowWarning::kind);
    if (place == all.end()) place = all.insert(all.end(), {text, kind, true, {}});
    place->same = place->same && place->text == text;
    place->rows.insert(row);
  }
}

std::vector<std::string> warning_lines(const std::vector<RowWarning>& all) {
  std::vector<std::string> lines;
  for (const RowWarning& warning : all) {
    if (lines.size() == most_kinds) {
      lines.push_back(fmt::format("and {} more kinds, in results.json of the rows", all.size() - most_kinds));
      break;
    }
    const char* const rows = warning.rows.size() == 1 ? "row" : "rows";
    lines.push_back(fmt::format(
        "{} {}: {}{}", rows, ranges_of_rows(warning.rows),
        warning.same ? "" : fmt::format("(of row {}, the others alike) ", *warning.rows.begin()), warning.text));
  }
  return lines;
}

}  // namespace voussoir
