#include "app/study/origins.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/base/row_ranges.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

std::string text_of(const Origin& origin, const std::string& planned_by) {
  const std::string program =
      origin.program == planned_by ? "the program that planned them" : "program " + one_line(origin.program, 60);
  return fmt::format("{}, math functions {}{}", program, one_line(origin.math_functions, 60),
                     origin.portable_math ? " (portable)" : "");
}

}  // namespace

void add_row(std::vector<RowOrigins>& all, int row, const std::vector<Origin>& origins) {
  auto place = std::find_if(all.begin(), all.end(), [&](const RowOrigins& o) { return o.origins == origins; });
  if (place == all.end()) place = all.insert(all.end(), {origins, {}});
  place->rows.insert(row);
}

std::vector<std::string> origin_lines(const std::vector<RowOrigins>& all, const std::string& planned_by) {
  std::vector<std::string> lines;
  for (const RowOrigins& some : all) {
    std::string text = some.origins.empty() ? "an unknown program" : "";
    for (const Origin& origin : some.origins)
      text += (text.empty() ? "" : "; and in part by ") + text_of(origin, planned_by);
    lines.push_back(fmt::format("rows {} computed by {}", ranges_of_rows(some.rows), text));
  }
  return lines;
}

std::vector<std::string> origin_warnings(const std::vector<RowOrigins>& all) {
  std::set<std::string> programs, functions;
  for (const RowOrigins& some : all)
    for (const Origin& origin : some.origins) {
      programs.insert(origin.program);
      functions.insert(origin.math_functions);
    }
  std::vector<std::string> warnings;
  if (programs.size() > 1)
    warnings.push_back(fmt::format("{} programs computed these rows, which may therefore differ: run them all with one",
                                   programs.size()));
  if (functions.size() > 1)
    warnings.push_back(fmt::format(
        "these rows were computed with {} variants of the C library's functions, by processor or version, and "
        "may therefore differ: run them all with 'voussoir study run --portable-math', for x86-64 processors "
        "with one version",
        functions.size()));
  return warnings;
}

}  // namespace voussoir
