#include "app/base/row_ranges.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "core/base/bad_input.hpp"

namespace voussoir {
namespace {

// a whole number above 0 that is the whole text
std::optional<int> number_in(std::string_view text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stop != end || number < 1) return std::nullopt;
  return number;
}

// first and last of "120-139" or "7"
std::optional<std::pair<int, int>> range_in(std::string_view text) {
  const std::size_t dash = text.find('-');
  const std::optional<int> first = number_in(text.substr(0, dash));
  const std::optional<int> last = dash == std::string_view::npos ? first : number_in(text.substr(dash + 1));
  if (!first || !last || *last < *first) return std::nullopt;
  return std::pair(*first, *last);
}

}  // namespace

std::set<int> rows_of_ranges(const std::string& text, int count) {
  std::set<int> rows;
  for (std::string_view left = text; true;) {
    const std::size_t comma = left.find(',');
    const auto range = range_in(left.substr(0, comma));
    if (!range) throw BadInput(fmt::format("--rows {}: must be rows and ranges of rows, e.g. 120-139,7", text));
    if (range->second > count) throw BadInput(fmt::format("--rows {}: the study has rows 1 to {}", text, count));
    for (int row = range->first; row <= range->second; ++row)
      rows.insert(row);
    if (comma == std::string_view::npos) return rows;
    left.remove_prefix(comma + 1);
  }
}

std::string ranges_of_rows(const std::set<int>& rows) {
  std::string text;
  for (auto first = rows.begin(); first != rows.end();) {
    auto next = first;
    int last = *first;
    while (++next != rows.end() && *next == last + 1)
      last = *next;
    text += (text.empty() ? "" : ",") + std::to_string(*first);
    if (last > *first) text += "-" + std::to_string(last);
    first = next;
  }
  return text;
}

Chunk chunk_of(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::optional<int> place = number_in(std::string_view(text).substr(0, slash));
  const std::optional<int> count =
      slash == std::string::npos ? std::nullopt : number_in(std::string_view(text).substr(slash + 1));
  if (!place || !count || *place > *count)
    throw BadInput(fmt::format("--chunk {}: must be k/n with k from 1 to n, e.g. 3/40", text));
  return {*place, *count};
}

}  // namespace voussoir
