#include "app/limit/decide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/run/run.hpp"
#include "core/run/simulate.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// of a block's inscribed radius: it has fallen; under gravity itself all joints close, too
constexpr double moved = 0.02, moved_by_gravity = 0.1;
constexpr double close = 0.01;          // of the level, or of the ends' distance: what a decision is worth
constexpr int most_runs = 8;            // of a load
constexpr int look_every = 100;         // at a run
constexpr double strong_friction = 85;  // deg, while the blocks settle before a search
constexpr double wider = 1.25;          // than the ends: the range of a search for a factor
constexpr double wider_deg = 5;         // of one for an angle
constexpr double tolerance_deg = 0.1;   // of its bracket

// what the stages of the scene install, from the beginning, as limit analysis has it
template <int Dim>
StagePlan settle_first(const Prepared<Dim>& scene) {
  StagePlan stage;
  stage.name = "settle";
  stage.plan = SettlePlan{};
  for (const StagePlan& stated : scene.stages)
    stage.change.install.insert(stage.change.install.end(), stated.change.install.begin(), stated.change.install.end());
  return stage;
}

// the scene's blocks in stages of our own, without anything that is only watched or written
template <int Dim>
Prepared<Dim> in_stages(const Prepared<Dim>& scene, std::vector<StagePlan> stages) {
  Prepared<Dim> run = scene;
  run.stages = std::move(stages);
  run.last_stage.reset();
  run.monitors.clear();
  run.output = {};
  return run;
}

void tell_run(const LimitRequest& request, const std::string& what) {
  if (request.on_run) request.on_run(what);
}

// the farthest that a free block has moved since the stage began, over its inscribed radius
template <int Dim>
double way_of(const Model<Dim>& model, const std::vector<Vector<Dim>>& now, const std::vector<Vector<Dim>>& begin) {
  double way = 0;
  for (std::size_t b = 0; b < begin.size(); ++b)
    if (model.bodies[b].present && !model.bodies[b].fixed)
      way = std::max(way, (now[b] - begin[b]).norm() / inscribed_radius(model.bodies[b]));
  return way;
}

enum class Ended { rests, falls, undecided };

// the last stage of the scene: whether the blocks come to rest in it
template <int Dim>
Ended ended(const Prepared<Dim>& scene, const LimitRequest& request, double most_way, const std::string& what) {
  Progress<Dim> progress = initial_progress(scene);
  Watcher<Dim> watcher;
  const int last = static_cast<int>(scene.stages.size()) - 1;
  std::vector<Vector<Dim>> begin;
  bool fell = false;
  watcher.pause = [&](const Progress<Dim>& now) {
    const bool pushed = now.stage == last && now.stage_under_way;
    if (pushed && begin.empty()) begin = displacements(now.state.bodies);
    if (now.state.counters.steps % look_every != 0) return false;
    tell_run(request, fmt::format("{}, step {}", what, now.state.counters.steps));
    return fell = pushed && way_of(scene.model, displacements(now.state.bodies), begin) > most_way;
  };
  const bool done = simulate(scene, progress, watcher);
  if (fell || !progress.results.moved.empty()) return Ended::falls;
  if (!done || progress.results.stages.empty()) return Ended::undecided;
  const std::string& reason = progress.results.stages.back().ended;
  if (reason == describe(StopReason::falls_free)) return Ended::falls;
  return reason == describe(StopReason::equilibrium) ? Ended::rests : Ended::undecided;
}

}  // namespace

template <int Dim>
Decision decide_factor(const Prepared<Dim>& scene, const LimitRequest& request, const std::vector<ForcePlan>& forces,
                       double least, double most) {
  const bool of_gravity = request.load->kind == LimitLoad::Kind::gravity;
  Decision decision;
  const auto at = [&](double factor) {
    std::vector<StagePlan> stages{settle_first(scene)};
    if (of_gravity) {
      stages.back().plan = SettlePlan{.gravity = {.to = factor}};
    } else {
      StagePlan pushed;
      pushed.name = "pushed";
      pushed.plan = SettlePlan{};
      pushed.change.force = forces;
      pushed.change.bond = request.cohesion;
      for (ForcePlan& force : pushed.change.force)
        for (double& part : force.force)
          part *= factor;
      stages.push_back(std::move(pushed));
    }
    ++decision.runs;
    const Ended end = ended(in_stages(scene, std::move(stages)), request, of_gravity ? moved_by_gravity : moved,
                            fmt::format("run {} at a factor of {:.6g}", decision.runs, factor));
    if (end == Ended::rests) decision.rests = factor;
    if (end == Ended::falls) decision.falls = factor;
    if (end == Ended::undecided)
      decision.because = fmt::format("a run at a factor of {:.6g} neither came to rest nor fell", factor);
    return end;
  };
  const double apart = std::max(most - least, close * std::abs(least));
  double low = least - 0.25 * apart;
  Ended end = at(low);
  for (double step = apart; end == Ended::falls && decision.runs < most_runs; step *= 2)
    end = at(low -= step);
  if (end == Ended::falls) decision.because = fmt::format("the blocks fall down to a factor of {:.6g}", low);
  if (end != Ended::rests) return decision;
  // a level that no run decides is left above: the bracket then stays wider
  double high = decision.falls.value_or(most);
  while (decision.runs < most_runs && high - low > close * std::abs(low)) {
    const double middle = 0.5 * (low + high);
    (at(middle) == Ended::rests ? low : high) = middle;
  }
  if (!decision.falls) decision.falls = most;
  return decision;
}

template <int Dim>
Decision decide_strength(const Prepared<Dim>& scene, const LimitRequest& request, double strong, double weak) {
  Decision decision;
  StagePlan settle = settle_first(scene), reduce;
  settle.change.friction = strong_friction * degree;
  ReducePlan plan;
  plan.criterion = FailureCriterion::required_strength;
  plan.properties = request.properties;
  if (request.factor) {
    plan.searched = Searched::factor;
    plan.factor = {strong / wider, weak * wider, close * strong, 0};
  } else {
    plan.from = std::min(strong + wider_deg * degree, strong_friction * degree);
    plan.to = std::max(0.5 * weak, weak - wider_deg * degree);
    plan.tolerance = tolerance_deg * degree;
  }
  reduce.name = "decide";
  reduce.plan = plan;
  reduce.change.friction_as_stated = true;
  reduce.change.bond = request.cohesion;

  const Prepared<Dim> search = in_stages(scene, {settle, reduce});
  Progress<Dim> progress = initial_progress(search);
  Watcher<Dim> watcher;
  watcher.pause = [&](const Progress<Dim>& now) {
    if (now.state.counters.steps % look_every == 0)
      tell_run(request, fmt::format("search on elastic joints, trial {}, step {}", now.reduction.trial + 1,
                                    now.state.counters.steps));
    return false;
  };
  simulate(search, progress, watcher);
  decision.runs = static_cast<int>(progress.results.trials.size());
  const Value* found = progress.results.find(request.factor ? "factor_of_safety" : "critical_friction");
  if (!found || !found->bracket || !found->bracket_middle) {
    decision.because = progress.results.message;
    return decision;
  }
  const double unit = request.factor ? 1 : degree, sign = request.factor ? 1 : -1;
  decision.rests = unit * (*found->bracket_middle - sign * *found->bracket);
  decision.falls = unit * (*found->bracket_middle + sign * *found->bracket);
  return decision;
}

template Decision decide_factor(const Prepared<2>&, const LimitRequest&, const std::vector<ForcePlan>&, double, double);
template Decision decide_factor(const Prepared<3>&, const LimitRequest&, const std::vector<ForcePlan>&, double, double);
template Decision decide_strength(const Prepared<2>&, const LimitRequest&, double, double);
template Decision decide_strength(const Prepared<3>&, const LimitRequest&, double, double);

}  // namespace voussoir
