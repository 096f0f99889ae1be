#pragma once
// The only pass/fail rule of this project, and the fields that a check must state before it may be judged by it.
#include <string>
#include <string_view>

namespace voussoir::verification {

// The allowed side of the expected value. at_most and at_least are for checks of kind `limit` only.
enum class Bound { both, at_most, at_least };

// Both numbers are finite and not negative; the two parts add up (see width).
struct Tolerance {
  double absolute = 0.0;  // in the unit of the check
  double relative = 0.0;  // fraction of |expected|, below 1: a tolerance of 1 would accept zero
  Bound bound = Bound::both;
};

enum class Kind {
  exact,      // closed form, or an identity: verification
  limit,      // an inequality or a limit that the result must approach: verification
  published,  // a value printed by others, with their uncertainty: validation
  drift,      // our own earlier value: reports "moved", never "right"
  reported,   // a number without a target: shown, never judged
};

struct Check {
  std::string quantity;  // unique within its case
  std::string unit;      // "1" for a number without dimension
  Kind kind = Kind::exact;
  std::string source;  // author, year, equation or page; for an identity, its name
  double expected = 0.0;
  Tolerance tolerance;
  std::string because;        // justification of the tolerance: derived, not tuned
  bool by_the_clock = false;  // of kind reported: a time, which no two runs share
};

// Half of the accepted interval: absolute + relative * |expected|, in the unit of the check.
double width(double expected, const Tolerance& tolerance);

// True when both numbers are finite and |computed - expected| <= width; a bound relaxes the other side.
bool within(double computed, double expected, const Tolerance& tolerance);

// True when a value three tolerances away on each forbidden side is refused, so that the check can fail.
bool bites(const Check& check);

// The used part of the tolerance: 1 is the edge, above 1 failed, negative is room to spare on a bounded side.
double margin(double computed, const Check& check);

// Throws std::invalid_argument, naming the check, when a field is empty or a number makes no sense.
void require_complete(const Check& check);

// Names as written in files. The readers throw std::invalid_argument for a name that is not in the list.
std::string_view name_of(Kind kind);
std::string_view name_of(Bound bound);
Kind kind_of(std::string_view name);
Bound bound_of(std::string_view name);

}  // namespace voussoir::verification
