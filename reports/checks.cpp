#include "reports/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "text/csv_table.hpp"

namespace voussoir::reports {
namespace {

using namespace verification;

constexpr int groups = 2;
constexpr double drawn_within = 1.4;  // tolerances: checks that failed by more are drawn at the edge of the figure

// the group of a row
std::optional<int> group_of(const Row& row) {
  for (int g = 0; g < groups; ++g)
    if (belongs_to(row, verdict_groups()[g])) return g;
  return std::nullopt;
}

bool is_finite(const Row& row) {
  return std::isfinite(row.computed) && std::isfinite(row.check.expected);
}

// (computed - expected) / tolerance, of a check with a two-sided tolerance
std::optional<double> over_tolerance(const Row& row) {
  const double half = width(row.check.expected, row.check.tolerance);
  if (!is_finite(row) || row.check.tolerance.bound != Bound::both || half == 0) return std::nullopt;
  return (row.computed - row.check.expected) / half;
}

bool fits_logarithmic_axes(const Row& row) {
  return is_finite(row) && row.check.expected != 0 && row.computed != 0;
}

GroupSpread spread_of_group(const Verdicts& verdicts, int group) {
  GroupSpread result;
  result.title = verdict_groups()[group].title;
  std::vector<double> errors, ratios;
  std::vector<std::pair<std::string, std::vector<double>>> cases;
  for (const Row& row : verdicts.rows) {
    if (group_of(row) != group) continue;
    ++result.judged;
    result.passed += passed(row);
    result.failed_to_compute += !is_finite(row);
    result.expected_zero += row.check.expected == 0;
    const auto error = over_tolerance(row);
    if (row.check.tolerance.bound != Bound::both)
      ++result.one_sided;
    else if (is_finite(row) && !error)
      ++result.without_room;
    if (!error) continue;
    errors.push_back(*error);
    if (row.check.expected * row.computed > 0) ratios.push_back(std::log(row.computed / row.check.expected));
    if (cases.empty() || cases.back().first != row.case_name) cases.push_back({row.case_name, {}});
    cases.back().second.push_back(*error);
  }
  result.over_tolerance = spread_of(errors);
  result.log_ratio = spread_of(ratios);
  for (const auto& [name, values] : cases)
    result.by_case.push_back({name, spread_of(values)});
  return result;
}

// offset of a check from the middle of its case in the figure: five lanes in turn
double lane(int number) {
  return 0.12 * (2 * number % 5 - 2);
}

std::string number(double value) {
  return fmt::format("{:.2g}", value);
}

}  // namespace

Spread spread_of(const std::vector<double>& values) {
  Spread spread{static_cast<int>(values.size())};
  for (const double value : values)
    spread.mean += value / spread.count;
  double squares = 0;
  for (const double value : values)
    squares += (value - spread.mean) * (value - spread.mean);
  if (spread.count > 1) spread.deviation = std::sqrt(squares / (spread.count - 1));
  return spread;
}

std::string in_words(const Spread& spread) {
  return fmt::format("bias {}, scatter {}", number(spread.mean), number(spread.deviation));
}

std::vector<std::string> CheckSpreads::cases(int group) const {
  std::vector<std::string> names;
  for (const CaseSpread& of_case : groups[group].by_case)
    names.push_back(of_case.case_name);
  return names;
}

bool CheckSpreads::can_be_drawn() const {
  return std::all_of(groups.begin(), groups.end(), [](const GroupSpread& g) { return g.over_tolerance.count > 0; });
}

CheckSpreads spreads_of(const Verdicts& verdicts) {
  return {{spread_of_group(verdicts, 0), spread_of_group(verdicts, 1)}};
}

std::string checks_csv(const Verdicts& verdicts) {
  std::string text = "group,case,side,place,expected,computed,over_tolerance\n";
  std::array<std::map<std::string, int>, groups> places, seen;
  for (const Row& row : verdicts.rows) {
    const auto group = group_of(row);
    if (!group) continue;
    const char* side = row.check.tolerance.bound == Bound::both ? "both" : "one";
    std::optional<double> place, expected, computed, error = over_tolerance(row);
    if (error) {
      const int next = static_cast<int>(places[*group].size()) + 1;
      const int of_case = places[*group].try_emplace(row.case_name, next).first->second;
      place = of_case + lane(seen[*group][row.case_name]++);
      error = std::clamp(*error, -drawn_within, drawn_within);
    }
    if (fits_logarithmic_axes(row)) {
      expected = std::abs(row.check.expected);
      computed = std::abs(row.computed);
    }
    text += csv_line({verdict_groups()[*group].title, row.case_name, side, csv_cell(place), csv_cell(expected),
                      csv_cell(computed), csv_cell(error)}) +
            "\n";
  }
  return text;
}

std::string checks_cases_csv(const CheckSpreads& spreads) {
  std::string text = "group,place,mean,deviation\n";
  for (const GroupSpread& group : spreads.groups)
    for (std::size_t k = 0; k < group.by_case.size(); ++k)
      text += csv_line({group.title, std::to_string(k + 1), csv_cell(group.by_case[k].over_tolerance.mean),
                        csv_cell(group.by_case[k].over_tolerance.deviation)}) +
              "\n";
  return text;
}

std::string checks_markdown(const CheckSpreads& spreads) {
  std::string text =
      "![Computed against expected, of all checks whose numbers are not zero, in the unit of each, without their "
      "signs. On the line they agree; an inequality may be on its allowed side of it.](checks_values.svg)\n\n"
      "![Error over tolerance, a point a check, case by case: within ±1 a check passes. The black mark is the mean of "
      "the case's checks, its bar their scatter. One-sided checks, and those that must agree to the last digit, are "
      "left out.](checks_errors.svg)\n\n"
      "*Bias* is the mean of error over tolerance and *scatter* its standard deviation: 0 and 0.58 would be errors "
      "spread evenly over the tolerance; much less means that tolerances are wide compared with the errors, a bias "
      "near ±1 that the errors are always on one side. The ratio of computed to expected shows the same without "
      "tolerances, as a geometric mean with its scatter.\n\n"
      "| | checks | passed | both sides | one side | to the last digit | bias, of the tolerance | scatter | computed "
      "over expected | scatter |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const GroupSpread& group : spreads.groups) {
    const Spread &error = group.over_tolerance, &ratio = group.log_ratio;
    text += fmt::format("| {} | {} | {} | {} | {} | {} | ", group.title, group.judged, group.passed, error.count,
                        group.one_sided, group.without_room);
    text += error.count == 0 ? " | | " : fmt::format("{} | {} | ", number(error.mean), number(error.deviation));
    text += ratio.count == 0
                ? " | |\n"
                : fmt::format("{:.4f} | {} % |\n", std::exp(ratio.mean), number(100 * std::expm1(ratio.deviation)));
  }
  return text + fmt::format(
                    "\nExpected values of zero, {} in verification and {} in validation, cannot be on logarithmic "
                    "axes.\n",
                    spreads.groups[0].expected_zero, spreads.groups[1].expected_zero);
}

}  // namespace voussoir::reports
