#include "core/limit/self_stress.hpp"

#include <cmath>

namespace voussoir {

// Solutions of A x = 0 can be added and scaled, so that one of them has all columns that any of them has, each at least
// 1: the largest sum of min(x, 1) is their number.
std::vector<bool> unbounded_columns(const LinearProgram& program) {
  const std::size_t count = program.columns.size();
  if (count == 0) return {};
  LinearProgram homogeneous{std::vector<double>(program.right_side.size(), 0), {}};
  for (ProgramColumn column : program.columns) {
    column.cost = 0;
    if (std::isfinite(column.low) && std::isfinite(column.high)) column.low = column.high = 0;
    homogeneous.columns.push_back(column);
  }
  for (const ProgramColumn& column : program.columns) {  // up to 1 of each relevant one
    const bool counts = std::isfinite(column.low) && !std::isfinite(column.high);
    homogeneous.columns.push_back({counts ? -1.0 : 0.0, 0, counts ? 1.0 : 0.0, column.entries});
  }
  std::vector<bool> unbounded(count, false);
  const ProgramSolution solution = solve(homogeneous);
  if (solution.status != ProgramStatus::optimal) return unbounded;
  for (std::size_t j = 0; j < count; ++j)
    unbounded[j] = solution.x[count + j] > 0.5;  // 0 or 1
  return unbounded;
}

}  // namespace voussoir
