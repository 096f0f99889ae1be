#include "core/run/brittle_factor.hpp"

#include <algorithm>
#include <limits>

#include "core/key_blocks/elastic_shear.hpp"

namespace voussoir {

template <int Dim>
std::optional<double> brittle_factor(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                     const BoltedVerdict<Dim>& bolted, const std::vector<int>& divided) {
  const Verdict<Dim>& verdict = bolted.verdict;
  const std::optional<Vector<Dim>> displacement = elastic_displacement(assembly, block, bolted);
  if (!displacement || !block.bolts.empty() || !closed_by_elastic_shear(assembly, block, bolted).empty()) return {};
  double first_slip = std::numeric_limits<double>::infinity(), cohesion = 0;
  for (int k = 0; k < verdict.loaded; ++k) {
    const RockFace<Dim>& face = block.faces[verdict.faces[k]];
    const JointProperties& joint = assembly.model.properties[face.properties];
    if (face.cohesion > 0 && joint.cohesion_law != CohesionLaw::brittle) return {};
    if (std::ranges::count(divided, face.properties) == 0) return {};
    const double closing = -face.normal.dot(*displacement);
    const double pressed = std::max(0.0, joint.normal_stiffness * face.area * closing);
    const double shear = joint.shear_stiffness * face.area * (*displacement + closing * face.normal).norm();
    first_slip = std::min(first_slip, (face.cohesion + face.friction_force(pressed)) / shear);
    cohesion += face.cohesion;
  }
  // cohesion of a face without normal force is left to a run
  constexpr double rounding = 1e-12;
  if (!(cohesion > 0) || verdict.cohesion > (1 + rounding) * cohesion) return {};
  return std::max(first_slip, *verdict.factor_friction_only());
}

template std::optional<double> brittle_factor<2>(const Assembly<2>&, const Block<2>&, const BoltedVerdict<2>&,
                                                 const std::vector<int>&);
template std::optional<double> brittle_factor<3>(const Assembly<3>&, const Block<3>&, const BoltedVerdict<3>&,
                                                 const std::vector<int>&);

}  // namespace voussoir
