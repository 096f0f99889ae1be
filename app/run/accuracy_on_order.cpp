#include "app/run/accuracy_on_order.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/run/budget_variations.hpp"
#include "core/scene/scene.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// A contribution above this fraction of the target is refined to this fraction: three such contributions and the
// bracket stay within the target.
constexpr double share = 1.0 / 3;

constexpr double most_at_once = 100;  // times finer in one round; a wrong order would ask for more

// The bracket's part of a bar, those of the variations' searches included; before a budget with one of the same width.
double bracket_of(const Value& value) {
  if (!value.is_middle()) return 0;
  const double own = value.bracket.value_or(*value.error_bar);
  if (value.covers != "budget") return std::sqrt(2.0) * own;
  double squares = *value.error_bar * *value.error_bar - std::pow(value.criterion.value_or(0), 2);
  for (const BudgetLine& line : value.budget)
    squares -= line.part * line.part;
  return std::max(std::sqrt(std::max(squares, 0.0)), own);
}

// the parts of a bar that can be refined, by name: "bracket", "criterion", those of the budget
std::map<std::string, double> parts_of(const Value& value) {
  std::map<std::string, double> parts;
  if (value.is_middle()) parts["bracket"] = bracket_of(value);
  if (value.criterion) parts["criterion"] = *value.criterion;
  for (const BudgetLine& line : value.budget)
    if (!line.sensitivity) parts[line.varied] = line.part;
  return parts;
}

std::vector<const Value*> searched(const LoadedScene& scene, const Results& results) {
  std::vector<const Value*> values;
  for (const Search& search : searches_of(scene))
    if (const Value* value = results.find(search.value); value && value->error_bar) values.push_back(value);
  return values;
}

// the cost of a result with this setting refined by a factor, over the present cost
double cost_of(const std::string& name, double finer) {
  if (name == "normal stiffness" || name == "stiffness") return std::sqrt(finer);
  if (name == "time step") return finer;
  if (name == "points") return finer;
  if (name == "ramp") return 0.5 * (1 + finer);
  return 1;
}

std::string bar_text(const std::string& name, const Value& value, const AccuracyTarget& target) {
  const bool known = value.covers == "budget";
  return fmt::format("{} is known to ± {:.2g}{}{}, requested {:.2g}", name,
                     known ? *value.error_bar : std::max(bracket_of(value), *value.error_bar),
                     value.unit == "1" ? "" : " " + value.unit, known ? "" : " by brackets alone",
                     target.allowed(value.value));
}

constexpr const char* whole_bar = "error bar";  // its name among the parts of a round

// of an earlier size: a part that is larger has not become smaller
constexpr double no_smaller = 0.95;

std::optional<double> least_before(const std::vector<AccuracyRound>& rounds, const std::string& part) {
  std::optional<double> least;
  for (const AccuracyRound& round : rounds)
    if (const auto found = round.parts.find(part); found != round.parts.end())
      least = std::min(least.value_or(found->second), found->second);
  return least;
}

// whether a part of a bar was seen in an earlier round and has not become smaller
bool resists(const std::vector<AccuracyRound>& rounds, const std::string& part, double size) {
  const std::optional<double> earlier = least_before(rounds, part);
  return earlier && size > no_smaller * *earlier;
}

// a budget that refines and finds a wider bar says which part has grown
void explain_wider(const std::string& name, const Value& value, const std::vector<AccuracyRound>& rounds,
                   std::vector<std::string>& warnings) {
  const std::optional<double> narrowest = least_before(rounds, name + ": " + whole_bar);
  if (value.covers != "budget" || !narrowest || *value.error_bar <= *narrowest) return;
  std::vector<std::string> grown;
  for (const auto& [part, size] : parts_of(value)) {
    const std::optional<double> earlier = least_before(rounds, name + ": " + part);
    if (!earlier && size > 0) grown.push_back(fmt::format("{} {:.2g} (not seen before)", part, size));
    if (earlier && size > *earlier) grown.push_back(fmt::format("{} {:.2g} after {:.2g}", part, size, *earlier));
  }
  warnings.push_back(fmt::format("the bar of {} is {:.2g}, wider than the {:.2g} of an earlier round: {}", name,
                                 *value.error_bar, *narrowest, fmt::join(grown, ", ")));
}

}  // namespace

std::map<std::string, double> parts_of_bars(const LoadedScene& scene, const Results& results) {
  std::map<std::string, double> parts;
  for (const Search& search : searches_of(scene)) {
    const Value* value = results.find(search.value);
    if (!value || value->covers != "budget") continue;
    for (const auto& [part, size] : parts_of(*value))
      parts[search.value + ": " + part] = size;
    parts[search.value + ": " + whole_bar] = *value->error_bar;
  }
  return parts;
}

std::optional<AccuracyTarget> wanted_accuracy(const LoadedScene& scene) {
  return scene.stated ? accuracy_target(*scene.stated->tree) : std::nullopt;
}

bool brackets_too_wide(const LoadedScene& scene, const AccuracyTarget& target, const Results& results) {
  return std::ranges::any_of(searched(scene, results),
                             [&](const Value* value) { return bracket_of(*value) > target.allowed(value->value); });
}

namespace {

// how far the parts of all bars that are too wide exceed their share
struct Excess {
  std::map<std::string, double> times;  // by bracket or criterion and the path of its search, or by variation
  std::vector<std::string> resisting;   // refined before in vain
  std::string open;                     // the bars, for the user

  double of(const std::string& part) const {
    const auto found = times.find(part);
    return found == times.end() ? 0 : found->second;
  }
};

Excess excess_of(const LoadedScene& scene, const AccuracyTarget& target, const std::vector<AccuracyRound>& rounds,
                 Results& results) {
  Excess excess;
  for (const Search& search : searches_of(scene)) {
    const Value* value = results.find(search.value);
    if (!value || !value->error_bar) continue;
    explain_wider(search.value, *value, rounds, results.warnings);
    const double allowed = target.allowed(value->value);
    const bool known = value->covers == "budget";
    if (known && *value->error_bar <= allowed) continue;
    excess.open += (excess.open.empty() ? "" : "; ") + bar_text(search.value, *value, target);
    for (const auto& [part, size] : parts_of(*value)) {
      const bool own = part == "bracket" || part == "criterion";
      double& most = excess.times[own ? part + " " + search.path : part];
      const double times = size / (share * allowed);
      most = std::max(most, times);
      // by itself too large, whatever becomes of the others
      if (times * share > 1 && resists(rounds, search.value + ": " + part, size)) excess.resisting.push_back(part);
    }
  }
  return excess;
}

// factors of refinement by variation, and the parts that nothing refines
struct Finer {
  std::map<std::string, double> times;
  std::vector<std::string> left;
};

Finer finer_variations(const Variations& all, const Excess& excess, double from) {
  Finer finer;
  const std::string together = at_once(all.together).name;
  const std::string others =
      all.together.size() > 1 ? at_once({all.together.begin() + 1, all.together.end()}).name : "";
  const auto ask = [&](const Variation& v, double over) {
    if (over <= from) return;
    if (v.order == 0) {
      finer.left.push_back(v.name);
      return;
    }
    double& most = finer.times[v.refined_by.empty() ? v.name : v.refined_by];
    most = std::max(most, std::min(std::pow(over / from, 1 / v.order), most_at_once));
  };
  for (const Variation& v : all.alone)
    ask(v, excess.of(v.name));
  // several at once: each of them may be the cause
  for (std::size_t k = 0; k < all.together.size(); ++k)
    ask(all.together[k],
        std::max({excess.of(all.together[k].name), excess.of(together), k > 0 ? excess.of(others) : 0.0}));
  return finer;
}

}  // namespace

std::optional<Refinement> refinement(const LoadedScene& scene, const AccuracyTarget& target,
                                     const std::vector<AccuracyRound>& rounds, Results& results) {
  const Excess excess = excess_of(scene, target, rounds, results);
  if (excess.open.empty()) return std::nullopt;
  double widest = 0;
  for (const auto& [name, times] : excess.times)
    widest = std::max(widest, times);
  const double from = std::min(1.0, widest / 1.5);  // if all contributions are small: the largest of them

  const Variations all = variations_of(scene, kind_of(scene, results));
  Finer variations = finer_variations(all, excess, from);
  Refinement next;
  std::vector<std::string> finer;
  const auto refine = [&](const std::string& name, double times, const std::vector<std::string>& overrides) {
    next.overrides.insert(next.overrides.end(), overrides.begin(), overrides.end());
    finer.push_back(fmt::format("{} {:.2g} times finer", name, times));
    next.cost *= cost_of(name, times);
  };
  for (const Search& search : searches_of(scene)) {
    // The estimates of a search agree the better the nearer its trials come, and each is taken over fewer elastic
    // displacements' way to zero the stiffer the joints are.
    const double bracket = excess.of("bracket " + search.path), criterion = excess.of("criterion " + search.path);
    const double times = std::min(std::max(bracket, criterion) / from, most_at_once);
    if (std::max(bracket, criterion) <= from) continue;
    refine(bracket >= criterion ? "bracket" : "criterion", times,
           {set(search.path, search.angle() ? "tolerance_deg" : "tolerance_factor", search.tolerance() / times)});
    const bool stiffens = std::ranges::count(all.alone, "stiffness", &Variation::name) > 0;
    if (criterion > from && stiffens) {
      double& most = variations.times["stiffness"];
      most = std::max(most, std::min(criterion / from, most_at_once));
    }
  }
  for (const std::vector<Variation>* some : {&all.alone, &all.together})
    for (const Variation& v : *some)
      if (const auto found = variations.times.find(v.name); found != variations.times.end())
        refine(v.name, found->second, v.by(found->second));

  const int number = static_cast<int>(rounds.size()) + 1;
  const bool in_vain = !excess.resisting.empty() && number > 2;
  if (next.overrides.empty() || number >= most_rounds || in_vain) {
    std::vector<std::string> reasons;
    if (!variations.left.empty())
      reasons.push_back(fmt::format("no finer {} is known", fmt::join(variations.left, ", ")));
    if (!excess.resisting.empty())
      reasons.push_back(fmt::format("{} was refined and is no smaller", fmt::join(excess.resisting, ", ")));
    if (reasons.empty()) reasons.push_back(fmt::format("the next would take {}", fmt::join(finer, ", ")));
    results.outcome = Outcome::incomplete;
    results.message = fmt::format("accuracy.error is not reached: {} after {} round{}; {}", excess.open, number,
                                  number == 1 ? "" : "s", fmt::join(reasons, "; "));
    return std::nullopt;
  }
  next.summary = fmt::format("{}; next round: {}", excess.open, fmt::join(finer, ", "));
  return next;
}

}  // namespace voussoir
