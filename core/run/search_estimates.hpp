// What the trials of a search tell of the critical strength besides that they are stable or have failed. Strength is
// tan φ, or the inverse of a factor of safety.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/run/search_levels.hpp"

namespace voussoir {

// of a trial that failed with a motion whose required strength falls in a straight line (core/run/failure_watch.hpp)
struct TrialEstimate {
  double level = 0;      // strength of the trial
  double critical = 0;   // strength required at no displacement
  double taken_out = 0;  // the change by the extrapolation to no displacement
};

// of a trial that reached equilibrium: how far its bodies had moved since the search began
struct StableTrial {
  double level = 0;         // strength
  double displacement = 0;  // m, of the body that moved most
  double of_failure = 0;    // the same over the displacement at which these bodies have failed
};

// why the required strength of a failed trial has no line to be taken to no displacement
enum class NoLine { none, turned, no_slip, broke, loads, too_short, not_straight };

struct SearchEstimates {
  std::vector<TrialEstimate> failed;
  std::vector<StableTrial> stable;
  NoLine no_line = NoLine::none;  // of the last failed trial
};

// levels, rad or 1
struct Bracket {
  double stable = 0, failed = 0;
};

// how the critical level follows from the trials; of bodies that turn, the bar of a bracket contains the error of
// turning
enum class CriticalBy { bracket, bracket_of_turning, required_strength, stable_fit };

struct CriticalLevel {
  double level = 0, error_bar = 0;  // rad or 1
  CriticalBy by = CriticalBy::bracket;
  double taken_out = 0;           // rad or 1: by the extrapolation to no displacement; by the fit, from the bracket
  std::string bracket_because{};  // why it is the bracket, as a clause; else empty
};

// Whether the last two estimates are equal within half the tolerance and a trial is stable within half the tolerance of
// them: the search needs no narrower bracket.
bool is_certified(const Levels& levels, const Bracket& bracket, const SearchEstimates& known);

// The level of the next trial by the last estimate: a hundredth beyond it, where its line is best seen; once two
// estimates agree, half a tolerance on the stable side. Nothing without an estimate inside the bracket.
std::optional<double> level_by_estimate(const Levels& levels, const Bracket& bracket, const SearchEstimates& known);

// The level of the next trial of bodies that turn, if half the bracket would be too long a step: displacements of
// stable trials are to grow by small factors, since the fit needs some of different size, and bodies do not return.
std::optional<double> level_for_fit(const Levels& levels, const Bracket& bracket, const SearchEstimates& known);

// The critical level: the strength required at no displacement; of bodies that turn, the fit through the stable trials;
// else the middle of the bracket. Error bar of the first: a tenth of what the extrapolation changed, and the difference
// of the last two estimates (half the bracket if there is one only); of the fit: twice its change by one trial more,
// and a tenth of its distance from the bracket, or of three trials all of that and the error of turning, and by squares
// half the bracket; of the bracket: half of it, and the error of turning.
CriticalLevel critical_level(const Levels& levels, const Bracket& bracket, const SearchEstimates& known);

// The strength at no displacement of bodies that turn.
struct StableFit {
  double critical = 0;
  double change = 0;  // by one trial more; of three trials there is none
  bool of_three = false;
};

// A block that turns on a face of normal stiffness kn is pressed on a strip whose width falls with the root of its
// turn, and with it the lever that the corner lacks: stable trials of strength s have moved by u with s = s0 + b
// u^(-1/2) - a u, b in proportion to kn^(-1/2). Through the three trials that have moved most, of those beyond three
// thousandths of their failure displacement, and short of half of it if these are enough: the law is that of a face
// already turned, and of a geometry that has not changed. Nothing of fewer than three, or if b or a is not positive.
std::optional<StableFit> fit_stable(const std::vector<StableTrial>& trials);

// By how much the strength at which bodies that turn fail on elastic faces may differ from that of rigid ones at no
// displacement; 0 of fewer than two trials. If the arm of the loads grows with the motion, a < 0, the last stable trial
// is at the least strength of the law, at which b u^(-1/2) = -2 a u, and another trial tells b; else the bodies have
// moved until a u is what counts, and another trial tells a. The larger of the two, and a third of it. If one trial at
// most has turned on its faces, b by the trial before it.
double error_of_turning(const std::vector<StableTrial>& trials);

}  // namespace voussoir
