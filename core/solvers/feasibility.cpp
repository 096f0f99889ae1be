#include "core/solvers/feasibility.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/solvers/extended_precision_feasibility.hpp"
#include "core/solvers/far_planes.hpp"

namespace voussoir {
namespace {

// a plane enters against multipliers only by more than rounding
constexpr double multiplier_rounding = 1e-11;

// a plane violated by no more than this fraction of the coordinates counts as satisfied: on rounding alone, degenerate
// bases would pivot endlessly
constexpr double violation_rounding = 16 * std::numeric_limits<double>::epsilon();

// each gains as many digits as the inverse has
constexpr int refinement_steps = 3;

// a multiplier below this is negative: its basis bounds nothing
constexpr double negative_multiplier = -8 * std::numeric_limits<double>::epsilon();

// the error that a value may have, as a fraction of the planes' extent; if it may have more it is computed again in
// extended precision
constexpr double value_rounding = 16 * std::numeric_limits<double>::epsilon();

// Tight planes of the dual simplex. With C = columns (a_i, 1) of the basis, C λ = (0, …, 0, 1) and (x, -s) C = d.
template <int Dim>
struct Basis {
  static constexpr int size = Dim + 1;
  std::array<int, size> planes{};
  FixedMatrix<size, size> inverse;
  FixedMatrix<size, 1> offsets;

  auto multipliers() const { return inverse.col(Dim); }
};

template <int Dim>
bool factorise(Basis<Dim>& basis, const HalfSpaces<Dim>& planes, double far) {
  FixedMatrix<Dim + 1, Dim + 1> columns;
  for (int k = 0; k <= Dim; ++k) {
    const HalfSpace<Dim> p = basis_plane(planes, basis.planes[k], far);
    columns.template block<Dim, 1>(0, k) = p.normal;
    columns(Dim, k) = 1;
    basis.offsets[k] = p.offset;
  }
  const double determinant = columns.determinant();
  if (!(std::abs(determinant) > 1e-14)) return false;
  basis.inverse = columns.inverse();
  return true;
}

template <int Dim>
Basis<Dim> start_basis(const HalfSpaces<Dim>& planes, const FeasibilityRequest<Dim>& request, double far) {
  Basis<Dim> basis;
  if (request.start) {
    basis.planes = *request.start;
    if (factorise(basis, planes, far) && basis.multipliers().minCoeff() >= -multiplier_rounding) return basis;
  }
  basis.planes = far_basis<Dim>();
  factorise(basis, planes, far);
  return basis;
}

// the tight plane that leaves when the plane (column) enters: the first to lose its multiplier
template <int Dim>
int leaving(const Basis<Dim>& basis, const FixedMatrix<Dim + 1, 1>& mu) {
  int leave = -1;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= Dim; ++k) {
    if (mu[k] <= multiplier_rounding) continue;
    const double ratio = std::max(basis.multipliers()[k], 0.0) / mu[k];
    // of equal ratios the far planes go first, then the largest pivot
    if (ratio < best || (ratio == best && mu[k] > mu[leave])) {
      best = ratio;
      leave = k;
    }
  }
  return leave;
}

template <int Dim>
void pivot(Basis<Dim>& basis, int leave, int enter, double offset, const FixedMatrix<Dim + 1, 1>& mu) {
  basis.inverse.row(leave) /= mu[leave];
  for (int k = 0; k <= Dim; ++k)
    if (k != leave) basis.inverse.row(k) -= mu[k] * basis.inverse.row(leave);
  basis.planes[leave] = enter;
  basis.offsets[leave] = offset;
}

// The point where the tight planes intersect, and -s. Refined: planes that are nearly parallel, as of two faces in
// contact, leave few correct digits in the inverse.
template <int Dim>
FixedMatrix<Dim + 1, 1> intersection_point(const Basis<Dim>& basis, const HalfSpaces<Dim>& planes, double far) {
  FixedMatrix<Dim + 1, 1> solution = basis.inverse.transpose() * basis.offsets, residual;
  for (int step = 0; step < refinement_steps; ++step) {
    for (int k = 0; k <= Dim; ++k)
      residual[k] = basis.offsets[k] -
                    basis_plane(planes, basis.planes[k], far).normal.dot(solution.template head<Dim>()) - solution[Dim];
    solution += basis.inverse.transpose() * residual;
  }
  return solution;
}

template <int Dim>
void record(const Basis<Dim>& basis, FeasibilityResult<Dim>& result) {
  result.basis = basis.planes;
  for (int k = 0; k <= Dim; ++k)
    result.multipliers[k] = basis.multipliers()[k];
}

// whether the point lies on its tight planes, up to rounding
template <int Dim>
bool lies_on_planes(const Basis<Dim>& basis, const HalfSpaces<Dim>& planes, double far,
                    const FixedMatrix<Dim + 1, 1>& solution, double coordinates) {
  for (int k = 0; k <= Dim; ++k) {
    const double residual = basis_plane(planes, basis.planes[k], far).normal.dot(solution.template head<Dim>()) +
                            solution[Dim] - basis.offsets[k];
    if (!(std::abs(residual) <= violation_rounding * (std::abs(basis.offsets[k]) + coordinates))) return false;
  }
  return true;
}

template <int Dim>
FeasibilityResult<Dim> search(const HalfSpaces<Dim>& planes, const FeasibilityRequest<Dim>& request) {
  const int count = static_cast<int>(planes.size());
  const double reach = reach_of<Dim>(planes), far = far_in_reaches * reach;
  const int limit = 10 * (count + Dim + 1) + 50;
  const int bland_after = limit / 2;

  Basis<Dim> basis = start_basis(planes, request, far);
  FeasibilityResult<Dim> result;
  bool polished = false;  // the inverse was just computed, not updated, and the point refined
  for (; result.pivots < limit; ++result.pivots) {
    const FixedMatrix<Dim + 1, 1> solution = polished
                                                 ? intersection_point(basis, planes, far)
                                                 : FixedMatrix<Dim + 1, 1>(basis.inverse.transpose() * basis.offsets);
    result.point = solution.template head<Dim>();
    result.value = -solution[Dim];

    // every basis is dual feasible, so its value is a lower bound; tiny pivots can spoil it, hence the certified bound
    if (result.value > request.stop_above) {
      record(basis, result);
      if (certified_lower_bound<Dim>(planes, result, reach) > request.stop_above) {
        result.status = FeasibilityStatus::separated_early;
        break;
      }
    }

    // the most violated plane enters; after many pivots the first violated one, which cannot cycle
    int enter = -1;
    double worst = request.tolerance;
    const double coordinates = std::min(result.point.cwiseAbs().maxCoeff(), reach) + std::abs(result.value);
    for (int i = 0; i < count; ++i) {
      const double rounding = violation_rounding * (std::abs(planes[i].offset) + coordinates);
      const double violation = planes[i].normal.dot(result.point) - planes[i].offset - result.value - rounding;
      if (violation > worst && std::find(basis.planes.begin(), basis.planes.end(), i) == basis.planes.end()) {
        worst = violation;
        enter = i;
        if (result.pivots > bland_after) break;
      }
    }
    if (enter < 0) {
      // updates lose digits: the result is computed from a fresh inverse of the final basis; if there is none, since
      // pivoting has led to nearly dependent planes, there is no result
      if (polished && lies_on_planes(basis, planes, far, solution, coordinates))
        result.status = FeasibilityStatus::optimal;
      if (polished || !factorise(basis, planes, far)) break;
      polished = true;
      continue;
    }

    FixedMatrix<Dim + 1, 1> column;
    column << planes[enter].normal, 1;
    const FixedMatrix<Dim + 1, 1> mu = basis.inverse * column;
    const int leave = leaving<Dim>(basis, mu);
    if (leave < 0) break;  // impossible in exact arithmetic: sum(mu) = 1
    pivot<Dim>(basis, leave, enter, planes[enter].offset, mu);
    polished = false;
  }

  record(basis, result);
  for (int k = 0; k <= Dim; ++k)
    if (basis.planes[k] < 0 && result.multipliers[k] > far_multiplier && result.status == FeasibilityStatus::optimal)
      result.status = FeasibilityStatus::unbounded;
  return result;
}

// Whether the result certifies itself. All planes are satisfied; by weak duality the optimum differs by no more than
// the multipliers' sum of the normals, which should be zero, times the distance of the optimum. In a basis of nearly
// dependent planes some multipliers may truly be negative.
template <int Dim>
bool answered(const HalfSpaces<Dim>& planes, const FeasibilityResult<Dim>& result) {
  if (result.status == FeasibilityStatus::separated_early) return true;  // proven there
  if (result.status == FeasibilityStatus::iteration_limit) return false;
  const double reach = reach_of<Dim>(planes);
  Vector<Dim> left = Vector<Dim>::Zero();
  for (int k = 0; k <= Dim; ++k) {
    if (result.multipliers[k] < negative_multiplier) return false;
    left += result.multipliers[k] * basis_plane(planes, result.basis[k], far_in_reaches * reach).normal;
  }
  if (result.status == FeasibilityStatus::unbounded) return true;
  const double out = beyond_extent * std::min(result.point.cwiseAbs().maxCoeff() / reach, 1.0);
  return left.template lpNorm<1>() * (1 + out) <= value_rounding;
}

}  // namespace

template <int Dim>
double certified_lower_bound(const HalfSpaces<Dim>& planes, const FeasibilityResult<Dim>& result, double reach) {
  Vector<Dim> residual = Vector<Dim>::Zero();
  double sum = 0, offsets = 0;
  for (int k = 0; k <= Dim; ++k) {
    const double lambda = std::max(result.multipliers[k], 0.0);
    const HalfSpace<Dim> p = basis_plane(planes, result.basis[k], 1000 * reach);
    residual += lambda * p.normal;
    offsets += lambda * p.offset;
    sum += lambda;
  }
  return -(offsets + residual.norm() * reach) / sum;
}

template <int Dim>
FeasibilityResult<Dim> solve_feasibility(const HalfSpaces<Dim>& planes, const FeasibilityRequest<Dim>& request) {
  const FeasibilityResult<Dim> result = search(planes, request);
  if (answered(planes, result)) return result;
  FeasibilityResult<Dim> extended = solve_feasibility_in_extended_precision(planes, request);
  extended.pivots += result.pivots;
  return extended;
}

template double certified_lower_bound<2>(const HalfSpaces<2>&, const FeasibilityResult<2>&, double);
template double certified_lower_bound<3>(const HalfSpaces<3>&, const FeasibilityResult<3>&, double);
template FeasibilityResult<1> solve_feasibility<1>(const HalfSpaces<1>&, const FeasibilityRequest<1>&);
template FeasibilityResult<2> solve_feasibility<2>(const HalfSpaces<2>&, const FeasibilityRequest<2>&);
template FeasibilityResult<3> solve_feasibility<3>(const HalfSpaces<3>&, const FeasibilityRequest<3>&);

}  // namespace voussoir
