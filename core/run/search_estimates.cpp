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

// of the failure displacement: trials beyond are left out of the fit, if so many are short of it
constexpr double geometry_changes = 0.5;
constexpr std::size_t enough = 5;

// A third is added to the error of turning, whose estimates come from trials at displacements this factor apart, or
// else this small one.
constexpr double turning_margin = 4.0 / 3, well_apart = 2.25, hardly_apart = 1.1;

// An estimate counts if its trial was at a strength within this fraction of it: if the normal force depends on the
// strength, a trial far below gives a wrong one.
constexpr double nearest_trial = 0.03;

// of the change by the extrapolation to no displacement: the error of the line
constexpr double error_of_line = 0.1;

// Of the strength, of the last stable trial to the next one of bodies that turn; and of their displacements, which the
// law of the fit predicts: states of the fit are to be spread over the displacements.
constexpr double gentle_strength = 0.8, gentle_displacement = 4;

// of the failure displacement: once bodies have moved so far, the fit has its states
constexpr double spread_until = 0.3;

// Beyond the estimate, as a fraction of it: levels of trials whose line is looked for.
constexpr double beyond_estimate = 0.01;

struct Law {
  double critical, b, a;
};

// s0, b and a of the least squares
Law law_of(std::span<const StableTrial> trials) {
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
  return {x[0], x[1], x[2]};
}

// those that have moved by more than this part of the failure displacement, by displacement; none of two that are
// hardly apart
std::vector<StableTrial> turned_trials(const std::vector<StableTrial>& trials, double beyond = least_turned) {
  std::vector<StableTrial> turned;
  std::ranges::copy_if(trials, std::back_inserter(turned), [&](const StableTrial& t) { return t.of_failure > beyond; });
  std::ranges::sort(turned, {}, &StableTrial::displacement);
  turned.erase(std::unique(turned.begin(), turned.end(),
                           [](const StableTrial& a, const StableTrial& b) {
                             return b.displacement < hardly_apart * a.displacement;
                           }),
               turned.end());
  return turned;
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

// with the way back to the bracket of an estimate outside of it, by less than the tolerance
double error_of_estimate(const Levels& levels, const Bracket& bracket, const std::vector<TrialEstimate>& estimates) {
  const TrialEstimate& last = estimates.back();
  const std::size_t n = estimates.size();
  const double level = levels.level_of(last.critical), taken_out = taken_out_of(levels, last);
  const double other = n < 2 ? 0.5 * std::abs(bracket.failed - bracket.stable)
                             : std::abs(level - levels.level_of(estimates[n - 2].critical));
  const double outside =
      std::max({0.0, levels.direction * (level - bracket.failed), levels.direction * (bracket.stable - level)});
  return error_of_line * taken_out + other + outside;
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

std::optional<double> level_for_fit(const Levels& levels, const Bracket& bracket, const SearchEstimates& known) {
  if (known.no_line != NoLine::turned || known.stable.empty()) return {};
  const StableTrial& last = known.stable.back();
  if (last.of_failure > spread_until) return {};
  double strength = gentle_strength * last.level;
  const bool has_law = known.stable.size() > 1 && known.stable[known.stable.size() - 2].displacement > 0;
  if (has_law && last.of_failure > least_turned) {
    const StableTrial& before = known.stable[known.stable.size() - 2];
    const double now = 1 / std::sqrt(last.displacement), then = 1 / std::sqrt(before.displacement);
    if (then > now)
      strength = std::max(strength, last.level - (before.level - last.level) / (then - now) * now *
                                                     (1 - 1 / std::sqrt(gentle_displacement)));
  }
  const double step = levels.direction * (levels.level_of(strength) - bracket.stable);
  const double half = 0.5 * levels.direction * (bracket.failed - bracket.stable);
  return step > 0.5 * levels.tolerance && step < half ? std::optional(levels.level_of(strength)) : std::nullopt;
}

CriticalLevel critical_level(const Levels& levels, const Bracket& bracket, const SearchEstimates& known) {
  CriticalLevel middle{0.5 * (bracket.stable + bracket.failed), 0.5 * std::abs(bracket.failed - bracket.stable)};
  if (const std::optional<double> level = last_estimate(levels, bracket, known))
    return {*level, error_of_estimate(levels, bracket, known.failed), CriticalBy::required_strength,
            taken_out_of(levels, known.failed.back())};
  middle.bracket_because = why_bracket(levels, known);
  if (known.no_line != NoLine::turned) return middle;
  const double stable = levels.strength(bracket.stable);
  const double turning = std::abs(levels.level_of(stable + error_of_turning(known.stable)) - bracket.stable);
  const std::optional<StableFit> fit = fit_stable(known.stable);
  if (!fit) {
    middle.error_bar += turning;
    middle.by = turning > 0 ? CriticalBy::bracket_of_turning : CriticalBy::bracket;
    return middle;
  }
  const double level = levels.level_of(fit->critical), from_bracket = std::abs(level - middle.level);
  const double change = std::abs(levels.level_of(fit->critical + fit->change) - level);
  // no fit tells the strength more finely than its trials
  const double of_fit = fit->of_three ? from_bracket + turning : 2 * change + error_of_line * from_bracket;
  return {level, std::hypot(of_fit, middle.error_bar), CriticalBy::stable_fit, from_bracket};
}

std::optional<StableFit> fit_stable(const std::vector<StableTrial>& trials) {
  std::vector<StableTrial> turned = turned_trials(trials);
  const auto far = std::ranges::find_if(turned, [](const StableTrial& t) { return t.of_failure > geometry_changes; });
  if (static_cast<std::size_t>(far - turned.begin()) >= enough) turned.erase(far, turned.end());
  if (turned.size() < 3) return {};
  const std::span<const StableTrial> all(turned);
  const Law law = law_of(all.last(3));
  if (!(law.b > 0) || !(law.a > 0) || !(law.critical > 0)) return {};
  if (turned.size() == 3) return StableFit{law.critical, 0, true};
  return StableFit{law.critical, std::abs(law_of(all.last(4)).critical - law.critical), false};
}

double error_of_turning(const std::vector<StableTrial>& trials) {
  std::vector<StableTrial> turned = turned_trials(trials);
  // bodies that fall after they have hardly moved: the trial before the last tells what their faces still lacked
  const bool sudden = turned.size() < 2;
  if (sudden) {
    turned = turned_trials(trials, 0);
    if (turned.size() > 2) turned.erase(turned.begin(), turned.end() - 2);
  }
  if (turned.size() < 2) return 0;
  const StableTrial& last = turned.back();
  // a u at the last displacement, by the trial before: those of far less displacement contain b u^(-1/2)
  const StableTrial& before = turned[turned.size() - 2];
  double most = sudden ? 0 : (before.level - last.level) / (1 - before.displacement / last.displacement);
  // 3/2 b u^(-1/2) at the last displacement, by one other trial
  const auto elastic = [&](const StableTrial& t) {
    const double x = std::sqrt(last.displacement / t.displacement);
    return 1.5 * (t.level - last.level) / (x - 1.5 + 0.5 / (x * x));
  };
  const bool any_apart = last.displacement >= well_apart * turned.front().displacement;
  for (const StableTrial& t : turned)
    if (last.displacement >= (any_apart ? well_apart : hardly_apart) * t.displacement)
      most = std::max(most, elastic(t));
  return turning_margin * std::max(0.0, most);
}

}  // namespace voussoir
