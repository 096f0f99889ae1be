// voussoir_study_report: turns the study of one case into points, figures, a recommendation and a page for the manual,
// compares the studies of all cases, and shows all checks at a glance.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/bars.hpp"
#include "reports/checks.hpp"
#include "reports/drawing.hpp"
#include "reports/study_report.hpp"
#include "reports/trade.hpp"
#include "verification/verdict_file.hpp"

namespace {

namespace fs = std::filesystem;
using voussoir::verification::read_text;
using voussoir::verification::write_atomically;

using voussoir::reports::OfSubfolder;

void draw_study(const voussoir::reports::Study& study, const std::string& quantity, const fs::path& style_folder,
                const fs::path& out) {
  std::vector<std::string> sweeps;
  for (const std::string& sweep : sweeps_of(study, quantity))
    if (sweep != voussoir::reports::default_sweep) sweeps.push_back(sweep);
  voussoir::reports::draw(
      style_folder, "study.gp", out / voussoir::reports::study_figure_name(quantity),
      {"points=" + (out / "study_points.csv").string(), "sweeps=" + voussoir::reports::as_words(sweeps),
       "quantity=" + quantity, std::string("cost=") + name_of(cost_unit(study)),
       std::string("default=") + (default_point(study, quantity) ? "yes" : "no")});
}

voussoir::reports::Study judged(const fs::path& study_file, const fs::path& reference_file) {
  using namespace voussoir::reports;
  if (!fs::exists(reference_file))
    throw std::runtime_error("there is no " + reference_file.string() +
                             ": the case's test must call CaseReport::reference()");
  return judge_study(read_study(read_text(study_file)),
                     read_references(nlohmann::json::parse(read_text(reference_file))));
}

// the report on one case
void report(const fs::path& study_file, const fs::path& reference_file, const fs::path& style_folder,
            const fs::path& out) {
  using namespace voussoir::reports;
  const Study study = judged(study_file, reference_file);
  write_atomically(out / "study_points.csv", study_points_csv(study));
  write_atomically(out / "study.json", study_json(study).dump(1) + "\n");
  if (!style_folder.empty())
    for (const std::string& quantity : study.quantities)
      draw_study(study, quantity, style_folder, out);
  write_atomically(out / "study.md", study_markdown(study));
  fmt::print("{} settings judged, {} failed: {}\n", study.points.size(), study.failed.size(),
             (out / "study.md").string());
  const std::string broken = broken_promises(study);
  if (!broken.empty()) throw std::runtime_error(broken);
}

std::vector<voussoir::reports::BudgetSet> budget_sets(const fs::path& cases) {
  std::vector<voussoir::reports::BudgetSet> sets;
  for (const OfSubfolder& found : voussoir::reports::in_subfolders(cases, "budget.csv"))
    sets.push_back(voussoir::reports::read_budget_set(found.name, read_text(found.file)));
  return sets;
}

// a JSON file of every subfolder, as the part of a report with its name and its content
template <class Part>
std::vector<Part> parts_of(const fs::path& folder, const std::string& file) {
  std::vector<Part> parts;
  for (const OfSubfolder& found : voussoir::reports::in_subfolders(folder, file))
    parts.push_back({found.name, nlohmann::json::parse(read_text(found.file))});
  return parts;
}

// inputs of the comparison, and their places
struct Compared {
  fs::path folder, case_outputs, budgets, style_folder;
};

// comparison of all studies in a folder
void compare(const Compared& compared) {
  const fs::path &folder = compared.folder, &style_folder = compared.style_folder;
  using namespace voussoir::reports;
  const auto studies = parts_of<CaseStudy>(folder, "study.json");
  const auto drawn = [&](const std::string& name, const std::vector<std::string>& cases) {
    if (!style_folder.empty())
      draw(style_folder, name + ".gp", folder / (name + ".svg"),
           {"data=" + (folder / (name + ".csv")).string(), "cases=" + as_words(cases)});
  };
  write_atomically(folder / "trade.csv", trade_csv(studies));
  drawn("trade", compared_cases(studies));
  const std::vector<BudgetSet> sets = budget_sets(compared.case_outputs);
  write_atomically(folder / "bars.csv", bars_csv(sets));
  std::vector<std::string> cases;
  for (const BudgetSet& set : sets)
    cases.push_back(set.name);
  if (!sets.empty()) drawn("bars", cases);
  write_atomically(
      folder / "trade.md",
      trade_markdown(studies) + bars_markdown(sets, parts_of<SceneBudget>(compared.budgets, "results.json"), studies));
  fmt::print("{} studies compared: {}\n", studies.size(), (folder / "trade.md").string());
}

// all checks at a glance
void gather_checks(const fs::path& verdict_file, const fs::path& style_folder, const fs::path& out) {
  using namespace voussoir::reports;
  const auto verdicts = voussoir::verification::verdicts_from_json(nlohmann::json::parse(read_text(verdict_file)));
  const CheckSpreads spreads = spreads_of(verdicts);
  write_atomically(out / "checks.csv", checks_csv(verdicts));
  write_atomically(out / "checks_cases.csv", checks_cases_csv(spreads));
  for (const char* figure : {"checks_values", "checks_errors"})
    if (!style_folder.empty() && spreads.can_be_drawn())
      draw(style_folder, std::string(figure) + ".gp", out / (std::string(figure) + ".svg"),
           {"points=" + (out / "checks.csv").string(), "means=" + (out / "checks_cases.csv").string(),
            "verification=" + as_words(spreads.cases(0)), "validation=" + as_words(spreads.cases(1)),
            "verification_spread=" + in_words(spreads.groups[0].over_tolerance),
            "validation_spread=" + in_words(spreads.groups[1].over_tolerance)});
  write_atomically(out / "checks.md", checks_markdown(spreads));
  fmt::print("{} checks at a glance: {}\n", verdicts.rows.size(), (out / "checks.md").string());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Joins results with references: error against cost, Pareto front, recommendation; all checks at a glance."};
  app.require_subcommand(1);
  fs::path study_file, reference_file, verdict_file, out, style_folder, folder, case_outputs, budgets;
  CLI::App* one = app.add_subcommand("case", "the report on one case's study");
  one->add_option("--study", study_file, "study.csv of `voussoir study`")->required();
  one->add_option("--reference", reference_file, "reference.json of the case's test")->required();
  one->add_option("--out", out, "folder for study_points.csv, study.md, study.json and the figures")->required();
  CLI::App* all = app.add_subcommand("compare", "comparison of all cases");
  all->add_option("--studies", folder, "folder with a folder for every case; trade.md, .csv and .svg go there")
      ->required();
  all->add_option("--cases", case_outputs, "folder of the files of the cases' tests, in which budget.csv are sought");
  all->add_option("--budgets", budgets, "folder with a folder for every case whose scene was run with its budget");
  CLI::App* checks = app.add_subcommand("checks", "all checks of a build at a glance");
  checks->add_option("--verdicts", verdict_file, "verdicts.json of the summary")->required();
  checks->add_option("--out", out, "folder for checks.md, checks.csv and the figures")->required();
  for (CLI::App* command : {one, all, checks})
    command->add_option("--style", style_folder, "folder with draw.sh and *.gp; without it no figure is drawn");
  CLI11_PARSE(app, argc, argv);

  try {
    if (one->parsed())
      report(study_file, reference_file, style_folder, out);
    else if (checks->parsed())
      gather_checks(verdict_file, style_folder, out);
    else
      compare({folder, case_outputs, budgets, style_folder});
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_study_report: {}\n", problem.what());
    return 1;
  }
}
