// The contact of two potential particles if only their planes count: the start of a search that has no other.
#pragma once

#include <vector>

#include "core/potential/shape.hpp"

namespace voussoir {

template <int Dim>
struct FirstPoint {
  bool found = false;
  Vector<Dim> point = Vector<Dim>::Zero();
  double ratio = 1;   // λ / (1 - λ)
  double level = 0;   // sqrt(f + 1) there by the tight planes; not positive if the bodies within the planes overlap
  int exchanges = 0;  // of the linear program
};

// The feasibility program in units of each body's radius u = r / sqrt(1 - k): the least t with a_i·x - d_i <= u_i t. At
// its optimum Dim + 1 planes are tight, and their multipliers μ give more: Σ μ a = 0, so that Σ μ_i s_i = t holds for
// the slacks of these planes at any x. Q_A and Q_B are then least, and equal, where the slacks of each body are in
// proportion to its multipliers,
//   s_i = σ u_A μ_i / |μ_A|,   σ = t / (u_A |μ_A| + u_B |μ_B|) = sqrt(Q),   λ / (1 - λ) = u_A |μ_A| / (u_B |μ_B|):
// at k = 0 this is the contact itself if no other plane has a slack there. If t is not positive the point is the
// program's, inside both sets of planes. Not found: one of the bodies has no planes, or does not bound the optimum; or
// there are more than 16 000 planes. By dual simplex, whose scan of the planes fills the machine's vector registers;
// the same bits at any width. `scratch` holds the planes side by side.
template <int Dim>
FirstPoint<Dim> find_first_point(const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b,
                                 std::vector<double>& scratch);

}  // namespace voussoir
