#include "app/check/plausible_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace voussoir {
namespace {

// show nothing of a motion
constexpr double small_step_fraction = 1e-3;  // of the stable time step, when stated

// of a stage that seeks rest
std::optional<long long> step_limit_of(const StagePlan& stage) {
  if (const auto* plan = std::get_if<SettlePlan>(&stage.plan)) return plan->step_limit;
  if (const auto* plan = std::get_if<ReducePlan>(&stage.plan)) return plan->step_limit;
  return {};
}

}  // namespace

double ramp_of(const StagePlan& stage) {
  double ramp = 0;
  if (const auto* plan = std::get_if<SettlePlan>(&stage.plan)) ramp = plan->gravity.ramp;
  if (const auto* plan = std::get_if<RunPlan>(&stage.plan)) ramp = plan->gravity.ramp;
  for (const WaterPlan& water : stage.water)
    ramp = std::max(ramp, water.ramp);
  if (stage.let_off) ramp = std::max(ramp, stage.let_off->duration);
  return ramp;
}

void judge_limits(const StagePlan& stage, const Settings& settings, const StageForecast& forecast,
                  std::vector<std::string>& warnings) {
  const std::optional<long long> limit = step_limit_of(stage);
  if (!limit) return;
  const auto most = static_cast<double>(*limit);
  const std::string where = "stage." + stage.name;
  if (settings.equilibrium.window > *limit)
    warnings.push_back(
        fmt::format("{}.step_limit = {}: equilibrium.window asks for {} steps at rest in a row, which no "
                    "run of so few steps has; raise step_limit or lower the window",
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
  // Newton's method puts ramps on in increments, whatever their time
  const double steps =
      forecast.time_step > 0 && settings.damping.statics != Statics::newton ? ramp / forecast.time_step : 0;
  if (steps > most)
    warnings.push_back(
        fmt::format("{}.step_limit = {}: its longest ramp, {:g} s, takes about {:.2g} steps of {:.2g} s and is not "
                    "reached; shorten "
                    "the ramp (gravity_ramp_s, duration_s of water and let_off), or raise step_limit",
                    where, *limit, ramp, steps, forecast.time_step));
}

void judge_stated_step(const TimeSettings& time, Plausibility& result) {
  if (!time.step || !std::isfinite(result.step_limit)) return;
  if (*time.step > result.step_limit)
    result.warnings.push_back(fmt::format(
        "time.step_s = {:.3g} s exceeds the stability limit of {:.2g} s: the blocks will fly apart; lower it, or leave "
        "it out",
        *time.step, result.step_limit));
  if (*time.step < small_step_fraction * result.step_limit)
    result.warnings.push_back(
        fmt::format("time.step_s = {:.3g} s is tiny beside the stability limit of {:.2g} s; is it in s?", *time.step,
                    result.step_limit));
}

}  // namespace voussoir
