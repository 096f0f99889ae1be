// The kernel's full result for a pair, checked by exact arithmetic on its input doubles.
//
// Promised, with the pair's size = radius of A + radius of B (Polytope::radius, about the bodies' centroids) and
// 1 ulp = 2^-52:
//  - touching only if s* < 0, separated only if s* > 0, undecided only within 64 ulp of the size, nothing else;
//  - a proof is valid as stored: an interior point is `margin` inside every plane; no point of A is beyond `support`
//    along a unit axis and none of B before support + margin; by multipliers s* >= margin; and margin > 0;
//  - the program's value, cold and to its end, within 64 ulp of the size;
//  - at the kernel's own point and normal: overlap within 64 ulp of the size, the faces those that end it (or nearer to
//    that than 64 ulp), area within 1e-12 relative plus the first-order effect of 64 ulp on each plane's offset;
//  - the same decisions and proofs for contacts on the central path, whose value is never deeper than the program's.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/contact/narrow_phase.hpp"
#include "core/testing/exact_referee.hpp"
#include "core/testing/pair_families.hpp"

namespace voussoir::families {

// a promise that was broken, by name, and the figures
struct Finding {
  std::string promise, figures;
};

// the queries and the largest errors, in units of the promised ones
struct Tally {
  std::map<std::string, long long> counts;
  std::map<std::string, double> worst;

  void add(const Tally& other);
};

// The case cold, once to the decision and once to the area, then warm after its move.
template <int Dim>
std::vector<Finding> judge(const Case<Dim>& c, Tally& tally);

// Checks cases `first` .. `last` - 1 of the seed in processes of their own. For every broken promise the text reports
// how often it was broken, the smallest case by seed and number, and that case without irrelevant faces.
template <int Dim>
std::string judge_all(std::uint64_t seed, long long first, long long last, int processes, Tally& tally);

}  // namespace voussoir::families
