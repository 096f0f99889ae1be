#include "verification/problems/references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "verification/verdict_file.hpp"

namespace voussoir::problems {
namespace {

using Json = nlohmann::ordered_json;

struct RowValue {
  double value = 0;
  std::string source;
};

RowValue value_of_row(const std::filesystem::path& verdicts, const std::string& case_name, const std::string& quantity,
                      const std::string& unit) {
  const verification::CaseFile file = verification::read_case_file(verdicts / (case_name + ".json"));
  const auto row = std::find_if(file.rows.begin(), file.rows.end(),
                                [&](const verification::Row& r) { return r.check.quantity == quantity; });
  const std::string repair = fmt::format("run `ctest -R case.{}` and check the row's name", case_name);
  if (row == file.rows.end())
    throw std::runtime_error(
        fmt::format("{}/{}.json: no row '{}': {}", verdicts.string(), case_name, quantity, repair));
  if (row->check.unit != unit)
    throw std::runtime_error(fmt::format("{}/{}.json: row '{}' has the unit {}, the problem asks {}: {}",
                                         verdicts.string(), case_name, quantity, row->check.unit, unit, repair));
  const bool reported = row->check.kind == verification::Kind::reported;
  const double value = reported ? row->computed : row->check.expected;
  if (!std::isfinite(value))
    throw std::runtime_error(
        fmt::format("{}/{}.json: row '{}' is not finite: {}", verdicts.string(), case_name, quantity, repair));
  return {value, fmt::format("{} (case {}, row '{}')", row->check.source, case_name, quantity)};
}

Json joints_json(const std::optional<Reference>& r, const std::string& unit, const std::filesystem::path& verdicts) {
  if (!r) return nullptr;
  const RowValue row = value_of_row(verdicts, r->case_name, r->row, unit);
  return {{"value", row.value},
          {"absolute", r->absolute},
          {"relative", r->relative},
          {"because", r->because},
          {"source", row.source}};
}

Json rigid_json(const std::optional<Reference>& r, const std::string& unit, const std::filesystem::path& verdicts) {
  if (!r) return nullptr;
  const RowValue upper = value_of_row(verdicts, r->case_name, r->row, unit);
  RowValue lower = upper;
  std::string source = upper.source;
  if (r->lower_row) {
    lower = value_of_row(verdicts, r->case_name, *r->lower_row, unit);
    source = fmt::format("lower: {}; upper: {}", lower.source, upper.source);
  }
  return {{"lower", lower.value},    {"upper", upper.value},  {"absolute", r->absolute},
          {"relative", r->relative}, {"because", r->because}, {"source", source}};
}

}  // namespace

nlohmann::ordered_json reference_json(const Problem& problem, const std::filesystem::path& verdicts) {
  Json list = Json::array();
  for (const ReferenceOf& r : problem.references) {
    const auto asked = std::find_if(problem.asked.begin(), problem.asked.end(),
                                    [&](const Asked& a) { return a.quantity == r.quantity; });
    if (asked == problem.asked.end())
      throw std::runtime_error(
          fmt::format("problem {}: a reference of '{}', which is not asked", problem.name, r.quantity));
    list.push_back({{"quantity", r.quantity},
                    {"unit", asked->unit},
                    {"joints", joints_json(r.joints, asked->unit, verdicts)},
                    {"rigid", rigid_json(r.rigid, asked->unit, verdicts)}});
  }
  if (problem.references.size() != problem.asked.size())
    throw std::runtime_error(fmt::format("problem {}: {} questions but {} references", problem.name,
                                         problem.asked.size(), problem.references.size()));
  return {{"format", "voussoir reference 1"}, {"name", problem.name}, {"quantities", list}};
}

}  // namespace voussoir::problems
