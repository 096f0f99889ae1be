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

// the bracket's part of a bar, those of the variations' searches included
double bracket_of(const Value& value) {
  if (!value.bracket) return std::sqrt(2.0) * value.error_bar.value_or(0);
  double squares = *value.error_bar * *value.error_bar;
  for (const BudgetLine& line : value.budget)
    squares -= square_of(line);
  return std::max(std::sqrt(std::max(squares, 0.0)), *value.bracket);
}

std::vector<const Value*> searched(const LoadedScene& scene, const Results& results) {
  std::vector<const Value*> values;
  for (const Search& search : searches_of(scene))
    if (const Value* value = results.find(search.value); value && value->error_bar) values.push_back(value);
  return values;
}

// the cost of a result with this setting refined by a factor, over the present cost
double cost_of(const std::string& name, double finer) {
  if (name == "normal stiffness") return std::sqrt(finer);
  if (name == "time step") return finer;
  if (name == "points") return finer;
  if (name == "ramp") return 0.5 * (1 + finer);
  return 1;
}

std::string bar_text(const std::string& name, const Value& value, const AccuracyTarget& target) {
  const bool known = value.covers == "budget";
  return fmt::format("{} is known to ± {:.2g}{}{}, requested {:.2g}", name,
                     known ? *value.error_bar : bracket_of(value), value.unit == "1" ? "" : " " + value.unit,
                     known ? "" : " by brackets alone", target.allowed(value.value));
}

}  // namespace

std::optional<AccuracyTarget> wanted_accuracy(const LoadedScene& scene) {
  return scene.stated ? accuracy_target(*scene.stated->tree) : std::nullopt;
}

bool brackets_too_wide(const LoadedScene& scene, const AccuracyTarget& target, const Results& results) {
  return std::ranges::any_of(searched(scene, results),
                             [&](const Value* value) { return bracket_of(*value) > target.allowed(value->value); });
}

std::optional<Refinement> refinement(const LoadedScene& scene, const AccuracyTarget& target, int rounds,
                                     Results& results) {
  // factor by which each contribution exceeds its share, the largest over the values
  std::map<std::string, double> wide;
  std::string open;
  for (const Search& search : searches_of(scene)) {
    const Value* value = results.find(search.value);
    if (!value || !value->error_bar) continue;
    const double allowed = target.allowed(value->value);
    const bool known = value->covers == "budget";
    if (known && *value->error_bar <= allowed) continue;
    open += (open.empty() ? "" : "; ") + bar_text(search.value, *value, target);
    const auto widen = [&](const std::string& name, double size) {
      wide[name] = std::max(wide[name], size / (share * allowed));
    };
    widen(search.path, bracket_of(*value));
    for (const BudgetLine& line : value->budget)
      if (!line.sensitivity) widen(line.varied, std::sqrt(square_of(line)));
  }
  if (wide.empty()) return std::nullopt;

  double widest = 0;
  for (const auto& [name, times] : wide)
    widest = std::max(widest, times);
  const double from = std::min(1.0, widest / 1.5);  // if all contributions are small: the largest of them

  Refinement next;
  std::vector<std::string> finer, left;
  const auto refine = [&](const std::string& name, double times, const std::vector<std::string>& overrides) {
    next.overrides.insert(next.overrides.end(), overrides.begin(), overrides.end());
    finer.push_back(fmt::format("{} {:.2g} times finer", name, times));
    next.cost *= cost_of(name, times);
  };
  for (const Search& search : searches_of(scene)) {
    const double times = std::min(wide[search.path] / from, most_at_once);
    if (wide[search.path] <= from) continue;
    const double tolerance = search.angle() ? search.plan.tolerance / degree : search.plan.factor.tolerance;
    refine("bracket", times,
           {set(search.path, search.angle() ? "tolerance_deg" : "tolerance_factor", tolerance / times)});
  }
  const Variations all = variations_of(scene);
  std::map<std::string, double> times;  // the factor by which each variation is refined
  std::vector<Variation> variations = all.alone;
  variations.insert(variations.end(), all.together.begin(), all.together.end());
  for (const Variation& v : variations) {
    const auto found = wide.find(v.name);
    if (found == wide.end() || found->second <= from) continue;
    if (v.order == 0) {
      left.push_back(v.name);
      continue;
    }
    double& most = times[v.refined_by.empty() ? v.name : v.refined_by];
    most = std::max(most, std::min(std::pow(found->second / from, 1 / v.order), most_at_once));
  }
  for (const Variation& v : variations)
    if (const auto found = times.find(v.name); found != times.end()) refine(v.name, found->second, v.by(found->second));
  if (next.overrides.empty() || rounds >= most_rounds) {
    results.outcome = Outcome::incomplete;
    results.message = fmt::format("accuracy.error is not reached: {} after {} rounds; {}", open, rounds,
                                  left.empty() ? fmt::format("the next would take {}", fmt::join(finer, ", "))
                                               : fmt::format("no finer {} is known", fmt::join(left, ", ")));
    return std::nullopt;
  }
  next.summary = fmt::format("{}; next round: {}", open, fmt::join(finer, ", "));
  return next;
}

}  // namespace voussoir
