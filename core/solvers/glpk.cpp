#include "core/solvers/glpk.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/solvers/glpk_environment.hpp"

namespace voussoir {
namespace {

// of the scaled problem, whose offsets are at most 1; well above the rounding of a few pivots
constexpr double simplex_tolerance = 1e-10;

template <int Dim>
bool all_finite(const HalfSpaces<Dim>& planes) {
  return std::all_of(planes.begin(), planes.end(), [](const HalfSpace<Dim>& plane) {
    return plane.normal.allFinite() && std::isfinite(plane.offset);
  });
}

// the largest offset: lengths are divided by it, so that GLPK's tolerances are relative to the size of the parts
template <int Dim>
double length_scale(const HalfSpaces<Dim>& planes) {
  double scale = 0;
  for (const HalfSpace<Dim>& plane : planes)
    scale = std::max(scale, std::abs(plane.offset));
  return scale > 0 ? scale : 1;
}

// min s subject to a_i·x - s <= d_i; columns 1..Dim are x, column Dim+1 is s, all free
template <int Dim>
GlpkProblem build(const HalfSpaces<Dim>& planes, double scale) {
  GlpkProblem problem(glp_create_prob());
  glp_prob* lp = problem.get();
  glp_set_obj_dir(lp, GLP_MIN);
  glp_add_cols(lp, Dim + 1);
  for (int column = 1; column <= Dim + 1; ++column)
    glp_set_col_bnds(lp, column, GLP_FR, 0, 0);
  glp_set_obj_coef(lp, Dim + 1, 1);

  glp_add_rows(lp, static_cast<int>(planes.size()));
  for (int row = 1; row <= static_cast<int>(planes.size()); ++row) {
    const HalfSpace<Dim>& plane = planes[row - 1];
    int columns[Dim + 2];
    double coefficients[Dim + 2];
    int count = 0;
    for (int k = 0; k < Dim; ++k) {
      if (plane.normal[k] == 0) continue;
      columns[++count] = k + 1;
      coefficients[count] = plane.normal[k];
    }
    columns[++count] = Dim + 1;
    coefficients[count] = -1;
    glp_set_mat_row(lp, row, count, columns, coefficients);
    glp_set_row_bnds(lp, row, GLP_UP, 0, plane.offset / scale);
  }
  return problem;
}

// Starts with Dim+1 independent planes tight and every column in the basis. A free column never leaves it, so that
// Dim+1 rows are tight at the end too, even in symmetric problems that need no pivot along some axis.
template <int Dim>
void set_start(glp_prob* lp, const HalfSpaces<Dim>& planes) {
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> rows(Dim + 1, static_cast<Eigen::Index>(planes.size()));
  for (std::size_t i = 0; i < planes.size(); ++i)
    rows.col(static_cast<Eigen::Index>(i)) << planes[i].normal, -1;
  const Eigen::ColPivHouseholderQR<decltype(rows)> factors(rows);
  if (factors.rank() <= Dim) return;  // normals that do not span: GLPK's own start
  for (int row = 1; row <= static_cast<int>(planes.size()); ++row)
    glp_set_row_stat(lp, row, GLP_BS);
  for (int k = 0; k <= Dim; ++k)
    glp_set_row_stat(lp, factors.colsPermutation().indices()[k] + 1, GLP_NU);
  for (int column = 1; column <= Dim + 1; ++column)
    glp_set_col_stat(lp, column, GLP_BS);
}

// the planes whose rows left the basis are tight; their multipliers are the negative duals
template <int Dim>
void read_basis(glp_prob* lp, FeasibilityResult<Dim>& result) {
  int found = 0;
  for (int row = 1; row <= glp_get_num_rows(lp) && found <= Dim; ++row) {
    if (glp_get_row_stat(lp, row) == GLP_BS) continue;
    result.basis[found] = row - 1;
    result.multipliers[found++] = std::max(0.0, -glp_get_row_dual(lp, row));
  }
}

FeasibilityStatus status_of(glp_prob* lp, int code) {
  if (code != 0) return FeasibilityStatus::iteration_limit;
  switch (glp_get_status(lp)) {
    case GLP_OPT:
      return FeasibilityStatus::optimal;
    case GLP_UNBND:
      return FeasibilityStatus::unbounded;
    default:
      return FeasibilityStatus::iteration_limit;
  }
}

}  // namespace

template <int Dim>
FeasibilityResult<Dim> solve_feasibility_glpk(const HalfSpaces<Dim>& planes, const FeasibilityRequest<Dim>&) {
  FeasibilityResult<Dim> result;
  result.basis.fill(-1);
  if (!all_finite(planes)) return result;
  static thread_local GlpkEnvironment environment;

  const double scale = length_scale(planes);
  const GlpkProblem problem = build(planes, scale);
  glp_prob* lp = problem.get();

  set_start(lp, planes);
  glp_smcp control;
  glp_init_smcp(&control);
  control.msg_lev = GLP_MSG_OFF;
  control.tol_bnd = control.tol_dj = simplex_tolerance;
  const int code = glp_simplex(lp, &control);

  result.status = status_of(lp, code);
  result.pivots = glp_get_it_cnt(lp);
  if (result.status != FeasibilityStatus::optimal) return result;
  result.value = glp_get_obj_val(lp) * scale;
  for (int k = 0; k < Dim; ++k)
    result.point[k] = glp_get_col_prim(lp, k + 1) * scale;
  read_basis(lp, result);
  return result;
}

template FeasibilityResult<2> solve_feasibility_glpk(const HalfSpaces<2>&, const FeasibilityRequest<2>&);
template FeasibilityResult<3> solve_feasibility_glpk(const HalfSpaces<3>&, const FeasibilityRequest<3>&);

}  // namespace voussoir
