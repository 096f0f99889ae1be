#include "app/run/error_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <thread>

#include "app/base/digest.hpp"
#include "app/run/accuracy_on_order.hpp"
#include "app/run/budget_variations.hpp"
#include "app/run_folder/child_process.hpp"
#include "app/study/found.hpp"
#include "app/study/runs.hpp"
#include "core/base/accuracy.hpp"
#include "core/run/reduction.hpp"
#include "core/scene/accuracy_target.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// A search first covers this number of brackets of the result's size, the result's own among them: if nothing shifts,
// it ends with the same one.
constexpr int brackets_below = 1, brackets_above = 2;

// of a half bracket: a change within rounding is no shift
constexpr double rounding = 1e-6;

constexpr const char* from_afar = "_wide";  // of a search over the range of the original one

// overrides that let the searches of a scene look near the result
std::vector<std::string> near(const LoadedScene& scene, const Results& results) {
  std::vector<std::string> overrides;
  for (const Search& search : searches_of(scene)) {
    const ReducePlan& plan = search.plan;
    if (plan.method != ReductionMethod::bisection) return {};
    const Value* found = results.find(search.value);
    if (!found || !found->error_bar) return {};
    const double unit = search.angle() ? degree : 1, half = found->bracket.value_or(*found->error_bar);
    const double from = (search.angle() ? plan.from : plan.factor.from) / unit,
                 to = (search.angle() ? plan.to : plan.factor.to) / unit;
    const double below = found->value - (2 * brackets_below + 1) * half,
                 above = found->value + (2 * brackets_above + 1) * half;
    if (below < std::min(from, to) || above > std::max(from, to)) return {};
    overrides.push_back(set(search.path, search.angle() ? "from_deg" : "from_factor", search.angle() ? above : below));
    overrides.push_back(set(search.path, search.angle() ? "to_deg" : "to_factor", search.angle() ? below : above));
  }
  return overrides;
}

StudyRun run_of(const Variation& v, const fs::path& scene, const std::vector<std::string>& settings,
                const std::vector<std::string>& closer, const std::string& name) {
  StudyRun run{scene, settings, {}, {scene}, name};
  for (const std::vector<std::string>& more :
       {v.overrides(), closer, {"accuracy.budget=false", "output.frames=false", "output.view=false"}})
    run.overrides.insert(run.overrides.end(), more.begin(), more.end());
  return run;
}

std::string folder_of(const Variation& v, const std::string& run) {
  std::string name = v.change.ends_with(" at once") ? v.change : v.name;
  std::ranges::replace(name, ' ', '_');
  std::erase_if(name, [](char c) { return !(std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'); });
  return name + "-" + run;
}

std::vector<Variation> without_first(const std::vector<Variation>& variations) {
  return {variations.begin() + 1, variations.end()};
}

// the bar of one value, from the lines of its budget; `other`: the largest half bracket among the variations
void combine(double other, Value& value) {
  if (!value.bracket) value.bracket = value.error_bar;
  const double own = value.error_bar.value_or(0);
  double squares = own * own + other * other;
  for (const BudgetLine& line : value.budget)
    if (std::abs(line.shift) > rounding * own) squares += square_of(line);
  value.error_bar = std::sqrt(squares);
  value.covers = "budget";
}

// an accuracy of [accuracy] level that a budget does not confirm
void judge_level(const LoadedScene& scene, const std::string& name, const Value& value,
                 std::vector<std::string>& warnings) {
  const Node* accuracy = scene.stated->tree->find("accuracy");
  const Node* level = accuracy ? accuracy->find("level") : nullptr;
  if (!level || value.covers != "budget") return;
  const auto found = std::ranges::find(accuracy_levels, level->text);
  const double promised = accuracy_promises[found - accuracy_levels.begin()];
  if (*value.error_bar > promised * std::abs(value.value))
    warnings.push_back(
        fmt::format("accuracy.level = \"{}\" promises {:g} %; the budget gives an error of {:.2g} % of {}", level->text,
                    100 * promised, 100 * *value.error_bar / std::abs(value.value), name));
}

}  // namespace

bool wants_budget(const LoadedScene& scene) {
  const Node* accuracy = scene.stated ? scene.stated->tree->find("accuracy") : nullptr;
  return accuracy && (states(*accuracy, "budget") || accuracy_target(*scene.stated->tree));
}

std::vector<std::string> budget_folders(const LoadedScene& scene) {
  std::vector<Variation> variations;
  const Variations all = variations_of(scene);
  for (const std::vector<Variation>& some :
       {all.alone, all.together, {at_once(all.together), at_once(without_first(all.together)), {"search", ""}}})
    variations.insert(variations.end(), some.begin(), some.end());
  const int rounds = accuracy_target(*scene.stated->tree) ? most_rounds : 1;
  std::vector<std::string> folders;
  for (int round = 0; round < rounds; ++round) {
    const std::string run = budget_runs(scene, round, {}).name;
    for (const Variation& v : variations)
      for (const char* kind : {"", from_afar})
        folders.push_back("budget/" + folder_of(v, run) + kind);
  }
  return folders;
}

BudgetRuns budget_runs(const LoadedScene& stated, int round, const std::vector<std::string>& settings) {
  const std::string run = digest(stated.hash + program_digest());
  return {round == 0 ? run : fmt::format("{}-{}", run, round + 1), settings};
}

namespace {

// the budget's runs, in a folder within that of the run
struct BudgetedRuns {
  BudgetRuns of;
  fs::path folder;
  RunsOptions options;
  std::vector<std::string> closer;    // overrides that let searches look near the result
  std::vector<std::string> searched;  // the values that searches found; without any all values are compared
  std::string path;                   // the run that varies only the begin of its searches; may be empty
  long long evaluations = 0;

  // the name of each variation's run; nothing: interrupted
  std::optional<std::vector<std::string>> carry_out(const std::vector<Variation>& variations) {
    std::vector<std::string> names;
    std::vector<StudyRun> runs, again;
    // the variation of a measured stiffness shifts far from the result
    const std::vector<std::string> from_its_begin;
    for (const Variation& v : variations) {
      names.push_back(folder_of(v, of.name) + (v.sensitivity ? from_afar : ""));
      runs.push_back(
          run_of(v, folder / "scene.toml", of.settings, v.sensitivity ? from_its_begin : closer, names.back()));
    }
    if (carry_out_runs(runs, options).interrupted) return {};
    // a search that found nothing near the result is repeated over the original range
    for (std::size_t k = 0; k < variations.size(); ++k) {
      evaluations += found(names[k], "").contact_evaluations;
      const auto has = [&](const std::string& name) { return found(names[k], name).result.has_value(); };
      if (closer.empty() || names[k].ends_with(from_afar) || std::ranges::all_of(searched, has)) continue;
      names[k] += from_afar;
      again.push_back(run_of(variations[k], folder / "scene.toml", of.settings, {}, names[k]));
    }
    if (!again.empty() && carry_out_runs(again, options).interrupted) return {};
    for (const StudyRun& run : again)
      evaluations += found(run.name, "").contact_evaluations;
    return names;
  }

  RunFound found(const std::string& run, const std::string& quantity) const {
    StudyPlan plan;
    plan.quantity = quantity;
    plan.wide_brackets = true;
    const fs::path at = options.folder / run;
    return fs::exists(at / "results.json") ? found_in(at, plan) : RunFound{.status = "no results"};
  }

  // values of monitors at the end of a search depend on which of its trials was the last
  bool is_judged(const std::string& name) const { return searched.empty() || std::ranges::count(searched, name) > 0; }

  // The value that a run is compared with: a search that began near the result reached it by another path.
  double unvaried(const std::string& run, const std::string& name, const Value& answer) const {
    if (path.empty() || run.ends_with(from_afar)) return answer.value;
    return found(path, name).result->value;
  }

  // whether a run has every value that is judged, and each is unchanged
  bool moved_nothing(const std::string& run, const Results& results) const {
    return std::ranges::all_of(results.values, [&](const auto& entry) {
      const auto& [name, value] = entry;
      if (!is_judged(name)) return true;
      const RunFound then = found(run, name);
      return then.result && std::abs(then.result->value - unvaried(run, name, value)) <=
                                rounding * value.error_bar.value_or(std::abs(value.value));
    });
  }

  // If runs that began near the result shifted, one that varies nothing else gives the effect of the path. False:
  // interrupted.
  bool try_path(const std::vector<std::string>& names, const Results& results) {
    const auto moved = [&](const std::string& run) {
      return !run.ends_with(from_afar) && !moved_nothing(run, results);
    };
    if (closer.empty() || std::ranges::none_of(names, moved)) return true;
    const Variation nothing{"search", "begun near the result", 1, 0, [](double) { return std::vector<std::string>(); }};
    const std::string run = folder_of(nothing, of.name);
    if (carry_out_runs({run_of(nothing, folder / "scene.toml", of.settings, closer, run)}, options).interrupted)
      return false;
    evaluations += found(run, "").contact_evaluations;
    if (std::ranges::all_of(searched, [&](const std::string& name) { return found(run, name).result.has_value(); }))
      path = run;
    return true;
  }
};

}  // namespace

bool add_budget(const LoadedScene& scene, const BudgetRuns& of, const fs::path& folder, int threads, bool quiet,
                Results& results) {
  const bool searches = !searches_of(scene).empty();
  if (searches && std::ranges::none_of(results.values, [](const auto& v) { return v.second.error_bar.has_value(); }))
    return true;  // no value can have a budget
  const Variations all = variations_of(scene);
  const fs::path runs_folder = folder / "budget";
  fs::create_directories(runs_folder);
  RunsOptions options;
  options.folder = runs_folder;
  options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / threads);
  options.threads = threads;
  options.quiet = quiet;
  BudgetedRuns runs{of, folder, options, near(scene, results), {}, {}};
  for (const auto& [name, value] : results.values)
    if (value.error_bar) runs.searched.push_back(name);

  std::vector<Variation> variations;
  std::vector<std::string> names;
  const auto carry_out = [&](const std::vector<Variation>& some) {
    const std::optional<std::vector<std::string>> done = runs.carry_out(some);
    if (!done) return false;
    variations.insert(variations.end(), some.begin(), some.end());
    names.insert(names.end(), done->begin(), done->end());
    return runs.path.empty() ? runs.try_path(*done, results) : true;
  };
  // whether the last of them, several together, shifted a value; then they are varied separately
  const auto take_back_moved = [&] {
    if (runs.moved_nothing(names.back(), results)) return false;
    variations.pop_back();
    names.pop_back();
    return true;
  };
  std::vector<Variation> first = all.alone;
  first.push_back(at_once(all.together));
  if (!carry_out(first)) return false;
  if (all.together.size() > 1 && take_back_moved()) {
    const std::vector<Variation> others = without_first(all.together);
    if (!carry_out({all.together.front(), at_once(others)})) return false;
    if (others.size() > 1 && take_back_moved() && !carry_out(others)) return false;
  }
  results.budget_evaluations = runs.evaluations;

  std::set<std::string> untold;
  for (auto& [name, value] : results.values) {
    if (!runs.is_judged(name)) continue;
    double other = 0;
    for (std::size_t k = 0; k < variations.size(); ++k) {
      const Variation& v = variations[k];
      const RunFound then = runs.found(names[k], name);
      if (!then.result) {
        if (untold.insert(v.name).second)
          results.warnings.push_back(
              fmt::format("the budget of {} leaves out {}, {}: {}", name, v.name, v.change, then.status));
        continue;
      }
      const double shift = then.result->value - runs.unvaried(names[k], name, value);
      if (!v.sensitivity) other = std::max(other, then.result->error_bar.value_or(0));
      value.budget.push_back({v.name, v.change, shift, v.left_by(shift), v.sensitivity});
    }
    if (!runs.path.empty()) {
      const double shift = runs.found(runs.path, name).result->value - value.value;
      value.budget.push_back({"search", "begun near the result", shift, shift, false});
    }
    if (!value.budget.empty()) combine(other, value);
    judge_level(scene, name, value, results.warnings);
    std::ranges::stable_sort(value.budget, std::greater{}, [](const BudgetLine& l) { return std::abs(l.left); });
  }
  return true;
}

}  // namespace voussoir
