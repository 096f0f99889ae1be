#include "core/run/search_estimates.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace voussoir {
namespace {

// of the failure displacement: bodies that have moved less have not turned on a face yet
constexpr double least_turned = 0.003;

// An estimate counts if its trial was at a strength within this fraction of it: if the normal force depends on the
// strength, a trial far below gives a wrong one.
constexpr double nearest_trial = 0.03;

// of the change by the extrapolation to no displacement: the error of the line
constexpr double error_of_line = 0.1;

// Beyond the estimate, as a fraction of it: levels of trials whose line is looked for.
constexpr double beyond_estimate = 0.01;

struct Line {
  double critical, b;
};

// s0 and b of the least squares
Line fit_of(std::span<const StableTrial> trials) {
  const double scale = trials.back().displacement;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const StableTrial& t : trials) {
    const double u = t.displacement / scale;
    const Eigen::Vector3d row(1, 1 / std::sqrt(u), -u);
    normal += row * row.transpose();
    right += t.level * row;
  }
  const Eigen::Vector3d x = normal.inverse() * right;
  return {x[0], x[1]};
}

bool is_inside(const Levels& levels, const Bracket& bracket, double level, double margin) {
  return levels.direction * (level - bracket.stable) > -margin && levels.direction * (bracket.failed - level) > -margin;
}

// the last estimate as a level, if it comes from a trial near it and does not contradict the bracket
std::optional<double> last_estimate(const Levels& levels, const Bracket& bracket, const SearchEstimates& known) {
  if (known.failed.empty()) return {};
  const TrialEstimate& last = known.failed.back();
  if (!(last.critical > 0) || std::abs(last.level - last.critical) > nearest_trial * last.critical) return {};
  const double level = levels.level_of(last.critical);
  return is_inside(levels, bracket, level, levels.tolerance) ? std::optional(level) : std::nullopt;
}

// within half the tolerance and a tenth of the distance of the last from its trial
bool last_two_agree(const Levels& levels, const std::vector<TrialEstimate>& estimates) {
  const std::size_t n = estimates.size();
  if (n < 2) return false;
  const double last = levels.level_of(estimates[n - 1].critical), before = levels.level_of(estimates[n - 2].critical);
  return std::abs(last - before) <=
         0.5 * levels.tolerance + error_of_line * std::abs(last - levels.level_of(estimates[n - 1].level));
}

double taken_out_of(const Levels& levels, const TrialEstimate& last) {
  return std::abs(levels.level_of(last.critical) - levels.level_of(last.critical - last.taken_out));
}

double error_of_estimate(const Levels& levels, const Bracket& bracket, const std::vector<TrialEstimate>& estimates) {
  const TrialEstimate& last = estimates.back();
  const std::size_t n = estimates.size();
  const double level = levels.level_of(last.critical), taken_out = taken_out_of(levels, last);
  const double other = n < 2 ? 0.5 * std::abs(bracket.failed - bracket.stable)
                             : std::abs(level - levels.level_of(estimates[n - 2].critical));
  return error_of_line * taken_out + other;
}

// why the trials give no strength at no displacement
std::string why_bracket(const Levels& levels, const SearchEstimates& known) {
  if (!known.failed.empty()) {
    const TrialEstimate& last = known.failed.back();
    if (!(last.critical > 0)) return "the motion of the last failed trial requires no strength at no displacement";
    const std::string found = levels.text(levels.level_of(last.critical));
    if (std::abs(last.level - last.critical) > nearest_trial * last.critical)
      return fmt::format("the strength required at no displacement, {}, is more than {:g} % from that of its trial, {}",
                         found, 100 * nearest_trial, levels.text(levels.level_of(last.level)));
    return fmt::format("the strength required at no displacement, {}, is outside the bracket", found);
  }
  switch (known.no_line) {
    case NoLine::turned:
      return "bodies turn, and no fit through the stable trials is certain";
    case NoLine::no_slip:
      return "no joint whose strength is reduced slips";
    case NoLine::broke:
      return "bonds broke in the trial that failed";
    case NoLine::loads:
      return "bolts still took up load when bodies had moved away";
    case NoLine::too_short:
      return "bodies had moved away before their required strength had a line";
    case NoLine::not_straight:
    case NoLine::none:
      break;
  }
  return "the required strength never fell in a straight line";
}

}  // namespace

bool is_certified(const Levels& levels, const Bracket& bracket, const SearchEstimates& known) {
  const std::optional<double> level = last_estimate(levels, bracket, known);
  const double half = 0.5 * (1 + 1e-9) * levels.tolerance;
  return level && last_two_agree(levels, known.failed) && levels.direction * (*level - bracket.stable) <= half;
}

std::optional<double> level_by_estimate(const Levels& levels, const Bracket& bracket, const SearchEstimates& known) {
  const std::optional<double> level = last_estimate(levels, bracket, known);
  if (!level || !is_inside(levels, bracket, *level, 0)) return {};
  const double near = std::max(2 * levels.tolerance, beyond_estimate * *level);
  const double beyond = *level + levels.direction * near, before = *level - levels.direction * 0.5 * levels.tolerance;
  const bool is_new = std::abs(beyond - bracket.failed) > 0.2 * near;
  if (!last_two_agree(levels, known.failed) && is_new && is_inside(levels, bracket, beyond, 0)) return beyond;
  return is_inside(levels, bracket, before, 0) ? std::optional(before) : std::nullopt;
}

CriticalLevel critical_level(const Levels& levels, const Bracket& bracket, const SearchEstimates& known) {
  CriticalLevel middle{0.5 * (bracket.stable + bracket.failed), 0.5 * std::abs(bracket.failed - bracket.stable)};
  if (const std::optional<double> level = last_estimate(levels, bracket, known))
    return {*level, error_of_estimate(levels, bracket, known.failed), CriticalBy::required_strength,
            taken_out_of(levels, known.failed.back())};
  middle.bracket_because = why_bracket(levels, known);
  const std::optional<StableFit> fit = known.no_line == NoLine::turned ? fit_stable(known.stable) : std::nullopt;
  if (!fit) return middle;
  const double level = levels.level_of(fit->critical), from_bracket = std::abs(level - middle.level);
  if (fit->of_three) return {level, from_bracket, CriticalBy::stable_fit, from_bracket};
  const double change = std::abs(level - levels.level_of(fit->critical + fit->change));
  return change < from_bracket
             ? CriticalLevel{level, std::min(2 * change, from_bracket), CriticalBy::stable_fit, from_bracket}
             : middle;
}

std::optional<StableFit> fit_stable(const std::vector<StableTrial>& trials) {
  std::vector<StableTrial> turned;
  std::ranges::copy_if(trials, std::back_inserter(turned),
                       [](const StableTrial& t) { return t.of_failure > least_turned; });
  std::ranges::sort(turned, {}, &StableTrial::displacement);
  turned.erase(std::unique(turned.begin(), turned.end(),
                           [](const StableTrial& a, const StableTrial& b) { return a.displacement == b.displacement; }),
               turned.end());
  if (turned.size() < 3) return {};
  const Line all = fit_of(turned);
  if (turned.size() == 3)
    return all.b > 0 && std::isfinite(all.critical) ? std::optional(StableFit{all.critical, 0, true}) : std::nullopt;
  const Line fewer = fit_of(std::span(turned).subspan(1));
  if (!(fewer.b > 0) || !std::isfinite(fewer.critical)) return {};
  return StableFit{fewer.critical, std::abs(fewer.critical - all.critical), false};
}

}  // namespace voussoir
