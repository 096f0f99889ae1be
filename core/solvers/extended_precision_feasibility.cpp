#include "core/solvers/extended_precision_feasibility.hpp"

#include <utility>

#include "core/solvers/double_double.hpp"
#include "core/solvers/far_planes.hpp"

namespace voussoir {
namespace {

// rounding in the sums below, as a fraction of their terms: 2^-96, some bits above the error of DoubleDouble
constexpr double sum_rounding = 0x1p-96;

// A plane violated by no more than this fraction of the coordinates counts as satisfied. Far below the resolution of
// the result in double, far above the error in 106 bits of a basis with a condition of 10^10.
constexpr double least_violation = 0x1p-64;

template <int Dim>
using LongRow = std::array<DoubleDouble, Dim + 1>;

// Tight planes of the dual simplex. With C = columns (a_i, 1) of the basis, C λ = (0, …, 0, 1) and (x, -s) C = d.
template <int Dim>
struct ExtendedBasis {
  std::array<int, Dim + 1> planes{};
  std::array<LongRow<Dim>, Dim + 1> inverse;  // of C

  const DoubleDouble& multiplier(int k) const { return inverse[k][Dim]; }
};

template <int Dim>
LongRow<Dim> column_of(const HalfSpace<Dim>& plane) {
  LongRow<Dim> column;
  for (int j = 0; j < Dim; ++j)
    column[j] = plane.normal[j];
  column[Dim] = 1;
  return column;
}

template <int Dim>
DoubleDouble product(const LongRow<Dim>& a, const LongRow<Dim>& b) {
  DoubleDouble sum;
  for (int j = 0; j <= Dim; ++j)
    sum = sum + a[j] * b[j];
  return sum;
}

// the rounding of such a product
template <int Dim>
double rounding_of(const LongRow<Dim>& a, const LongRow<Dim>& b) {
  double sum = 0;
  for (int j = 0; j <= Dim; ++j)
    sum += std::abs(a[j].high * b[j].high);
  return sum_rounding * sum;
}

// Gauss and Jordan with the largest of each column as pivot; false when the planes are dependent
template <int Dim>
bool factorise(ExtendedBasis<Dim>& basis, const HalfSpaces<Dim>& planes, double far) {
  std::array<LongRow<Dim>, Dim + 1> matrix{};  // Cᵀ, whose inverse is that of C turned over
  std::array<LongRow<Dim>, Dim + 1> inverse{};
  for (int k = 0; k <= Dim; ++k) {
    matrix[k] = column_of<Dim>(basis_plane(planes, basis.planes[k], far));
    inverse[k][k] = 1;
  }
  for (int round = 0; round <= Dim; ++round) {
    int pivot = round;
    for (int k = round + 1; k <= Dim; ++k)
      if (abs(matrix[k][round]) > abs(matrix[pivot][round])) pivot = k;
    if (!(abs(matrix[pivot][round]) > sum_rounding)) return false;
    std::swap(matrix[pivot], matrix[round]);
    std::swap(inverse[pivot], inverse[round]);
    const DoubleDouble scale = 1 / matrix[round][round];
    for (int j = 0; j <= Dim; ++j) {
      matrix[round][j] = matrix[round][j] * scale;
      inverse[round][j] = inverse[round][j] * scale;
    }
    for (int k = 0; k <= Dim; ++k) {
      if (k == round) continue;
      const DoubleDouble factor = matrix[k][round];
      for (int j = 0; j <= Dim; ++j) {
        matrix[k][j] = matrix[k][j] - factor * matrix[round][j];
        inverse[k][j] = inverse[k][j] - factor * inverse[round][j];
      }
    }
  }
  for (int k = 0; k <= Dim; ++k)
    for (int j = 0; j <= Dim; ++j)
      basis.inverse[k][j] = inverse[j][k];
  return true;
}

template <int Dim>
bool dual_feasible(const ExtendedBasis<Dim>& basis) {
  for (int k = 0; k <= Dim; ++k)
    if (basis.multiplier(k) < 0) return false;
  return true;
}

template <int Dim>
ExtendedBasis<Dim> start_basis(const HalfSpaces<Dim>& planes, const std::array<int, Dim + 1>* start, double far) {
  ExtendedBasis<Dim> basis;
  if (start) {
    basis.planes = *start;
    if (factorise(basis, planes, far) && dual_feasible(basis)) return basis;
  }
  basis.planes = far_basis<Dim>();
  factorise(basis, planes, far);
  return basis;
}

// the point where the tight planes intersect, and -s
template <int Dim>
LongRow<Dim> intersection_point(const ExtendedBasis<Dim>& basis, const HalfSpaces<Dim>& planes, double far) {
  LongRow<Dim> solution;
  for (int k = 0; k <= Dim; ++k)
    for (int j = 0; j <= Dim; ++j)
      solution[j] = solution[j] + basis.inverse[k][j] * basis_plane(planes, basis.planes[k], far).offset;
  return solution;
}

// The most violated plane, or after many pivots the first; -1: none is violated.
template <int Dim>
int entering(const ExtendedBasis<Dim>& basis, const HalfSpaces<Dim>& planes, const LongRow<Dim>& solution,
             double tolerance, bool first) {
  double coordinates = 0;
  for (const DoubleDouble& x : solution)
    coordinates = std::max(coordinates, std::abs(x.high));
  int enter = -1;
  DoubleDouble worst = tolerance;
  for (int i = 0; i < static_cast<int>(planes.size()); ++i) {
    const double rounding = least_violation * (std::abs(planes[i].offset) + coordinates);
    const DoubleDouble violation = product<Dim>(column_of<Dim>(planes[i]), solution) - planes[i].offset - rounding;
    if (violation > worst && std::find(basis.planes.begin(), basis.planes.end(), i) == basis.planes.end()) {
      worst = violation;
      enter = i;
      if (first) break;
    }
  }
  return enter;
}

// the tight plane that leaves, except those that must not: the first to lose its multiplier, and of several the one
// with the largest pivot, or after many pivots the one with the least number
template <int Dim>
int leaving(const ExtendedBasis<Dim>& basis, const HalfSpace<Dim>& enter, bool first,
            const std::array<bool, Dim + 1>& stays) {
  const LongRow<Dim> column = column_of<Dim>(enter);
  int leave = -1;
  DoubleDouble best, largest;
  for (int k = 0; k <= Dim; ++k) {
    if (stays[k]) continue;
    const DoubleDouble mu = product<Dim>(basis.inverse[k], column);
    if (!(mu > rounding_of<Dim>(basis.inverse[k], column))) continue;
    const DoubleDouble ratio = (basis.multiplier(k) < 0 ? DoubleDouble(0) : basis.multiplier(k)) / mu;
    const bool equal = leave >= 0 && !(ratio < best) && !(best < ratio);
    if (leave < 0 || ratio < best || (equal && (first ? basis.planes[k] < basis.planes[leave] : mu > largest))) {
      best = ratio;
      largest = mu;
      leave = k;
    }
  }
  return leave;
}

// The basis with the entering plane; false: none was found. If a plane's leaving would make the others dependent, its
// pivot was zero but for the rounding of the inverse: it stays.
template <int Dim>
bool exchange(ExtendedBasis<Dim>& basis, const HalfSpaces<Dim>& planes, int enter, bool first, double far) {
  const ExtendedBasis<Dim> before = basis;
  std::array<bool, Dim + 1> stays{};
  for (int tries = 0; tries <= Dim; ++tries) {
    const int leave = leaving<Dim>(before, planes[enter], first, stays);
    if (leave < 0) return false;  // impossible in exact arithmetic: sum(mu) = 1
    basis.planes = before.planes;
    basis.planes[leave] = enter;
    if (factorise<Dim>(basis, planes, far)) return true;
    stays[leave] = true;
  }
  return false;
}

}  // namespace

template <int Dim>
FeasibilityResult<Dim> solve_feasibility_in_extended_precision(const HalfSpaces<Dim>& planes,
                                                               const FeasibilityRequest<Dim>& request) {
  const double far = far_in_reaches * reach_of<Dim>(planes);
  const int limit = 10 * (static_cast<int>(planes.size()) + Dim + 1) + 50;
  ExtendedBasis<Dim> basis = start_basis<Dim>(planes, request.start, far);
  FeasibilityResult<Dim> result;
  for (; result.pivots < limit; ++result.pivots) {
    const bool first = result.pivots > limit / 2;  // in this order no basis comes twice
    const LongRow<Dim> solution = intersection_point<Dim>(basis, planes, far);
    for (int j = 0; j < Dim; ++j)
      result.point[j] = solution[j].high;
    result.value = -solution[Dim].high;
    const int enter = entering<Dim>(basis, planes, solution, request.tolerance, first);
    if (enter < 0) {
      result.status = FeasibilityStatus::optimal;
      break;
    }
    if (!exchange<Dim>(basis, planes, enter, first, far)) break;
  }
  result.basis = basis.planes;
  for (int k = 0; k <= Dim; ++k) {
    result.multipliers[k] = basis.multiplier(k).high;
    if (basis.planes[k] < 0 && result.multipliers[k] > far_multiplier && result.status == FeasibilityStatus::optimal)
      result.status = FeasibilityStatus::unbounded;
  }
  return result;
}

template FeasibilityResult<1> solve_feasibility_in_extended_precision<1>(const HalfSpaces<1>&,
                                                                         const FeasibilityRequest<1>&);
template FeasibilityResult<2> solve_feasibility_in_extended_precision<2>(const HalfSpaces<2>&,
                                                                         const FeasibilityRequest<2>&);
template FeasibilityResult<3> solve_feasibility_in_extended_precision<3>(const HalfSpaces<3>&,
                                                                         const FeasibilityRequest<3>&);

}  // namespace voussoir
