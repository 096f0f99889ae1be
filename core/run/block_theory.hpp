// What block theory says of the blocks that a search found to move.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/results.hpp"

namespace voussoir {

// Adds its verdict to the records of searches whose failed trial moves blocks that it can judge (StableState), with a
// factor of safety or a friction angle, and what it knows of a difference to the search's value.
template <int Dim>
void add_block_theory(const Prepared<Dim>& prepared, Results& results);

// "block theory: 1.0694 for the same blocks; 68.4 kN (-5.1/003.1) would give 1.3"
std::string text_of(const BlockTheory& theory, const std::string& unit);

}  // namespace voussoir
