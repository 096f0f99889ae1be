// voussoir_study_report: turns the study of one case into points, figures, a recommendation and a page for the manual,
// and compares the studies of all cases.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/bars.hpp"
#include "reports/study_report.hpp"
#include "reports/trade.hpp"
#include "verification/verdict_file.hpp"

namespace {

namespace fs = std::filesystem;
using voussoir::verification::read_text;
using voussoir::verification::write_atomically;

// one word of a shell command, whatever it holds
std::string quoted(const std::string& text) {
  std::string word = "'";
  for (const char character : text)
    word += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return word + "'";
}

void run_draw(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words)
    command += quoted(word) + " ";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("not drawn: " + words.at(2));
}

void draw(const voussoir::reports::Study& study, const std::string& quantity, const fs::path& style_folder,
          const fs::path& out) {
  std::string sweeps;
  for (const std::string& sweep : sweeps_of(study, quantity))
    if (sweep != voussoir::reports::default_sweep) sweeps += (sweeps.empty() ? "" : "|") + sweep;
  run_draw({(style_folder / "draw.sh").string(), (style_folder / "study.gp").string(),
            (out / voussoir::reports::study_figure_name(quantity)).string(),
            "points=" + (out / "study_points.csv").string(), "sweeps=" + sweeps, "quantity=" + quantity,
            std::string("cost=") + name_of(cost_unit(study)),
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
      draw(study, quantity, style_folder, out);
  write_atomically(out / "study.md", study_markdown(study));
  fmt::print("{} settings judged, {} failed: {}\n", study.points.size(), study.failed.size(),
             (out / "study.md").string());
  const std::string broken = broken_promises(study);
  if (!broken.empty()) throw std::runtime_error(broken);
}

std::vector<voussoir::reports::BudgetSet> budget_sets(const fs::path& cases) {
  std::vector<voussoir::reports::BudgetSet> sets;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(cases, error))
    if (fs::exists(entry.path() / "budget.csv"))
      sets.push_back(
          voussoir::reports::read_budget_set(entry.path().filename().string(), read_text(entry.path() / "budget.csv")));
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return sets;
}

std::vector<voussoir::reports::SceneBudget> scene_budgets(const fs::path& folder) {
  std::vector<voussoir::reports::SceneBudget> scenes;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (fs::exists(entry.path() / "results.json"))
      scenes.push_back(
          {entry.path().filename().string(), nlohmann::json::parse(read_text(entry.path() / "results.json"))});
  std::sort(scenes.begin(), scenes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return scenes;
}

// what is compared, and where
struct Compared {
  fs::path folder, case_outputs, budgets, style_folder;
};

// all studies in a folder beside each other
void compare(const Compared& compared) {
  const auto& [folder, case_outputs, budgets, style_folder] = compared;
  using namespace voussoir::reports;
  std::vector<CaseStudy> studies;
  for (const auto& entry : fs::directory_iterator(folder))
    if (fs::exists(entry.path() / "study.json"))
      studies.push_back(
          {entry.path().filename().string(), nlohmann::json::parse(read_text(entry.path() / "study.json"))});
  std::sort(studies.begin(), studies.end(), [](const CaseStudy& a, const CaseStudy& b) { return a.name < b.name; });
  write_atomically(folder / "trade.csv", trade_csv(studies));
  const std::vector<BudgetSet> sets = budget_sets(case_outputs);
  write_atomically(folder / "bars.csv", bars_csv(sets));
  if (!style_folder.empty() && !sets.empty()) {
    std::string cases;
    for (const BudgetSet& set : sets)
      cases += (cases.empty() ? "" : "|") + set.name;
    run_draw({(style_folder / "draw.sh").string(), (style_folder / "bars.gp").string(), (folder / "bars.svg").string(),
              "data=" + (folder / "bars.csv").string(), "cases=" + cases});
  }
  if (!style_folder.empty()) {
    std::string cases;
    for (const std::string& name : compared_cases(studies))
      cases += (cases.empty() ? "" : "|") + name;
    run_draw({(style_folder / "draw.sh").string(), (style_folder / "trade.gp").string(),
              (folder / "trade.svg").string(), "data=" + (folder / "trade.csv").string(), "cases=" + cases});
  }
  write_atomically(folder / "trade.md", trade_markdown(studies) + bars_markdown(sets, scene_budgets(budgets), studies));
  fmt::print("{} studies compared: {}\n", studies.size(), (folder / "trade.md").string());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Joins study.csv with reference.json: error against cost, Pareto front, recommendation."};
  app.require_subcommand(1);
  fs::path study_file, reference_file, out, style_folder, folder, case_outputs, budgets;
  CLI::App* one = app.add_subcommand("case", "the report on one case's study");
  one->add_option("--study", study_file, "what `voussoir study` wrote")->required();
  one->add_option("--reference", reference_file, "reference.json of the case's test")->required();
  one->add_option("--out", out, "folder for study_points.csv, study.md, study.json and the figures")->required();
  CLI::App* all = app.add_subcommand("compare", "all cases beside each other");
  all->add_option("--studies", folder, "folder that holds a folder for every case; trade.md, .csv and .svg go there")
      ->required();
  all->add_option("--cases", case_outputs, "folder of what the cases' tests wrote, in which budget.csv are looked for");
  all->add_option("--budgets", budgets,
                  "folder that holds a folder for every case whose scene was run with its budget");
  for (CLI::App* command : {one, all})
    command->add_option("--style", style_folder, "folder with draw.sh and *.gp; without it no figure is drawn");
  CLI11_PARSE(app, argc, argv);

  try {
    if (one->parsed())
      report(study_file, reference_file, style_folder, out);
    else
      compare({folder, case_outputs, budgets, style_folder});
    return 0;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_study_report: {}\n", problem.what());
    return 1;
  }
}
