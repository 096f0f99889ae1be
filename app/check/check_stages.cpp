#include "app/check/check_stages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/base/shown_unit.hpp"
#include "app/check/check_line.hpp"
#include "core/scene/stage_excavations.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

struct PlanText {
  std::string operator()(const SettlePlan& plan) const { return "settle until equilibrium" + gravity(plan.gravity); }
  std::string operator()(const RunPlan& plan) const {
    return fmt::format("run for {:g} s", plan.duration) + gravity(plan.gravity);
  }
  std::string operator()(const ReducePlan& plan) const {
    std::string of = "all joint properties";
    if (!plan.properties.empty()) of = fmt::format("{}", fmt::join(plan.properties, ", "));
    std::string failure = "after ";
    failure += plan.failure_displacement > 0 ? fmt::format("{:g} m", plan.failure_displacement)
                                             : std::string("a tenth of the smallest inscribed radius");
    if (plan.criterion == FailureCriterion::required_strength && plan.failure_displacement == 0)
      failure = "by the strength that its motion requires, or " + failure;
    if (plan.failure_fraction > 0) failure += fmt::format(", by {:g} of the free mass", plan.failure_fraction);
    if (plan.searched == Searched::factor)
      return fmt::format("divide tan φ and cohesion of {} by {:g} to {:g} {}; failed {}", of, plan.factor.from,
                         plan.factor.to, how(plan.method, plan.factor), failure);
    return fmt::format("reduce the friction of {} from {:g} to {:g} deg {}; failed {}", of, to_degrees(plan.from),
                       to_degrees(plan.to), how(plan), failure);
  }
  static std::string how(ReductionMethod method, const FactorPlan& plan) {
    if (method == ReductionMethod::steps) return fmt::format("in steps of {:g}", plan.step);
    return fmt::format("by bisection to {:g}", plan.tolerance);
  }
  static std::string gravity(const GravityPlan& plan) {
    if (plan.ramp > 0 && !plan.to && plan.from == 0) return fmt::format(", gravity applied within {:g} s", plan.ramp);
    if (plan.ramp > 0)
      return fmt::format(", gravity changed from {:g} to {:g} times its value within {:g} s", plan.from,
                         plan.to.value_or(1), plan.ramp);
    return plan.to ? fmt::format(", under {:g} times gravity", *plan.to) : "";
  }
  static std::string how(const ReducePlan& plan) {
    switch (plan.method) {
      case ReductionMethod::bisection:
        return fmt::format("by bisection to {:g} deg", to_degrees(plan.tolerance));
      case ReductionMethod::steps:
        return fmt::format("in steps of {:g} deg", to_degrees(plan.step));
      case ReductionMethod::rate:
        return fmt::format("at {:g} deg/s", to_degrees(plan.rate));
      case ReductionMethod::two_rates:
        return fmt::format("at {:g} and {:g} deg/s, extrapolated", to_degrees(plan.rate), to_degrees(plan.slower_rate));
    }
    return "";
  }
};

// in the unit in which values of the SI unit `si` are printed
std::string numbers_text(const std::vector<double>& numbers, const std::string& si = "1") {
  const ShownUnit shown = shown_unit(si);
  std::vector<std::string> texts;
  for (const double number : numbers)
    texts.push_back(fmt::format("{:g}", number / shown.size + 0.0));
  return fmt::format("({}){}", fmt::join(texts, ", "), after_value(shown));
}

std::string factor_text(const TimeFactor& factor) {
  std::string text;
  if (factor.frequency > 0)
    text += fmt::format(", times a sine of {:g} Hz from {:g} deg on", factor.frequency, to_degrees(factor.phase));
  if (!factor.times.empty())
    text += fmt::format(", times {} at {} s", numbers_text(factor.factors), numbers_text(factor.times));
  return text;
}

std::string move_text(const MovePlan& move) {
  std::string text;
  if (!move.records.empty())
    return fmt::format("as {} record{} move{} the ground", move.records.size(), move.records.size() == 1 ? "" : "s",
                       move.records.size() == 1 ? "s" : "");
  if (!move.velocity.empty()) {
    std::string axes;
    for (std::size_t k = 0; k < move.velocity.size(); ++k)
      if (move.translation[k]) axes += "xyz"[k];
    text = fmt::format("at {} m/s along {}", numbers_text(move.velocity), axes);
  }
  if (!move.angular_velocity.empty())
    text += fmt::format("{}turning at {} rad/s", text.empty() ? "" : ", ", numbers_text(move.angular_velocity));
  return text + factor_text(move.factor);
}

std::string open_side_text(const BoundaryPlan& plan) {
  const std::string side = fmt::format("{}", fmt::join(plan.bodies.sides, ", "));
  if (plan.free_field) return fmt::format("; free field beyond {}", side);
  std::string text = fmt::format("; waves leave through {}", side);
  const char* const share = plan.quiet->upgoing == 1 ? "" : ", half of which enters";
  if (!plan.quiet->records.empty())
    text += fmt::format(", {} record{} enter{}{}", plan.quiet->records.size(),
                        plan.quiet->records.size() == 1 ? "" : "s", plan.quiet->records.size() == 1 ? "s" : "", share);
  else if (!plan.quiet->velocity.empty())
    text +=
        fmt::format(", {} m/s enter{}", numbers_text(plan.quiet->velocity), share) + factor_text(plan.quiet->factor);
  return text;
}

// changes of the model before the stage, and motions and loads prescribed during it
std::string change_text(const Change& change) {
  std::string text;
  for (const MovePlan& move : change.move)
    text += "; moves blocks " + move_text(move);
  for (const BoundaryPlan& plan : change.boundary) {
    if (plan.lets_waves_leave()) {
      text += open_side_text(plan);
      continue;
    }
    text += fmt::format("; stress {} = {} on outer faces of blocks",
                        plan.stress.size() == 3 ? "(xx, yy, xy)" : "(xx, yy, zz, yz, zx, xy)",
                        numbers_text(plan.stress, "Pa"));
    if (const auto& in_situ = plan.in_situ)
      text += fmt::format(" plus the stress of {} below {:g} m, horizontally {:g}{} times as much",
                          quantity_text(in_situ->unit_weight.value(), "N/m³"), in_situ->surface, in_situ->k0,
                          in_situ->k0_y ? fmt::format(", along y {:g}", *in_situ->k0_y) : "");
  }
  for (const ForcePlan& plan : change.force) {
    text += fmt::format("; force '{}' = {} on blocks", plan.name,
                        numbers_text(plan.force, plan.force.size() == 2 ? "N/m" : "N"));
    if (!plan.point.empty()) text += fmt::format(" at {} m", numbers_text(plan.point));
    if (plan.turns_with_body) text += ", turning with them";
    text += factor_text(plan.factor);
  }
  if (change.bond) text += "; bonds closed joints that have tension or cohesion";
  if (!change.fix.empty()) text += "; fixes blocks";
  if (!change.release.empty()) text += "; releases blocks";
  if (!change.remove.empty()) text += "; removes blocks";
  if (!change.excavate.empty()) text += fmt::format("; excavates '{}'", fmt::join(change.excavate, "', '"));
  if (!change.install.empty()) text += fmt::format("; installs '{}'", fmt::join(change.install, "', '"));
  if (change.friction) text += fmt::format("; friction {:g} deg", to_degrees(*change.friction));
  if (change.friction_as_stated) text += "; friction of all joints as their joint_properties state it";
  for (const FrictionPlan& plan : change.friction_of)
    text += plan.as_stated ? fmt::format("; friction of {} as its joint_properties state it", plan.properties)
                           : fmt::format("; friction of {} {:g} deg", plan.properties, to_degrees(plan.friction));
  if (change.zero_slip) text += "; plastic slip set to zero";
  return text;
}

}  // namespace

std::string statics_text(const StaticsSettings& statics) {
  switch (statics.method) {
    case Statics::local:
      return "true motion under local damping";
    case Statics::newton:
      return fmt::format("Newton's method in {} increment{}, confirmed by relaxation", statics.increments,
                         statics.increments == 1 ? "" : "s");
    case Statics::adaptive:
      break;
  }
  return "relaxation";
}

std::string damping_text(const DampingSettings& damping) {
  std::string text;
  if (damping.local > 0) text = fmt::format("local {:g}", damping.local);
  if (damping.viscous_ratio > 0) text += fmt::format("{}viscous {:g}", text.empty() ? "" : ", ", damping.viscous_ratio);
  return text.empty() ? "none" : text;
}

void print_stages(const std::vector<StagePlan>& stages, const std::vector<Water>& waters) {
  ActingForces acting;
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const StagePlan& stage = stages[k];
    std::string text = fmt::format("{} {}: {}", k + 1, stage.name, std::visit(PlanText{}, stage.plan));
    text += change_text(stage.change);
    for (const WaterPlan& water : stage.water)
      text += fmt::format("; water '{}' changes within {:g} s", waters[water.water].name, water.ramp);
    if (const auto& forces = stage.excavation_forces)
      text += fmt::format("; excavation forces fall to {} within {:g} s", remaining_text(forces->remaining),
                          forces->duration);
    if (stage.statics && !std::holds_alternative<RunPlan>(stage.plan))
      text += "; statics: " + statics_text(*stage.statics);
    if (stage.damping) text += "; damping " + damping_text(*stage.damping);
    print_line(k == 0 ? "stages" : "", text);
    acting.follow(stage);
  }
  if (acting.remaining > 0)
    print_line("", fmt::format("excavation_forces: {} after the last stage, since stage {}",
                               remaining_text(acting.remaining), acting.stage));
}

}  // namespace voussoir
