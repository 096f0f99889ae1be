#pragma once
// Values of earlier versions, kept in the repository (verification/history/<version>.jsonl: one JSON line per case and
// quantity), and the values that have moved since.
//
// Runs promise equal bits where the C library computes the same functions (the file's first line has their hash), so a
// value has moved when it differs beyond rounding, and a count of contact evaluations when it differs at all. Rounding
// is `rounding_share` of the value, far above the effect of other last bits in a closed form, or `tolerance_share` of
// the check's tolerance, for values that are rounding themselves. Times by the clock are kept to be drawn, never
// compared. A change that moves a value on purpose is announced in the first section of CHANGELOG.md:
//
//   - Moved: `wedge`: `critical friction`, since …      (without the quantity: all of the case)
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "verification/verdicts.hpp"

namespace voussoir::verification {

inline constexpr double rounding_share = 1e-9;
inline constexpr double tolerance_share = 1e-6;

struct PastRow {
  std::string case_name;
  std::string quantity;
  std::string unit;
  double value = 0.0;
  std::optional<double> error;  // of checks with a target
  long long contact_evaluations = 0;
  double seconds = 0.0;
};

struct PastVersion {
  std::string version;
  std::string math_functions;  // a hash of the C library's functions that computed the rows (`voussoir --version`)
  std::vector<PastRow> rows;
};

// Oldest first; empty when there is no such folder. Throws std::runtime_error naming file and line.
std::vector<PastVersion> read_history(const std::filesystem::path& folder);

// The hash of the functions of the C library in the output of `voussoir --version`; empty if it has none.
std::string math_functions_in(std::string_view version_text);

// The rows of these verdicts as lines of a history file, after one of the hash. Throws std::runtime_error when the
// verdicts are not all good: a version that fails is not one to compare with.
std::string history_lines(const Verdicts& verdicts, const std::string& math_functions);

// The rows that differ, in the order of the verdicts, then those that are gone. Rows of kind reported count like
// others.
std::vector<Moved> moved_since(const PastVersion& past, const Verdicts& verdicts);

// Marks the moves that the text of the changelog announces; returns the announcements that match no move, each a line.
std::vector<std::string> mark_announced(std::vector<Moved>& moved, std::string_view changelog);

// "wedge: critical friction: 33.358 deg, was 33.371 in 0.1.0"
std::string describe(const Moved& moved, const std::string& version);

// For the drawing: case,quantity,place,version,change,moved; place counts the versions from 0 and the present is last.
// `change` is the difference from the present value, relative to it, or to the tolerance if that is larger; times by
// the clock are left out. The last rows, of the quantity `history_cost`, are each case's costliest run.
inline constexpr const char* history_cost = "contact evaluations of the costliest run";
std::string history_csv(const std::vector<PastVersion>& history, const Verdicts& verdicts);

}  // namespace voussoir::verification
