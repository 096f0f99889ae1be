// The tangent of all contacts: the change of the loads on the free bodies as they move.
#pragma once

#include <vector>

#include "core/model/state.hpp"
#include "core/solvers/block_matrix.hpp"

namespace voussoir {

// Minus the derivative of the contacts' forces and moments, a row of blocks for each free body: the stiffness of every
// pair, and the rotation of its forces with its first body; and the contribution of other loads for each single body
// (`own`, by body; may be empty). `place`: index of a body among the free ones, or -1; `free`: 1, or 0 for a restrained
// direction, by degree of freedom of the free bodies.
template <int Dim>
void find_tangent(int threads, const std::vector<const PairStiffness<Dim>*>& pairs,
                  const std::vector<typename PairStiffness<Dim>::Block>& own, const std::vector<int>& place,
                  const Eigen::VectorXd& free, BlockMatrix<freedoms<Dim>>& k);

}  // namespace voussoir
