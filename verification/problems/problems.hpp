// The ten problems, by what they need.
#pragma once

#include <vector>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

Problem sliding_cube();
Problem incline();
Problem toppling_block();
Problem wedge();
Problem free_rotation();
Problem rocking();
Problem arch();
Problem bonded_beam();
Problem bolted_block();
Problem rock_mass();  // sliced from cases/slicing/rock_mass.toml of this source tree

std::vector<Problem> all_problems();  // in this order

}  // namespace voussoir::problems
