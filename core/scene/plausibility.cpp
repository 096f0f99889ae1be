#include "core/scene/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/scene/values.hpp"

namespace voussoir {
namespace {

// beyond these a value is legal but more likely a mistake of unit or sign
constexpr double least_density = 500, most_density = 8000;      // kg/m³
constexpr double least_stiffness = 1e5, most_stiffness = 1e13;  // Pa/m
constexpr double least_block = 1e-3, most_block = 1e4;          // m
constexpr double least_gravity = 1, most_gravity = 30;          // m/s²
constexpr double most_radians = 1.6;                            // an angle below π/2 may be in radians

using Warnings = std::vector<std::string>;

std::string text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", number);
  return buffer;
}

void judge_gravity(const Scene& scene, Warnings& warnings) {
  if (!scene.gravity) return;
  const Subject top{scene.tree.get(), ""};
  double square = 0;
  for (const double g : *scene.gravity)
    square += g * g;
  const double magnitude = std::sqrt(square);
  if (scene.gravity->back() > 0)
    warnings.push_back(complaint(top, "gravity", "points upwards; the last entry is normally negative"));
  if (magnitude < least_gravity || magnitude > most_gravity)
    warnings.push_back(complaint(top, "gravity", "is " + text(magnitude) + " m/s² strong; on earth it is 9.81"));
}

void judge_density(const Subject& subject, Warnings& warnings) {
  const Node* density = subject.node->find("density");
  if (density && (density->number < least_density || density->number > most_density))
    warnings.push_back(complaint(subject, "density", "rock has 2000 to 3000 kg/m³; is the unit right?"));
}

void judge_angle(const Subject& subject, const char* key, Warnings& warnings) {
  const Node* angle = subject.node->find(key);
  if (angle && angle->number > 0 && angle->number < most_radians)
    warnings.push_back(complaint(subject, key, "is a very small angle; degrees are meant, was it given in radians?"));
}

void judge_properties(const PropertiesSpec& spec, Warnings& warnings) {
  judge_angle(spec.subject, "friction_deg", warnings);
  const JointProperties& p = spec.properties;
  if (p.shear_stiffness > p.normal_stiffness)
    warnings.push_back(complaint(spec.subject, "shear_stiffness",
                                 "exceeds the normal stiffness; joints are softer in shear, were the two swapped?"));
  if (p.constant_stiffness) return;
  for (const char* key : {"normal_stiffness", "shear_stiffness"}) {
    const double stiffness = spec.subject.node->find(key)->number;
    if (stiffness < least_stiffness)
      warnings.push_back(complaint(spec.subject, key, "is very soft for Pa/m; was it given in MPa/m or GPa/m?"));
    if (stiffness > most_stiffness)
      warnings.push_back(complaint(spec.subject, key, "is very stiff for Pa/m: the time step will be tiny"));
  }
}

template <int Dim>
void judge_sizes(const Scene& scene, const Model<Dim>& model, Warnings& warnings) {
  double thinnest = model.bodies.front().size, largest = 0;
  for (const Body<Dim>& body : model.bodies) {
    thinnest = std::min(thinnest, body.size);
    largest = std::max(largest, body.radius);
  }
  const std::string file = scene.file + ": ";
  if (2 * thinnest < least_block)
    warnings.push_back(
        file + "the thinnest block measures " + text(2 * thinnest) +
        " m; coordinates are in m, were they given in km, or is it a sliver (slicing.smallest_inscribed_radius)?");
  if (2 * largest > most_block)
    warnings.push_back(file + "the largest block measures " + text(2 * largest) +
                       " m; coordinates are in m, were they given in mm?");
}

template <int Dim>
void judge_joints(const Scene& scene, const Model<Dim>& model, Warnings& warnings) {
  if (!scene.domain) return;
  std::vector<bool> cuts(model.joints.size(), false);
  for (const Body<Dim>& body : model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (const int joint : part.joints)
        if (joint != no_joint) cuts[joint] = true;
  for (std::size_t j = 0; j < cuts.size(); ++j)
    if (!cuts[j])
      warnings.push_back(complaint(*scene.joints[j].subject.node, scene.joints[j].subject.path,
                                   "cuts no block: it misses the domain, or its blocks would be smaller than "
                                   "slicing.smallest_inscribed_radius"));
}

}  // namespace

template <int Dim>
std::vector<std::string> implausible_values(const Scene& scene, const Prepared<Dim>& prepared) {
  Warnings warnings;
  judge_gravity(scene, warnings);
  judge_density({scene.tree.get(), ""}, warnings);
  judge_joints<Dim>(scene, prepared.model, warnings);
  for (const PropertiesSpec& p : scene.properties)
    judge_properties(p, warnings);
  for (const BlockSpec& block : scene.blocks)
    judge_density(block.subject, warnings);
  for (const StageSpec& stage : scene.stages)
    for (const char* key : {"friction_deg", "from_deg"})
      judge_angle(stage.subject, key, warnings);
  judge_sizes<Dim>(scene, prepared.model, warnings);
  return warnings;
}

template std::vector<std::string> implausible_values<2>(const Scene&, const Prepared<2>&);
template std::vector<std::string> implausible_values<3>(const Scene&, const Prepared<3>&);

}  // namespace voussoir
