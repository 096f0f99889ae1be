// Whether error budgets enclose the truth: scenes whose truth is known, run by the program with --budget, and judged.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases/case_tools.hpp"

namespace voussoir::cases {

// a scene of a set, drawn before any of the set is run
struct BudgetScene {
  std::string label;
  std::filesystem::path scene;
  std::vector<std::string> overrides;
  double truth = 0;  // deg
};

struct BudgetFound {
  bool found = false;                      // false: the search ended without a value, or undecided
  double value = 0, bar = 0, bracket = 0;  // deg
  double cost = 0;                         // evaluations of the budget over those of the result
  long long evaluations = 0;               // of both
  int silent = 0;                          // variations that ended without a value
  std::string message, lines;              // the result of the search, and the budget's shifts
};

// requirements on budgets
struct BudgetPromise {
  double enclosed = 0.95, widest = 4, dearest = 3;
  int few = 20;  // of fewer scenes all but one
  // For fewer the median is only reported. A bar of 1.4 half brackets and an error that is uniform within one have a
  // median of 2.8, and six scenes have one above 4 one time in four.
  int very_few = 10;
};

inline BudgetFound read_budget(const nlohmann::json& results) {
  BudgetFound found;
  found.message = results.at("message");
  const double answer = results.at("counters").at("contact_evaluations");
  found.evaluations = std::llround(answer);
  const nlohmann::json& values = results.at("values");
  if (results.at("status") != "done" || !values.contains("critical_friction")) return found;
  const nlohmann::json& angle = values.at("critical_friction");
  const double budget = results.at("budget").at("contact_evaluations");
  found.found = true;
  found.value = angle.at("value");
  found.bar = angle.at("error_bar");
  found.bracket = angle.at("bracket");
  found.cost = budget / answer;
  found.evaluations += std::llround(budget);
  for (const nlohmann::json& line : angle.at("budget"))
    found.lines += fmt::format("; {} {:+.4f}", line.at("varied").get<std::string>(), line.at("shift").get<double>());
  for (const nlohmann::json& warning : results.at("warnings"))
    found.silent += warning.get<std::string>().starts_with("the budget of critical_friction knows nothing of");
  return found;
}

inline std::string run_command(const BudgetScene& scene, const std::string& option, const std::filesystem::path& out) {
  std::string command = fmt::format("'{}' run '{}' {} --overwrite --quiet --out '{}' --set output.frames=false",
                                    VOUSSOIR_PROGRAM, scene.scene.string(), option, out.string());
  for (const std::string& set : scene.overrides)
    command += fmt::format(" --set '{}'", set);
  return command;
}

inline nlohmann::json results_with(const BudgetScene& scene, const std::string& option, const std::string& case_name) {
  const std::filesystem::path out = verification::case_output(case_name) / "budget";
  std::filesystem::remove(out / "results.json");
  const std::string command = run_command(scene, option, out);
  const int ended = std::system(command.c_str());
  // 1: all was written, but a goal was not reached
  if (!WIFEXITED(ended) || WEXITSTATUS(ended) > 1) throw std::runtime_error("failed: " + command);
  std::ifstream file(out / "results.json");
  return nlohmann::json::parse(file);
}

// with one more override
inline nlohmann::json results_of(const BudgetScene& scene, const std::string& more, const std::string& case_name) {
  return results_with(scene, fmt::format("--set '{}'", more), case_name);
}

inline BudgetFound with_budget(const BudgetScene& scene, const std::string& case_name) {
  return read_budget(results_with(scene, "--budget", case_name));
}

// one line for the result; with the command that repeats it if it misses the requirement
inline void tell_budget(const BudgetScene& scene, const BudgetFound& found) {
  const double off = found.value - scene.truth;
  if (!found.found)
    fmt::print("{}: {:.4f} deg, no value: {}\n", scene.label, scene.truth, found.message);
  else
    fmt::print("{}: {:.4f} deg, off by {:+.4f}, bar {:.4f}, bracket {:.4f}, {:.2g} times the cost, {} evaluations{}\n",
               scene.label, found.value, off, found.bar, found.bracket, found.cost, found.evaluations, found.lines);
  if (!found.found || std::abs(off) > found.bar)
    fmt::print("  not enclosed: {}\n", run_command(scene, "--budget", "out"));
  std::fflush(stdout);
}

// one scene, whose truth its bar must enclose
inline void judge_budget(verification::CaseReport& report, const std::string& case_name, const std::string& source,
                         const BudgetScene& scene) {
  const BudgetFound found = with_budget(scene, case_name);
  tell_budget(scene, found);
  if (!found.found) throw std::runtime_error(scene.label + ": " + found.message);
  report.record({"critical friction with its budget, " + scene.label,
                 "deg",
                 verification::Kind::limit,
                 source,
                 scene.truth,
                 {found.bar, 0},
                 fmt::format("the bar of its own budget, {:.2g} times the cost of the result", found.cost)},
                found.value);
}

inline double median(std::vector<double> numbers) {
  if (numbers.empty()) throw std::invalid_argument("no median of nothing");
  std::ranges::sort(numbers);
  const std::size_t half = numbers.size() / 2;
  return numbers.size() % 2 ? numbers[half] : 0.5 * (numbers[half - 1] + numbers[half]);
}

// results of a set, one number for each search that ended with a value
struct BudgetSet {
  int inside = 0, inside_bracket = 0, undecided = 0, silent = 0;
  std::vector<double> ratios, costs, truths, errors, bars;

  void add(const BudgetScene& scene, const BudgetFound& found) {
    undecided += !found.found;
    if (!found.found) return;
    const double error = std::abs(found.value - scene.truth);
    inside += error <= found.bar;
    inside_bracket += error <= found.bracket;
    silent += found.silent;
    truths.push_back(scene.truth);
    errors.push_back(error);
    bars.push_back(found.bar);
    ratios.push_back(found.bar / error);
    costs.push_back(found.cost);
  }
};

// `set`: "random wedges"; `source`: of their truths
inline void judge_budgets(verification::CaseReport& report, const std::string& case_name, const std::string& set,
                          const std::string& source, const std::vector<BudgetScene>& scenes) {
  using verification::Bound;
  const BudgetPromise promise;
  BudgetSet all;
  for (const BudgetScene& scene : scenes) {
    const BudgetFound found = with_budget(scene, case_name);
    tell_budget(scene, found);
    all.add(scene, found);
  }
  const int count = static_cast<int>(scenes.size());
  const auto share = [&](int n) { return static_cast<double>(n) / count; };
  const std::string of = fmt::format(" of {} {}", count, set), asked = "requirement on budgets";
  const auto judge = [&](const std::string& what, double most, Bound bound, const std::string& because, double found) {
    report.record({what, "1", verification::Kind::limit, source, 0, {most, 0, bound}, because}, found);
  };
  judge("share" + of + " that the budget's bar encloses", count < promise.few ? share(count - 1) : promise.enclosed,
        Bound::at_least, asked + "; of few, all but one", share(all.inside));
  const std::string width = "bar over error, median" + of;
  if (count < promise.very_few)
    report.report(width, "1", median(all.ratios), fmt::format("of many, required: {:g}", promise.widest));
  else
    judge(width, promise.widest, Bound::at_most, asked, median(all.ratios));
  judge("searches" + of + " that end without a value", 0, Bound::at_most, asked + ": none", all.undecided);
  report.report("cost of the budget, median" + of, "1", median(all.costs),
                fmt::format("over that of the result; required: {:g}", promise.dearest));
  report.report("share" + of + " that the bracket alone encloses", "1", share(all.inside_bracket),
                "coverage of a bar without a budget");
  report.report("variations without a value" + of, "1", all.silent, "of all runs of the budgets");
  write_csv(case_name, "budget.csv", {"truth_deg", "error_deg", "bar_deg", "cost"},
            {all.truths, all.errors, all.bars, all.costs});
}

}  // namespace voussoir::cases
