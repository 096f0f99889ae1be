#include "app/check/plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/check/plausible_assembly.hpp"
#include "app/check/plausible_steps.hpp"
#include "app/check/plausible_support.hpp"
#include "core/potential/particle.hpp"
#include "core/scene/plausibility.hpp"
#include "core/stage/install_linings.hpp"
#include "core/step/contacts.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/neighbours.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/static_solver.hpp"
#include "core/step/time_step.hpp"

namespace voussoir {
namespace {

// thresholds of warnings: where experience says "look again", not where anything breaks
constexpr double large_overlap_fraction = 0.01;  // of the inscribed radius: blocks visibly sink into each other
constexpr double least_overlap_fraction = 1e-9;  // stiffer than rock can be: rounding becomes visible
constexpr double large_overlap = 0.01;           // m: joints in rock close by a millimetre or so
constexpr double many_steps = 1e6;               // hours
constexpr double few_steps = 10;
constexpr double many_frames = 1e4;       // files
constexpr double long_interval = 2;       // of output, over the longest stage
constexpr double many_rows = 1e6;         // of history.csv: a hundred megabytes
constexpr double relaxed_fraction = 0.9;  // of the stability limit: what relaxation takes for its step
constexpr double dashpot_error = 0.4;     // of a restitution, over the fraction of the step (cases/bounce)
constexpr double large_dashpot_error = 0.041;
constexpr double settlement_margin = 10;  // failure displacement over elastic settlement
constexpr double wide_size_ratio = 100;   // largest over smallest inscribed radius

template <int Dim>
bool moves(const Body<Dim>& body) {
  return body.present && !body.fixed && !body.parts.empty();
}

// Overlap at which the joints under a body carry its weight: u such that sum k A (n·g)² u = W over its faces that look
// down and may meet another. 0 without gravity or without such a face.
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

// Time in which a block that bounces on its joint comes down to the fraction `rest` of its first swing. Local damping
// (fraction α) drives every swing inwards with 1-α and outwards with 1+α of the force, the dashpot takes ξω of the
// amplitude per time. Relaxation damps critically.
double settling_time(double overlap, double g, const DampingSettings& damping, double rest) {
  if (relaxes(true, damping)) return -std::log(rest) / std::sqrt(g / overlap);
  const double frequency = std::sqrt(g / overlap), in = std::sqrt(1 - damping.local),
               out = std::sqrt(1 + damping.local);
  const double half_swing = 0.5 * std::numbers::pi * (1 / in + 1 / out) / frequency;
  const double decay = std::log(out / in) / half_swing + damping.viscous_ratio * frequency;
  return decay > 0 ? -std::log(rest) / decay : 0;
}

// inscribed radius of the smallest free block, m; 0 when none is free yet
template <int Dim>
double smallest_size(const Model<Dim>& model) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body<Dim>& body : model.bodies)
    if (moves(body)) smallest = std::min(smallest, thickest_part(body));
  return std::isfinite(smallest) ? smallest : 0;
}

// a stage that relaxes from its first step on stops every body
bool relaxes(const StagePlan& stage, const DampingSettings& damping) {
  if (damping.statics == Statics::local) return false;
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan))
    return plan->method == ReductionMethod::bisection || plan->method == ReductionMethod::steps;
  return std::holds_alternative<SettlePlan>(stage.plan);
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
  // a trial ends at rest, or when a body has slid away at a tenth of gravity
  double trial(const ReducePlan& plan) const {
    const double way = plan.failure_displacement > 0 ? plan.failure_displacement : 0.1 * smallest;
    const double sliding = g > 0 && !relaxed ? std::sqrt(2 * way / (0.1 * g)) : 0;
    return ramp(plan) + std::max(settling, sliding);
  }
};

EstimateKind reckoning_of(const StagePlan& stage) {
  if (std::holds_alternative<RunPlan>(stage.plan)) return EstimateKind::about;
  const auto* plan = std::get_if<ReducePlan>(&stage.plan);
  return plan && plan->method != ReductionMethod::bisection ? EstimateKind::at_most : EstimateKind::at_least;
}

template <int Dim>
void forecast_stages(const Prepared<Dim>& prepared, const Model<Dim>& model, State<Dim>& state, Plausibility& result) {
  const double g = model.gravity.norm();
  const double smallest = smallest_size(model);
  std::vector<std::string> installed;
  for (const StagePlan& stage : prepared.stages) {
    const Settings settings = settings_of(stage, prepared.settings);
    const DampingSettings& damping = settings.damping;
    installed.insert(installed.end(), stage.change.install.begin(), stage.change.install.end());
    const LiningCost linings = cost_of_linings(model, installed);
    TimeStepEstimate estimate =
        estimate_time_step<Dim>(model, settings, damping, state.bodies, state.loads, state.contacts, state.time_step);
    if (linings.step_limit < estimate.limit) {
      if (!settings.time.step && std::isfinite(estimate.limit)) estimate.step *= linings.step_limit / estimate.limit;
      estimate.limit = linings.step_limit;
    }
    if (&stage == &prepared.stages.front()) result.step_limit = estimate.limit;
    const bool relaxed = relaxes(stage, damping);
    StageForecast forecast{.name = stage.name, .time_step = estimate.step, .reckoning = reckoning_of(stage)};
    if (relaxed && !prepared.settings.time.step && std::isfinite(estimate.limit))
      forecast.time_step = relaxed_fraction * estimate.limit;
    double settling = 0;
    if (g > 0 && result.overlap > 0)
      settling = settling_time(result.overlap, g, damping, prepared.settings.equilibrium.unbalanced);
    forecast.duration =
        std::visit(Forecaster{settling, g, smallest, forecast.time_step, relaxed, ramp_of(stage)}, stage.plan);
    if (forecast.time_step > 0) forecast.steps = forecast.duration / forecast.time_step;
    if (forecast.steps > 0 && damping.statics != Statics::newton && !std::holds_alternative<RunPlan>(stage.plan))
      forecast.steps = std::max(forecast.steps, linings.steps);
    result.stages.push_back(forecast);
  }
}

template <int Dim>
void find_overlaps(const Model<Dim>& model, Plausibility& result) {
  const std::vector<bool> used = properties_of_faces(model);
  for (const Body<Dim>& body : model.bodies) {
    if (!moves(body)) continue;
    const double overlap = own_weight_overlap(model, used, body);
    result.overlap = std::max(result.overlap, overlap);
    result.overlap_fraction = std::max(result.overlap_fraction, overlap / thickest_part(body));
  }
}

// Weight over stiffness: a wrong unit in density, gravity, stiffness or geometry shows here.
template <int Dim>
void judge_overlaps(const Prepared<Dim>& prepared, Plausibility& result) {
  const double radius = prepared.settings.contact.potential_radius, fraction = result.overlap_fraction;
  const std::string units = "or check the units of normal_stiffness (Pa/m), density, gravity and the geometry (m)";
  if (fraction > radius)
    result.warnings.push_back(
        fmt::format("blocks sink by {:.2g} of their inscribed radius under their own weight, more than "
                    "contact.potential_radius = {:.2g}: raise normal_stiffness, or potential_radius, {}",
                    fraction, radius, units));
  else if (fraction > large_overlap_fraction)
    result.warnings.push_back(fmt::format(
        "blocks sink by {:.2g} of their inscribed radius under their own weight: raise normal_stiffness, {}", fraction,
        units));
  else if (fraction > 0 && fraction < least_overlap_fraction)
    result.warnings.push_back(
        fmt::format("blocks sink by only {:.2g} of their inscribed radius under their own weight: lower "
                    "normal_stiffness, {}",
                    fraction, units));
  if (result.overlap > large_overlap)
    result.warnings.push_back(fmt::format(
        "joints close by {:.2g} m under the weight of one block, rock joints by a millimetre: raise normal_stiffness, "
        "{}",
        result.overlap, units));
}

// the block with most neighbours, and the memory of a run: a step keeps two lists of pairs while one is renewed
template <int Dim>
void find_crowd(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state, Plausibility& result) {
  constexpr double memory_of_a_block = 10e3;  // bytes, measured over whole runs
  result.memory = memory_of_a_block * static_cast<double>(model.bodies.size()) +
                  2.0 * static_cast<double>(state.contacts.list.size() * sizeof(Contact<Dim>) +
                                            state.contacts.subs.size() * sizeof(SubContact<Dim>));
  if (asks_for_newton(prepared.settings.damping, prepared.stages)) result.memory += memory_of_newton(state);
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

template <int Dim>
void judge_bodies(const Prepared<Dim>& prepared, const Model<Dim>& model, const State<Dim>& state,
                  Plausibility& result) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  bool anything_moves = model.gravity.norm() > 0 || !model.boundary.empty() ||
                        std::any_of(prepared.stages.begin(), prepared.stages.end(),
                                    [](const StagePlan& s) { return !s.change.force.empty(); });
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    anything_moves |= body.prescribed;
    if (!moves(body)) continue;
    smallest = std::min(smallest, thickest_part(body));
    largest = std::max(largest, thickest_part(body));
    const Motion<Dim>& motion = state.bodies.motions[b];
    anything_moves |= motion.velocity.norm() > 0 || motion.angular_momentum.norm() > 0;
  }
  if (!anything_moves && state.contacts.list.empty())
    result.warnings.push_back("no gravity, no velocity, no force and no contact: nothing will move");
  if (largest > wide_size_ratio * smallest)
    result.warnings.push_back(
        fmt::format("inscribed radii of free blocks range from {:.2g} to {:.2g} m: the smallest sets the time step; "
                    "consider slicing.smallest_inscribed_radius",
                    smallest, largest));
}

// initial velocities that the first stage forgets
template <int Dim>
void judge_velocities(const Prepared<Dim>& prepared, const Model<Dim>& model, Plausibility& result) {
  if (prepared.stages.empty()) return;
  const StagePlan& first = prepared.stages.front();
  if (!begins_relaxing(first, first.damping.value_or(prepared.settings.damping))) return;
  for (std::size_t b = 0; b < prepared.state.bodies.motions.size(); ++b) {
    const Motion<Dim>& motion = prepared.state.bodies.motions[b];
    if (!moves(model.bodies[b]) || (motion.velocity.isZero(0) && motion.angular_momentum.isZero(0))) continue;
    result.warnings.push_back(
        fmt::format("block {} begins with a velocity (its own, or that of initial_velocity) that is lost: stage.{} "
                    "comes to rest by "
                    "relaxation, which stops every block; let a stage of kind \"run\" come first, or state "
                    "stage.{}.damping.statics = \"local\"",
                    name_of(model, static_cast<int>(b)), first.name, first.name));
    return;  // one tells
  }
}

void judge_stage(const StagePlan& stage, const Settings& settings, double overlap, double smallest,
                 Plausibility& result) {
  const DampingSettings& damping = settings.damping;
  const TimeSettings& time = settings.time;
  const std::string where = "stage." + stage.name;
  const bool undamped = damping.local == 0 && damping.viscous_ratio == 0;
  const double fraction = undamped ? TimeSettings::most_undamped : TimeSettings::most_damped;
  if (!time.step && time.fraction > fraction)
    result.warnings.push_back(
        fmt::format("{}: time.fraction = {} is above {}{}: contacts that open and close gain energy", where,
                    time.fraction, fraction, undamped ? ", the most without damping" : ""));
  const bool seeks_rest = !std::holds_alternative<RunPlan>(stage.plan);
  if (!seeks_rest && !time.step && damping.viscous_ratio > 0 && dashpot_error * time.fraction > large_dashpot_error)
    result.warnings.push_back(fmt::format(
        "{}: dashpots (damping.viscous_ratio = {}) at time.fraction = {} put the restitution of impacts some {:.2g} % "
        "off, in proportion to the fraction; 0.02 leaves 1 %",
        where, damping.viscous_ratio, time.fraction, 100 * dashpot_error * time.fraction));
  if (seeks_rest && undamped && !begins_relaxing(stage, damping))
    result.warnings.push_back(where + " waits for rest but nothing damps: give it damping.local = 0.7");
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan);
      plan && smallest > 0 && plan->failure_displacement > smallest)
    result.warnings.push_back(
        fmt::format("{}.failure_displacement = {:.2g} m exceeds the smallest inscribed radius of a free block, {:.2g} "
                    "m; is it in m?",
                    where, plan->failure_displacement, smallest));
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan);
      plan && plan->failure_displacement > 0 && plan->failure_displacement < settlement_margin * overlap)
    result.warnings.push_back(fmt::format(
        "{}.failure_displacement = {:.2g} m is less than {} times the elastic settlement of about {:.2g} m: "
        "settling may pass as failure",
        where, plan->failure_displacement, settlement_margin, overlap));
}

// A column of n blocks swings (2 n + 1)/π times as slowly as one of them, and an assembly as a column of its height.
template <int Dim>
double slowest_swing(const Model<Dim>& model, double period) {
  const Vector<Dim> down = model.gravity / model.gravity.norm();
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
  int count = 0;
  for (const Body<Dim>& body : model.bodies) {
    if (!moves(body)) continue;
    low = std::min(low, down.dot(body.reference) - body.size);
    high = std::max(high, down.dot(body.reference) + body.size);
    sum += 2 * thickest_part(body);
    ++count;
  }
  if (count == 0) return period;
  const double layers = std::clamp((high - low) * count / sum, 1.0, static_cast<double>(count));
  return period * std::max(1.0, (2 * layers + 1) / std::numbers::pi);
}

// the keys that make a stage long or short
struct DurationKeys {
  std::string operator()(const SettlePlan&) const { return "gravity_ramp_s"; }
  std::string operator()(const RunPlan&) const { return "duration_s"; }
  std::string operator()(const ReducePlan& plan) const {
    const bool factor = plan.searched == Searched::factor;
    switch (plan.method) {
      case ReductionMethod::bisection:
        return factor ? "tolerance_factor" : "tolerance_deg";
      case ReductionMethod::steps:
        return factor ? "step_factor" : "step_deg";
      case ReductionMethod::rate:
        return "rate_deg_per_s";
      case ReductionMethod::two_rates:
        return "slower_rate_deg_per_s";
    }
    return "";
  }
};

void judge_steps(const StagePlan& stage, const StageForecast& forecast, Plausibility& result) {
  const std::string key = fmt::format("stage.{}.{}", stage.name, std::visit(DurationKeys{}, stage.plan));
  const char* const units =
      "or the time step (normal_stiffness, density, block sizes, time.fraction, time.step_s): is a unit wrong?";
  if (forecast.steps > many_steps)
    result.warnings.push_back(fmt::format("stage.{} needs {} {:.0e} steps of {:.2g} s: check {}, {}", stage.name,
                                          text_of(forecast.reckoning), forecast.steps, forecast.time_step, key, units));
  if (std::holds_alternative<RunPlan>(stage.plan) && forecast.time_step > 0 && forecast.steps < few_steps)
    result.warnings.push_back(fmt::format("stage.{} takes about {:.1g} steps of {:.2g} s: check {}, {}", stage.name,
                                          forecast.steps, forecast.time_step, key, units));
}

// What the times that a stage states mean beside its own times. `swing`: s, the slowest that the stage knows
void judge_times(const StagePlan& stage, const StageForecast& forecast, double swing, const OutputPlan& output,
                 Plausibility& result) {
  const auto warn = [&](const std::string& key, double value, const std::string& what) {
    result.warnings.push_back(fmt::format("{} = {:.3g} s: {}; is it in s?", key, value, what));
  };
  const std::string where = "stage." + stage.name;
  double ramp = 0;
  if (const auto* plan = std::get_if<RunPlan>(&stage.plan)) ramp = plan->gravity.ramp;
  if (const auto* plan = std::get_if<SettlePlan>(&stage.plan)) {
    ramp = plan->gravity.ramp;
    if (plan->time_limit < forecast.duration)
      warn(where + ".time_limit_s", plan->time_limit,
           fmt::format("rest is expected after about {:.2g} s", forecast.duration));
  }
  if (ramp > 0 && ramp < swing)
    warn(where + ".gravity_ramp_s", ramp,
         fmt::format("shorter than one swing of the blocks on their joints, {:.2g} s, it acts as a blow", swing));
  for (const WaterPlan& water : stage.water)
    if (water.ramp > 0 && water.ramp < swing)
      warn(where + ".water", water.ramp, fmt::format("shorter than one swing, {:.2g} s, it acts as a blow", swing));
  if (output.history_interval > 0 && forecast.duration / output.history_interval > many_rows &&
      forecast.steps > many_rows)
    warn("output.history_interval_s", output.history_interval,
         fmt::format("{} would write about {:.0e} rows", where, forecast.duration / output.history_interval));
  if (output.frames && output.frame_interval > 0 && forecast.duration / output.frame_interval > many_frames)
    warn("output.frame_interval_s", output.frame_interval,
         fmt::format("{} would write about {:.0e} files", where, forecast.duration / output.frame_interval));
}

// Intervals that no stage reaches, where all state how long they take: how long a stage takes to rest, and in which
// time, is its own.
void judge_intervals(const std::vector<StagePlan>& stages, const OutputPlan& output, Plausibility& result) {
  double longest = 0;
  for (const StagePlan& stage : stages) {
    const auto* plan = std::get_if<RunPlan>(&stage.plan);
    if (!plan) return;
    longest = std::max(longest, plan->duration);
  }
  for (const auto& [key, interval] : {std::pair{"output.history_interval_s", output.history_interval},
                                      std::pair{"output.frame_interval_s", output.frame_interval}})
    if (interval > long_interval * longest)
      result.warnings.push_back(
          fmt::format("{} = {:.3g} s: longer than any stage, the longest of which takes {:.2g} s; is it in s?", key,
                      interval, longest));
}

// what else contacts by multipliers need for a force that has a potential
template <int Dim>
void judge_multipliers(const ContactSettings& contact, const Model<Dim>& model, Plausibility& result) {
  if (contact.smoothing != ContactSettings{}.smoothing && contact.point != ContactPoint::central_path)
    result.warnings.push_back("contact.smoothing acts only with contact.point = \"central_path\"");
  const auto of_half_spaces = [&](const PartId& id) { return !is_particle(model.bodies[id.body].parts[id.part]); };
  if (contact.normal != ContactNormal::multipliers || std::ranges::none_of(model.parts, of_half_spaces)) return;
  const char* const keeps = "contact.normal = \"multipliers\" keeps energy only with";
  if (contact.point != ContactPoint::central_path && contact.point != ContactPoint::chebyshev)
    result.warnings.push_back(fmt::format("{} contact.point = \"central_path\"", keeps));
  const std::vector<bool> used = properties_of_faces(model);
  bool constant = true;
  for (std::size_t p = 0; p < used.size(); ++p)
    constant &= !used[p] || model.properties[p].constant_stiffness;
  if (!constant) result.warnings.push_back(fmt::format("{} joint_properties.constant_stiffness = true", keeps));
}

template <int Dim>
Plausibility assess_prepared(const Prepared<Dim>& prepared) {
  // as the first stage begins
  Model<Dim> model = prepared.model;
  State<Dim> state = prepared.state;
  if (!prepared.stages.empty()) {
    model = apply(std::move(model), prepared.stages.front().change);
    add_bodies(model, state.bodies, state.contacts, state.loads, state.time_step);
    install_linings(model, prepared.stages.front().change.install, state);
  }
  Plausibility result;
  find_neighbours(model, prepared.settings, state.bodies, state.contacts, state.counters);
  find_contacts(model, prepared.settings, state.bodies, state.contacts, state.counters);
  sum_loads(model, prepared.settings, state);  // water and forces determine the step, too
  result.candidates = static_cast<int>(state.contacts.list.size());
  result.touching = static_cast<int>(std::count_if(state.contacts.list.begin(), state.contacts.list.end(),
                                                   [](const Contact<Dim>& contact) { return contact.touching(); }));

  if (std::any_of(prepared.stages.begin(), prepared.stages.end(), [](const StagePlan& s) { return s.change.bond; })) {
    State<Dim> bonded = state;
    make_bonds(model, prepared.settings, bonded.bodies, bonded.contacts, bonded.ledger.bonds, bonded.counters);
    result.bonds = count_bonds(bonded.contacts, bonded.ledger.bonds);
  }

  // numbers
  find_crowd(prepared, model, state, result);
  find_overlaps(model, result);
  forecast_stages(prepared, model, state, result);

  // warnings
  judge_bodies(prepared, model, state, result);
  judge_assembly(prepared, model, state, result.warnings);
  for (const StagePlan& stage : prepared.stages)
    judge_stage(stage, settings_of(stage, prepared.settings), result.overlap, smallest_size(model), result);
  judge_velocities(prepared, model, result);
  judge_overlaps(prepared, result);
  judge_multipliers(prepared.settings.contact, model, result);
  judge_stated_step(prepared.settings.time, result);
  const double g = model.gravity.norm();
  // relaxation, whose inertia is not the blocks', knows no slower swing than a block's
  const double period = g > 0 ? 2 * std::numbers::pi * std::sqrt(result.overlap / g) : 0;
  const double swing = g > 0 ? slowest_swing(model, period) : 0;
  judge_intervals(prepared.stages, prepared.output, result);
  for (std::size_t k = 0; k < prepared.stages.size(); ++k) {
    const StagePlan& stage = prepared.stages[k];
    const bool relaxed = relaxes(stage, stage.damping.value_or(prepared.settings.damping));
    judge_steps(stage, result.stages[k], result);
    judge_limits(stage, settings_of(stage, prepared.settings), result.stages[k], result.warnings);
    judge_times(stage, result.stages[k], relaxed ? period : swing, prepared.output, result);
  }
  return result;
}

}  // namespace

const char* text_of(EstimateKind kind) {
  return kind == EstimateKind::about ? "about" : kind == EstimateKind::at_least ? "at least" : "at most";
}

bool asks_for_newton(const DampingSettings& damping, const std::vector<StagePlan>& stages) {
  return damping.statics == Statics::newton || std::any_of(stages.begin(), stages.end(), [](const StagePlan& s) {
           return s.damping && s.damping->statics == Statics::newton;
         });
}

Plausibility assess(const LoadedScene& scene) {
  Plausibility result = std::visit([](const auto& prepared) { return assess_prepared(prepared); }, scene.prepared);
  result.warnings.insert(result.warnings.begin(), scene.warnings.begin(), scene.warnings.end());
  return result;
}

}  // namespace voussoir
