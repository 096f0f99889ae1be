#include "app/check/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/check/blocks.hpp"
#include "app/check/motion_damping.hpp"
#include "core/implicit/load_bounds.hpp"
#include "core/run/bonds_as_sliced.hpp"
#include "core/scene/judge_values.hpp"
#include "core/step/contacts.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/neighbours.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/static_solver.hpp"
#include "core/step/time_step.hpp"

namespace voussoir {

// inscribed radius of the smallest free block, m; 0 when none is free yet
template <int Dim>
double smallest_size(const Model<Dim>& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body<Dim>& body : model.bodies)
    if (moves(body)) smallest = std::min(smallest, inscribed_radius(body));
  return std::isfinite(smallest) ? smallest : 0;
}

// a stage that relaxes from its first step on stops every body
bool relaxes(const StagePlan& stage, const StaticsSettings& statics) {
  if (statics.method == Statics::local) return false;
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan))
    return plan->method == ReductionMethod::bisection || plan->method == ReductionMethod::steps;
  return std::holds_alternative<SettlePlan>(stage.plan);
}

double ramp_of(const StagePlan& stage) {
  double ramp = 0;
  if (const auto* plan = std::get_if<SettlePlan>(&stage.plan)) ramp = plan->gravity.ramp;
  if (const auto* plan = std::get_if<RunPlan>(&stage.plan)) ramp = plan->gravity.ramp;
  for (const WaterPlan& water : stage.water)
    ramp = std::max(ramp, water.ramp);
  if (stage.excavation_forces) ramp = std::max(ramp, stage.excavation_forces->duration);
  return ramp;
}

const char* text_of(EstimateKind kind) {
  return kind == EstimateKind::about ? "about" : kind == EstimateKind::at_least ? "at least" : "at most";
}

bool asks_for_newton(const StaticsSettings& statics, const std::vector<StagePlan>& stages) {
  return statics.method == Statics::newton || std::any_of(stages.begin(), stages.end(), [](const StagePlan& s) {
           return s.statics && s.statics->method == Statics::newton;
         });
}

namespace {

constexpr double relaxed_fraction = 0.9;  // of the stability limit: the step of relaxation

// Overlap at which the joints under a body support its weight: u such that sum k A (n·g)² u = W over its faces that
// look down and may touch another. 0 without gravity or without such a face.
template <int Dim>
double own_weight_overlap(const Model<Dim>& model, const std::vector<bool>& used, const Body<Dim>& body) {
  const double g = model.gravity.norm();
  if (g == 0) return 0;
  double stiffness = 0;
  for (const Polytope<Dim>& part : body.parts)
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      const double slope = part.faces[f].normal.dot(model.gravity) / g;
      if (slope <= 0) continue;
      const int joint = part.joints[f];
      const int properties = joint == no_joint ? model.default_properties : model.joints[joint].properties;
      if (properties < 0 || properties >= static_cast<int>(model.properties.size()) || !used[properties]) continue;
      const JointProperties& p = model.properties[properties];
      const double area = p.constant_stiffness ? 1 : face_area<Dim>(part, static_cast<int>(f));
      stiffness += p.normal_stiffness * area * slope * slope;
    }
  return stiffness > 0 ? body.mass * g / stiffness : 0;
}

// Time in which the oscillation of a block on its joint decays to the fraction `rest` of its first amplitude. Local
// damping (fraction α) leaves 1-α of the force inwards and 1+α outwards, the dashpot reduces the amplitude at the rate
// ξω. Relaxation damps critically.
double settling_time(double overlap, double g, const Settings& settings) {
  const double rest = settings.equilibrium.unbalanced;
  if (relaxes(true, settings.statics)) return -std::log(rest) / std::sqrt(g / overlap);
  const DampingSettings& damping = settings.damping;
  const double frequency = std::sqrt(g / overlap), in = std::sqrt(1 - damping.local),
               out = std::sqrt(1 + damping.local);
  const double half_swing = 0.5 * std::numbers::pi * (1 / in + 1 / out) / frequency;
  const double decay = std::log(out / in) / half_swing + damping.viscous_ratio * frequency;
  return decay > 0 ? -std::log(rest) / decay : 0;
}

struct Forecaster {
  double settling;       // s
  double g;              // m/s²
  double smallest;       // m: inscribed radius of a free block
  double time_step;      // s
  bool relaxed;          // there is no motion that could slide away
  double ramp_of_stage;  // s

  double operator()(const SettlePlan&) const { return ramp_of_stage + settling; }
  double operator()(const RunPlan& plan) const { return plan.duration; }
  double operator()(const ReducePlan& plan) const {
    const bool factor = plan.searched == Searched::factor;
    const double range = std::abs(factor ? plan.factor.from - plan.factor.to : plan.from - plan.to);
    const double tolerance = factor ? plan.factor.tolerance : plan.tolerance;
    switch (plan.method) {
      case ReductionMethod::bisection:
        return (2 + std::ceil(std::log2(std::max(1.0, range / tolerance)))) * trial(plan);
      case ReductionMethod::steps:
        return std::ceil(range / (factor ? plan.factor.step : plan.step)) * (ramp(plan) + settling);
      case ReductionMethod::rate:
        return range / plan.rate;
      case ReductionMethod::two_rates:
        return range / plan.rate + range / plan.slower_rate;
    }
    return 0;
  }
  double ramp(const ReducePlan& plan) const { return static_cast<double>(plan.ramp_steps) * time_step; }
  // a trial ends in equilibrium, or when a body has slid away at a tenth of gravity
  double trial(const ReducePlan& plan) const {
    const double distance = plan.failure_displacement > 0 ? plan.failure_displacement : 0.1 * smallest;
    const double sliding = g > 0 && !relaxed ? std::sqrt(2 * distance / (0.1 * g)) : 0;
    return ramp(plan) + std::max(settling, sliding);
  }
};

EstimateKind kind_of(const StagePlan& stage) {
  if (std::holds_alternative<RunPlan>(stage.plan)) return EstimateKind::about;
  const auto* plan = std::get_if<ReducePlan>(&stage.plan);
  return plan && plan->method != ReductionMethod::bisection ? EstimateKind::at_most : EstimateKind::at_least;
}

// Of all linings. A chain of n beams bends in modes whose frequencies range as n² to 1: an explicit method, whose step
// the stiffest mode limits, takes about n² steps until the slowest is in equilibrium.
struct LiningCost {
  double step_limit;  // s: of the beams' stiffest mode
  double steps = 0;   // to equilibrium, about; not by Newton's method
};

template <int Dim>
LiningCost cost_of_linings(const Model<Dim>& model, const std::vector<std::string>& names) {
  LiningCost cost{std::numeric_limits<double>::infinity(), 0};
  for (const Lining& lining : model.linings) {
    if (std::ranges::find(names, lining.properties.name) == names.end()) continue;
    double square = 0;
    for (const LiningNode& node : lining.nodes)
      square = std::max(square, node.square_frequency);
    if (square > 0) cost.step_limit = std::min(cost.step_limit, 2 / std::sqrt(square));
    const auto nodes = static_cast<double>(lining.nodes.size());
    cost.steps = std::max(cost.steps, nodes * nodes);
  }
  return cost;
}

template <int Dim>
void forecast_stages(const Prepared<Dim>& prepared, const Model<Dim>& model, State<Dim>& state, Forecast& result) {
  const double g = model.gravity.norm();
  const double smallest = smallest_size(model);
  std::vector<std::string> installed;
  for (const StagePlan& stage : prepared.stages) {
    const Settings settings = settings_of(stage, prepared.settings);
    installed.insert(installed.end(), stage.change.install.begin(), stage.change.install.end());
    const LiningCost linings = cost_of_linings(model, installed);
    TimeStepEstimate estimate = estimate_time_step<Dim>(model, settings, settings.damping, state.bodies, state.loads,
                                                        state.contacts, state.time_step);
    if (linings.step_limit < estimate.limit) {
      if (!settings.time.step && std::isfinite(estimate.limit)) estimate.step *= linings.step_limit / estimate.limit;
      estimate.limit = linings.step_limit;
    }
    if (&stage == &prepared.stages.front()) result.step_limit = estimate.limit;
    const bool relaxed = relaxes(stage, settings.statics);
    StageForecast forecast{.name = stage.name, .time_step = estimate.step, .kind = kind_of(stage)};
    if (relaxed && !prepared.settings.time.step && std::isfinite(estimate.limit))
      forecast.time_step = relaxed_fraction * estimate.limit;
    double settling = 0;
    if (g > 0 && result.overlap > 0) settling = settling_time(result.overlap, g, settings);
    forecast.duration =
        std::visit(Forecaster{settling, g, smallest, forecast.time_step, relaxed, ramp_of(stage)}, stage.plan);
    if (forecast.time_step > 0) forecast.steps = forecast.duration / forecast.time_step;
    if (forecast.steps > 0 && settings.statics.method != Statics::newton &&
        !std::holds_alternative<RunPlan>(stage.plan))
      forecast.steps = std::max(forecast.steps, linings.steps);
    if (std::holds_alternative<RunPlan>(stage.plan)) {
      const double load_step = step_of_loads(stage.change);
      forecast.load_step = std::isfinite(load_step) ? load_step : 0;
      forecast.implicit = settings.time.integration == Integration::implicit_steps;
      const double swing = g > 0 && result.overlap > 0 ? std::sqrt(g / result.overlap) / (2 * std::numbers::pi) : 0;
      forecast.damping = motion_damping_text(settings.damping, swing);
    }
    result.stages.push_back(forecast);
  }
}

template <int Dim>
void find_overlaps(const Model<Dim>& model, Forecast& result) {
  const std::vector<bool> used = properties_of_faces(model);
  for (const Body<Dim>& body : model.bodies) {
    if (!moves(body)) continue;
    const double overlap = own_weight_overlap(model, used, body);
    result.overlap = std::max(result.overlap, overlap);
    result.overlap_fraction = std::max(result.overlap_fraction, overlap / inscribed_radius(body));
  }
}

// the block with most neighbours, and the memory of a run: a step has two lists of pairs while one is renewed
template <int Dim>
void find_crowd(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state, Forecast& result) {
  constexpr double memory_of_a_block = 10e3;  // bytes, measured in complete runs
  result.memory = memory_of_a_block * static_cast<double>(model.bodies.size()) +
                  2.0 * static_cast<double>(state.contacts.list.size() * sizeof(Contact<Dim>) +
                                            state.contacts.subs.size() * sizeof(SubContact<Dim>) +
                                            state.contacts.rises.size() * sizeof(JointRise<Dim>));
  if (asks_for_newton(prepared.settings.statics, prepared.stages)) result.memory += memory_of_newton(state);
  result.candidates_allowed = static_cast<double>(most_candidates(model.parts.size()));
  std::size_t most = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const std::size_t count = contacts_of(state.contacts, static_cast<int>(b)).size();
    if (count <= most) continue;
    most = count;
    result.crowded = name_of(model, static_cast<int>(b));
  }
  result.most_candidates = static_cast<int>(most);
}

}  // namespace

template <int Dim>
Forecast forecast(const Prepared<Dim>& prepared, const Model<Dim>& model, State<Dim>& state) {
  Forecast result;
  result.candidates = static_cast<int>(state.contacts.list.size());
  result.touching = static_cast<int>(std::count_if(state.contacts.list.begin(), state.contacts.list.end(),
                                                   [](const Contact<Dim>& contact) { return contact.touching(); }));
  const bool by_stage =
      std::any_of(prepared.stages.begin(), prepared.stages.end(), [](const StagePlan& s) { return s.change.bond; });
  if (by_stage || (has_bonds_as_sliced(model) && !prepared.stages.empty())) {
    State<Dim> bonded = state;
    make_bonds_as_sliced(model, prepared.settings, bonded);
    if (by_stage)
      make_bonds(model, prepared.settings, bonded.bodies, bonded.contacts, bonded.ledger.bonds, bonded.counters);
    result.bonds = count_bonds(bonded.contacts, bonded.ledger.bonds);
  }
  find_crowd(prepared, model, state, result);
  find_overlaps(model, result);
  forecast_stages(prepared, model, state, result);
  return result;
}

template double smallest_size<2>(const Model<2>&);
template Forecast forecast<2>(const Prepared<2>&, const Model<2>&, State<2>&);
template double smallest_size<3>(const Model<3>&);
template Forecast forecast<3>(const Prepared<3>&, const Model<3>&, State<3>&);

}  // namespace voussoir
