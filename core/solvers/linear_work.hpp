// What a state keeps of its linear systems (block_solver.hpp).
#pragma once

#include "core/solvers/block_matrix.hpp"
#include "core/solvers/incomplete_factors.hpp"

namespace voussoir {

// A linear system and what is made to solve it; the storage serves the next system, too.
template <int Size>
struct LinearWork {
  BlockMatrix<Size> matrix;  // A
  IncompleteFactors<Size> factors;
};

}  // namespace voussoir
