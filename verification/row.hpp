#pragma once
// One line of the verdict table.
#include <string>

#include "verification/comparison/comparison.hpp"

namespace voussoir::verification {

struct Cost {
  long long contact_evaluations = 0;
  double seconds = 0.0;
};

// One line of the verdict table. Error, margin and verdict follow from these, so they are computed, never stored.
// For kind reported, check.because is the note and check.expected has no meaning.
struct Row {
  std::string case_name;
  Check check;
  double computed = 0.0;
  Cost cost;
  std::string commit;
};

bool passed(const Row& row);             // true for kind reported, which is never judged
std::string verdict_of(const Row& row);  // "passed", "FAILED" or "reported"
double error_of(const Row& row);         // computed - expected; NaN when either is not finite

}  // namespace voussoir::verification
