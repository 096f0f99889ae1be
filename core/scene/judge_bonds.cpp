#include "core/scene/judge_bonds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

constexpr double longest_cohesion_slip = 0.3;  // m

// joints, sets counted twice, with cohesion that the first slip takes
int brittle_joints(const Scene& scene, bool made) {
  const auto is_brittle = [&](const std::optional<std::string>& name) {
    if (scene.properties.empty()) return false;
    const auto named = [&](const PropertiesSpec& p) { return p.properties.name == name.value_or("default"); };
    const auto found = std::ranges::find_if(scene.properties, named);
    const JointProperties& p = (found == scene.properties.end() ? scene.properties.begin() : found)->properties;
    return p.cohesion > 0 && p.cohesion_law == CohesionLaw::brittle && (made || p.bonds == BondsMade::as_sliced);
  };
  int joints = 0;
  for (const JointSpec& joint : scene.joints)
    joints += is_brittle(joint.properties);
  for (const JointSetSpec& set : scene.joint_sets)
    joints += 2 * is_brittle(set.properties);
  return joints;
}

// A block on one brittle joint has the factor of its peak strength; on several, that of the joint that breaks first.
void judge_brittle_searches(const Scene& scene, bool made, std::vector<std::string>& warnings) {
  if (brittle_joints(scene, made) < 2) return;
  for (const StageSpec& stage : scene.stages) {
    const auto* search = std::get_if<ReducePlan>(&stage.plan.plan);
    if (search && search->searched == Searched::factor)
      warnings.push_back(complaint(
          stage.subject, "search",
          "seeks a factor of safety over brittle bonds of several joints: the joint that breaks first depends on "
          "shear_stiffness / normal_stiffness (Hoek and Bray's wedge: 1.11 to 1.62, limit equilibrium 1.74), and the "
          "least value is that of friction alone; vary shear_stiffness, or state cohesion_law = \"plastic\" or "
          "\"softening\""));
  }
}

// weight that comes on in true motion overshoots, and a joint that parts loses its strength permanently
void judge_first_load(const Scene& scene, std::vector<std::string>& warnings) {
  const auto acts = [](const PropertiesSpec& p) { return p.properties.bonds_as_sliced(); };
  if (scene.stages.empty() || std::ranges::none_of(scene.properties, acts)) return;
  const auto* timed = std::get_if<RunPlan>(&scene.stages.front().plan.plan);
  if (timed && timed->gravity.to.value_or(1) != 0)
    warnings.push_back(complaint(scene.stages.front().subject, "kind",
                                 "brings the weight on in true motion, which may part joints for a moment, and with it "
                                 "their tension and cohesion are lost; let a stage of kind \"settle\" come first"));
}

}  // namespace

std::vector<std::string> judge_bonds(const Scene& scene) {
  std::vector<std::string> warnings;
  const bool made = std::any_of(scene.stages.begin(), scene.stages.end(),
                                [](const StageSpec& stage) { return stage.plan.change.bond; });
  bool strong = false;
  for (const PropertiesSpec& spec : scene.properties) {
    const JointProperties& p = spec.properties;
    strong |= p.laws.bond;
    if (p.tension * std::tan(p.friction) > p.cohesion)
      warnings.push_back(complaint(
          spec.subject, "tension",
          "exceeds cohesion / tan(friction_deg) = " + fmt::format("{:.3g}", p.cohesion / std::tan(p.friction)) +
              " Pa, beyond which a joint in tension has no shear strength: it breaks there"));
    if (p.softens_cohesion() && p.cohesion_slip > longest_cohesion_slip)
      warnings.push_back(
          complaint(spec.subject, "cohesion_slip_m",
                    fmt::format("is {:g} m, beyond the slip of any shear test: the cohesion is as good as "
                                "plastic; if it is meant in mm, write cohesion_slip_m = {:g}",
                                p.cohesion_slip, p.cohesion_slip / 1000)));
    const bool of_lining = std::ranges::count(scene.linings, p.name, &LiningSpec::interface_properties) > 0;
    if (made || scene.stages.empty() || !p.laws.bond || of_lining || p.bonds == BondsMade::as_sliced) continue;
    warnings.push_back(complaint(spec.subject, p.cohesion > 0 ? "cohesion" : "tension",
                                 "has an effect only if joints are bonded, and no stage bonds any: write bonds = "
                                 "\"as_sliced\" here, or bond = true in "
                                 "the stage from which it should act"));
  }
  judge_brittle_searches(scene, made, warnings);
  judge_first_load(scene, warnings);
  for (const StageSpec& stage : scene.stages)
    if (stage.plan.change.bond && !strong)
      warnings.push_back(
          complaint(stage.subject, "bond", "bonds nothing: no joint_properties state tension or cohesion"));
  return warnings;
}

}  // namespace voussoir
