#include "core/scene/beside_particles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/potential/particle.hpp"
#include "core/scene/support_table.hpp"

namespace voussoir {
namespace {

// their contacts are points, with the properties of faces that no joint made
template <int Dim>
void check_properties(const Scene& scene, const Model<Dim>& model) {
  if (scene.properties.empty()) return;
  const PropertiesSpec& spec = scene.properties[model.default_properties];
  if (!spec.properties.constant_stiffness)
    refuse(spec.subject, "constant_stiffness",
           "applies to contacts of potential particles, which are points without area; write constant_stiffness = true "
           "and "
           "stiffnesses in N/m, or add joint_properties named default with these values");
  if (spec.properties.sub_contacts > 1)
    refuse(spec.subject, "sub_contacts",
           "applies to contacts of potential particles, which touch at one point; write 1, or add joint_properties "
           "named default with it");
}

template <int Dim>
void check_stages(const Scene& scene, const Model<Dim>& model) {
  for (const StageSpec& stage : scene.stages)
    for (const SelectorSpec& spec : stage.chosen_by("boundary"))
      for (const int b : select<Dim>(model, spec.selector))
        if (std::ranges::any_of(model.bodies[b].parts, is_particle<Dim>))
          refuse(
              *spec.subject.node, spec.subject.path,
              fmt::format("{} block '{}', a potential particle, which has no faces; choose only blocks of "
                          "half-spaces, or apply a "
                          "force to it ([[stage.force]])",
                          spec.subject.node->find("stress") || spec.subject.node->find("in_situ") ? "stresses"
                                                                                                  : "opens the side of",
                          model.bodies[b].name));
}

}  // namespace

template <int Dim>
void check_beside_particles(const Scene& scene, const Model<Dim>& model) {
  if (!model.particles) return;
  check_properties(scene, model);
  const auto refuse_all = [](const auto& list, const char* table) {
    if (!list.empty())
      refuse(list.front().subject, "name",
             fmt::format("{} cannot act on potential particles: remove [[{}]], or shape = \"potential\" of the blocks",
                         table, table));
  };
  refuse_all(scene.waters, "water");
  for (const SceneSupport& row : scene_supports)
    if (row.table) refuse_all(row.stated(scene), row.table);
  if (scene.settings.contact.tolerance > 0)
    refuse(*child({scene.tree.get(), ""}, "contact"), "tolerance",
           "is a tolerance of half-spaces, which potential particles do not have; leave it out");
  check_stages(scene, model);
}

template void check_beside_particles<2>(const Scene&, const Model<2>&);
template void check_beside_particles<3>(const Scene&, const Model<3>&);

}  // namespace voussoir
