// The problems that decide up to which rounding a shape is acceptable: each rounds blocks whose sharp behaviour is
// known, and gives one number.
#pragma once

#include "cases/potential_particles/trial.hpp"

namespace voussoir::cases {

// The rounding that is varied: r as a fraction of the inscribed radius of the smallest block that moves; 0:
// half-spaces.
struct RelativeRounding {
  double radius = 0;
  double sphericity = 0;
};

// the case `wedge`: critical friction angle, deg; rotations restrained
Trial sliding_wedge(const RelativeRounding& rounding);

// The case `hingedbeam`, all contacts with 100 MN/m: the weight that it carries over that of the sharp hinge
// (reference/potential_particles/rounded_blocks.hpp, r = 0) when the corners have penetrated by half of r, but at 0.05
// rad at most; half-space blocks as for r = 1e-2 of the size.
Trial hinged_beam(const RelativeRounding& rounding);

double beam_rotation(const RelativeRounding& rounding);  // rad, of that push

// its peak, N, with corners penetrating by 3 mm
Trial hinged_beam_peak(const RelativeRounding& rounding);

// Eight squares of 1 m on a fixed one, rotation restrained: settlement of the top over that of eight sharp ones.
Trial settled_column(const RelativeRounding& rounding);

// The same with rotations free and the top pushed sideways: sideways displacement of the top after 12 s, m.
Trial leaning_column(const RelativeRounding& rounding);

// 1/(1/ρ_a + 1/ρ_b) of two such squares' faces, in their heights (reference/potential_particles/rounded_blocks.hpp)
double joint_radius(const RelativeRounding& rounding);

}  // namespace voussoir::cases
