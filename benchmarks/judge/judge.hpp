// Judges a contact kernel by pairs.json.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/judge/kernels.hpp"
#include "benchmarks/judge/pair_file.hpp"
#include "core/geometry/polytope.hpp"

namespace voussoir::benchmarks {

// What a kernel got wrong on the pairs of one shape and state. The worst values are of touching pairs that it called
// touching.
struct Verdict {
  std::string shape, state;
  int pairs = 0;
  int decisions = 0;                          // wrong, when a decision or a contact was asked
  int unusable = 0;                           // failed, or a number is not finite, or a flag is none
  int points = 0, normals = 0, overlaps = 0;  // wrong
  int contacts = 0;                           // touching pairs with a usable answer
  int points_given = 0, normals_given = 0, overlaps_given = 0;
  double worst_point = 0;    // m beyond a plane of either block
  double worst_normal = 0;   // rad outside the cone, of normals that are no direction of the smallest translation
  double worst_overlap = 0;  // m
  std::string first_error;   // a sentence; empty: none

  int errors() const { return decisions + unusable + points + normals + overlaps; }
};

// of all of a state, or of every one; the first error of them
Verdict sum_of(const std::vector<Verdict>& verdicts, const std::string& state = "");

// How one contact of a touching pair differs from the exact answer; of quantities that are not given, zero.
struct ContactErrors {
  double point = 0;        // m beyond a plane
  double normal = 0;       // rad outside the cone; pi for a normal that is not unit
  double translation = 0;  // m: that along the normal, less the smallest
  double overlap = 0;      // m; infinite for an unknown kind, or one that needs a point and a normal and has none
};
// a, b: the blocks of the pair's planes.
ContactErrors contact_errors(const ExactPair& pair, const Polytope<3>& a, const Polytope<3>& b,
                             const voussoir_answer& answer);

// The smallest angle between the direction, unit, and a non-negative sum of the generators, unit; rad.
double angle_outside(const std::vector<Vector<3>>& generators, const Vector<3>& direction);

// Every pair twice, for the decision and for the contact, the second block in turned axes of its own; in the file's
// order, one verdict for each shape and state. Throws std::runtime_error if planes close no block.
std::vector<Verdict> judge_kernel(const Kernel& kernel, const PairFile& file);

}  // namespace voussoir::benchmarks
