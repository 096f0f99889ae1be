#include "core/probability/design_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/probability/linearisations.hpp"
#include "core/probability/nearest_point.hpp"
#include "core/probability/normal.hpp"

namespace voussoir {
namespace {

constexpr int most_shortenings = 6;     // of a step, by half
constexpr double allowed_growth = 0.1;  // of the first g: as large may |g| become
constexpr double longest_step = 6;      // in u
constexpr double farthest_point = 37;   // Φ(-37) is about the least double

// Linearisations are one if their directions differ by no more: the least angle, or the tolerance if it is larger; a
// cosine (3°) of brackets.
constexpr double least_angle = 1e-4;
constexpr double parallel_of_brackets = 0.9986;

// Cosines of a point's direction with the slope of g there, at which it counts as smooth (3°, 10°); and in tolerances
// the sine at which the search of exact answers may end there, for its error of β is half the square of it.
constexpr double smooth_of_exact = 0.9986, smooth_of_brackets = 0.985, aligned_within = 10;

// Differences shrink to this part of the way to the next point, but not below the least one, nor to where g changes by
// less than so many brackets.
constexpr double step_of_way = 0.03, least_step = 1e-3, brackets_of_step = 30;

constexpr double wider = 3;  // differences of the last try

// of g, relative: a change that is none, and by how much a piece may lie above the answer
constexpr double rounding = 1e-13, allowed_rounding = 1e-9;

struct Manner {
  double step = 0;
  bool shrinks = false;  // the differences
  bool damped = false;   // half of each step, without memory: for a limit state that curves much
  int most_iterations = 0;
};

struct DesignPointWalk {
  const LimitFunction& limit;
  const DesignPointRequest& request;
  DesignPointSearch& search;
  double scale = 0;  // of g: that at the medians, or what one deviation changes
  double step = 0;

  std::vector<StateAnswer> ask(const std::vector<StandardPoint>& points) {
    search.evaluations += static_cast<int>(points.size());
    return limit(points);
  }

  // One batch; a second one, of differences backward, for keys without an answer forward, or for all if g changes by
  // none. None: there is no answer.
  std::optional<LocalAnswer> look(const StandardPoint& u, const std::optional<StateAnswer>& known) {
    std::vector<StandardPoint> points;
    if (!known) points.push_back(u);
    for (std::size_t key = 0; key < u.size(); ++key) {
      points.push_back(u);
      points.back()[key] += step;
    }
    std::vector<StateAnswer> answers = ask(points);
    if (known) answers.insert(answers.begin(), *known);
    if (!answers.front().g) return std::nullopt;
    LocalAnswer local{u, StandardPoint(u.size(), 0), *answers.front().g, answers.front().mode};
    answers.erase(answers.begin());
    std::vector<std::size_t> backward;
    for (std::size_t key = 0; key < u.size(); ++key)
      if (answers[key].g)
        local.gradient[key] = (*answers[key].g - local.g) / step;
      else
        backward.push_back(key);
    if (backward.empty() && is_flat(local))
      for (std::size_t key = 0; key < u.size(); ++key)
        backward.push_back(key);
    if (backward.empty()) return local;
    points.assign(backward.size(), u);
    for (std::size_t k = 0; k < backward.size(); ++k)
      points[k][backward[k]] -= step;
    answers = ask(points);
    for (std::size_t k = 0; k < backward.size(); ++k) {
      if (!answers[k].g) return std::nullopt;
      local.gradient[backward[k]] = (local.g - *answers[k].g) / step;
    }
    return local;
  }

  // g changes by roundings only
  bool is_flat(const LocalAnswer& local) const {
    return length(local.gradient) * step <= rounding * std::max(std::abs(local.g), scale);
  }

  double tolerance() const { return std::max(request.tolerance, scale > 0 ? 2 * request.bracket / scale : 0); }

  bool is_small(double g) const { return std::abs(g) <= std::max(tolerance() * scale, request.bracket); }

  double parallel() const {
    const double sine = std::max(request.tolerance, least_angle);
    return request.bracket > 0 ? parallel_of_brackets : 1 - sine * sine / 2;
  }

  // the slope of g at a smooth design point is along u
  bool is_smooth(const Linearisations& memory, const StandardPoint& u) const {
    return memory.alignment(u) >= (request.bracket > 0 ? smooth_of_brackets : smooth_of_exact);
  }

  bool is_aligned(const Linearisations& memory, const StandardPoint& u) const {
    const double sine = aligned_within * tolerance();
    return request.bracket > 0 ? is_smooth(memory, u) : memory.alignment(u) >= 1 - sine * sine / 2;
  }

  // A step towards the next point, shortened while |g| grows or there is no answer or slope; none: there never is.
  std::optional<LocalAnswer> advance(const LocalAnswer& from, const StandardPoint& to, bool damped) {
    const double way = distance(from.u, to), allowed = std::max(std::abs(from.g), allowed_growth * scale);
    double part = std::min(damped ? 0.5 : 1, way > longest_step ? longest_step / way : 1);
    std::optional<LocalAnswer> best;
    for (int k = 0; k < most_shortenings; ++k, part /= 2) {
      StandardPoint u = from.u;
      for (std::size_t key = 0; key < u.size(); ++key)
        u[key] += part * (to[key] - u[key]);
      // a full step is likely to be taken: its differences are asked for at once
      std::optional<StateAnswer> known;
      if (k > 0) {
        known = ask({u}).front();
        if (!known->g || (k + 1 < most_shortenings && std::abs(*known->g) > allowed)) continue;
      }
      std::optional<LocalAnswer> trial = look(u, known);
      if (!trial || is_flat(*trial)) continue;
      best = std::move(trial);
      if (std::abs(best->g) <= allowed) break;
    }
    return best;
  }

  // `next`: the nearest point of the linearisations, which are those at `local` where all is smooth
  DesignPoint told(const LocalAnswer& local, const StandardPoint& next, const Linearisations& memory,
                   int iteration) const {
    const bool smooth = length(local.u) > 0 && is_smooth(memory, local.u);
    const StandardPoint& u = smooth && request.bracket == 0 ? next : local.u;
    const double beta = length(u);
    DesignPoint point{u, request.reversed ? -beta : beta, local.g, {}, local.mode, iteration};
    if (smooth) {
      point.pieces.push_back({u, beta});
      for (double& part : point.pieces.front().direction)
        part /= beta;
    } else {
      point.pieces = memory.pieces(local.u, tolerance() * std::max(1.0, beta));
    }
    return point;
  }

  // From a point with its answer; the design point or the reason is in `search`. False: in another manner it may find
  // one.
  bool walk(LocalAnswer local, const Manner& manner) {
    Linearisations memory;
    std::optional<DesignPoint> doubted;  // a kink held from far away: believed if the search comes back to it
    for (int iteration = 0; iteration < manner.most_iterations; ++iteration) {
      search.looked_at.push_back(local.u);
      search.last = local.u;
      const double away = length(local.u), within = tolerance() * std::max(1.0, away);
      memory.add(local, parallel(), std::max(request.bracket, allowed_rounding * scale));
      if (manner.damped) memory.keep_newest();
      StandardPoint next = memory.next();
      if (distance(next, local.u) <= within && is_small(local.g) && !is_aligned(memory, local.u) &&
          memory.is_pulled_from_afar(within)) {
        if (doubted && distance(doubted->u, local.u) <= within) {
          search.found = std::move(doubted);
          return true;
        }
        doubted = told(local, next, memory, iteration);
        memory.forget_afar(within);
        next = memory.next();
      }
      const double way = distance(next, local.u);
      if (way <= within && is_small(local.g)) {
        if (memory.alignment(local.u) < 0) {
          search.reason = "the search ended where what fails lies towards the medians";
          return true;
        }
        search.found = told(local, next, memory, iteration);
        return true;
      }
      if (manner.shrinks) {
        const double least = std::max(least_step, brackets_of_step * request.bracket / memory.kept.back().slope);
        step = std::clamp(step_of_way * way, std::min(manner.step, least), manner.step);
      }
      std::optional<LocalAnswer> reached = advance(local, next, manner.damped);
      if (!reached) {
        search.reason = fmt::format(
            "no answer, or none that depends on a key, beyond {:.2f} standard deviations from "
            "the medians",
            away);
        return false;
      }
      local = *std::move(reached);
      if (length(local.u) > farthest_point) {
        search.last = local.u;
        search.reason = fmt::format("nothing fails within {} standard deviations of the medians", farthest_point);
        return true;
      }
    }
    search.reason = fmt::format("no design point within {} iterations", request.most_iterations);
    return false;
  }
};

// The first finds most; the second is for limit states that curve much, or of brackets for kinks, the third for rough
// answers.
std::array<Manner, 3> manners_of(const DesignPointRequest& request) {
  const bool exact = request.bracket == 0;
  const int most = request.most_iterations;
  return {Manner{request.step, exact, false, most}, Manner{request.step, true, exact, most / 2},
          Manner{wider * request.step, false, false, most / 2}};
}

}  // namespace

DesignPointSearch find_design_point(const LimitFunction& limit, std::size_t keys, const DesignPointRequest& request) {
  DesignPointSearch search;
  DesignPointWalk walk{limit, request, search};
  const bool from_medians = request.start.empty();
  search.last = from_medians ? StandardPoint(keys, 0) : request.start;
  std::optional<StateAnswer> known;
  if (from_medians && request.g_at_medians) known = StateAnswer{request.g_at_medians, ""};
  for (const Manner& manner : manners_of(request)) {
    walk.step = manner.step;
    const std::optional<LocalAnswer> local = walk.look(search.last, known);
    const bool is_first = search.looked_at.empty();
    if (!local) {
      if (is_first) search.reason = from_medians ? "no answer at the medians" : "no answer where the search starts";
      return search;
    }
    if (is_first && from_medians && local->g < 0) {
      search.reason = "the medians fail";
      return search;
    }
    if (is_first) known = StateAnswer{local->g, local->mode};
    const double slope = length(local->gradient);
    if (walk.is_flat(*local)) {
      if (is_first) search.reason = "the answer depends on no key";
      continue;
    }
    known.reset();
    if (walk.scale == 0) walk.scale = std::max(std::abs(request.g_at_medians.value_or(local->g)), slope);
    if (walk.walk(*local, manner)) break;
  }
  if (search.found) search.reason.clear();
  return search;
}

std::optional<double> probability_of_pieces(const DesignPoint& point) {
  const bool reversed = point.beta < 0;
  double probability = 0;
  if (point.pieces.size() <= 1) {
    probability = normal_probability(-std::abs(point.beta));
  } else if (point.pieces.size() == 2) {
    const FailedHalfSpace &a = point.pieces[0], &b = point.pieces[1];
    probability = bivariate_normal_probability(-a.distance, -b.distance, dot(a.direction, b.direction));
  } else {
    return std::nullopt;
  }
  return reversed ? 1 - probability : probability;
}

}  // namespace voussoir
