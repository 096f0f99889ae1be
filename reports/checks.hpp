#pragma once
// All checks at a glance: computed against expected, and error over tolerance, verification and validation apart.
#include <array>
#include <string>
#include <vector>

#include "verification/verdicts.hpp"

namespace voussoir::reports {

// of some numbers; all zero for none, and no deviation for one
struct Spread {
  int count = 0;
  double mean = 0, deviation = 0;  // the deviation of a sample, n - 1
};
Spread spread_of(const std::vector<double>& values);
std::string in_words(const Spread& spread);  // "bias 0.039, scatter 0.23"

struct CaseSpread {
  std::string case_name;
  Spread over_tolerance;  // of (computed - expected) / tolerance
};

// Of one group of verdicts. Bias and scatter count the checks that are bounded on both sides, have room and are finite.
struct GroupSpread {
  std::string title;
  int judged = 0, passed = 0;
  int one_sided = 0;                // an inequality: its error has no middle
  int without_room = 0;             // must agree to the last digit
  int expected_zero = 0;            // zero expected, so not on logarithmic axes
  int failed_to_compute = 0;        // not finite
  Spread over_tolerance;            // 0: no bias; a scatter of 1/√3 would be errors spread evenly over the tolerance
  Spread log_ratio;                 // of ln(computed/expected), if both have one sign
  std::vector<CaseSpread> by_case;  // in the order of the verdicts
};

struct CheckSpreads {
  std::array<GroupSpread, 2> groups;  // verification, validation

  std::vector<std::string> cases(int group) const;  // names, in the order of by_case
  bool can_be_drawn() const;                        // both groups have points
};
CheckSpreads spreads_of(const verification::Verdicts& verdicts);

// For gnuplot, a check a line: group, case, side (both, or one of an inequality), place (of the case among the group's,
// from 1, a little off it so that points of one case do not hide each other), expected and computed (empty if they
// cannot be on logarithmic axes), over_tolerance (empty if it has none; clamped to ±1.4).
std::string checks_csv(const verification::Verdicts& verdicts);
// group, place, mean and deviation of each case
std::string checks_cases_csv(const CheckSpreads& spreads);

// For the manual; the figures are checks_values.svg and checks_errors.svg.
std::string checks_markdown(const CheckSpreads& spreads);

}  // namespace voussoir::reports
