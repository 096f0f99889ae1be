#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/export/formats.hpp"
#include "core/base/version.hpp"

namespace voussoir {
namespace {

void refuse_unspeakable(const Scene& scene, std::string_view program) {
  const auto first = [&](const auto& specs, const char* what) {
    if (!specs.empty())
      refuse(*specs.front().subject.node, specs.front().subject.path,
             fmt::format(
                 "{} cannot be expressed in the text for {}, and without them the model differs; remove them from a "
                 "copy of the scene",
                 what, program));
  };
  first(scene.waters, "waters");
  first(scene.bolts, "bolts");
  for (const BlockSpec& block : scene.blocks)
    if (block.shape == BlockShape::potential)
      refuse(block.subject, "shape",
             fmt::format("potential particles cannot be expressed in the text for {}; write shape = \"half_spaces\"",
                         program));
}

void refuse_laws(const Scene& scene, const ExportedScene& found, std::string_view program) {
  for (const int p : found.properties) {
    const PropertiesSpec& spec = scene.properties[p];
    JointLaws laws = spec.properties.laws;
    laws.bond = false;
    // 3DEC's joints dilate at a constant angle up to an offset, as ours of this law
    const bool dilates_there = program == "3DEC" && laws.dilation == DilationLaw::constant;
    const char* const key = laws.normal != StiffnessLaw::constant         ? "normal_law"
                            : laws.shear != StiffnessLaw::constant        ? "shear_law"
                            : laws.friction != FrictionLaw::constant      ? "friction_law"
                            : spec.properties.dilates() && !dilates_there ? "dilation_law"
                            : spec.properties.constant_stiffness          ? "constant_stiffness"
                                                                          : nullptr;
    if (spec.properties.states_barton_bandis())
      refuse(spec.subject, "friction_law",
             fmt::format(
                 "{} has no Barton-Bandis model; give the joint friction_law = \"constant\" with the friction angle "
                 "at the stress of your blocks, which 'voussoir check' prints",
                 program));
    if (key)
      refuse(spec.subject, key,
             fmt::format("cannot be expressed in the text for {}, which has constant stiffness per area and constant "
                         "friction{}; give the joint these",
                         program, program == "3DEC" ? ", and dilation_law = \"constant\" alone" : " without dilation"));
  }
}

// joints that blocks have faces of, and how many faces each has
std::map<int, int> faces_of_joints(const Model<3>& model) {
  std::map<int, int> faces;
  for (const Body<3>& body : model.bodies)
    for (const Polytope<3>& part : body.parts)
      for (const int joint : part.joints)
        if (joint != no_joint && !model.joints[joint].holds) ++faces[joint];
  return faces;
}

std::string names_of(const std::vector<StageSpec>& stages) {
  std::vector<std::string> names;
  for (const StageSpec& stage : stages)
    names.push_back(stage.plan.name);
  return listed(names);
}

std::vector<std::string> left_out(const Scene& scene) {
  std::vector<std::string> lines;
  const auto add = [&](bool stated, const std::string& line) {
    if (stated) lines.push_back(line);
  };
  add(true, fmt::format("the stages ({}): run, loads, excavation, searches", names_of(scene.stages)));
  std::vector<std::string> dug;
  for (const StageSpec& stage : scene.stages)
    dug.insert(dug.end(), stage.plan.change.excavate.begin(), stage.plan.change.excavate.end());
  add(!dug.empty(), fmt::format("the excavation of {}: the rock is still there", listed(dug)));
  const bool moves = std::ranges::any_of(
      scene.blocks, [](const BlockSpec& b) { return b.motion.velocity || b.motion.angular_velocity; });
  add(moves || !scene.initial_velocity.empty(), "initial velocities");
  add(!scene.monitors.empty(), fmt::format("{} monitors", scene.monitors.size()));
  add(true, "damping, time step, contact detection, criterion of equilibrium");
  return lines;
}

}  // namespace

ExportedScene exported(const Scene& scene, const Prepared<3>& prepared, std::string_view program) {
  refuse_unspeakable(scene, program);
  ExportedScene found;
  found.model = &prepared.model;
  found.title = scene.title.empty() ? scene.file : scene.title;
  std::map<int, int> faces_of_properties;
  for (const auto& [joint, faces] : faces_of_joints(prepared.model)) {
    found.joints.push_back(joint);
    faces_of_properties[prepared.model.joints[joint].properties] += faces;
  }
  // faces that no joint made touch if blocks are stated one by one
  const bool others = !prepared.model.properties.empty() && (!scene.blocks.empty() || faces_of_properties.empty());
  if (others) faces_of_properties.try_emplace(prepared.model.default_properties, 0);
  for (const auto& [properties, faces] : faces_of_properties)
    found.properties.push_back(properties);
  std::ranges::stable_sort(found.properties,
                           [&](int a, int b) { return faces_of_properties[a] > faces_of_properties[b]; });
  refuse_laws(scene, found, program);
  found.left_out = left_out(scene);
  return found;
}

std::string export_head(const ExportedScene& scene, std::string_view program, std::string_view comment,
                        std::string_view run) {
  std::vector<std::string> lines{
      fmt::format("{}", scene.title),
      fmt::format("Text for {}, written by voussoir {} ({}).", program, version(), commit()),
      std::string(run),
      "Units: m, kg, s, N, Pa, angles in degrees where they are named so; x east, y north, z up.",
      fmt::format("{} blocks as they are before the first stage, {} joints between them.", scene.model->bodies.size(),
                  scene.joints.size()),
      "Features of the scene that were left out:"};
  for (const std::string& line : scene.left_out)
    lines.push_back("- " + line);
  std::string text;
  for (const std::string& line : lines)
    text += fmt::format("{} {}\n", comment, line);
  return text;
}

}  // namespace voussoir
