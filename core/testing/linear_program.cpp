#include "core/testing/linear_program.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {

Certificate judge(const LinearProgram& program, const ProgramSolution& solution) {
  Certificate certificate;
  std::vector<double> residual(program.right_side);
  for (std::size_t j = 0; j < program.columns.size(); ++j) {
    const ProgramColumn& column = program.columns[j];
    const double x = solution.x[j];
    certificate.primal += column.cost * x;
    certificate.primal_violation = std::max({certificate.primal_violation, column.low - x, x - column.high});
    double reduced_cost = column.cost;
    for (const auto& [row, coefficient] : column.entries) {
      residual[row] -= coefficient * x;
      reduced_cost -= coefficient * solution.y[row];
    }
    // the bound at which this column has the least cost; without a bound the cost must be zero
    const double bound = reduced_cost > 0 ? column.low : column.high;
    if (std::isfinite(bound))
      certificate.dual += reduced_cost * bound;
    else
      certificate.dual_violation = std::max(certificate.dual_violation, std::abs(reduced_cost));
  }
  for (std::size_t i = 0; i < residual.size(); ++i) {
    certificate.dual += program.right_side[i] * solution.y[i];
    certificate.primal_violation = std::max(certificate.primal_violation, std::abs(residual[i]));
  }
  return certificate;
}

}  // namespace voussoir
