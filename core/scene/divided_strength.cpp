#include "core/scene/divided_strength.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "text/angle.hpp"

namespace voussoir {
namespace {

// the friction of joint properties that a stage has changed, and the stage that last stated it
struct FrictionInForce {
  bool own = true;   // that of the joint_properties, with its law
  double angle = 0;  // rad, else
  std::string stage{};
};

bool states_friction(const Change& change, const std::string& properties) {
  return change.friction || change.friction_as_stated ||
         std::ranges::any_of(change.friction_of,
                             [&](const FrictionPlan& plan) { return plan.properties == properties; });
}

FrictionInForce friction_by(const FrictionPlan& plan, const JointProperties& joint, const std::string& stage) {
  const bool same = !joint.states_barton_bandis() && plan.friction == joint.friction;
  return {plan.as_stated || same, plan.friction, stage};
}

void follow(const StagePlan& stage, const std::vector<PropertiesSpec>& properties,
            std::vector<FrictionInForce>& in_force) {
  const Change& change = stage.change;
  for (std::size_t p = 0; p < properties.size(); ++p) {
    const JointProperties& joint = properties[p].properties;
    if (change.friction || change.friction_as_stated)
      in_force[p] =
          friction_by({joint.name, change.friction.value_or(0), change.friction_as_stated}, joint, stage.name);
    for (const FrictionPlan& plan : change.friction_of)
      if (plan.properties == joint.name) in_force[p] = friction_by(plan, joint, stage.name);
  }
}

std::string item(const FrictionPlan& plan) {
  return fmt::format(
      "{{ name = \"{}\", {} }}", plan.properties,
      plan.as_stated ? "as_stated = true" : fmt::format("friction_deg = {:.10g}", to_degrees(plan.friction)));
}

bool is_named(const ReducePlan& search, const std::string& properties) {
  return search.properties.empty() || std::ranges::find(search.properties, properties) != search.properties.end();
}

// entries that the stage already states stay in the line
std::string line_to_add(const Change& change, std::vector<std::string> missing) {
  std::vector<std::string> items;
  for (const FrictionPlan& plan : change.friction_of)
    items.push_back(item(plan));
  items.insert(items.end(), missing.begin(), missing.end());
  return fmt::format("friction = [{}]", fmt::join(items, ", "));
}

void check_search(const StageSpec& stage, const ReducePlan& search, const std::vector<PropertiesSpec>& properties,
                  const std::vector<FrictionInForce>& in_force) {
  std::vector<std::string> told, missing;
  for (std::size_t p = 0; p < properties.size(); ++p) {
    const JointProperties& joint = properties[p].properties;
    if (!is_named(search, joint.name) || states_friction(stage.plan.change, joint.name) || in_force[p].own) continue;
    const bool rough = joint.states_barton_bandis();
    told.push_back(
        fmt::format("'{}' has {:.10g} deg since stage '{}', and its joint_properties state {}", joint.name,
                    to_degrees(in_force[p].angle), in_force[p].stage,
                    rough ? "Barton and Bandis' law" : fmt::format("{:.10g} deg", to_degrees(joint.friction))));
    missing.push_back(item({joint.name, joint.friction, rough}));
  }
  if (missing.empty()) return;
  refuse(
      stage.subject, "friction",
      fmt::format(
          "{}; a factor of safety divides the friction that its own stage states: write {}, or the angle to be reduced",
          fmt::join(told, "; "), line_to_add(stage.plan.change, missing)));
}

// the stage's own change is in force
void check_angle(const StageSpec& stage, const ReducePlan& search, const std::vector<PropertiesSpec>& properties,
                 const std::vector<FrictionInForce>& in_force) {
  for (std::size_t p = 0; p < properties.size(); ++p) {
    const JointProperties& joint = properties[p].properties;
    if (joint.states_barton_bandis() && in_force[p].own && is_named(search, joint.name))
      refuse(stage.subject, "search",
             fmt::format("seeks a friction angle, but '{}' follows Barton and Bandis' law, whose angle depends on the "
                         "normal stress; write search = \"factor\", which divides its shear strength, or name other "
                         "joint_properties",
                         joint.name));
  }
}

}  // namespace

void check_divided_strength(const std::vector<PropertiesSpec>& properties, const std::vector<StageSpec>& stages) {
  std::vector<FrictionInForce> in_force(properties.size());
  for (const StageSpec& stage : stages) {
    const auto* search = std::get_if<ReducePlan>(&stage.plan.plan);
    if (search && search->searched == Searched::factor) check_search(stage, *search, properties, in_force);
    follow(stage.plan, properties, in_force);
    if (search && search->searched == Searched::friction) check_angle(stage, *search, properties, in_force);
  }
}

}  // namespace voussoir
