#include "verification/row.hpp"

#include <cmath>
#include <limits>

namespace voussoir::verification {

bool passed(const Row& row) {
  if (row.check.kind == Kind::reported) return true;
  return within(row.computed, row.check.expected, row.check.tolerance);
}

std::string verdict_of(const Row& row) {
  if (row.check.kind == Kind::reported) return "reported";
  return passed(row) ? "passed" : "FAILED";
}

double error_of(const Row& row) {
  if (!std::isfinite(row.computed) || !std::isfinite(row.check.expected))
    return std::numeric_limits<double>::quiet_NaN();
  return row.computed - row.check.expected;
}

}  // namespace voussoir::verification
