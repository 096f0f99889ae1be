#include "app/derivatives/derivative_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/bad_input.hpp"
#include "core/scene/scene_error.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

// first steps: what answers bend over
constexpr double bend_angle = 30;     // deg
constexpr double least_share = 1e-2;  // of it, by exact answers, whose extrapolation takes care of the rest
constexpr double most_share = 0.05;
constexpr double order_of_share = 0.2;  // of the answer's bar: between 1/3 of differences and 1/7 of two extrapolations
constexpr double at_once = 1e-5;        // of the first step: the piece of the base has no length that bisection sees
constexpr std::size_t longest_reason = 100;  // letters
constexpr double no_change = 1e-11;          // of the answer, by the usual change

double step_of(const MovingKey& key, const DifferentiatedAnswer& answer, double value) {
  const double share =
      std::clamp(std::pow(answer.bar / std::max(std::abs(value), 1e-300), order_of_share), least_share, most_share);
  switch (key.scale) {
    case KeyScale::angle:
      return share * bend_angle;
    case KeyScale::length:
      return share * answer.length;
    case KeyScale::share:
      break;
  }
  return share * std::abs(key.value);
}

std::string side_text(const char* side, const SideDerivative& derivative, const MovingKey& key, double step) {
  if (!derivative.words.empty()) return fmt::format("{} {}", side, derivative.words);
  const std::string words = derivative.end ? one_line(derivative.end->words, longest_reason) : "";
  if (derivative.end && derivative.end->distance <= at_once * step) return fmt::format("{}: {} at once", side, words);
  if (derivative.end) return fmt::format("{}: {} within {:.2g} {}", side, words, derivative.end->distance, key.unit);
  return "";
}

std::string remark_of(const Derivative& derivative, const MovingKey& key, double step) {
  std::string text = derivative.kink       ? "kink, below | above"
                     : derivative.one_side ? fmt::format("from {}", derivative.below.value ? "below" : "above")
                     : derivative.value    ? ""
                                           : "no derivative";
  if (text.empty()) return text;
  for (const auto& [side, found] : {std::pair("below", derivative.below), std::pair("above", derivative.above)})
    if (const std::string more = side_text(side, found, key, step); !more.empty()) text += "; " + more;
  return text;
}

double change_of(const Derivative& derivative, const MovingKey& key) {
  if (derivative.value) return *derivative.value * key.usual;
  if (!derivative.kink) return 0;
  const double below = *derivative.below.value, above = *derivative.above.value;
  return (std::abs(below) > std::abs(above) ? below : above) * key.usual;
}

}  // namespace

void sort_rows(DerivativeTable& table) {
  std::stable_sort(table.rows.begin(), table.rows.end(), [](const DerivativeRow& a, const DerivativeRow& b) {
    return a.refused != b.refused ? b.refused : std::abs(a.change) > std::abs(b.change);
  });
}

DerivativeTable derivative_table(const std::vector<MovingKey>& keys, const PieceAnswer& base,
                                 const DifferentiatedAnswer& answer, const AnswerWith& answer_with,
                                 const KeyHook& hook) {
  DerivativeTable table{.answer = answer, .base = base};
  if (!base.value) return table;
  for (const MovingKey& key : keys) {
    const auto at = [&](double distance) -> PieceAnswer {
      try {
        return answer_with(key.overrides(distance));
      } catch (const SceneError& error) {
        return {{}, "", "", error.what()};
      } catch (const BadInput& error) {
        return {{}, "", "", error.what()};
      }
    };
    DerivativeRow row{.key = key};
    const double step = step_of(key, answer, *base.value);
    row.derivative = differentiate(at, {.base = base,
                                        .step = step,
                                        .below = key.below,
                                        .above = key.above,
                                        .bar = answer.bar,
                                        .levels = answer.levels,
                                        .bisections = answer.bisections});
    if (hook && !hook(static_cast<std::size_t>(&key - keys.data()) + 1, keys.size())) {
      table.unfinished = true;
      break;
    }
    table.answers += row.derivative.answers;
    row.change = change_of(row.derivative, key);
    row.refused = !row.derivative.value && !row.derivative.kink;
    row.remark = remark_of(row.derivative, key, step);
    const bool still = row.derivative.still || std::abs(row.change) <= no_change * std::abs(*base.value) ||
                       (row.derivative.value && std::abs(*row.derivative.value) <= row.derivative.bar);
    if (still && !row.refused)
      table.still.push_back(key.key);
    else
      table.rows.push_back(std::move(row));
  }
  sort_rows(table);
  return table;
}

}  // namespace voussoir
