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
constexpr double least_overlap = 1e-7, most_overlap = 1e-3;     // of the block's size
constexpr double most_radians = 1.6;                            // an angle below π/2 may be in radians
constexpr double many_steps = 1e8;

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

// a body that rests with its largest face on the softest joint
template <int Dim>
double own_overlap(const Model<Dim>& model, const Body<Dim>& body) {
  double area = 0;
  for (const Polytope<Dim>& part : body.parts)
    for (std::size_t f = 0; f < part.faces.size(); ++f)
      area = std::max(area, face_area<Dim>(part, static_cast<int>(f)));
  double overlap = 0;
  for (const JointProperties& p : model.properties) {
    const double stiffness = p.constant_stiffness ? p.normal_stiffness : p.normal_stiffness * area;
    overlap = std::max(overlap, body.mass * model.gravity.norm() / stiffness);
  }
  return overlap / body.size;
}

template <int Dim>
void measure(const Model<Dim>& model, ScenePlausibility& result) {
  result.bodies = static_cast<int>(model.bodies.size());
  for (const Body<Dim>& body : model.bodies) {
    result.smallest_size = result.smallest_size == 0 ? body.size : std::min(result.smallest_size, body.size);
    result.largest_size = std::max(result.largest_size, body.radius);
    if (body.fixed) continue;
    ++result.free_bodies;
    result.overlap = std::max(result.overlap, own_overlap<Dim>(model, body));
  }
}

void judge_measures(const Scene& scene, const ScenePlausibility& result, Warnings& warnings) {
  const std::string file = scene.file + ": ";
  if (2 * result.smallest_size < least_block)
    warnings.push_back(
        file + "the thinnest block measures " + text(2 * result.smallest_size) +
        " m; coordinates are in m, were they given in km, or is it a sliver (slicing.smallest_inscribed_radius)?");
  if (2 * result.largest_size > most_block)
    warnings.push_back(file + "the largest block measures " + text(2 * result.largest_size) +
                       " m; coordinates are in m, were they given in mm?");
  if (result.overlap > most_overlap)
    warnings.push_back(file + "under its own weight a block sinks in by " + text(result.overlap) +
                       " of its size (expected 1e-7 to 1e-3); raise normal_stiffness");
  if (result.overlap > 0 && result.overlap < least_overlap)
    warnings.push_back(file + "under its own weight a block sinks in by only " + text(result.overlap) +
                       " of its size (expected 1e-7 to 1e-3); a lower normal_stiffness allows longer time steps");
  if (result.overlap > scene.settings.contact.potential_radius)
    warnings.push_back(file + "contact.potential_radius = " + text(scene.settings.contact.potential_radius) +
                       " is less than the expected overlap " + text(result.overlap) + "; raise it or the stiffness");
  if (result.time_step == 0)
    warnings.push_back(file + "no contact determines the time step; write [time] step_s, or the first contact will");
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

StageEstimate estimate(const StagePlan& stage, double time_step) {
  StageEstimate result{stage.name, "settle", {}, 0};
  if (const auto* run = std::get_if<RunPlan>(&stage.plan)) {
    result.kind = "run";
    if (time_step > 0) result.steps = std::ceil(run->duration / time_step);
  }
  if (const auto* reduce = std::get_if<ReducePlan>(&stage.plan)) {
    result.kind = "reduce";
    const double range = reduce->from - reduce->to;
    switch (reduce->method) {
      // two trials check the ends of the bracket
      case ReductionMethod::bisection:
        result.trials = 2 + static_cast<int>(std::max(0.0, std::ceil(std::log2(range / reduce->tolerance))));
        break;
      case ReductionMethod::steps:
        result.trials = 1 + static_cast<int>(std::min(1e9, std::ceil(range / reduce->step)));
        break;
      case ReductionMethod::rate:
        if (time_step > 0) result.steps = std::ceil(range / reduce->rate / time_step);
    }
  }
  return result;
}

void judge_stage(const Scene& scene, const StageSpec& spec, const StageEstimate& estimate, Warnings& warnings) {
  const DampingSettings& damping = spec.plan.damping ? *spec.plan.damping : scene.settings.damping;
  const bool damped = damping.local > 0 || damping.viscous_ratio > 0;
  if (!damped && !estimate.steps && estimate.kind != "run")
    warnings.push_back(complaint(*spec.subject.node, spec.subject.path,
                                 "waits for rest, but nothing is damped; write for example damping = { local = 0.7 }"));
  if (estimate.steps && *estimate.steps > many_steps)
    warnings.push_back(complaint(*spec.subject.node, spec.subject.path,
                                 "takes about " + text(*estimate.steps) + " steps; shorten it or check the stiffness"));
  for (const char* key : {"friction_deg", "from_deg"})
    judge_angle(spec.subject, key, warnings);
}

}  // namespace

template <int Dim>
ScenePlausibility judge_plausibility(const Scene& scene, const Prepared<Dim>& prepared, double time_step) {
  ScenePlausibility result;
  result.time_step = time_step;
  measure<Dim>(prepared.model, result);

  // what the file states, in its order
  judge_gravity(scene, result.warnings);
  judge_density({scene.tree.get(), ""}, result.warnings);
  judge_joints<Dim>(scene, prepared.model, result.warnings);
  for (const PropertiesSpec& p : scene.properties)
    judge_properties(p, result.warnings);
  for (const BlockSpec& block : scene.blocks)
    judge_density(block.subject, result.warnings);

  // what follows from it
  judge_measures(scene, result, result.warnings);
  for (const StageSpec& stage : scene.stages) {
    result.stages.push_back(estimate(stage.plan, time_step));
    judge_stage(scene, stage, result.stages.back(), result.warnings);
  }
  return result;
}

template ScenePlausibility judge_plausibility<2>(const Scene&, const Prepared<2>&, double);
template ScenePlausibility judge_plausibility<3>(const Scene&, const Prepared<3>&, double);

}  // namespace voussoir
