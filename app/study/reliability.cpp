#include "app/study/reliability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/probability/normal.hpp"

namespace voussoir {
namespace {

// steps of differences in u: an answer that a search brackets needs a long one
constexpr double tolerance_of_exact = 1e-5;  // of design points whose answers cost microseconds
constexpr double step_of_exact = 1e-3, step_of_fine = 1e-2, step_of_bracket = 0.3;
constexpr double fine_bar = 1e-5;  // of an answer, relative to its distance from the limit
// With bars b, slope g₀/β and n keys the gradient's direction is known to some b √n β/(g₀ step) only.
constexpr double turns_of_bar = 16, most_tolerance = 0.01;
// of second differences, which lose twice as many digits
constexpr double step_of_curvature = 0.02;
constexpr double step_at_medians = 0.01;
constexpr std::size_t most_keys_of_curvature = 12;
// of an unsettled search: g near the limit, beside that at the medians; number of such points; their spread
constexpr double near_limit = 0.02, most_spread = 0.2;
constexpr std::size_t least_near = 6;
constexpr double most_of_one_row = 0.1;  // of the estimate
// of the distance between two design points, that their mechanisms are told as near
constexpr double near_beta = 1;

void choose_step(const EvaluatedSetting& medians, DesignPointRequest& search) {
  const double bar = medians.error_bar.value_or(0) / std::max(*search.g_at_medians, 1e-300);
  if (!medians.error_bar) {
    search.step = step_of_exact;
    search.tolerance = tolerance_of_exact;
  } else if (bar <= fine_bar) {
    search.step = step_of_fine;
  } else {
    search.step = step_of_bracket;
    search.tolerance = std::clamp(turns_of_bar * bar / search.step, search.tolerance, most_tolerance);
  }
}

// asks for answers at points u, and remembers them
class Asked {
 public:
  Asked(const Sweep& sweep, const Evaluations& evaluations, ReliabilityFound& found)
      : sweep_(sweep), evaluations_(evaluations), found_(found) {}

  std::string purpose;
  bool reversed = false;
  int below_zero = 0;  // answers with a friction angle below 0, taken as 0
  int undecided = 0;   // whose error bar contains the limit

  // g, or only its sign where that is cheaper
  std::vector<StateAnswer> failed(const std::vector<StandardPoint>& points) {
    return answers(points, evaluations_.failed ? evaluations_.failed : evaluations_.value);
  }
  std::vector<StateAnswer> operator()(const std::vector<StandardPoint>& points) {
    return answers(points, evaluations_.value);
  }

  // above 0: stands; of a reversed search: fails
  std::optional<double> g_of(const EvaluatedSetting& answer) const {
    if (answer.failed) return *answer.failed != reversed ? -1 : 1;
    if (!answer.value || !std::isfinite(*answer.value)) return std::nullopt;
    const Fails& fails = *sweep_.fails;
    const double g = fails.below ? *answer.value - fails.limit : fails.limit - *answer.value;
    return reversed ? -g : g;
  }

 private:
  std::vector<StateAnswer> answers(const std::vector<StandardPoint>& points, const Evaluate& evaluate) {
    KeySettings settings;
    for (const StandardPoint& u : points)
      settings.push_back(values_at(u));
    const std::vector<EvaluatedSetting> found = evaluate(settings);
    std::vector<StateAnswer> limits;
    for (std::size_t k = 0; k < points.size(); ++k) {
      found_.rows.push_back({purpose, points[k], settings[k], found[k]});
      limits.push_back({g_of(found[k]), found[k].mode});
      undecided += limits.back().g && found[k].error_bar && std::abs(*limits.back().g) <= *found[k].error_bar;
    }
    return limits;
  }

  // A law without ends may give a friction angle below 0, which is no friction.
  std::vector<double> values_at(const StandardPoint& u) {
    std::vector<double> values = sweep_.drawn->at(u);
    const std::vector<std::string> keys = sweep_.drawn->scene_keys();
    bool any = false;
    for (std::size_t k = 0; k < keys.size(); ++k)
      if (keys[k].ends_with("friction_deg") && values[k] < 0) {
        values[k] = 0;
        any = true;
      }
    below_zero += any;
    return values;
  }

  const Sweep& sweep_;
  const Evaluations& evaluations_;
  ReliabilityFound& found_;
};

// Squares of the direction γ = α L⁻¹/|α L⁻¹| of the keys' normals z, of a direction α of u: at the design point the
// importances of the keys, along the gradient at the medians their shares of the variance. Those of u if all are
// independent.
std::vector<double> shares_of(const DrawnKeys& drawn, const StandardPoint& direction) {
  std::vector<double> gamma = direction;
  if (!drawn.factor.empty())
    for (std::size_t k = gamma.size(); k-- > 0;) {
      for (std::size_t j = k + 1; j < gamma.size(); ++j)
        gamma[k] -= drawn.factor[j][k] * gamma[j];
      gamma[k] /= drawn.factor[k][k];
    }
  double size = 0;
  for (const double g : gamma)
    size += g * g;
  for (double& g : gamma)
    g = size > 0 ? g * g / size : 0;
  return gamma;
}

// Of g's variance to first order: by central differences at the medians. Empty if an answer is missing.
std::vector<double> shares_at_medians(const DrawnKeys& drawn, Asked& asked) {
  std::vector<StandardPoint> points;
  for (std::size_t k = 0; k < drawn.components(); ++k)
    for (const double step : {-step_at_medians, step_at_medians}) {
      points.emplace_back(drawn.components(), 0.0);
      points.back()[k] = step;
    }
  asked.purpose = "variance";
  const std::vector<StateAnswer> answers = asked(points);
  StandardPoint slope;
  for (std::size_t k = 0; k < answers.size(); k += 2) {
    if (!answers[k].g || !answers[k + 1].g) return {};
    slope.push_back(*answers[k + 1].g - *answers[k].g);
  }
  return shares_of(drawn, slope);
}

// a design point that no strength has
std::string impossible(const DrawnKeys& drawn, const std::vector<double>& values) {
  const std::vector<std::string> keys = drawn.scene_keys();
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (keys[k].ends_with("friction_deg") && values[k] <= 0)
      return fmt::format("the design point has a friction of {:.3g} deg ({}): use lognormal, or least = 0", values[k],
                         keys[k]);
    if (keys[k].ends_with("cohesion") && values[k] < 0)
      return fmt::format("the design point has a cohesion of {:.3g} Pa ({}): use lognormal, or least = 0", values[k],
                         keys[k]);
  }
  return "";
}

// The search of a rough answer, as of runs whose way differs from row to row, ends nowhere but goes round the design
// point. Then the mean of the points that it found near the limit is good enough to sample around.
std::optional<DesignPoint> unsettled_point(const Asked& asked, ReliabilityFound& found, double g_at_medians) {
  std::vector<const StandardPoint*> near;
  for (const ReliabilityRow& row : found.rows)
    if (const std::optional<double> g = asked.g_of(row.answer);
        g && row.answer.error_bar && std::abs(*g) <= near_limit * g_at_medians)
      near.push_back(&row.u);
  if (near.size() < least_near) return std::nullopt;
  near.erase(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2));
  const auto length = [](const StandardPoint& u) {
    double square = 0;
    for (const double part : u)
      square += part * part;
    return std::sqrt(square);
  };
  DesignPoint point;
  point.u.assign(near.front()->size(), 0.0);
  double least = length(*near.front()), most = least;
  for (const StandardPoint* u : near) {
    for (std::size_t k = 0; k < u->size(); ++k)
      point.u[k] += (*u)[k] / static_cast<double>(near.size());
    least = std::min(least, length(*u));
    most = std::max(most, length(*u));
  }
  const double beta = length(point.u);
  if (!(beta > 0) || most - least > most_spread * beta) return std::nullopt;
  StandardPoint direction = point.u;
  for (double& part : direction)
    part /= beta;
  point.beta = found.medians_fail ? -beta : beta;
  point.pieces = {{direction, beta}};
  found.warnings.push_back(
      fmt::format("the search of the design point did not settle, since the answers are rougher than their error bars: "
                  "beta is between {:.3g} and {:.3g}",
                  least, most));
  return point;
}

SamplingEstimate of_failing(SamplingEstimate estimate, bool medians_fail) {
  if (!medians_fail) return estimate;
  std::swap(estimate.low, estimate.high);
  for (double* p : {&estimate.probability, &estimate.low, &estimate.high})
    *p = std::clamp(1 - *p, 0.0, 1.0);
  return estimate;
}

void warn_of_several(const ReliabilityFound& found, std::vector<std::string>& warnings) {
  double largest = 0, sum = 0;
  int near = 0;
  for (const DesignPoint& point : found.points) {
    if (std::abs(point.beta) > std::abs(found.points.front().beta) + near_beta) continue;
    const double p = normal_probability(-point.beta);
    largest = std::max(largest, p);
    sum += p;
    ++near;
  }
  if (near > 1 && !found.medians_fail)
    warnings.push_back(
        fmt::format("{} mechanisms fail within β + {:g}: to first order their union is between {:.3g} and {:.3g}", near,
                    near_beta, largest, std::min(1.0, sum)));
}

void sample(const Sweep& sweep, Asked& asked, const LimitFunction& g, const DesignPointRequest& search,
            ReliabilityFound& found) {
  asked.purpose = "pilot";
  const LimitFunction failed = [&](const std::vector<StandardPoint>& points) { return asked.failed(points); };
  const OtherPointsRequest others{.seed = sweep.drawn->seed, .failed = failed, .search = search};
  const OtherPoints points = find_other_design_points(g, found.points.front(), others);
  found.points = points.points;
  found.pilots = points.pilots;
  // at a kink mechanisms meet, and the point belongs to all of them
  const bool kink =
      std::ranges::any_of(points.points, [](const DesignPoint& point) { return point.pieces.size() > 1; });
  for (const std::string& mode : points.modes_without)
    if (!kink)
      found.warnings.push_back(
          fmt::format("'{}' failed too, and no design point of it was found: the probability may be too low", mode));
  if (points.lost > 0)
    found.warnings.push_back(fmt::format(
        "{} of {} searches from pilot rows that failed found no design point: the answer jumps there, and the "
        "probability may be too low; a [[sample]] tells it without design points",
        points.lost, points.starts));
  for (const std::string& mode : points.modes_behind)
    found.warnings.push_back(fmt::format("'{}' fails too, nowhere nearer than the design points", mode));
  asked.purpose = "importance";
  asked.undecided = 0;
  const SamplingRequest request{
      .seed = sweep.drawn->seed, .target = sweep.reliability->target, .most_rows = sweep.reliability->most_rows};
  const SamplingEstimate estimate = sample_by_importance(failed, found.points, request);
  found.sampled = of_failing(estimate, found.medians_fail);
  if (estimate.failed == 0) {
    found.failure = fmt::format(
        "none of {} rows around the design point failed: the answer jumps there, or never passes the "
        "limit",
        estimate.rows);
    return;
  }
  if (!estimate.reached)
    found.warnings.push_back(
        fmt::format("the target of {:.3g} was not reached in {} rows (most_rows)", request.target, estimate.rows));
  double largest = 0, sum = 0;
  for (const SamplingRow& row : estimate.history)
    if (row.failed) {
      largest = std::max(largest, row.weight);
      sum += row.weight;
    }
  if (largest > most_of_one_row * sum)
    found.warnings.push_back(fmt::format(
        "one row carries {:.0f} % of the probability: it failed far from the design points, and others like it "
        "may be missed",
        100 * largest / sum));
  if (estimate.unanswered > 0)
    found.warnings.push_back(
        fmt::format("{} of {} rows have no answer and count as standing: the probability is per draw, not per draw in "
                    "which a block can move",
                    estimate.unanswered, estimate.rows));
  if (asked.undecided > 0)
    found.warnings.push_back(
        fmt::format("the error bar of {} rows contains the limit; they count by their value", asked.undecided));
}

}  // namespace

ReliabilityFound analyse_reliability(const Sweep& sweep, const Evaluations& evaluations) {
  const DrawnKeys& drawn = *sweep.drawn;
  ReliabilityFound found;
  Asked asked(sweep, evaluations, found);
  const LimitFunction g = [&](const std::vector<StandardPoint>& points) { return asked(points); };

  asked.purpose = "medians";
  const StandardPoint medians(drawn.components(), 0.0);
  const std::optional<double> first = g({medians}).front().g;
  if (!first) {
    found.failure = fmt::format("the medians have no answer: {}", found.rows.front().answer.status);
    return found;
  }
  found.g_at_medians = *first;
  found.medians_fail = *first <= 0;
  if (found.medians_fail) {
    asked.reversed = true;
    found.warnings.push_back(
        "the medians fail: beta is negative, the probability above one half; a [[sample]] of 200 rows tells it best");
  }

  if (!found.rows.front().answer.error_bar) found.variance_shares = shares_at_medians(drawn, asked);
  asked.purpose = "design point";
  DesignPointRequest search;
  const double tolerance = search.tolerance;
  search.bracket = found.rows.front().answer.error_bar.value_or(0);
  search.g_at_medians = std::abs(*first);
  search.reversed = found.medians_fail;
  choose_step(found.rows.front().answer, search);
  DesignPointSearch form = find_design_point(g, drawn.components(), search);
  if (!form.found && search.tolerance < tolerance) {
    search.tolerance = tolerance;
    form = find_design_point(g, drawn.components(), search);
  }
  if (!form.found) form.found = unsettled_point(asked, found, *search.g_at_medians);
  if (!form.found) {
    found.failure = form.reason;
    for (const ReliabilityRow& row : found.rows)
      if (!row.answer.value) {
        found.failure += fmt::format("; answers are missing, the first because of: {}", row.answer.status);
        break;
      }
    return found;
  }
  found.points = {*form.found};
  found.failure = impossible(drawn, drawn.at(form.found->u));
  if (!found.failure.empty()) return found;
  found.first_order = probability_of_pieces(*form.found);
  if (search.step == step_of_exact && drawn.components() <= most_keys_of_curvature && !found.medians_fail) {
    asked.purpose = "second order";
    found.second_order = second_order(g, *form.found, step_of_curvature);
  }
  search.g_at_medians.reset();
  if (sweep.reliability->method == ReliabilityMethod::importance) sample(sweep, asked, g, search, found);
  warn_of_several(found, found.warnings);
  if (asked.below_zero > 0)
    found.warnings.push_back(fmt::format("{} answers are of a friction angle below 0, taken as 0", asked.below_zero));
  for (const DesignPoint& point : found.points) {
    found.point_values.push_back(drawn.at(point.u));
    found.importances.push_back(shares_of(drawn, point.u));
  }
  return found;
}

}  // namespace voussoir
