#include "core/scene/accuracy_target.hpp"

#include <charconv>

namespace voussoir {
namespace {

constexpr double largest_fraction = 0.5, largest_deg = 45;
// about 4000 rounding errors of a value: a search compares sums of as many forces
constexpr double least_fraction = 1e-12, least_deg = 1e-10;

bool says(const Node& table, std::string_view key, std::string_view text) {
  const Node* found = table.find(key);
  return found && found->text == text;
}

}  // namespace

std::optional<AccuracyTarget> accuracy_target(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !std::isfinite(number) || !(number > 0)) return std::nullopt;
  std::string_view unit(end, text.data() + text.size() - end);
  if (unit.starts_with(' ')) unit.remove_prefix(1);
  if (unit == "%" && number / 100 >= least_fraction && number / 100 <= largest_fraction)
    return AccuracyTarget{number / 100, true};
  if (unit == "deg" && number >= least_deg && number <= largest_deg) return AccuracyTarget{number, false};
  return std::nullopt;
}

std::optional<AccuracyTarget> accuracy_target(const Node& scene) {
  const std::optional<Subject> accuracy = child({&scene, ""}, "accuracy");
  const Node* stated = accuracy ? accuracy->node->find("error") : nullptr;
  if (!stated) return std::nullopt;
  const std::string path = key_path(accuracy->path, "error");
  const std::optional<AccuracyTarget> target = accuracy_target(stated->text);
  if (!target)
    refuse(*stated, path,
           "must be relative, \"1 %\", from 1e-10 to 50 %, or an angle, \"0.1 deg\", from 1e-10 to 45 deg: double "
           "precision allows no smaller "
           "error");
  bool searches = false;
  for (const Subject& stage : children({&scene, ""}, "stage")) {
    if (!says(*stage.node, "kind", "reduce")) continue;
    searches = true;
    if (!says(*stage.node, "method", "bisection") && stage.node->find("method"))
      refuse(*stated, path,
             "is reached by finer brackets, so it applies only if method = \"bisection\", which " + stage.path +
                 " does not state");
    if (!target->relative && says(*stage.node, "search", "factor"))
      refuse(*stated, path, stage.path + " searches for a factor, which is not an angle: state it as \"1 %\"");
  }
  if (!searches)
    refuse(*stated, path,
           "is the error of the result of a stage with kind = \"reduce\", and there is none; budget = true gives the "
           "errors of other "
           "values");
  const Node* budget = accuracy->node->find("budget");
  if (budget && !budget->boolean) return std::nullopt;
  return target;
}

}  // namespace voussoir
