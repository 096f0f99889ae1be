// The problems by which the question is asked from which rounding on a shape is acceptable: each takes blocks whose
// sharp behaviour is known, rounds them, and gives one number.
#pragma once

#include <string>

#include "cases/potential_particles/rounded_scene.hpp"

namespace voussoir::cases {

// Rounding as it is varied: r as a fraction of the inscribed radius of the smallest block that moves; 0: half-spaces.
struct RelativeRounding {
  double radius = 0;
  double sphericity = 0;
};

struct Trial {
  bool answered = false;      // a number was found
  double value = 0;           // see each problem
  std::string why;            // where there is none
  double seconds = 0;         // of the processor
  long long evaluations = 0;  // of contacts
};

// the case `wedge`: critical friction angle, deg; rotations restrained
Trial sliding_wedge(const RelativeRounding& rounding);

// The case `hingedbeam`, all contacts with 100 MN/m: the weight that it carries over that of the sharp hinge
// (reference/potential_particles/rounded_blocks.hpp, r = 0) at the rotation where the corners have gone in by half of
// r; half-space blocks by half of 1e-2 of the size.
Trial hinged_beam(const RelativeRounding& rounding);

// its peak, N, where the corners go in by 3 mm
Trial hinged_beam_peak(const RelativeRounding& rounding);

// Eight squares of 1 m on a fixed one, which cannot turn: settlement of the top over that of the springs.
Trial settled_column(const RelativeRounding& rounding);

// The same with rotations free and the top pushed sideways: how far the top has gone sideways at the end, m.
Trial leaning_column(const RelativeRounding& rounding);

}  // namespace voussoir::cases
