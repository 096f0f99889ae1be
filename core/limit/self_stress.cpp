#include "core/limit/self_stress.hpp"

#include <algorithm>

#include "core/limit/shortfall.hpp"

namespace voussoir {
namespace {

constexpr double least_share = 1e-6;  // of the largest self-stress: below it a corner has none
constexpr double still = 1e-6;        // of the fastest body: far above the rounding of multipliers

// Self-stresses can be added and scaled: their largest sum is unbounded if there are any, and the interior point method
// ends inside the set of them all, where every corner that can have one has it.
template <int Dim>
std::vector<std::vector<bool>> corners_with_self_stress(const CornerAssembly<Dim>& assembly) {
  CornerAssembly<Dim> frictional = assembly;
  std::vector<std::vector<bool>> possible;
  for (CornerFace<Dim>& face : frictional.faces) {
    face.cohesion = 0;
    possible.emplace_back(face.corners.size(), false);
  }
  CornerProgram<Dim> program = corner_program(frictional, {});
  for (auto& cone : program.cones)
    cone.cost = -1;
  const ConeProgramAnswer answer = solve(program);
  if (answer.status != ConeStatus::unbounded) return possible;
  double largest = 0;
  for (std::size_t k = 0; k < program.cones.size(); ++k)
    largest = std::max(largest, answer.x[Dim * k]);
  Eigen::Index at = 0;
  for (std::vector<bool>& of_face : possible)
    for (std::size_t k = 0; k < of_face.size(); ++k, at += Dim)
      of_face[k] = answer.x[at] > least_share * largest;
  return possible;
}

}  // namespace

template <int Dim>
std::vector<bool> faces_with_self_stress(const CornerAssembly<Dim>& assembly) {
  std::vector<bool> faces;
  for (const std::vector<bool>& corners : corners_with_self_stress(assembly))
    faces.push_back(std::ranges::find(corners, true) != corners.end());
  return faces;
}

template <int Dim>
bool may_rest_on_self_stress(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                             const std::vector<BodyVelocity<Dim>>& velocities) {
  const std::vector<std::vector<bool>> possible = corners_with_self_stress(assembly);
  const CornerProgram<Dim> all = corner_program(assembly, loads);
  CornerProgram<Dim> without = all;
  without.cones.clear();
  bool moves = false;
  auto cone = all.cones.begin();
  for (std::size_t f = 0; f < assembly.faces.size(); ++f) {
    const CornerFace<Dim>& face = assembly.faces[f];
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      if (!possible[f][k])
        without.cones.push_back(*cone);
      else if (velocities.empty() || opening_at(assembly, face, face.corners[k], velocities).norm() > still)
        moves = true;
      ++cone;
      if (face.cohesion > 0) without.cones.push_back(*cone++);
    }
  }
  return moves && !shortfall(assembly, without).stands();
}

template std::vector<bool> faces_with_self_stress(const CornerAssembly<2>&);
template std::vector<bool> faces_with_self_stress(const CornerAssembly<3>&);
template bool may_rest_on_self_stress(const CornerAssembly<2>&, const Loads<2>&, const std::vector<BodyVelocity<2>>&);
template bool may_rest_on_self_stress(const CornerAssembly<3>&, const Loads<3>&, const std::vector<BodyVelocity<3>>&);

}  // namespace voussoir
