#include "core/run/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/accuracy.hpp"

namespace voussoir {
namespace {

// the unexplained energy, as a fraction of the largest energy, from which a run is doubted
constexpr double energy_left_open = 0.05;

// the fraction of that energy from which local damping dominates a motion
constexpr double much_damped = 0.1;

// of what friction takes, or of the square of this of the largest energy: what implicit steps may leave unresolved
constexpr double much_unresolved = 0.05;

// the first stage of true motion with a step that is too long for impacts
const StagePlan* long_step(std::span<const StagePlan> stages, const Settings& scene) {
  for (const StagePlan& stage : stages) {
    const Settings in_force = settings_of(stage, scene);
    const double most = in_force.damping.local > 0 ? TimeSettings::most_damped : TimeSettings::most_undamped;
    if (std::holds_alternative<RunPlan>(stage.plan) && !in_force.time.step && in_force.time.fraction > most)
      return &stage;
  }
  return nullptr;
}

// Newton's method knows the work of an increment along its chord only
bool by_newton(const StagePlan& stage, const Settings& scene) {
  return !std::holds_alternative<RunPlan>(stage.plan) && settings_of(stage, scene).statics.method == Statics::newton;
}

std::string open_balance(const EnergyBalance& e, std::span<const StagePlan> stages, const Settings& scene) {
  if (std::abs(e.motion_error) > std::abs(e.contact_error))
    return "the motion, which should close to rounding: is the time step unstable (time.step_s)?";
  std::string causes;
  if (const StagePlan* stage = long_step(stages, scene))
    causes += fmt::format("; steps are long for impacts (time.fraction = {:g} in stage {})",
                          settings_of(*stage, scene).time.fraction, stage->name);
  if (e.flows[Source::local_damping] > much_damped * e.largest_energy)
    causes += fmt::format(
        "; local damping removed {:.2g} of that energy and slows the motion, so that little energy remains to compare "
        "with (damping.local "
        "= 0 gives the true motion)",
        e.flows[Source::local_damping] / e.largest_energy);
  if (std::ranges::any_of(stages, [&](const StagePlan& stage) { return by_newton(stage, scene); }))
    causes +=
        "; Newton's method integrates the work of an increment along its chord (statics = \"adaptive\" gives a balance "
        "that closes)";
  if (causes.empty())
    causes =
        "; areas and normals of contacts change as blocks rock or slide over edges (contact.face, joint_properties "
        "sub_contacts, contact.normal), or an impact lasts few steps (time.fraction, time.step_s)";
  return "the contacts" + causes;
}

}  // namespace

std::string doubts_of(const EnergyBalance& energy, std::span<const StagePlan> stages, const Settings& scene) {
  if (!(energy.relative_error() > energy_left_open)) return {};
  const bool of_contacts = std::abs(energy.contact_error) >= std::abs(energy.motion_error);
  if (of_contacts && std::ranges::all_of(stages, [&](const StagePlan& stage) { return by_newton(stage, scene); }))
    return {};
  return fmt::format(
      "the energy balance does not close: {:.2g} J, {:.2g} of the largest energy of the run, is unexplained, in the "
      "balance of {}",
      energy.worst_error, energy.relative_error(), open_balance(energy, stages, scene));
}

std::string doubts_of_implicit_steps(const EnergyBalance& energy) {
  const double taken = energy.flows[Source::unresolved_springs] + energy.flows[Source::unresolved_motion];
  const double friction = energy.flows[Source::friction];
  if (!(taken > much_unresolved * std::max(friction, much_unresolved * energy.largest_energy))) return {};
  return fmt::format(
      "implicit steps took {:.2g} J out of swings and impacts that they do not resolve, friction {:.2g} J: the answer "
      "depends on the step; lower time.error_m or time.step_s, or take explicit steps",
      taken, friction);
}

std::vector<std::string> doubts_of_level(std::string_view level, const Results& results) {
  std::vector<std::string> doubts;
  if (level.empty()) return doubts;
  for (const auto& [name, value] : results.values)
    if (name.ends_with("critical_friction") && value.value < least_promised_angle)
      doubts.push_back(
          fmt::format("accuracy.level = \"{}\" has its accuracy for critical angles above {:g} deg; {} is {:.3g} "
                      "± {:.2g} deg: "
                      "lower tolerance_deg or step_deg of its stage, or choose a finer level",
                      level, least_promised_angle, name, value.value, value.error_bar.value_or(0)));
  return doubts;
}

}  // namespace voussoir
