// The least point of a weighted sum of potentials: Newton's method on a convex function whose second derivative jumps.
#pragma once

#include <array>
#include <vector>

#include "core/potential/shape.hpp"

namespace voussoir {

// h(x) = Σ weight f(x) - pull·x, over one potential or two
template <int Dim>
struct WeightedPotentials {
  std::array<const PlacedPotential<Dim>*, 2> potentials{};  // the second may be null
  std::array<double, 2> weights{};                          // not negative
  Vector<Dim> pull = Vector<Dim>::Zero();
};

// a plane along a ray: the distance of the ray's start outside it, and its growth along the ray
struct RayPlane {
  double slack, rate;
  double weight;  // of its square in h
};
using RayScratch = std::vector<RayPlane>;

// Newton's direction -H⁻¹ g. `spheres` is the curvature that the spheres give H in every direction, 2 Σ weight k / R².
// If it is the only curvature of a direction, but less than H's rounding, it replaces H's own there; if there is none
// at all (k = 0), a floor does: the step in such a direction is then negligible, or as long as the search along the
// line makes it.
template <int Dim>
Vector<Dim> newton_solution(const Matrix<Dim>& hessian, double spheres, const Vector<Dim>& right);
// the same for two right sides, columns
template <int Dim>
FixedMatrix<Dim, 2> newton_solutions(const Matrix<Dim>& hessian, double spheres, const FixedMatrix<Dim, 2>& right);

// A step down from the point, given the sum's derivatives there: along Newton's direction, with length 1 if that
// reduces the slope of h well, otherwise to the zero of the slope. Along a line the slope is increasing and piecewise
// linear, so that its zero is found. A plane through the point itself, which the step would only just not pass, is
// counted in the given Hessian, so that the step runs along it. Zero: rounding leaves no step.
template <int Dim>
Vector<Dim> descent_step(const WeightedPotentials<Dim>& sum, const Vector<Dim>& point, const Vector<Dim>& gradient,
                         Matrix<Dim>& hessian, double spheres, RayScratch& scratch);

template <int Dim>
struct LeastPoint {
  bool converged = false;
  Vector<Dim> point = Vector<Dim>::Zero();
  int iterations = 0;
};

// The least point of h from a start, until rounding ends the descent.
template <int Dim>
LeastPoint<Dim> find_least_point(const WeightedPotentials<Dim>& sum, const Vector<Dim>& start, RayScratch& scratch);

}  // namespace voussoir
