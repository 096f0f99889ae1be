// A linear program in sparse columns, its solution by GLPK, and an independent verification of the solution.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace voussoir {

struct ProgramColumn {
  double cost = 0;
  double low = 0, high = 0;                     // infinite without a bound
  std::vector<std::pair<int, double>> entries;  // row from 0, coefficient
};

// min cost·x subject to A x = right_side, low <= x <= high
struct LinearProgram {
  std::vector<double> right_side;
  std::vector<ProgramColumn> columns;
};

enum class ProgramStatus { optimal, infeasible, unbounded, failed };

struct ProgramSolution {
  ProgramStatus status = ProgramStatus::failed;
  std::vector<double> x;  // by column
  std::vector<double> y;  // by row: the multipliers
};

// Values of x and y, computed from the program's own numbers. Without any violation, the optimum is between `dual` and
// `primal`.
struct Certificate {
  double primal = 0;            // cost·x
  double dual = 0;              // right_side·y plus the terms of bounded columns
  double primal_violation = 0;  // largest |A x - right_side| and distance of x beyond a bound
  double dual_violation = 0;    // largest reduced cost of the wrong sign in a column without a bound on that side
};

// By GLPK's simplex method; its optimality status is not needed if a Certificate is computed. A number that is not
// finite (except bounds) gives `failed`.
ProgramSolution solve(const LinearProgram& program);

Certificate judge(const LinearProgram& program, const ProgramSolution& solution);

}  // namespace voussoir
