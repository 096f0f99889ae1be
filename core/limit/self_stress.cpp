#include "core/limit/self_stress.hpp"

#include <algorithm>

#include "core/limit/shortfall.hpp"

namespace voussoir {
namespace {

constexpr double least_share = 1e-6;  // of the largest self-stress: below it a corner has none
constexpr double still = 1e-6;        // of the fastest body: far above the rounding of multipliers
// of jammed corners, in weights: small beside a missing force, and what they cost is beside what is missing otherwise
constexpr double cost_of_jams = 1e-7, nearly_nothing = 1e-3;

using OfCorners = std::vector<std::vector<bool>>;  // by face and corner

// nor ties: no force between blocks has a bound, but for friction
template <int Dim>
CornerAssembly<Dim> without_cohesion(CornerAssembly<Dim> assembly) {
  assembly.ties.clear();
  for (CornerFace<Dim>& face : assembly.faces)
    face.cohesion = 0;
  return assembly;
}

// Self-stresses can be added and scaled: their largest sum is unbounded if there are any, and the interior point method
// ends inside the set of them all, where every corner that can have one has it. `program`: without loads; its first
// cones are those of friction.
template <int Dim>
OfCorners corners_with_self_stress(const CornerAssembly<Dim>& assembly, CornerProgram<Dim> program) {
  OfCorners possible;
  std::size_t count = 0;
  for (const CornerFace<Dim>& face : assembly.faces) {
    possible.emplace_back(face.corners.size(), false);
    count += face.corners.size();
  }
  for (std::size_t k = 0; k < count; ++k)
    program.cones[k].cost = -1;
  const ConeProgramAnswer answer = solve(program);
  if (answer.status != ConeStatus::unbounded) return possible;
  double largest = 0;
  for (std::size_t k = 0; k < count; ++k)
    largest = std::max(largest, answer.x[Dim * k]);
  Eigen::Index at = 0;
  for (std::vector<bool>& of_face : possible)
    for (std::size_t k = 0; k < of_face.size(); ++k, at += Dim)
      of_face[k] = answer.x[at] > least_share * largest;
  return possible;
}

template <int Dim>
OfCorners corners_with_self_stress(const CornerAssembly<Dim>& assembly) {
  return corners_with_self_stress(assembly, corner_program(without_cohesion(assembly), {}));
}

}  // namespace

template <int Dim>
std::vector<int> may_rest_on_self_stress(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                         const std::vector<BodyVelocity<Dim>>& velocities) {
  const OfCorners possible = corners_with_self_stress(assembly);
  const CornerProgram<Dim> all = corner_program(assembly, loads);
  CornerProgram<Dim> without = all;
  without.cones.clear();
  std::vector<int> moving;
  auto cone = all.cones.begin();
  for (std::size_t f = 0; f < assembly.faces.size(); ++f) {
    const CornerFace<Dim>& face = assembly.faces[f];
    bool moves = false;
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      if (!possible[f][k])
        without.cones.push_back(*cone);
      else if (velocities.empty() || opening_at(assembly, face, face.corners[k], velocities).norm() > still)
        moves = true;
      ++cone;
      if (face.cohesion > 0) without.cones.push_back(*cone++);
    }
    if (moves) moving.push_back(static_cast<int>(f));
  }
  without.cones.insert(without.cones.end(), cone, all.cones.end());  // of ties
  if (!moving.empty() && shortfall(assembly, without).stands()) moving.clear();
  return moving;
}

template <int Dim>
bool carried_by_any_friction(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                             const std::vector<bool>& gain) {
  const CornerAssembly<Dim> frictional = without_cohesion(assembly);
  OfCorners jammed;
  for (const CornerFace<Dim>& face : assembly.faces)
    jammed.emplace_back(face.corners.size(), false);
  const auto with_jams = [&](const Loads<Dim>& dead) {
    CornerProgram<Dim> program = corner_program(frictional, dead);
    add_free_forces(frictional, jammed, gain, cost_of_jams, program);
    return program;
  };
  for (bool grown = true; grown;) {
    grown = false;
    const OfCorners possible = corners_with_self_stress(frictional, with_jams({}));
    for (std::size_t f = 0; f < jammed.size(); ++f)
      for (std::size_t k = 0; k < jammed[f].size(); ++k)
        if (possible[f][k] && !jammed[f][k]) jammed[f][k] = grown = true;
  }
  const Shortfall found = shortfall(frictional, with_jams(loads));
  return !found.failed() && found.answer.value < nearly_nothing;
}

template std::vector<int> may_rest_on_self_stress(const CornerAssembly<2>&, const Loads<2>&,
                                                  const std::vector<BodyVelocity<2>>&);
template std::vector<int> may_rest_on_self_stress(const CornerAssembly<3>&, const Loads<3>&,
                                                  const std::vector<BodyVelocity<3>>&);
template bool carried_by_any_friction(const CornerAssembly<2>&, const Loads<2>&, const std::vector<bool>&);
template bool carried_by_any_friction(const CornerAssembly<3>&, const Loads<3>&, const std::vector<bool>&);

}  // namespace voussoir
