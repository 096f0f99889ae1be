#include "reports/bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "text/csv_table.hpp"

namespace voussoir::reports {
namespace {

std::string link(const std::string& name) {
  return fmt::format("[{0}](../{0}/README.md)", name);
}

// a value that equals the reference to rounding has no ratio
std::string ratio_text(std::vector<double> ratios) {
  return ratios.empty() ? "–" : fmt::format("{:.2g}", median(ratios));
}

std::vector<double> ratios_of(const std::vector<double>& bar, const std::vector<double>& error) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < bar.size(); ++k)
    if (error[k] > 1e-9 * bar[k]) ratios.push_back(bar[k] / error[k]);
  return ratios;
}

std::string row(const std::string& name, const std::vector<double>& bar, const std::vector<double>& error) {
  int inside = 0;
  for (std::size_t k = 0; k < bar.size(); ++k)
    inside += error[k] <= bar[k];
  return fmt::format("| {} | {} | {} | {}", link(name), bar.size(), inside, ratio_text(ratios_of(bar, error)));
}

std::string budgets(const std::vector<BudgetSet>& sets) {
  if (sets.empty()) return "";
  std::string text =
      "Budgets (`voussoir run --budget`) of scenes drawn at random, whose truth is known. Every build runs a few "
      "of each, the long tests many.\n\n"
      "![Error bar against true error, a point a scene: above the line the bar covers the truth.](bars.svg)\n\n"
      "| case | scenes | truth within the bar | bar over error, median | cost over the result's, median |\n"
      "|---|--:|--:|--:|--:|\n";
  for (const BudgetSet& set : sets)
    text += row(set.name, set.bar, set.error) + fmt::format(" | {:.2g} |\n", median(set.cost));
  return text + "\n";
}

std::string unit_of(const nlohmann::json& value) {
  return value.at("unit") == "1" ? "" : " " + value.at("unit").get<std::string>();
}

// every line of a budget, as results.json has them: by size
std::string scene_budgets(const std::vector<SceneBudget>& scenes) {
  std::string rows;
  for (const SceneBudget& scene : scenes)
    for (const auto& [quantity, value] : scene.results.at("values").items()) {
      if (!value.contains("budget")) continue;
      rows += fmt::format("| {} | {} {:.6g} ± {:.2g}{} | its bracket | | {:.2g} |\n", link(scene.name), quantity,
                          value.at("value").get<double>(), value.at("error_bar").get<double>(), unit_of(value),
                          value.at("bracket").get<double>());
      for (const nlohmann::json& line : value.at("budget"))
        rows += fmt::format("| | | {}, {} | {:+.2g} | {} |\n", line.at("varied").get<std::string>(),
                            line.at("change").get<std::string>(), line.at("shift").get<double>(),
                            line.at("sensitivity").get<bool>() ? "measured, no error"
                                                               : fmt::format("{:+.2g}", line.at("left").get<double>()));
    }
  if (rows.empty()) return "";
  return "The budgets of the cases' scenes. A bar is the root of the sum of squares of the brackets (of the result and "
         "of the runs that vary a setting) and of 1.25 times the remaining error of each setting.\n\n"
         "| case | value | varied | shift | remaining error |\n|---|---|---|--:|--:|\n" +
         rows + "\n";
}

// relative; of settings that have a bar
std::string brackets(const std::vector<CaseStudy>& studies) {
  std::string rows;
  for (const CaseStudy& entry : studies) {
    std::vector<double> bar, error;
    for (const nlohmann::json& point : entry.study.at("points")) {
      const double is = point.at("relative_error"), upper = point.at("relative_error_upper");
      if (!(upper > is)) continue;
      bar.push_back(upper - is);
      error.push_back(is);
    }
    if (!bar.empty()) rows += row(entry.name, bar, error) + " |\n";
  }
  if (rows.empty()) return "";
  return "Without a budget the bar is the search's bracket only. In the studies, including coarse settings:\n\n"
         "| case | settings | truth within the bracket | bracket over error, median |\n|---|--:|--:|--:|\n" +
         rows + "\n";
}

}  // namespace

BudgetSet read_budget_set(const std::string& name, const std::string& csv) {
  BudgetSet set{name, {}, {}, {}};
  CsvReader reader(csv);
  const auto error = reader.find("error_deg"), bar = reader.find("bar_deg"), cost = reader.find("cost");
  if (!error || !bar || !cost) throw std::runtime_error("budget.csv of " + name + ": a column is missing");
  for (CsvRow row; reader.next(row);) {
    set.error.push_back(std::stod(row.cells[*error].text));
    set.bar.push_back(std::stod(row.cells[*bar].text));
    set.cost.push_back(std::stod(row.cells[*cost].text));
  }
  return set;
}

std::string bars_csv(const std::vector<BudgetSet>& sets) {
  std::string text = "case,error_deg,bar_deg\n";
  for (const BudgetSet& set : sets)
    for (std::size_t k = 0; k < set.bar.size(); ++k)
      text += csv_line({set.name, csv_cell(set.error[k]), csv_cell(set.bar[k])}) + "\n";
  return text;
}

std::string bars_markdown(const std::vector<BudgetSet>& sets, const std::vector<SceneBudget>& scenes,
                          const std::vector<CaseStudy>& studies) {
  const std::string text = budgets(sets) + scene_budgets(scenes) + brackets(studies);
  return text.empty() ? "" : "### Coverage of the error bars\n\n" + text;
}

}  // namespace voussoir::reports
