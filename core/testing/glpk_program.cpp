#include <algorithm>
#include <cmath>

#include "core/solvers/glpk_environment.hpp"
#include "core/testing/linear_program.hpp"

namespace voussoir {
namespace {

// for programs with numbers of order one; above the rounding of some thousand pivots
constexpr double simplex_tolerance = 1e-11;

// pivots per rows and columns; the simplex method takes one or two, and may cycle
constexpr int most_pivots = 100;

// A pivot is at least this fraction of the largest entry of its row. GLPK's own 0.1 left forces out of balance by 1e-5
// in a wall of 400 blocks and found the first basis of one of 900 singular; this costs no measurable time.
constexpr double pivot_tolerance = 0.9;

bool is_usable(const LinearProgram& program) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return std::all_of(program.right_side.begin(), program.right_side.end(), finite) &&
         std::all_of(program.columns.begin(), program.columns.end(), [&](const ProgramColumn& column) {
           return finite(column.cost) && !std::isnan(column.low) && !std::isnan(column.high) &&
                  std::all_of(column.entries.begin(), column.entries.end(),
                              [&](const auto& entry) { return finite(entry.second); });
         });
}

int bound_type(const ProgramColumn& column) {
  const bool low = std::isfinite(column.low), high = std::isfinite(column.high);
  if (low && high) return column.low < column.high ? GLP_DB : GLP_FX;
  return low ? GLP_LO : high ? GLP_UP : GLP_FR;
}

GlpkProblem build(const LinearProgram& program) {
  GlpkProblem problem(glp_create_prob());
  glp_prob* lp = problem.get();
  glp_set_obj_dir(lp, GLP_MIN);
  glp_add_rows(lp, static_cast<int>(program.right_side.size()));
  for (std::size_t i = 0; i < program.right_side.size(); ++i)
    glp_set_row_bnds(lp, static_cast<int>(i) + 1, GLP_FX, program.right_side[i], program.right_side[i]);

  glp_add_cols(lp, static_cast<int>(program.columns.size()));
  std::vector<int> rows;
  std::vector<double> coefficients;
  for (std::size_t j = 0; j < program.columns.size(); ++j) {
    const ProgramColumn& column = program.columns[j];
    rows.assign(1, 0);  // GLPK's indices start at 1
    coefficients.assign(1, 0);
    for (const auto& [row, coefficient] : column.entries) {
      rows.push_back(row + 1);
      coefficients.push_back(coefficient);
    }
    const int place = static_cast<int>(j) + 1;
    glp_set_col_bnds(lp, place, bound_type(column), column.low, column.high);
    glp_set_obj_coef(lp, place, column.cost);
    glp_set_mat_col(lp, place, static_cast<int>(column.entries.size()), rows.data(), coefficients.data());
  }
  return problem;
}

ProgramStatus status_of(glp_prob* lp, int code) {
  if (code != 0) return ProgramStatus::failed;
  switch (glp_get_status(lp)) {
    case GLP_OPT:
      return ProgramStatus::optimal;
    case GLP_NOFEAS:
      return ProgramStatus::infeasible;
    case GLP_UNBND:
      return ProgramStatus::unbounded;
    default:
      return ProgramStatus::failed;
  }
}

}  // namespace

ProgramSolution solve(const LinearProgram& program) {
  ProgramSolution solution;
  if (!is_usable(program)) return solution;
  static thread_local GlpkEnvironment environment;
  const GlpkProblem problem = build(program);
  glp_prob* lp = problem.get();
  glp_adv_basis(lp, 0);
  glp_bfcp factorisation;
  glp_get_bfcp(lp, &factorisation);
  factorisation.piv_tol = pivot_tolerance;
  glp_set_bfcp(lp, &factorisation);

  glp_smcp control;
  glp_init_smcp(&control);
  control.msg_lev = GLP_MSG_OFF;
  control.it_lim = most_pivots * (glp_get_num_rows(lp) + glp_get_num_cols(lp));
  control.tol_bnd = control.tol_dj = simplex_tolerance;
  solution.status = status_of(lp, glp_simplex(lp, &control));

  for (int column = 1; column <= glp_get_num_cols(lp); ++column)
    solution.x.push_back(glp_get_col_prim(lp, column));
  for (int row = 1; row <= glp_get_num_rows(lp); ++row)
    solution.y.push_back(glp_get_row_dual(lp, row));
  return solution;
}

}  // namespace voussoir
