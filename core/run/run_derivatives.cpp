#include "core/run/run_derivatives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/run/search_levels.hpp"
#include "core/run/simulate.hpp"
#include "core/run/twin.hpp"
#include "core/step/integrate.hpp"

namespace voussoir {
namespace {

// Corrections of a twin at the end of an increment, until less than this is left of the first difference, which the
// derivative has as its error: by the run's own factors one correction leaves about h of it where no contact changes its
// branch. Near a collapse the factors magnify what is left. Or no correction takes away this much of the one before:
// rounding.
constexpr int most_corrections = 6, most_alike = 4;
constexpr double corrected_at_rest = 1e-4, corrected = 1e-7, hardly_corrected = 0.3;

// At the end of an increment the run's own twin, which relaxation has not moved, is as unbalanced as the run, or by
// this times the criterion.
constexpr double may_be_unbalanced = 10;

// Twins whose differences to the run differ by more than this share of the derivative have different contacts.
constexpr double smooth = 0.01;
constexpr double rounding_of_answer = 1e-10;

// of a level: the step of the derivative by it
constexpr double step_of_level = 1e-7;

// A mechanism if the smallest singular value over the second is below this share of the least shear over normal
// stiffness; else a joint of it still sticks.
constexpr double mechanism_share = 0.01;

// From this share on a search's twins move as far as the run, before it at the same level.
constexpr double soft_share = 0.1;

// The roots of two trials' distances to the critical level of which one extrapolates differ by this factor.
constexpr double far_enough = 1.25;

// of the unknowns' scale, on the diagonal of a singular tangent
constexpr double singular_share = 1e-6;

// motions beyond the last stable state until the joints of a mechanism slip
constexpr int most_steps_beyond = 4;

using TwinClock = std::chrono::steady_clock;

double seconds_since(TwinClock::time_point began) {
  return std::chrono::duration<double>(TwinClock::now() - began).count();
}

// where the run was at the end of an increment, and under which schedule
template <int Dim>
struct IncrementEnd {
  std::vector<Motion<Dim>> motions;
  Schedule schedule;
  bool begins = false, ends = false;  // the first part of an increment; the last, in equilibrium
};

template <int Dim>
bool same_place(const std::vector<Motion<Dim>>& a, const std::vector<Motion<Dim>>& b) {
  return std::ranges::equal(a, b, [](const Motion<Dim>& m, const Motion<Dim>& n) {
    return m.displacement == n.displacement && rotation_vector(m.rotation) == rotation_vector(n.rotation);
  });
}

// The middle of the twins' differences to the run. `size`: of the answer, whose rounding the differences see.
RunDerivative derivative_between(double below, double base, double above, double step, double size) {
  RunDerivative d;
  d.below = (base - below) / step;
  d.above = (above - base) / step;
  d.value = 0.5 * (d.below + d.above);
  const double apart = std::abs(d.above - d.below);
  const bool same_branch = apart <= smooth * std::abs(d.value) + rounding_of_answer * size / step;
  if (!std::isfinite(d.value))
    d.reason = "not a number";
  else if (!same_branch)
    d.reason = "a contact changes its branch within the step";
  d.bar = 0.1 * apart;
  return d;
}

template <int Dim>
class RunTwins {
 public:
  RunTwins(const Prepared<Dim>& scene, const std::vector<TwinScenes<Dim>>& numbers, RunDerivatives& found)
      : found_(found), zero_(scene) {
    for (const TwinScenes<Dim>& n : numbers) {
      std::string reason = not_twins(scene.model, n.below.model);
      if (reason.empty()) reason = not_twins(scene.model, n.above.model);
      refused_.push_back(std::move(reason));
      if (!refused_.back().empty()) continue;
      steps_.push_back(n.step);
      for (const Prepared<Dim>* side : {&n.below, &n.above})
        twins_.emplace_back(*side);
    }
  }

  // before every step of the run
  void look(const Progress<Dim>& now) {
    const TwinClock::time_point began = TwinClock::now();
    watch(now);
    found_.seconds += seconds_since(began);
  }

  // after the last
  void end(const Progress<Dim>& now, const AnswersAtRest<Dim>& answers) {
    const TwinClock::time_point began = TwinClock::now();
    if (searches())
      end_trial(now);
    else if (!fallen_back(now.state))
      follow_all();
    if (!failed()) searches() ? find_critical(now) : find_at_rest(answers);
    found_.seconds += seconds_since(began);
  }

 private:
  bool searches() const { return std::holds_alternative<ReducePlan>(zero_.stage().plan().plan); }
  const ReducePlan& search_plan() const { return std::get<ReducePlan>(zero_.stage().plan().plan); }
  bool failed() const { return !found_.reason.empty(); }

  bool fallen_back(const State<Dim>& state) {
    if (state.counters.static_fallbacks == fallbacks_ || failed()) return failed();
    found_.reason = "relaxation found an equilibrium that Newton's method did not";
    return true;
  }

  // ---- what the run does --------------------------------------------------------------------------------------------

  void watch(const Progress<Dim>& now) {
    if (failed()) return;
    const State<Dim>& state = now.state;
    if (now.stage != stage_) {
      if (stage_ >= 0 && fallen_back(state)) return;
      if (stage_ >= 0) follow_all();
      begin_stage_of_twins(now.stage);
      trial_ = -1;
      newton_ = false;
      fallbacks_ = state.counters.static_fallbacks;
    }
    if (searches()) {
      if (now.reduction.trial != trial_ && now.reduction.leg == FollowLeg::none) {
        if (trial_ >= 0) end_trial(now);
        trial_ = now.reduction.trial;
        newton_ = false;
        fallbacks_ = state.counters.static_fallbacks;
      }
      if (now.reduction.leg != FollowLeg::none) return;
      target_ = now.reduction.target;
    }
    const bool under_way = state.increment.under_way;
    const std::vector<Motion<Dim>>& motions = under_way ? state.increment.base.motions : state.bodies.motions;
    const bool ends = newton_ && (!under_way || state.increment.increments_left != increments_left_);
    if (ends || (newton_ && !same_place(motions, motions_))) {
      ends_.push_back({motions, schedule_, begins_, ends});
      begins_ = false;
    }
    begins_ = begins_ || ends || !newton_;
    newton_ = under_way;
    schedule_ = state.schedule;
    if (!under_way) return;
    motions_ = motions;
    increments_left_ = state.increment.increments_left;
  }

  // of a search; a failed trial leaves nothing
  void end_trial(const Progress<Dim>& now) {
    if (now.reduction.stable != target_) return ends_.clear();
    if (fallen_back(now.state)) return;
    near_.reset();
    tangent_.reset();
    follow_all();
    if (near_) nearer_.push_back(std::move(*near_));
    if (tangent_) way_.push_back(*tangent_);
  }

  void begin_stage_of_twins(int stage) {
    stage_ = stage;
    zero_.enter(stage);
    for (Twin<Dim>& twin : twins_)
      twin.enter(stage);
  }

  // ---- how the twins follow -----------------------------------------------------------------------------------------

  void follow_all() {
    for (const IncrementEnd<Dim>& end : ends_)
      follow(end);
    ends_.clear();
  }

  Eigen::VectorXd residual(Twin<Dim>& twin, const Schedule& schedule, const Eigen::VectorXd& q) {
    ++found_.counters.evaluations;
    return twin.residual(schedule, twin.base, q);
  }

  bool rests(const Twin<Dim>& twin) const {
    return unbalanced_ratio(twin.model, twin.settings.threads, twin.state()) <=
           may_be_unbalanced * twin.settings.equilibrium.unbalanced;
  }

  void follow(const IncrementEnd<Dim>& end) {
    if (failed()) return;
    if (end.begins) {
      zero_.begin_increment(end.schedule);
      for (Twin<Dim>& twin : twins_)
        twin.begin_increment(twin.schedule_beside(zero_, end.schedule));
      found_.counters.evaluations += static_cast<long long>(1 + twins_.size());
    }
    const Eigen::VectorXd q = zero_.motion_to(end.motions);
    // The run came here by steps, and contacts are found near those of the last evaluation: once more, unless it rests.
    Eigen::VectorXd r = residual(zero_, end.schedule, q);
    if (!end.ends || !rests(zero_)) r = residual(zero_, end.schedule, q);
    if (end.ends && !rests(zero_)) {
      found_.reason = "by Newton's method alone the run does not come to rest where it did";
      return;
    }
    const TangentFactors<Dim> factors(zero_.tangent(zero_.base));
    ++found_.counters.increments;
    ++found_.counters.factorisations;
    if (!factors.regular()) {
      found_.reason = "the tangent of an increment is singular";
      return;
    }
    const Weakening weakening = weakening_at(end.schedule, factors, q);
    if (weakening.acts) near_ = near_collapse_at(weakening);
    for (Twin<Dim>& twin : twins_) {
      const Schedule schedule = twin.schedule_beside(zero_, end.schedule);
      if (weakening.acts) {
        near_->changes.push_back(moved_alike(twin, schedule, factors, q, r, weakening));
        twin.take_base();
      } else {
        correct(twin, schedule, factors, q, r);
        twin.take_base();
      }
    }
    zero_.take_base();
    if (!zero_.answers() || !std::ranges::all_of(twins_, &Twin<Dim>::answers))
      found_.reason = "a contact of a twin has no solution";
  }

  // moves the twin to where it has the unbalanced forces r
  void correct(Twin<Dim>& twin, const Schedule& schedule, const TangentFactors<Dim>& factors, const Eigen::VectorXd& q,
               const Eigen::VectorXd& r) {
    Eigen::VectorXd own = q, rest = residual(twin, schedule, own) - r;
    const double first = size_of(rest);
    double before = first;
    for (int k = 0; k < most_corrections && before > corrected_at_rest * first; ++k) {
      own += factors.solve(rest);
      ++found_.counters.back_substitutions;
      rest = residual(twin, schedule, own) - r;
      if (const double now = size_of(rest); std::exchange(before, now) * hardly_corrected < now) break;
    }
  }

  // ---- in a search --------------------------------------------------------------------------------------------------

  // How the run would move if the searched level changed: w = K^-1 dr/dF, and D w, along which motion is measured.
  struct Weakening {
    bool acts = false;  // the joints of a mechanism slip
    double level = 0;
    Eigen::VectorXd by_level, along;
    NullVectors vectors;
  };
  // near a collapse: by twin the change of its level at which it moves as the run does
  struct NearCollapse {
    CriticalDerivatives at;
    std::vector<double> changes;
  };
  NearCollapse near_collapse_at(const Weakening& w) const {
    const NullVectors& v = w.vectors;
    NearCollapse near;
    near.at.level = w.level;
    near.at.smallest = v.smallest;
    near.at.second = v.second;
    near.at.motion = v.motion;
    near.at.weight = v.weight;
    near.at.near_collapse = v.smallest < mechanism_share * softest_joint() * v.second;
    return near;
  }
  Weakening weakening_at(const Schedule& schedule, const TangentFactors<Dim>& factors, const Eigen::VectorXd& q) {
    if (!searches()) return {};
    const ReducePlan& plan = search_plan();
    Weakening w;
    w.level = level_in_force(plan.searched, chosen_properties(zero_.model, plan), schedule);
    const double step = step_of_level * w.level;
    const auto at = [&](double level) { return residual(zero_, at_level(zero_, schedule, level), q); };
    w.by_level = factors.solve((at(w.level + step) - at(w.level - step)) / (2 * step));
    ++found_.counters.back_substitutions;
    w.along = zero_.unknowns.scale.cwiseProduct(w.by_level);
    if (w.along.dot(w.by_level) > 0) {
      w.vectors = null_vectors<Dim>(factors, zero_.unknowns.scale);
      w.acts = w.vectors.smallest < soft_share * softest_joint() * w.vectors.second;
      tangent_ = {w.level, w.vectors.smallest, w.vectors.second};
    }
    residual(zero_, schedule, q);
    return w;
  }

  double softest_joint() const {
    double softest = 1;
    for (const JointProperties& p : zero_.model.properties)
      softest = std::min(softest, p.shear_stiffness / p.normal_stiffness);
    return softest;
  }

  Schedule at_level(const Twin<Dim>& twin, Schedule schedule, double level) const {
    const ReducePlan& plan = search_plan();
    set_strength(twin.model, plan.searched, chosen_properties(zero_.model, plan), level, schedule);
    return schedule;
  }

  // Moves the twin to where it has the unbalanced forces r and has come as far as the
  // run along w: near a collapse a level may have no rest, or one far away, but every motion has a level.
  double moved_alike(Twin<Dim>& twin, const Schedule& schedule, const TangentFactors<Dim>& factors,
                     const Eigen::VectorXd& q, const Eigen::VectorXd& r, const Weakening& w) {
    Eigen::VectorXd own = q;
    double change = 0;
    const double began = w.along.dot(zero_.motion_to(twin.base.motions)), per_level = w.along.dot(w.by_level);
    double first = 0;
    for (int k = 0; k < most_alike; ++k) {
      const Eigen::VectorXd way = factors.solve(residual(twin, at_level(twin, schedule, w.level + change), own) - r);
      ++found_.counters.back_substitutions;
      const double more = -(began + w.along.dot(own - q + way)) / per_level;
      const Eigen::VectorXd step = way + more * w.by_level;
      own += step;
      change += more;
      const double now = size_of(step.cwiseProduct(zero_.unknowns.scale));
      if (k == 0) first = now;
      if (now <= corrected * first) break;
    }
    residual(twin, at_level(twin, schedule, w.level + change), own);
    return change;
  }

  double size_of(const Eigen::VectorXd& x) const { return std::sqrt(x.dot(x.cwiseQuotient(zero_.unknowns.scale))); }

  // ---- derivatives --------------------------------------------------------------------------------------------------

  void find_at_rest(const AnswersAtRest<Dim>& answers) {
    const auto of = [&](const Twin<Dim>& twin) { return answers(*twin.scene, twin.model, twin.state()); };
    found_.answers = of(zero_);
    std::size_t t = 0;
    for (const std::string& reason : refused_) {
      std::vector<RunDerivative>& row = found_.at_rest.emplace_back(found_.answers.size());
      const std::vector<double> below = reason.empty() ? of(twins_[2 * t]) : found_.answers;
      const std::vector<double> above = reason.empty() ? of(twins_[2 * t + 1]) : found_.answers;
      for (std::size_t k = 0; k < row.size(); ++k)
        row[k] = reason.empty()
                     ? derivative_between(below[k], found_.answers[k], above[k], steps_[t], std::abs(found_.answers[k]))
                     : RunDerivative{.reason = reason};
      t += reason.empty();
    }
  }

  void find_critical(const Progress<Dim>& now) {
    if (nearer_.empty()) look_beyond(now.reduction.failed);
    if (failed()) return;
    CriticalDerivatives& c = found_.critical.emplace(nearer_.back().at);
    c.critical = 0.5 * (now.reduction.stable + now.reduction.failed);
    c.way = std::move(way_);
    std::size_t t = 0;
    for (const std::string& reason : refused_)
      c.by.push_back(reason.empty() ? derivative_of_level(t++, c.critical) : RunDerivative{.reason = reason});
  }

  // The derivative D of the last stable trial whose twins have the run's contacts. On the way to the collapse it
  // changes with the root of the distance d to the critical level, D = D* + c d^(1/2): the last two give D*, and its
  // distance from the last is the bar.
  RunDerivative derivative_of_level(std::size_t t, double critical) const {
    const auto of = [&](const NearCollapse& near) {
      return derivative_between(near.changes[2 * t], 0, near.changes[2 * t + 1], steps_[t], near.at.level);
    };
    const auto root_of_way = [&](const NearCollapse& near) { return std::sqrt(std::abs(near.at.level - critical)); };
    for (std::size_t k = nearer_.size(); k-- > 0;) {
      RunDerivative d = of(nearer_[k]);
      if (!d.reason.empty() && k > 0) continue;
      if (k == 0) return d;
      const RunDerivative before = of(nearer_[k - 1]);
      const double last = root_of_way(nearer_[k]), first = root_of_way(nearer_[k - 1]), change = d.value - before.value;
      if (before.reason.empty() && first > far_enough * last) {
        const double more = change * last / (first - last);
        d.value += more;
        d.bar = std::max(d.bar, std::abs(more));
      } else {
        d.bar = std::max(d.bar, std::abs(change));
      }
      return d;
    }
    return {.reason = "no state near the collapse"};
  }

  // Of a search without slip in its last stable state, as of a block on a plane: the first failed level, after a motion
  // in which the joints that stuck slip. K is singular there, and the level at which nothing is unbalanced is critical.
  void look_beyond(double level) {
    const Schedule schedule = at_level(zero_, schedule_, level);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(zero_.unknowns.free.size());
    const Eigen::VectorXd balanced = q;
    for (int k = 0; k < most_steps_beyond && nearer_.empty(); ++k) {
      const Eigen::VectorXd r = residual(zero_, schedule, q);
      BlockMatrix<freedoms<Dim>> matrix = zero_.tangent(zero_.base);
      matrix.add_diagonal(singular_share * zero_.unknowns.scale);
      const TangentFactors<Dim> factors(matrix);
      ++found_.counters.factorisations;
      if (!factors.regular()) break;
      const Weakening weakening = weakening_at(schedule, factors, q);
      if (!weakening.acts) {
        q += factors.solve(r);
        continue;
      }
      if (slipped_) {
        const double own = moved_alike(zero_, schedule, factors, q, balanced, weakening);
        NearCollapse near = near_collapse_at(weakening);
        for (Twin<Dim>& twin : twins_)
          near.changes.push_back(
              moved_alike(twin, twin.schedule_beside(zero_, schedule), factors, q, balanced, weakening) - own);
        near.at.level += own;
        nearer_.push_back(std::move(near));
      } else {
        const Eigen::VectorXd& u = weakening.vectors.motion;
        q += (u.dot(r) < 0 ? -1 : 1) * largest_overlap() / u.template lpNorm<Eigen::Infinity>() * u;
        slipped_ = true;
      }
    }
    if (nearer_.empty()) found_.reason = "no state near the collapse: the joints of a mechanism slip in none";
  }

  double largest_overlap() const {
    double largest = 0;
    for (const Contact<Dim>& c : zero_.state().contacts.list)
      if (c.touching()) largest = std::max(largest, c.geometry.overlap);
    return largest;
  }

  RunDerivatives& found_;
  std::vector<std::string> refused_;  // by number: why it has no twins
  std::vector<double> steps_;         // of the others
  Twin<Dim> zero_;                    // of the scene itself: by Newton's method alone, as all twins
  std::vector<Twin<Dim>> twins_;      // of the same: below, above

  int stage_ = -1, trial_ = -1;
  double target_ = 0;
  long long fallbacks_ = 0;
  bool newton_ = false;  // an increment was under way before the last step
  bool begins_ = true;   // no part of it has ended
  int increments_left_ = 0;
  std::vector<Motion<Dim>> motions_;       // its base's
  Schedule schedule_;                      // of the last step
  std::vector<IncrementEnd<Dim>> ends_;    // of the trial or stage under way: no twin has followed yet
  bool slipped_ = false;                   // beyond the last stable state
  std::optional<NearCollapse> near_;       // of the trial that is followed
  std::vector<NearCollapse> nearer_;       // of stable trials, in their order
  std::optional<TangentOfTrial> tangent_;  // of the trial that is followed
  std::vector<TangentOfTrial> way_;        // of stable trials, in their order
};

}  // namespace

template <int Dim>
RunDerivatives run_with_derivatives(const Prepared<Dim>& scene, const std::vector<TwinScenes<Dim>>& numbers,
                                    const AnswersAtRest<Dim>& answers, Progress<Dim>& progress) {
  RunDerivatives found;
  found.reason = not_differentiable(scene);
  const TwinClock::time_point began = TwinClock::now();
  RunTwins<Dim> twins(scene, numbers, found);
  Watcher<Dim> watcher;
  watcher.pause = [&](const Progress<Dim>& now) {
    twins.look(now);
    return false;
  };
  progress = initial_progress(scene);
  simulate(scene, progress, watcher);
  found.seconds_of_run = seconds_since(began) - found.seconds;
  if (found.reason.empty() && progress.results.outcome != Outcome::done)
    found.reason = "the run has no answer: " + progress.results.message;
  if (found.reason.empty()) twins.end(progress, answers);
  return found;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                              \
  template RunDerivatives run_with_derivatives<Dim>(const Prepared<Dim>&, const std::vector<TwinScenes<Dim>>&, \
                                                    const AnswersAtRest<Dim>&, Progress<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
