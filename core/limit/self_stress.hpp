// Forces in equilibrium without any load, as in blocks jammed between walls.
#pragma once

#include <vector>

#include "core/limit/linear_program.hpp"

namespace voussoir {

// Which columns of a program can grow without bound: those that are positive in some x with A x = 0, where columns from
// 0 to infinity are at least 0, free ones are free, and those with two bounds are 0. Also none if the solver gives up.
std::vector<bool> unbounded_columns(const LinearProgram& program);

}  // namespace voussoir
