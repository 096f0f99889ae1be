#include "core/run/run_derivatives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/run/search_levels.hpp"
#include "core/run/simulate.hpp"
#include "core/run/twin.hpp"
#include "core/step/static_solver.hpp"

namespace voussoir {
namespace {

// Corrections of a twin at the end of an increment; less than this is left of the first difference, or no correction
// takes away this much of the one before: rounding.
constexpr int most_corrections = 6;
constexpr double corrected = 1e-12, hardly_corrected = 0.3;

// Twins whose differences to the run differ by more than this share of the derivative have different contacts.
constexpr double smooth = 0.01;

// of a level: the step of the derivative by it
constexpr double step_of_level = 1e-7;

// A mechanism if the smallest singular value over the second is below this share of the least shear over normal
// stiffness; else a joint of it still sticks.
constexpr double mechanism_share = 0.01;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point began) {
  return std::chrono::duration<double>(Clock::now() - began).count();
}

// where the run was at the end of an increment, and under which schedule
template <int Dim>
struct IncrementEnd {
  std::vector<Motion<Dim>> motions;
  Schedule schedule;
};

template <int Dim>
bool same_place(const std::vector<Motion<Dim>>& a, const std::vector<Motion<Dim>>& b) {
  return std::ranges::equal(a, b, [](const Motion<Dim>& m, const Motion<Dim>& n) {
    return m.displacement == n.displacement && rotation_vector(m.rotation) == rotation_vector(n.rotation);
  });
}

// The middle of the twins' differences to the run.
RunDerivative derivative_between(double below, double base, double above, double step) {
  RunDerivative d;
  d.below = (base - below) / step;
  d.above = (above - base) / step;
  d.value = 0.5 * (d.below + d.above);
  const double apart = std::abs(d.above - d.below);
  if (!std::isfinite(d.value))
    d.reason = "not a number";
  else
    d.bar = apart > smooth * std::abs(d.value) ? apart : 0.1 * apart;
  return d;
}

template <int Dim>
class RunTwins {
 public:
  RunTwins(const Prepared<Dim>& scene, const std::vector<TwinScenes<Dim>>& numbers, RunDerivatives& found)
      : numbers_(numbers), found_(found), zero_(scene) {
    for (const TwinScenes<Dim>& n : numbers)
      for (const Prepared<Dim>* side : {&n.below, &n.above})
        twins_.emplace_back(*side);
  }

  // before every step of the run
  void look(const Progress<Dim>& now) {
    const Clock::time_point began = Clock::now();
    watch(now);
    found_.seconds += seconds_since(began);
  }

  // after the last
  void end(const Progress<Dim>& now, const AnswersAtRest<Dim>& answers) {
    const Clock::time_point began = Clock::now();
    const auto* search = std::get_if<ReducePlan>(&zero_.stage().plan().plan);
    if (search)
      end_trial(now);
    else
      stable_ends_ = std::move(ends_);
    if (failed() || fallen_back(now.state)) return;
    search ? find_critical(*search, now) : find_at_rest(answers);
    found_.seconds += seconds_since(began);
  }

 private:
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
      if (stage_ >= 0) end_stage();
      begin_stage_of_twins(now.stage);
      trial_ = -1;
      newton_ = false;
      fallbacks_ = state.counters.static_fallbacks;
    }
    if (std::holds_alternative<ReducePlan>(zero_.stage().plan().plan)) {
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
    if (newton_ && (!under_way || state.increment.increments_left != increments_left_ || !same_place(motions, motions_)))
      ends_.push_back({motions, schedule_});
    newton_ = under_way;
    schedule_ = state.schedule;
    if (!under_way) return;
    motions_ = motions;
    increments_left_ = state.increment.increments_left;
  }

  // of a search; a failed trial leaves nothing
  void end_trial(const Progress<Dim>& now) {
    const bool stable = now.reduction.stable == target_;
    if (stable && !fallen_back(now.state)) {
      follow_all(stable_ends_);
      stable_ends_ = std::move(ends_);
    }
    ends_.clear();
  }
  void end_stage() {
    follow_all(stable_ends_);
    follow_all(ends_);
  }

  void begin_stage_of_twins(int stage) {
    stage_ = stage;
    zero_.enter(stage);
    for (Twin<Dim>& twin : twins_)
      twin.enter(stage);
  }

  // ---- how the twins follow -----------------------------------------------------------------------------------------

  void follow_all(std::vector<IncrementEnd<Dim>>& ends) {
    for (const IncrementEnd<Dim>& end : ends)
      follow(end);
    ends.clear();
  }

  Eigen::VectorXd residual(Twin<Dim>& twin, const Schedule& schedule, const Eigen::VectorXd& q) {
    ++found_.counters.evaluations;
    return twin.residual(schedule, twin.base, q);
  }

  void follow(const IncrementEnd<Dim>& end) {
    if (failed()) return;
    const Eigen::VectorXd q = zero_.motion_to(end.motions);
    const Eigen::VectorXd r = residual(zero_, end.schedule, q);
    const TangentFactors<Dim> factors(zero_.tangent(zero_.base));
    ++found_.counters.increments;
    ++found_.counters.factorisations;
    if (!factors.regular()) {
      found_.reason = "the tangent of an increment is singular";
      return;
    }
    const Weakening weakening = weakening_at(end.schedule, factors, q);
    for (Twin<Dim>& twin : twins_) {
      const Schedule schedule = twin.schedule_beside(zero_, end.schedule);
      twin.take_base(weakening.acts ? moved_alike(twin, schedule, factors, q, r, weakening).motion
                                    : corrected_motion(twin, schedule, factors, q, r));
    }
    zero_.take_base(q);
  }

  // the twin's motion at which it has the unbalanced forces r
  Eigen::VectorXd corrected_motion(Twin<Dim>& twin, const Schedule& schedule, const TangentFactors<Dim>& factors,
                                   const Eigen::VectorXd& q, const Eigen::VectorXd& r) {
    Eigen::VectorXd own = q, rest = residual(twin, schedule, own) - r;
    const double first = size_of(rest);
    double before = first;
    for (int k = 0; k < most_corrections && before > corrected * first; ++k) {
      own += factors.solve(rest);
      ++found_.counters.back_substitutions;
      rest = residual(twin, schedule, own) - r;
      if (const double now = size_of(rest); std::exchange(before, now) * hardly_corrected < now) break;
    }
    return own;
  }

  // ---- in a search --------------------------------------------------------------------------------------------------

  // How the run would move if the searched level changed: w = K^-1 dr/dF, and D w, along which motion is measured.
  struct Weakening {
    bool acts = false;
    double level = 0;
    Eigen::VectorXd by_level, along;
  };
  Weakening weakening_at(const Schedule& schedule, const TangentFactors<Dim>& factors, const Eigen::VectorXd& q) {
    const auto* plan = std::get_if<ReducePlan>(&zero_.stage().plan().plan);
    if (!plan) return {};
    Weakening w;
    w.level = level_in_force(plan->searched, chosen_properties(zero_.model, *plan), schedule);
    const double step = step_of_level * w.level;
    const auto at = [&](double level) { return residual(zero_, at_level(schedule, level), q); };
    w.by_level = factors.solve((at(w.level + step) - at(w.level - step)) / (2 * step));
    ++found_.counters.back_substitutions;
    w.along = zero_.unknowns.scale.cwiseProduct(w.by_level);
    w.acts = w.along.dot(w.by_level) > 0;
    residual(zero_, schedule, q);
    return w;
  }

  Schedule at_level(Schedule schedule, double level) const {
    const ReducePlan& plan = std::get<ReducePlan>(zero_.stage().plan().plan);
    set_strength(zero_.model, plan.searched, chosen_properties(zero_.model, plan), level, schedule);
    return schedule;
  }

  // The twin's motion, and the change of its level, at which it has the unbalanced forces r and has come as far as the
  // run along w: near a collapse a level may have no rest, or one far away, but every motion has a level.
  struct MovedAlike {
    Eigen::VectorXd motion;
    double change = 0;
  };
  MovedAlike moved_alike(Twin<Dim>& twin, const Schedule& schedule, const TangentFactors<Dim>& factors,
                         const Eigen::VectorXd& q, const Eigen::VectorXd& r, const Weakening& w) {
    MovedAlike own{q};
    const double began = w.along.dot(zero_.motion_to(twin.base.motions)), per_level = w.along.dot(w.by_level);
    for (int k = 0; k < 4; ++k) {
      const Eigen::VectorXd way =
          factors.solve(residual(twin, at_level(schedule, w.level + own.change), own.motion) - r);
      ++found_.counters.back_substitutions;
      const double more = -(began + w.along.dot(own.motion - q + way)) / per_level;
      own.motion += way + more * w.by_level;
      own.change += more;
    }
    residual(twin, at_level(schedule, w.level + own.change), own.motion);
    return own;
  }

  double size_of(const Eigen::VectorXd& x) const { return std::sqrt(x.dot(x.cwiseQuotient(zero_.unknowns.scale))); }

  // ---- derivatives --------------------------------------------------------------------------------------------------

  void find_at_rest(const AnswersAtRest<Dim>& answers) {
    follow_all(stable_ends_);
    if (failed()) return;
    const auto of = [&](const Twin<Dim>& twin) { return answers(*twin.scene, twin.model, twin.state()); };
    found_.answers = of(zero_);
    for (std::size_t n = 0; n < numbers_.size(); ++n) {
      const std::vector<double> below = of(twins_[2 * n]), above = of(twins_[2 * n + 1]);
      std::vector<RunDerivative>& row = found_.at_rest.emplace_back();
      for (std::size_t k = 0; k < below.size(); ++k)
        row.push_back(derivative_between(below[k], found_.answers[k], above[k], numbers_[n].step));
    }
  }

  // The last increment of the last stable trial: its base is that of all twins, its end is near the collapse.
  void find_critical(const ReducePlan& plan, const Progress<Dim>& now) {
    if (stable_ends_.empty()) {
      found_.reason = "no trial of the search took an increment of Newton's method";
      return;
    }
    const IncrementEnd<Dim> last = std::move(stable_ends_.back());
    stable_ends_.pop_back();
    follow_all(stable_ends_);
    if (failed()) return;
    const Eigen::VectorXd q = zero_.motion_to(last.motions);
    const Eigen::VectorXd r = residual(zero_, last.schedule, q);
    const TangentFactors<Dim> factors(zero_.tangent(zero_.base));
    ++found_.counters.factorisations;
    if (!factors.regular()) {
      found_.reason = "the tangent of the last stable state is singular";
      return;
    }
    const NullVectors vectors = null_vectors<Dim>(factors, zero_.unknowns.scale);
    CriticalDerivatives& c = found_.critical.emplace();
    const std::vector<int> properties = chosen_properties(zero_.model, plan);
    c.level = level_in_force(plan.searched, properties, last.schedule);
    c.critical = 0.5 * (now.reduction.stable + now.reduction.failed);
    c.smallest = vectors.smallest;
    c.second = vectors.second;
    c.motion = vectors.motion;
    c.weight = vectors.weight;
    double softest = 1;
    for (const JointProperties& p : zero_.model.properties)
      softest = std::min(softest, p.shear_stiffness / p.normal_stiffness);
    c.near_collapse = zero_.unknowns.free.size() > 1 && c.smallest < mechanism_share * softest * c.second;

    const Weakening weakening = weakening_at(last.schedule, factors, q);
    if (!weakening.acts) {
      found_.reason = "no joint that is searched slips in the last stable state";
      return;
    }
    const auto change_of = [&](Twin<Dim>& twin) {
      return moved_alike(twin, twin.schedule_beside(zero_, last.schedule), factors, q, r, weakening).change;
    };
    for (std::size_t n = 0; n < numbers_.size(); ++n) {
      const double below = change_of(twins_[2 * n]), above = change_of(twins_[2 * n + 1]);
      c.by.push_back(derivative_between(below, 0, above, numbers_[n].step));
    }
  }

  const std::vector<TwinScenes<Dim>>& numbers_;
  RunDerivatives& found_;
  Twin<Dim> zero_;                 // of the scene itself: by Newton's method alone, as all twins
  std::vector<Twin<Dim>> twins_;   // by number: below, above

  int stage_ = -1, trial_ = -1;
  double target_ = 0;
  long long fallbacks_ = 0;
  bool newton_ = false;  // an increment was under way before the last step
  int increments_left_ = 0;
  std::vector<Motion<Dim>> motions_;  // its base's
  Schedule schedule_;                 // of the last step
  // increments that no twin has followed: those of the trial or stage under way; of the last stable trial
  std::vector<IncrementEnd<Dim>> ends_, stable_ends_;
};

}  // namespace

template <int Dim>
std::string not_differentiable(const Prepared<Dim>& scene) {
  if (!newton_applies(scene.model)) return "joints that soften, dilate or mobilise are left to relaxation";
  for (const StagePlan& stage : scene.stages) {
    const Settings settings = settings_of(stage, scene.settings);
    if (std::holds_alternative<RunPlan>(stage.plan))
      return fmt::format("stage {} is a motion in time, not an equilibrium", stage.name);
    if (settings.statics.method != Statics::newton)
      return fmt::format("stage {} does not use Newton's method (statics = \"newton\")", stage.name);
    if (!stage.change.excavate.empty()) return fmt::format("stage {} excavates", stage.name);
    const auto* search = std::get_if<ReducePlan>(&stage.plan);
    if (search && search->method != ReductionMethod::bisection)
      return fmt::format("stage {} does not search by bisection", stage.name);
    if (search && &stage != &scene.stages.back()) return fmt::format("stages follow the search of stage {}", stage.name);
  }
  return {};
}

template <int Dim>
std::string not_twins(const Model<Dim>& model, const Model<Dim>& other) {
  if (model.bodies.size() != other.bodies.size())
    return fmt::format("{} blocks instead of {}", other.bodies.size(), model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>&one = model.bodies[b], &two = other.bodies[b];
    const bool same = one.name == two.name && one.fixed == two.fixed && one.free_translation == two.free_translation &&
                      one.free_rotation == two.free_rotation &&
                      std::ranges::equal(one.parts, two.parts, [](const Polytope<Dim>& p, const Polytope<Dim>& q) {
                        return p.joints == q.joints && p.loops == q.loops;
                      });
    const double apart = (one.reference - two.reference).norm();
    if (!same || apart > 0.01 * one.radius) return fmt::format("block {} has other faces or another place", b);
  }
  if (model.properties.size() != other.properties.size() || model.bolts.size() != other.bolts.size() ||
      model.joints.size() != other.joints.size())
    return "other joints or bolts";
  return {};
}

template <int Dim>
RunDerivatives run_with_derivatives(const Prepared<Dim>& scene, const std::vector<TwinScenes<Dim>>& numbers,
                                    const AnswersAtRest<Dim>& answers, Progress<Dim>& progress) {
  RunDerivatives found;
  found.reason = not_differentiable(scene);
  for (const TwinScenes<Dim>& n : numbers)
    for (const Prepared<Dim>* side : {&n.below, &n.above})
      if (found.reason.empty()) found.reason = not_twins(scene.model, side->model);
  const Clock::time_point began = Clock::now();
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

#define VOUSSOIR_INSTANTIATE(Dim)                                                             \
  template std::string not_differentiable<Dim>(const Prepared<Dim>&);                         \
  template std::string not_twins<Dim>(const Model<Dim>&, const Model<Dim>&);                  \
  template RunDerivatives run_with_derivatives<Dim>(                                          \
      const Prepared<Dim>&, const std::vector<TwinScenes<Dim>>&, const AnswersAtRest<Dim>&, Progress<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
