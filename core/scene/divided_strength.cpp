#include "core/scene/divided_strength.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "text/angle.hpp"

namespace voussoir {
namespace {

// a friction angle and the stage that last stated it; empty: none
struct FrictionInForce {
  double angle;  // rad
  std::string stage;
};

bool states_friction(const Change& change, const std::string& properties) {
  return change.friction || std::ranges::any_of(change.friction_of, [&](const FrictionPlan& plan) {
           return plan.properties == properties;
         });
}

void follow(const StagePlan& stage, const std::vector<PropertiesSpec>& properties,
            std::vector<FrictionInForce>& in_force) {
  for (std::size_t p = 0; p < properties.size(); ++p) {
    if (stage.change.friction) in_force[p] = {*stage.change.friction, stage.name};
    for (const FrictionPlan& plan : stage.change.friction_of)
      if (plan.properties == properties[p].properties.name) in_force[p] = {plan.friction, stage.name};
  }
}

std::string item(const std::string& properties, double angle) {
  return fmt::format("{{ name = \"{}\", friction_deg = {:.10g} }}", properties, to_degrees(angle));
}

// entries that the stage already states stay in the line
std::string line_to_add(const Change& change, std::vector<std::string> missing) {
  std::vector<std::string> items;
  for (const FrictionPlan& plan : change.friction_of)
    items.push_back(item(plan.properties, plan.friction));
  items.insert(items.end(), missing.begin(), missing.end());
  return fmt::format("friction = [{}]", fmt::join(items, ", "));
}

void check_search(const StageSpec& stage, const ReducePlan& search, const std::vector<PropertiesSpec>& properties,
                  const std::vector<FrictionInForce>& in_force) {
  std::vector<std::string> told, missing;
  for (std::size_t p = 0; p < properties.size(); ++p) {
    const JointProperties& joint = properties[p].properties;
    const bool named =
        search.properties.empty() || std::ranges::find(search.properties, joint.name) != search.properties.end();
    if (!named || states_friction(stage.plan.change, joint.name) || in_force[p].angle == joint.friction) continue;
    told.push_back(fmt::format("'{}' has {:.10g} deg since stage '{}', and its joint_properties state {:.10g} deg",
                               joint.name, to_degrees(in_force[p].angle), in_force[p].stage,
                               to_degrees(joint.friction)));
    missing.push_back(item(joint.name, joint.friction));
  }
  if (missing.empty()) return;
  refuse(
      stage.subject, "friction",
      fmt::format(
          "{}; a factor of safety divides the friction that its own stage states: write {}, or the angle to be reduced",
          fmt::join(told, "; "), line_to_add(stage.plan.change, missing)));
}

}  // namespace

void check_divided_strength(const std::vector<PropertiesSpec>& properties, const std::vector<StageSpec>& stages) {
  std::vector<FrictionInForce> in_force;
  for (const PropertiesSpec& p : properties)
    in_force.push_back({p.properties.friction, ""});
  for (const StageSpec& stage : stages) {
    const auto* search = std::get_if<ReducePlan>(&stage.plan.plan);
    if (search && search->searched == Searched::factor) check_search(stage, *search, properties, in_force);
    follow(stage.plan, properties, in_force);
  }
}

}  // namespace voussoir
