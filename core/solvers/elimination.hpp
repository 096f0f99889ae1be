// The elimination of a sparse matrix of blocks as a graph: an order of rows with little fill-in, the pattern of the
// factors, and which of their columns share a pattern.
#pragma once

#include <vector>

#include "core/solvers/block_matrix.hpp"

namespace voussoir {

using Neighbours = std::vector<std::vector<int>>;

// for each row the others with which it shares a block, on either side of the diagonal; ascending
template <int Size>
Neighbours neighbours_in(const BlockMatrix<Size>& matrix);

// an order of the rows with little fill-in: approximate minimum degree (Amestoy, Davis and Duff 1996, by Eigen)
std::vector<int> minimum_degree(const Neighbours& rows);

// The columns left of the diagonal that each row of the factors has in this order: those from which the elimination
// tree leads to it (Liu 1990). Empty if eliminating them takes more than `most` products of blocks.
Neighbours lower_pattern(const Neighbours& rows, const std::vector<int>& order, double most);

// Columns that are eliminated as one dense panel.
struct Supernode {
  int first = 0, columns = 0;  // in the order of elimination
  std::vector<int> below;      // the rows under them, ascending
};

// The complete elimination of a graph, made once for all matrices of its pattern: supernodes in an order of minimum
// degree, merged where little more than a tenth of the numbers are zeros that a sparser pattern would leave out.
struct EliminationPlan {
  explicit EliminationPlan(const Neighbours& rows);

  // known before any factorisation
  struct Cost {
    double entries = 0;     // numbers in the factors
    double operations = 0;  // multiplications, additions and divisions of a factorisation
    double bytes = 0;       // of the factors and, at its peak, of the work beside them
  };
  Cost cost(int block_size, bool symmetric) const;

  std::vector<int> order;             // the matrix's row that is eliminated as i-th
  std::vector<Supernode> supernodes;  // children before parents
  std::vector<int> parent;            // by supernode; -1: a root
};

}  // namespace voussoir
