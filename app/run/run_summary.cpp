#include "app/run/run_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/base/progress_line.hpp"
#include "app/base/shown_unit.hpp"
#include "core/output/support_summary.hpp"
#include "core/run/block_theory.hpp"
#include "core/run/stable_state.hpp"
#include "core/scene/stage_excavations.hpp"

namespace voussoir {
namespace {

// The parts of a bar, the largest of the budget's first: "bracket 0.003, criterion 0.05, stiffness 0.11".
std::string parts_text(const Value& value, const ShownUnit& shown) {
  constexpr double least_printed = 0.05;  // of the bar; results.json has all
  std::vector<std::string> parts;
  const auto add = [&](const std::string& name, double size) {
    if (size > least_printed * *value.error_bar) parts.push_back(fmt::format("{} {:.2g}", name, size / shown.size));
  };
  if (value.is_middle() && value.bracket) add("bracket", *value.bracket);
  if (value.criterion) add("criterion", *value.criterion);
  for (const BudgetLine& line : value.budget)
    add(line.varied, line.part);
  if (!value.not_varied.empty()) parts.push_back(fmt::format("without {}", fmt::join(value.not_varied, ", ")));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string covers_text(const Value& value, const ShownUnit& shown) {
  if (value.covers == "bracket") return "search bracket only; --budget adds the model's errors";
  const std::string parts = parts_text(value, shown);
  const std::string kind =
      value.covers == "criterion" ? "--budget adds the model's errors; numerical error only" : "numerical error only";
  return parts + (parts.empty() ? "" : "; ") + kind;
}

// an error bar needs two digits, and its value as many places
std::string value_text(const Value& value, const ShownUnit& shown) {
  const std::string unit = after_value(shown);
  if (!std::isfinite(value.value)) return "not a finite number" + unit;
  if (!value.error_bar || *value.error_bar <= 0) return fmt::format("{:.6g}{}", value.value / shown.size, unit);
  const double error_bar = *value.error_bar / shown.size;
  const int places = std::clamp(1 - static_cast<int>(std::floor(std::log10(error_bar))), 0, 15);
  return fmt::format("{:.{}f} ± {:.{}f}{} ({})", value.value / shown.size, places, error_bar, places, unit,
                     covers_text(value, shown));
}

void print_budget(const Value& value, const ShownUnit& shown) {
  constexpr double least_printed = 0.01;  // of the bar; results.json has all
  for (const BudgetLine& line : value.budget) {
    if (!line.sensitivity && !(std::abs(line.left) >= least_printed * value.error_bar.value_or(0) && line.left != 0))
      continue;
    std::string remains = fmt::format("remaining error {:+.2g}", line.left / shown.size);
    // of known sign: it falls in proportion to the stiffness
    if (line.varied == "stiffness" && !value.found_by.empty())
      remains += fmt::format(": rigid joints would give {:.6g}", (value.value + line.left) / shown.size);
    if (line.sensitivity) remains = "measured: a sensitivity, no error";
    fmt::print("      {:+.2g}{} with {}, {}: {}\n", line.shift / shown.size, after_value(shown), line.varied,
               line.change, remains);
  }
}

// bodies whose position of equilibrium differs from that at the begin of the stage
void print_moved(const std::vector<MovedBody>& moved) {
  constexpr std::size_t most_moved_shown = 10;
  for (std::size_t k = 0; k < std::min(moved.size(), most_moved_shown); ++k) {
    const MovedBody& m = moved[k];
    fmt::print("  moved in stage {}: body {}{} by {:.3g} m, now in equilibrium at ({:.4g}){}\n", m.stage, m.body,
               m.name.empty() ? "" : " (" + m.name + ")", m.distance, fmt::join(m.place, ", "),
               m.left_all ? ", in other contacts" : "");
  }
  if (moved.size() > most_moved_shown)
    fmt::print("  and {} more (results.json, moved)\n", moved.size() - most_moved_shown);
}

void print_values(const std::vector<std::pair<std::string, Value>>& values, const std::set<std::string>& per_metre) {
  std::size_t width = 0;
  for (const auto& [name, value] : values)
    width = std::max(width, name.size());
  for (const auto& [name, value] : values) {
    ShownUnit shown = shown_unit(value.unit);
    if (per_metre.contains(name)) shown.name += "/m";
    fmt::print("  {:<{}}  {}{}\n", name, width, value_text(value, shown),
               value.rule.empty() ? "" : "  (" + value.rule + ")");
    print_budget(value, shown);
    if (!value.divides.empty()) fmt::print("      it {}\n", value.divides);
  }
  const auto has_bar = [](const auto& named) { return named.second.error_bar.value_or(0) > 0; };
  if (std::ranges::any_of(values, has_bar))
    fmt::print("  (±: numerical error; it says nothing of strengths, geometry or water)\n");
}

void print_stages(const Results& results) {
  int number = 0;
  for (const StageResult& stage : results.stages) {
    fmt::print("  stage {}: {} after {} steps, {:.4g} s simulated\n", stage.name, stage.ended, stage.steps, stage.time);
    if (const auto& half = stage.half_error)
      fmt::print("      {} has moved most, {:.4g} m; with half of error_m no block ends more than {:.2g} m elsewhere\n",
                 half->name.empty() ? fmt::format("body {}", half->body) : half->name, half->displacement,
                 half->change);
    // that of an incomplete stage ends the message
    if (const std::string sentence = sentence_of(stage.mechanism); !results.message.ends_with(sentence))
      fmt::print("      {}\n", sentence);
    const SupportsCarry carry = supports_carry(results, ++number);
    for (const BoltsCarry& bolts : carry.bolts)
      fmt::print("      {}\n", text_of(bolts));
    for (const LiningCarries& lining : carry.linings)
      fmt::print("      {}\n", text_of(lining));
    for (const StableState& at : results.at_last_stable_state) {
      if (at.stage != stage.name) continue;
      if (at.bonds) fmt::print("      {}: {}\n", moment_text(at), bonds_text(*at.bonds));
      for (const std::string& line : search_text(at))
        fmt::print("      {}\n", line);
      if (at.block_theory) fmt::print("      {}\n", text_of(*at.block_theory, at.unit));
    }
  }
}

std::string reasons_of_fallbacks(const Counters& counters) {
  if (counters.unconverged_fallbacks == 0) return ": bonds broke";
  if (counters.broken_bonds_fallbacks == 0) return ": no equilibrium within its iterations";
  return fmt::format(": in {} bonds broke, in {} it found no equilibrium within its iterations",
                     counters.broken_bonds_fallbacks, counters.unconverged_fallbacks);
}

void print_cost(const Results& results, const std::vector<AccuracyRound>& rounds) {
  const Counters& counters = results.counters;
  fmt::print("  {} steps, {} contact evaluations, {}\n", counters.steps, counters.contact_evaluations,
             duration_text(results.seconds));
  if (counters.static_fallbacks > 0)
    fmt::print("  Newton's method left {} of its increments to relaxation{}\n", counters.static_fallbacks,
               reasons_of_fallbacks(counters));
  if (counters.implicit_solutions > 0)
    fmt::print(
        "  implicit steps: {} systems, {:.2g} iterations each; {} held by load or output, {} by their error; {} "
        "refused, {} halved\n",
        counters.implicit_solutions,
        static_cast<double>(counters.implicit_iterations) / static_cast<double>(counters.implicit_solutions),
        counters.implicit_by_load, counters.implicit_by_error, counters.implicit_refused, counters.implicit_halved);
  for (std::size_t k = 0; k + 1 < rounds.size(); ++k)
    fmt::print("  round {}: {} contact evaluations; {}\n", k + 1, rounds[k].contact_evaluations, rounds[k].told);
  if (results.budget_evaluations > 0)
    fmt::print("  error budget: {} contact evaluations, {:.2g} times those of the run\n", results.budget_evaluations,
               static_cast<double>(results.budget_evaluations) / static_cast<double>(counters.contact_evaluations));
}

}  // namespace

template <int Dim>
std::set<std::string> forces_per_metre(const std::vector<Monitor>& monitors) {
  std::set<std::string> names;
  if (Dim == 3) return names;
  for (const Monitor& monitor : monitors) {
    if (monitor.followed.quantity == Quantity::bolt_force) continue;
    for (const Column& column : monitor_columns<Dim>({monitor}))
      if (column.unit == "N" || column.unit == "Nm") names.insert(column.name);
  }
  return names;
}
template std::set<std::string> forces_per_metre<2>(const std::vector<Monitor>& monitors);
template std::set<std::string> forces_per_metre<3>(const std::vector<Monitor>& monitors);

void print_summary(const std::string& title, const Results& results, const std::vector<AccuracyRound>& rounds,
                   const std::set<std::string>& per_metre, const std::filesystem::path& folder) {
  const std::string message = results.message.empty() ? "" : ": " + results.message;
  fmt::print("{}{}{}\n", title.empty() ? "" : title + " - ", outcome_name(results.outcome), message);
  print_values(results.values, per_metre);
  print_stages(results);
  if (const auto& bonds = results.bonds)
    fmt::print(
        "  bonds: {} made, {} whole, {} broken, {} removed with their blocks; {} joints not yet in compression\n",
        bonds->made, bonds->whole, bonds->broken, bonds->removed, bonds->due);
  print_moved(results.moved);
  if (results.forces_remaining > 0)
    fmt::print("  excavation_forces: {} at the end\n", remaining_text(results.forces_remaining));
  print_cost(results, rounds);
  fmt::print("results: {}\n", folder.string());
}

}  // namespace voussoir
