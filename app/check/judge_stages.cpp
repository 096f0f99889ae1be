#include "app/check/judge_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "app/check/blocks.hpp"
#include "core/scene/judge_values.hpp"
#include "core/step/relaxation.hpp"

namespace voussoir {
namespace {

// thresholds of warnings, from experience; values beyond them are unusual, not invalid
constexpr double many_steps = 1e6;  // hours
constexpr double few_steps = 10;
constexpr double many_frames = 1e4;    // files
constexpr double long_interval = 2;    // of output, over the longest stage
constexpr double many_rows = 1e6;      // of history.csv: a hundred megabytes
constexpr double dashpot_error = 0.4;  // of a restitution, over the fraction of the step (cases/bounce)
constexpr double large_dashpot_error = 0.041;
constexpr double settlement_margin = 10;      // failure displacement over elastic settlement
constexpr double small_step_fraction = 1e-3;  // of the stable time step, when stated

// of a stage that seeks equilibrium
std::optional<long long> step_limit_of(const StagePlan& stage) {
  if (const auto* plan = std::get_if<SettlePlan>(&stage.plan)) return plan->step_limit;
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan)) return plan->step_limit;
  return {};
}

void judge_limits(const StagePlan& stage, const Settings& settings, const StageForecast& forecast,
                  std::vector<std::string>& warnings) {
  const std::optional<long long> limit = step_limit_of(stage);
  if (!limit) return;
  const auto most = static_cast<double>(*limit);
  const std::string where = "stage." + stage.name;
  if (settings.equilibrium.window > *limit)
    warnings.push_back(
        fmt::format("{}.step_limit = {}: equilibrium.window asks for {} successive steps in equilibrium, more than "
                    "the limit allows; raise step_limit or lower the window",
                    where, *limit, settings.equilibrium.window));
  const auto* reduce = std::get_if<ReducePlan>(&stage.plan);
  const bool trials = reduce && reduce->method != ReductionMethod::rate;
  if (trials && reduce->ramp_steps >= *limit)
    warnings.push_back(
        fmt::format("{}.step_limit = {}: a trial lowers the strength over ramp_steps = {} steps and ends before; raise "
                    "step_limit or "
                    "lower ramp_steps",
                    where, *limit, reduce->ramp_steps));
  const double ramp = ramp_of(stage);
  // Newton's method applies ramps in increments, whatever their duration
  const double steps =
      forecast.time_step > 0 && settings.statics.method != Statics::newton ? ramp / forecast.time_step : 0;
  if (steps > most)
    warnings.push_back(
        fmt::format("{}.step_limit = {}: its longest ramp, {:g} s, takes about {:.2g} steps of {:.2g} s and is not "
                    "reached; shorten "
                    "the ramp (gravity_ramp_s, duration_s of water and excavation_forces), or raise step_limit",
                    where, *limit, ramp, steps, forecast.time_step));
}

// A column of n blocks oscillates (2 n + 1)/π times as slowly as one of them, and an assembly like a column of its
// height.
template <int Dim>
double slowest_swing(const Model<Dim>& model, double period) {
  const Vector<Dim> down = model.gravity / model.gravity.norm();
  double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0;
  int count = 0;
  for (const Body<Dim>& body : model.bodies) {
    if (!moves(body)) continue;
    low = std::min(low, down.dot(body.reference) - body.size);
    high = std::max(high, down.dot(body.reference) + body.size);
    sum += 2 * inscribed_radius(body);
    ++count;
  }
  if (count == 0) return period;
  const double layers = std::clamp((high - low) * count / sum, 1.0, static_cast<double>(count));
  return period * std::max(1.0, (2 * layers + 1) / std::numbers::pi);
}

// the keys that determine the duration of a stage
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

void judge_steps(const StagePlan& stage, const StageForecast& forecast, std::vector<std::string>& warnings) {
  const std::string key = fmt::format("stage.{}.{}", stage.name, std::visit(DurationKeys{}, stage.plan));
  const char* const units =
      "or the time step (normal_stiffness, density, block sizes, time.fraction, time.step_s): is a unit wrong?";
  if (forecast.steps > many_steps)
    warnings.push_back(fmt::format("stage.{} needs {} {:.0e} steps of {:.2g} s: check {}, {}", stage.name,
                                   text_of(forecast.kind), forecast.steps, forecast.time_step, key, units));
  if (std::holds_alternative<RunPlan>(stage.plan) && forecast.time_step > 0 && forecast.steps < few_steps)
    warnings.push_back(fmt::format("stage.{} takes about {:.1g} steps of {:.2g} s: check {}, {}", stage.name,
                                   forecast.steps, forecast.time_step, key, units));
}

// The times that a stage states against its own periods. `swing`: s, the longest period of the stage
void judge_times(const StagePlan& stage, const StageForecast& forecast, double swing, const OutputPlan& output,
                 std::vector<std::string>& warnings) {
  const auto warn = [&](const std::string& key, double value, const std::string& what) {
    warnings.push_back(fmt::format("{} = {:.3g} s: {}; is it in s?", key, value, what));
  };
  const std::string where = "stage." + stage.name;
  double ramp = 0;
  if (const auto* plan = std::get_if<RunPlan>(&stage.plan)) ramp = plan->gravity.ramp;
  if (const auto* plan = std::get_if<SettlePlan>(&stage.plan)) {
    ramp = plan->gravity.ramp;
    if (plan->time_limit < forecast.duration)
      warn(where + ".time_limit_s", plan->time_limit,
           fmt::format("equilibrium is expected after about {:.2g} s", forecast.duration));
  }
  if (ramp > 0 && ramp < swing)
    warn(where + ".gravity_ramp_s", ramp,
         fmt::format("shorter than a period of the blocks on their joints, {:.2g} s, it acts as an impact", swing));
  for (const WaterPlan& water : stage.water)
    if (water.ramp > 0 && water.ramp < swing)
      warn(where + ".water", water.ramp,
           fmt::format("shorter than a period of the blocks, {:.2g} s, it acts as an impact", swing));
  if (output.history_interval > 0 && forecast.duration / output.history_interval > many_rows &&
      forecast.steps > many_rows)
    warn("output.history_interval_s", output.history_interval,
         fmt::format("{} would write about {:.0e} rows", where, forecast.duration / output.history_interval));
  if (output.frames && output.frame_interval > 0 && forecast.duration / output.frame_interval > many_frames)
    warn("output.frame_interval_s", output.frame_interval,
         fmt::format("{} would write about {:.0e} files", where, forecast.duration / output.frame_interval));
}

// of the stages that implicit steps carry out
bool moves_implicitly(const StagePlan& stage, const Settings& settings) {
  return std::holds_alternative<RunPlan>(stage.plan) && settings.time.integration == Integration::implicit_steps;
}

// hundreds of blocks that touch without pressing each other, and some of which are loose, take steps of microseconds
constexpr std::ptrdiff_t many_loose_blocks = 100;

template <int Dim>
void judge_first_stage(const Prepared<Dim>& prepared, const Model<Dim>& model, std::vector<std::string>& warnings) {
  const StagePlan& first = prepared.stages.front();
  if (!moves_implicitly(first, settings_of(first, prepared.settings))) return;
  const auto free = std::ranges::count_if(model.bodies, [](const Body<Dim>& b) { return b.present && !b.fixed; });
  if (free >= many_loose_blocks)
    warnings.push_back(
        fmt::format("stage.{}: implicit steps begin with {} blocks that do not press on each other yet, "
                    "and may have to be very short: let a stage of kind settle come first",
                    first.name, free));
}

}  // namespace

void judge_stage(const StagePlan& stage, const Settings& settings, double overlap, double smallest,
                 std::vector<std::string>& warnings) {
  const DampingSettings& damping = settings.damping;
  const TimeSettings& time = settings.time;
  const std::string where = "stage." + stage.name;
  const bool undamped = damping.local == 0 && damping.viscous_ratio == 0;
  const bool explicit_steps = !moves_implicitly(stage, settings);
  const double fraction = undamped ? TimeSettings::most_undamped : TimeSettings::most_damped;
  if (explicit_steps && !time.step && time.fraction > fraction)
    warnings.push_back(fmt::format("{}: time.fraction = {} is above {}{}: contacts that open and close gain energy",
                                   where, time.fraction, fraction, undamped ? ", the most without damping" : ""));
  const bool seeks_rest = !std::holds_alternative<RunPlan>(stage.plan);
  if (!seeks_rest && explicit_steps && !time.step && damping.viscous_ratio > 0 &&
      dashpot_error * time.fraction > large_dashpot_error)
    warnings.push_back(
        fmt::format("{}: dashpots (damping.viscous_ratio = {}) at time.fraction = {} change the restitution of impacts "
                    "by about {:.2g} %, "
                    "in proportion to the fraction; 0.02 leaves 1 %",
                    where, damping.viscous_ratio, time.fraction, 100 * dashpot_error * time.fraction));
  if (seeks_rest && undamped && !begins_relaxing(stage, settings.statics))
    warnings.push_back(where + " seeks equilibrium without damping: state damping.local = 0.7");
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan);
      plan && smallest > 0 && plan->failure_displacement > smallest)
    warnings.push_back(
        fmt::format("{}.failure_displacement = {:.2g} m exceeds the smallest inscribed radius of a free block, {:.2g} "
                    "m; is it in m?",
                    where, plan->failure_displacement, smallest));
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan);
      plan && plan->failure_displacement > 0 && plan->failure_displacement < settlement_margin * overlap)
    warnings.push_back(fmt::format(
        "{}.failure_displacement = {:.2g} m is less than {} times the elastic settlement of about {:.2g} m: "
        "settlement may count as failure",
        where, plan->failure_displacement, settlement_margin, overlap));
}

void judge_stated_step(const TimeSettings& time, double limit, std::vector<std::string>& warnings) {
  if (!time.step || !std::isfinite(limit) || time.integration == Integration::implicit_steps) return;
  if (*time.step > limit)
    warnings.push_back(fmt::format(
        "time.step_s = {:.3g} s exceeds the stability limit of {:.2g} s: the blocks will fly apart; lower it, or leave "
        "it out",
        *time.step, limit));
  if (*time.step < small_step_fraction * limit)
    warnings.push_back(fmt::format("time.step_s = {:.3g} s is far below the stability limit of {:.2g} s; is it in s?",
                                   *time.step, limit));
}

void judge_intervals(const std::vector<StagePlan>& stages, const OutputPlan& output,
                     std::vector<std::string>& warnings) {
  double longest = 0;
  for (const StagePlan& stage : stages) {
    const auto* plan = std::get_if<RunPlan>(&stage.plan);
    if (!plan) return;
    longest = std::max(longest, plan->duration);
  }
  for (const auto& [key, interval] : {std::pair{"output.history_interval_s", output.history_interval},
                                      std::pair{"output.frame_interval_s", output.frame_interval}})
    if (interval > long_interval * longest)
      warnings.push_back(
          fmt::format("{} = {:.3g} s: longer than any stage, the longest of which takes {:.2g} s; is it in s?", key,
                      interval, longest));
}

template <int Dim>
void judge_durations(const Prepared<Dim>& prepared, const Model<Dim>& model, const Forecast& forecast,
                     std::vector<std::string>& warnings) {
  const double g = model.gravity.norm();
  // relaxation, whose inertia is not the blocks', has no longer period than that of one block
  const double period = g > 0 ? 2 * std::numbers::pi * std::sqrt(forecast.overlap / g) : 0;
  const double swing = g > 0 ? slowest_swing(model, period) : 0;
  if (!prepared.stages.empty()) judge_first_stage(prepared, model, warnings);
  for (std::size_t k = 0; k < prepared.stages.size(); ++k) {
    const StagePlan& stage = prepared.stages[k];
    const bool relaxed = relaxes(stage, stage.statics.value_or(prepared.settings.statics));
    judge_steps(stage, forecast.stages[k], warnings);
    judge_limits(stage, settings_of(stage, prepared.settings), forecast.stages[k], warnings);
    judge_times(stage, forecast.stages[k], relaxed ? period : swing, prepared.output, warnings);
  }
}

template void judge_durations<2>(const Prepared<2>&, const Model<2>&, const Forecast&, std::vector<std::string>&);
template void judge_durations<3>(const Prepared<3>&, const Model<3>&, const Forecast&, std::vector<std::string>&);

}  // namespace voussoir
