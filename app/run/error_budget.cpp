#include "app/run/error_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <thread>

#include "app/base/digest.hpp"
#include "app/base/message.hpp"
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
    if (!found || !found->bracket) return {};
    const double unit = search.angle() ? degree : 1, half = *found->bracket, middle = *found->bracket_middle;
    const double from = (search.angle() ? plan.from : plan.factor.from) / unit,
                 to = (search.angle() ? plan.to : plan.factor.to) / unit;
    const double below = middle - (2 * brackets_below + 1) * half, above = middle + (2 * brackets_above + 1) * half;
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
       {v.overrides(),
        closer,
        {"accuracy.budget=false", "accuracy.error_bar=\"bracket\"", "output.frames=false", "output.view=false"}})
    run.overrides.insert(run.overrides.end(), more.begin(), more.end());
  return run;
}

std::string folder_of(const Variation& v, const std::string& run) {
  std::string name = v.change.ends_with(" at once") ? v.change : v.name + (v.refined == 1 ? "" : " " + v.change);
  std::ranges::replace(name, ' ', '_');
  std::erase_if(name, [](char c) { return !(std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-'); });
  return name + "-" + run;
}

std::vector<Variation> without_first(const std::vector<Variation>& variations) {
  return {variations.begin() + 1, variations.end()};
}

// by the same factor once more, which measures the order
Variation again(Variation v) {
  v.refined *= v.refined;
  v.change = fmt::format("{:g} times", v.refined);
  return v;
}

// the bar of one value, from the lines of its budget; `other`: the largest half bracket among the variations
void combine(double other, const char* covers, Value& value) {
  double squares = other * other;
  if (value.is_middle()) squares += std::pow(value.bracket.value_or(*value.error_bar), 2);
  squares += std::pow(value.criterion.value_or(0), 2);
  for (const BudgetLine& line : value.budget)
    squares += line.part * line.part;
  value.error_bar = std::sqrt(squares);
  value.covers = covers;
  std::ranges::stable_sort(value.budget, std::greater{}, [](const BudgetLine& l) { return std::abs(l.left); });
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

bool wants_stiffness_bar(const LoadedScene& scene) {
  if (!scene.stated || wants_budget(scene)) return false;
  const Node* accuracy = scene.stated->tree->find("accuracy");
  const Node* stated = accuracy ? accuracy->find("error_bar") : nullptr;
  return stated && stated->text == "stiffness";
}

std::vector<std::string> budget_folders(const LoadedScene& scene) {
  std::vector<Variation> variations{{"search", ""}};
  for (const ResultKind kind :
       {ResultKind::no_search, ResultKind::by_displacement, ResultKind::slides, ResultKind::turns}) {
    const Variations all = variations_of(scene, kind);
    for (const std::vector<Variation>& some :
         {all.alone, all.together, {at_once(all.together), at_once(without_first(all.together))}})
      variations.insert(variations.end(), some.begin(), some.end());
    if (const std::optional<Variation> of_bar = stiffness_of_bar(scene, kind)) variations.push_back(*of_bar);
    for (const Variation& v : all.alone)
      if (v.name == "stiffness") variations.push_back(again(v));
  }
  const int rounds = accuracy_target(*scene.stated->tree) ? most_rounds : 1;
  std::vector<std::string> folders;
  for (int round = 0; round < rounds; ++round) {
    const std::string run = budget_runs(scene, round, {}).name;
    for (const Variation& v : variations)
      for (const char* kind : {"", from_afar})
        folders.push_back("budget/" + folder_of(v, run) + kind);
  }
  std::ranges::sort(folders);
  folders.erase(std::unique(folders.begin(), folders.end()), folders.end());
  return folders;
}

BudgetRuns budget_runs(const LoadedScene& stated, int round, const std::vector<std::string>& settings) {
  const std::string run = digest(stated.hash + program_digest());
  return {round == 0 ? run : fmt::format("{}-{}", run, round + 1), settings};
}

namespace {

// how a result follows from its trials: a shift is one of the same only
enum class Sort { middle, strength, fit };
Sort sort_of(const Value& value) {
  if (value.found_by == found_by_strength) return Sort::strength;
  return value.found_by == found_by_fit ? Sort::fit : Sort::middle;
}

// the budget's runs, in a folder within that of the run
struct BudgetedRuns {
  BudgetRuns of;
  fs::path folder;
  RunsOptions options;
  std::vector<std::string> closer;    // overrides that let searches look near the result
  std::vector<std::string> searched;  // the values that searches found; without any all values are compared
  std::string path;                   // the run that varies only the begin of its searches; may be empty
  long long evaluations = 0;
  std::vector<Variation> variations;  // carried out, and the names of their runs
  std::vector<std::string> names;

  // the name of each variation's run; nothing: interrupted
  std::optional<std::vector<std::string>> carry_out(const std::vector<Variation>& some) {
    std::vector<std::string> done;
    std::vector<StudyRun> runs, again;
    // the variation of a measured stiffness shifts far from the result
    const std::vector<std::string> from_its_begin;
    for (const Variation& v : some) {
      done.push_back(folder_of(v, of.name) + (v.sensitivity ? from_afar : ""));
      runs.push_back(
          run_of(v, folder / "scene.toml", of.settings, v.sensitivity ? from_its_begin : closer, done.back()));
    }
    if (carry_out_runs(runs, options).interrupted) return {};
    // a search that found nothing near the result is repeated over the original range
    for (std::size_t k = 0; k < some.size(); ++k) {
      evaluations += found(done[k], "").contact_evaluations;
      const auto has = [&](const std::string& name) { return found(done[k], name).result.has_value(); };
      if (closer.empty() || done[k].ends_with(from_afar) || std::ranges::all_of(searched, has)) continue;
      done[k] += from_afar;
      again.push_back(run_of(some[k], folder / "scene.toml", of.settings, {}, done[k]));
    }
    if (!again.empty() && carry_out_runs(again, options).interrupted) return {};
    for (const StudyRun& run : again)
      evaluations += found(run.name, "").contact_evaluations;
    return done;
  }

  // the same, and notes them; false: interrupted
  bool add(const std::vector<Variation>& some, const Results& results) {
    const std::optional<std::vector<std::string>> done = carry_out(some);
    if (!done) return false;
    variations.insert(variations.end(), some.begin(), some.end());
    names.insert(names.end(), done->begin(), done->end());
    return path.empty() ? try_path(*done, results) : true;
  }

  // whether the last of them, several together, shifted a value; then it is forgotten, to be varied apart
  bool take_back_moved(const Results& results) {
    if (moved_nothing(names.back(), results)) return false;
    variations.pop_back();
    names.pop_back();
    return true;
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
  bool try_path(const std::vector<std::string>& done, const Results& results) {
    const auto moved = [&](const std::string& run) {
      return !run.ends_with(from_afar) && !moved_nothing(run, results);
    };
    if (closer.empty() || std::ranges::none_of(done, moved)) return true;
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

BudgetedRuns runs_of(const BudgetRuns& of, const fs::path& folder, int threads, bool quiet, const Results& results) {
  BudgetedRuns runs{of, folder, {}, {}, {}, {}, 0, {}, {}};
  runs.options.folder = folder / "budget";
  fs::create_directories(runs.options.folder);
  runs.options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / threads);
  runs.options.threads = threads;
  runs.options.quiet = quiet;
  for (const auto& [name, value] : results.values)
    if (value.error_bar) runs.searched.push_back(name);
  return runs;
}

// A variation's line of a value's budget; `other`: the largest half bracket of results of its kind. Between results of
// two kinds, an estimate and the middle of a bracket, the errors of both are added to the shift.
void add_line(const BudgetedRuns& runs, std::size_t k, const std::string& name, Value& value, double& other,
              std::vector<std::string>& warnings) {
  const Variation& v = runs.variations[k];
  const RunFound then = runs.found(runs.names[k], name);
  if (!then.result) {
    value.not_varied.push_back(v.name);
    warnings.push_back(fmt::format("the budget of {} leaves out {}, {}: {}", name, v.name, v.change, then.status));
    return;
  }
  const bool same = sort_of(*then.result) == sort_of(value);
  BudgetLine line{v.name, v.change, then.result->value - runs.unvaried(runs.names[k], name, value),
                  0,      0,        v.sensitivity};
  double halves = 0;
  if (!same && !v.sensitivity) {
    const double own = value.is_middle() ? value.bracket.value_or(0) : value.criterion.value_or(0);
    halves = std::hypot(own, then.result->error_bar.value_or(0));
  } else if (!v.sensitivity && value.is_middle()) {
    other = std::max(other, then.result->bracket.value_or(then.result->error_bar.value_or(0)));
  }
  line.left = v.left_by(line.shift);
  const bool shifted = std::abs(line.shift) > rounding * value.error_bar.value_or(0);
  if (!v.sensitivity) line.part = std::hypot(shifted ? part_of(line.left) : 0, halves);
  value.budget.push_back(std::move(line));
}

// The order of the stiffness' error, if its shift is larger than the accuracy asked for, by a second factor of the same
// size. False: interrupted.
bool measure_order(const LoadedScene& scene, BudgetedRuns& runs, Results& results) {
  const std::optional<AccuracyTarget> target = accuracy_target(*scene.stated->tree);
  const auto first = std::ranges::find(runs.variations, "stiffness", &Variation::name);
  if (first == runs.variations.end()) return true;
  const Variation second = again(*first);
  const std::string nearer = runs.names[first - runs.variations.begin()];
  std::string farther;
  for (const Search& search : searches_of(scene)) {
    const auto at = std::ranges::find(results.values, search.value, &std::pair<std::string, Value>::first);
    if (at == results.values.end()) continue;
    Value& value = at->second;
    const auto line = std::ranges::find(value.budget, "stiffness", &BudgetLine::varied);
    const double asked = target ? target->allowed(value.value) : search.tolerance();
    if (line == value.budget.end() || !(std::abs(line->shift) > asked)) continue;
    if (farther.empty()) {
      const auto done = runs.carry_out({second});
      if (!done) return false;
      farther = done->front();
    }
    const RunFound one = runs.found(nearer, search.value), two = runs.found(farther, search.value);
    if (!one.result || !two.result || sort_of(*one.result) != sort_of(value) ||
        sort_of(*two.result) != sort_of(value)) {
      results.warnings.push_back(fmt::format(
          "the order of the error of {} in stiffness is not measured, and taken as 1: its results with stiffness, {} "
          "and {}, do not follow from their trials in the same way",
          search.value, first->change, second.change));
      continue;
    }
    const double further = two.result->value - one.result->value;
    const std::optional<double> left = left_by_measured_order(line->shift, further, first->refined, first->order);
    line->left = left.value_or(std::copysign(std::abs(line->shift) + std::abs(first->left_by(further)), line->shift));
    line->part = part_of(line->left);
    line->change = first->change + " and " + second.change;
    if (!left)
      results.warnings.push_back(
          fmt::format("{} does not converge with stiffness: {:+.2g} with {}, {:+.2g} more with {}; the bar covers both",
                      search.value, line->shift, first->change, further, second.change));
  }
  return true;
}

std::string runs_text(const std::vector<Variation>& alone, const std::vector<Variation>& together, ResultKind kind) {
  std::string text;
  for (const Variation& v : alone)
    text +=
        fmt::format("{}, {}{}; ", v.name, v.change,
                    kind == ResultKind::slides && v.name == "stiffness" ? ", and again if that shifts the result" : "");
  if (!together.empty()) text += at_once(together).name + " at once";
  return text;
}

}  // namespace

bool add_budget(const LoadedScene& scene, const BudgetRuns& of, const fs::path& folder, int threads, bool quiet,
                Results& results) {
  const ResultKind kind = kind_of(scene, results);
  if (kind != ResultKind::no_search &&
      std::ranges::none_of(results.values, [](const auto& v) { return v.second.error_bar.has_value(); }))
    return true;  // no value can have a budget
  const Variations all = variations_of(scene, kind);
  BudgetedRuns runs = runs_of(of, folder, threads, quiet, results);
  if (kind == ResultKind::by_displacement) runs.closer = near(scene, results);
  const bool judged = kind == ResultKind::slides || kind == ResultKind::turns;

  std::vector<Variation> first = all.alone;
  first.push_back(at_once(all.together));
  if (!quiet) {
    // together they are varied apart at most twice; a second factor of stiffness; the path
    const std::size_t more = kind == ResultKind::slides ? 1 : kind == ResultKind::by_displacement ? 3 : 0;
    tell("voussoir: error budget: {}{} more evaluations of the result{}: {}\n", more > 0 ? "at most " : "",
         first.size() + more, runs.closer.empty() ? "" : ", each from near it",
         runs_text(all.alone, all.together, kind));
  }
  if (!runs.add(first, results)) return false;
  if (!judged && all.together.size() > 1 && runs.take_back_moved(results)) {
    const std::vector<Variation> others = without_first(all.together);
    if (!runs.add({all.together.front(), at_once(others)}, results)) return false;
    const bool apart = kind == ResultKind::no_search && others.size() > 1;
    if (apart && runs.take_back_moved(results) && !runs.add(others, results)) return false;
  }

  std::map<std::string, double> other;
  for (auto& [name, value] : results.values) {
    if (!runs.is_judged(name)) continue;
    for (std::size_t k = 0; k < runs.variations.size(); ++k)
      add_line(runs, k, name, value, other[name], results.warnings);
    if (runs.path.empty()) continue;
    const double shift = runs.found(runs.path, name).result->value - value.value;
    value.budget.push_back({"search", "begun near the result", shift, shift, part_of(shift), false});
  }
  if (kind == ResultKind::slides && !measure_order(scene, runs, results)) return false;
  for (auto& [name, value] : results.values) {
    if (!value.budget.empty()) combine(other[name], "budget", value);
    judge_level(scene, name, value, results.warnings);
  }
  results.budget_evaluations = runs.evaluations;
  return true;
}

bool add_stiffness_bar(const LoadedScene& scene, const BudgetRuns& of, const fs::path& folder, int threads, bool quiet,
                       Results& results) {
  const std::optional<Variation> variation = stiffness_of_bar(scene, kind_of(scene, results));
  if (!variation) return true;
  BudgetedRuns runs = runs_of(of, folder, threads, quiet, results);
  if (!runs.add({*variation}, results)) return false;
  for (auto& [name, value] : results.values) {
    if (!runs.is_judged(name) || !value.error_bar) continue;
    double other = 0;
    add_line(runs, 0, name, value, other, results.warnings);
    if (!value.budget.empty()) combine(other, "stiffness", value);
  }
  results.budget_evaluations = runs.evaluations;
  return true;
}

}  // namespace voussoir
