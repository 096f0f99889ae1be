#include "core/run/twin_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "core/step/static_solver.hpp"

namespace voussoir {

template <int Dim>
std::string not_differentiable(const Prepared<Dim>& scene) {
  if (!newton_applies(scene.model)) return "joints that soften, dilate or mobilise are left to relaxation";
  for (const StagePlan& stage : scene.stages) {
    const Settings settings = settings_of(stage, scene.settings);
    if (std::holds_alternative<RunPlan>(stage.plan))
      return fmt::format("stage {} is a motion in time, not an equilibrium", stage.name);
    if (settings.statics.method != Statics::newton)
      return fmt::format("stage {} does not use Newton's method (statics = \"newton\")", stage.name);
    if (!stage.change.excavate.empty()) return fmt::format("stage {} excavates", stage.name);
    const auto* search = std::get_if<ReducePlan>(&stage.plan);
    if (search && search->method != ReductionMethod::bisection)
      return fmt::format("stage {} does not search by bisection", stage.name);
    if (search && &stage != &scene.stages.back())
      return fmt::format("stages follow the search of stage {}", stage.name);
  }
  return {};
}

template <int Dim>
std::string not_twins(const Model<Dim>& model, const Model<Dim>& other) {
  if (model.bodies.size() != other.bodies.size())
    return fmt::format("{} blocks instead of {}", other.bodies.size(), model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>&one = model.bodies[b], &two = other.bodies[b];
    const bool same =
        one.name == two.name && one.fixed == two.fixed && one.free_translation == two.free_translation &&
        one.free_rotation == two.free_rotation &&
        std::ranges::equal(one.parts, two.parts, [](const Polytope<Dim>& p, const Polytope<Dim>& q) {
          return p.joints == q.joints && p.vertices.size() == q.vertices.size() &&
                 std::ranges::equal(p.loops, q.loops, {}, &std::vector<int>::size, &std::vector<int>::size);
        });
    const double apart = (one.reference - two.reference).norm();
    if (!same || apart > 0.01 * one.radius) return fmt::format("block {} has other faces or another place", b);
  }
  if (model.properties.size() != other.properties.size() || model.bolts.size() != other.bolts.size() ||
      model.joints.size() != other.joints.size())
    return "other joints or bolts";
  return {};
}

#define VOUSSOIR_INSTANTIATE(Dim)                                     \
  template std::string not_differentiable<Dim>(const Prepared<Dim>&); \
  template std::string not_twins<Dim>(const Model<Dim>&, const Model<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
