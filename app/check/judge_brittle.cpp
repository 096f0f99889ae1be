#include "app/check/judge_brittle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "core/key_blocks/block_survey.hpp"
#include "core/run/brittle_factor.hpp"
#include "core/run/failure_watch.hpp"

namespace voussoir {
namespace {

struct LeastBrittle {
  double factor = 0, plastic = 0, friction_only = 0;
  std::vector<int> bodies;
};

template <int Dim>
bool any_brittle(const Model<Dim>& model) {
  return std::ranges::any_of(model.properties, [](const JointProperties& joint) {
    return joint.cohesion > 0 && joint.cohesion_law == CohesionLaw::brittle;
  });
}

// of blocks and clusters that slide on joints with brittle bonds alone
template <int Dim>
std::optional<LeastBrittle> least_brittle(const Assembly<Dim>& assembly, const ReducePlan& search) {
  std::optional<LeastBrittle> least;
  const std::vector<int> divided = chosen_properties(assembly.model, search);
  Block<Dim> block;
  const auto look_at = [&](const std::vector<int>& bodies, const BoltedVerdict<Dim>& bolted) {
    gather<Dim>(assembly, bodies, {}, block);
    const std::optional<double> factor = brittle_factor(assembly, block, bolted, divided);
    if (!factor || (least && *factor >= least->factor)) return;
    least = LeastBrittle{*factor, *bolted.factor, *bolted.verdict.factor_friction_only(), bodies};
  };
  const std::vector<BoltedVerdict<Dim>> single = judge_all<Dim>(assembly, {});
  for (int b = 0; b < static_cast<int>(single.size()); ++b)
    if (moves(single[b].verdict.kind)) look_at({b}, single[b]);
  for (const Cluster<Dim>& cluster : find_clusters<Dim>(assembly, single, {}).lower)
    look_at(cluster.bodies, cluster.verdict);
  return least;
}

}  // namespace

template <int Dim>
void judge_brittle_bonds(const Prepared<Dim>& prepared, std::vector<std::string>& warnings) {
  if (!any_brittle(prepared.model)) return;
  for (std::size_t s = 0; s < prepared.stages.size(); ++s) {
    const auto* search = std::get_if<ReducePlan>(&prepared.stages[s].plan);
    if (!search || search->searched != Searched::factor) continue;
    const std::optional<Assembly<Dim>> assembly = assembly_of_stage(prepared, static_cast<int>(s));
    const std::optional<LeastBrittle> least = assembly ? least_brittle(*assembly, *search) : std::nullopt;
    if (!least) continue;
    warnings.push_back(fmt::format(
        "stage.{}: of blocks that slide on brittle bonds {} {} {} the least factor by the closed form at this "
        "shear_stiffness / normal_stiffness, {:.4g} ({:.4g} if plastic, {:.4g} by friction only); a joint that carries "
        "what another loses gives more",
        prepared.stages[s].name, least->bodies.size() == 1 ? "block" : "blocks", fmt::join(least->bodies, ", "),
        least->bodies.size() == 1 ? "has" : "have", least->factor, least->plastic, least->friction_only));
  }
}

template void judge_brittle_bonds<2>(const Prepared<2>&, std::vector<std::string>&);
template void judge_brittle_bonds<3>(const Prepared<3>&, std::vector<std::string>&);

}  // namespace voussoir
