#include "app/limit/limit_derivatives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

constexpr int levels_of_bars = 3;      // of the extrapolation: more would only add bars
constexpr int few_bisections = 4;      // an answer takes long
constexpr double turns_at_all = 1e-3;  // of a block's motion
constexpr double bar_of_exact = 1e-8;  // of a value that states none, relative

// how the blocks of the mechanism move, and how many corners they have; blocks are counted, for a number may change
template <int Dim>
PieceAnswer piece_answer(const LimitAnalysis<Dim>& analysis) {
  if (analysis.values.empty() || analysis.mechanism.moving.empty())
    return {{}, "", "", analysis.message.empty() ? "no block moves" : analysis.message};
  const auto& [name, value] = analysis.values.front();
  std::vector<std::string> blocks;
  int turning = 0;
  for (const BlockMotion<Dim>& motion : analysis.mechanism.moving) {
    std::size_t corners = 0;
    for (const Polytope<Dim>& part : analysis.model.bodies[motion.body].parts)
      corners += part.vertices.size();
    const bool turns = motion.turning > turns_at_all * (motion.speed + motion.turning);
    turning += turns;
    blocks.push_back(fmt::format("{}{}", corners, turns ? "t" : ""));
  }
  std::sort(blocks.begin(), blocks.end());
  const std::size_t count = blocks.size();
  std::string words = fmt::format("{} block{}", count, count == 1 ? " moves" : "s move");
  if (turning > 0) words += fmt::format(", {} turn{}", turning, turning == 1 ? "s" : "");
  if (name.ends_with("_least")) words += ", between ends that differ";
  return {value.value, fmt::format("{}: {}", name, fmt::join(blocks, " ")), words, ""};
}

// half of the extent of the moving blocks, or of all free ones
template <int Dim>
double length_of_mechanism(const LimitAnalysis<Dim>& analysis) {
  Vector<Dim> low = Vector<Dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto include = [&](const Body<Dim>& body) {
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& vertex : part.vertices) {
        low = low.cwiseMin(body.reference + vertex);
        high = high.cwiseMax(body.reference + vertex);
      }
  };
  for (const BlockMotion<Dim>& motion : analysis.mechanism.moving)
    include(analysis.model.bodies[motion.body]);
  if (analysis.mechanism.moving.empty())
    for (const Body<Dim>& body : analysis.model.bodies)
      if (body.present && !body.fixed) include(body);
  const double extent = (high - low).maxCoeff();
  return extent > 0 ? extent / 2 : 1;
}

}  // namespace

template <int Dim>
DerivativeTable limit_derivatives(const LoadedScene& scene, const LimitRequest& stated,
                                  const LimitAnalysis<Dim>& analysis, const KeyHook& hook) {
  LimitRequest request = stated;
  request.proof = request.decide = false;
  PieceAnswer base = piece_answer(analysis);
  DifferentiatedAnswer answer{.levels = levels_of_bars, .bisections = few_bisections};
  if (base.value) {
    const auto& [name, value] = analysis.values.front();
    answer.name = name;
    answer.unit = value.unit;
    answer.bar = value.error_bar.value_or(bar_of_exact * std::abs(value.value));
    answer.length = length_of_mechanism(analysis);
  } else {
    base.reason += ": no mechanism, so no derivative";
  }
  const AnswerWith answer_with = [&](const std::vector<std::string>& overrides) {
    return piece_answer(analyse_limit<Dim>(load_changed(*scene.stated, overrides), request));
  };
  return derivative_table(moving_keys(*scene.stated->tree), base, answer, answer_with, hook);
}

template DerivativeTable limit_derivatives(const LoadedScene&, const LimitRequest&, const LimitAnalysis<2>&,
                                           const KeyHook&);
template DerivativeTable limit_derivatives(const LoadedScene&, const LimitRequest&, const LimitAnalysis<3>&,
                                           const KeyHook&);

}  // namespace voussoir
