// What the trials of a search tell of the critical strength besides that they are stable or have failed. Strength is
// tan φ, or the inverse of a factor of safety.
#pragma once

#include <optional>
#include <vector>

namespace voussoir {

// of a trial that lost its equilibrium on a straight line (core/run/failure_watch.hpp)
struct TrialEstimate {
  double level = 0;      // strength of the trial
  double critical = 0;   // strength required, taken to no displacement
  double taken_out = 0;  // what the extrapolation changed
};

// of a trial that came to equilibrium: how far its bodies had moved since the search began
struct StableTrial {
  double level = 0;         // strength
  double displacement = 0;  // m, of the body that moved most
  double of_failure = 0;    // the same over the displacement at which that body has failed
};

// the strength at no displacement of bodies that turn
struct StableFit {
  double critical = 0;
  double change = 0;  // by leaving out the trial that moved least; 0 of three trials, which have no such change
  bool of_three = false;
};

// A block that turns on a face of normal stiffness kn is pressed on a strip whose width falls with the root of its
// turn, so that what the corner lacks in lever does, too: stable trials of strength s have moved by u with s = s0 + b
// u^(-1/2) - a u, b in proportion to kn^(-1/2). Least squares through those that have moved by more than three
// thousandths of their failure displacement, the least of four or more left out. Nothing from fewer than three, or if b
// is not positive.
std::optional<StableFit> fit_stable(const std::vector<StableTrial>& trials);

}  // namespace voussoir
