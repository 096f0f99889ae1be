#include "core/potential/descent.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/eigen_pairs.hpp"
#include "core/geometry/half_space_inl.hpp"
#include "core/potential/rounding.hpp"

namespace voussoir {
namespace {

// The rounding of a Hessian's stiffest direction affects all others; a flat one gets as much curvature.
constexpr double floor_of_curvature = 4 * machine_epsilon;

// below this many such roundings the spheres' curvature cannot be read from the Hessian
constexpr double drowned_curvature = 1000;

// a slope that falls to this fraction of its first value ends a search along a line: the next direction is better
constexpr double good_slope = 0.25;

// each iteration of a descent ends in a better set of planes or at the least point: far more than there are sets
constexpr int descent_limit = 200;
constexpr int line_limit = 200;

// decrement, as a fraction of the function's terms, at which only steps of rounding remain
constexpr double last_decrement = machine_epsilon * machine_epsilon;

struct Slope {
  double value, rate;
};

// h'(t) and h''(t) along the ray; `smooth` is the part of the spheres and the pull
Slope slope_at(const RayScratch& planes, const Slope& smooth, double t) {
  Slope slope{smooth.value + t * smooth.rate, smooth.rate};
  for (const RayPlane& plane : planes) {
    const double slack = plane.slack + t * plane.rate;
    if (slack <= 0) continue;
    slope.value += 2 * plane.weight * slack * plane.rate;
    slope.rate += 2 * plane.weight * plane.rate * plane.rate;
  }
  return slope;
}

// fills the scratch with the planes along the direction, those of the first potential before those of the second
template <int Dim>
double step_along(const WeightedPotentials<Dim>& sum, const Vector<Dim>& point, const Vector<Dim>& direction,
                  RayScratch& scratch) {
  scratch.clear();
  Slope smooth{-sum.pull.dot(direction), 0};
  for (int i = 0; i < 2; ++i) {
    if (!sum.potentials[i]) continue;
    const PlacedPotential<Dim>& potential = *sum.potentials[i];
    for (const HalfSpace<Dim>& plane : potential.planes)
      scratch.push_back(
          {signed_distance<Dim>(plane, point), plane.normal.dot(direction), sum.weights[i] * potential.plane_weight});
    const double weight = 2 * sum.weights[i] * potential.sphere_weight;
    smooth.value += weight * direction.dot(point - potential.centre);
    smooth.rate += weight * direction.squaredNorm();
  }

  const double enough = good_slope * std::abs(slope_at(scratch, smooth, 0).value);
  double low = 0, high = std::numeric_limits<double>::infinity(), t = 1;
  for (int i = 0; i < line_limit; ++i) {
    const Slope slope = slope_at(scratch, smooth, t);
    if (std::abs(slope.value) <= enough) break;
    (slope.value < 0 ? low : high) = t;
    t = slope.rate > 0 ? t - slope.value / slope.rate : 2 * t;
    if (!(t > low && t < high)) t = std::isfinite(high) ? low + (high - low) / 2 : 2 * low;
    if (t <= low || t >= high) break;
  }
  return t;
}

// Planes on which the point lies, to rounding, and on which the step would end: counted in the Hessian. Whether there
// were any.
template <int Dim>
bool hold_planes(const WeightedPotentials<Dim>& sum, const Vector<Dim>& point, double length, const RayScratch& ray,
                 Matrix<Dim>& hessian) {
  bool held = false;
  std::size_t i = 0;
  for (const PlacedPotential<Dim>* potential : sum.potentials) {
    if (!potential) continue;
    for (const HalfSpace<Dim>& plane : potential->planes) {
      const RayPlane& along = ray[i++];
      const double rounding = placed_rounding * (std::abs(plane.offset) + point.norm());
      if (along.slack > 0 || along.slack < -rounding || !(along.rate > 0) || length * along.rate > rounding) continue;
      hessian += 2 * along.weight * plane.normal * plane.normal.transpose();
      held = true;
    }
  }
  return held;
}

// as solve_symmetric, with one division for each of H's pivots; the loops are short, and unrolled stay in registers
template <int Dim, int Columns>
bool solve_by_factors(Matrix<Dim>& h, FixedMatrix<Dim, Columns>& g) {
  double inverse[Dim];
#pragma GCC unroll 3
  for (int k = 0; k < Dim; ++k) {
    if (!(h(k, k) > 0)) return false;
    inverse[k] = 1 / h(k, k);
#pragma GCC unroll 3
    for (int i = k + 1; i < Dim; ++i) {
      const double factor = h(i, k) * inverse[k];
#pragma GCC unroll 3
      for (int j = k + 1; j <= i; ++j)
        h(i, j) -= factor * h(j, k);
#pragma GCC unroll 2
      for (int c = 0; c < Columns; ++c)
        g(i, c) -= factor * g(k, c);
    }
  }
#pragma GCC unroll 3
  for (int k = Dim - 1; k >= 0; --k)
#pragma GCC unroll 2
    for (int c = 0; c < Columns; ++c) {
#pragma GCC unroll 3
      for (int i = k + 1; i < Dim; ++i)
        g(k, c) -= h(i, k) * g(i, c);
      g(k, c) *= inverse[k];
    }
  return true;
}

template <int Dim, int Columns>
FixedMatrix<Dim, Columns> solve(const Matrix<Dim>& hessian, double spheres, const FixedMatrix<Dim, Columns>& right) {
  const double rounding = floor_of_curvature * hessian.trace();
  if (spheres > 0 && spheres < drowned_curvature * rounding) {
    const EigenPairs<Dim> own = eigen_pairs<Dim>(hessian);
    FixedMatrix<Dim, Columns> along = own.vectors.transpose() * right;
    for (int k = 0; k < Dim; ++k)
      along.row(k) /= own.values[k] > drowned_curvature * rounding ? own.values[k] : spheres;
    return -(own.vectors * along);
  }
  Matrix<Dim> h = hessian;
  FixedMatrix<Dim, Columns> solution = -right;
  if (!(spheres > 0))
    for (int k = 0; k < Dim; ++k)
      h(k, k) += rounding;
  // without any curvature (inside all planes, k = 0) the search along the line determines the length
  if (!solve_by_factors<Dim, Columns>(h, solution)) solution = -right;
  return solution;
}

}  // namespace

template <int Dim>
Vector<Dim> newton_solution(const Matrix<Dim>& hessian, double spheres, const Vector<Dim>& right) {
  return solve<Dim, 1>(hessian, spheres, right);
}
template <int Dim>
FixedMatrix<Dim, 2> newton_solutions(const Matrix<Dim>& hessian, double spheres, const FixedMatrix<Dim, 2>& right) {
  return solve<Dim, 2>(hessian, spheres, right);
}

template <int Dim>
Vector<Dim> descent_step(const WeightedPotentials<Dim>& sum, const Vector<Dim>& point, const Vector<Dim>& gradient,
                         Matrix<Dim>& hessian, double spheres, RayScratch& scratch) {
  for (int i = 0; i <= 2 * Dim; ++i) {
    const Vector<Dim> direction = newton_solution<Dim>(hessian, spheres, gradient);
    const double length = step_along<Dim>(sum, point, direction, scratch);
    if (length >= 1 || !hold_planes<Dim>(sum, point, length, scratch, hessian)) return length * direction;
  }
  return Vector<Dim>::Zero();  // planes on all sides
}

template <int Dim>
LeastPoint<Dim> find_least_point(const WeightedPotentials<Dim>& sum, const Vector<Dim>& start, RayScratch& scratch) {
  LeastPoint<Dim> least;
  least.point = start;
  double previous = std::numeric_limits<double>::infinity();
  for (; least.iterations < descent_limit; ++least.iterations) {
    Vector<Dim> gradient = -sum.pull;
    Matrix<Dim> hessian = Matrix<Dim>::Zero();
    double terms = std::abs(sum.pull.dot(least.point)), spheres = 0;
    for (int i = 0; i < 2; ++i) {
      if (!sum.potentials[i]) continue;
      const PotentialDerivatives<Dim> at = derivatives<Dim>(*sum.potentials[i], least.point);
      gradient += sum.weights[i] * at.gradient;
      hessian += sum.weights[i] * at.hessian;
      terms += sum.weights[i] * (at.value + 1);
      spheres += 2 * sum.weights[i] * sum.potentials[i]->sphere_weight;
    }
    const Vector<Dim> direction = newton_solution<Dim>(hessian, spheres, gradient);
    const double decrement = -gradient.dot(direction);
    if (!(decrement > 0)) break;  // the gradient vanishes
    // only rounding remains when the decrement is tiny and no longer falls; a single rise may be due to a plane that
    // was only just passed
    if (decrement <= machine_epsilon * terms && decrement >= previous) break;
    if (std::max(decrement, previous) <= last_decrement * terms) break;
    previous = decrement;
    const Vector<Dim> step = descent_step<Dim>(sum, least.point, gradient, hessian, spheres, scratch);
    if (step.isZero(0)) break;
    least.point += step;
  }
  least.converged = least.iterations < descent_limit;
  return least;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                \
  template Vector<Dim> newton_solution<Dim>(const Matrix<Dim>&, double, const Vector<Dim>&);                     \
  template FixedMatrix<Dim, 2> newton_solutions<Dim>(const Matrix<Dim>&, double, const FixedMatrix<Dim, 2>&);    \
  template Vector<Dim> descent_step<Dim>(const WeightedPotentials<Dim>&, const Vector<Dim>&, const Vector<Dim>&, \
                                         Matrix<Dim>&, double, RayScratch&);                                     \
  template LeastPoint<Dim> find_least_point<Dim>(const WeightedPotentials<Dim>&, const Vector<Dim>&, RayScratch&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
