// Complete factors of a sparse matrix of blocks, by dense fronts over supernodes (multifrontal: Duff and Reid 1983):
// L D Lᵀ of symmetric matrices; P L U of others, with pivots within a supernode. The order of operations is fixed.
#pragma once

#include <array>

#include "core/solvers/block_matrix.hpp"
#include "core/solvers/elimination.hpp"

namespace voussoir {

template <int Size>
class CompleteFactors {
 public:
  // The plan must outlive the factors. `symmetric`: of each pair of blocks across the diagonal one is read, and it is
  // enough if the matrix has only this one; of blocks on the diagonal the lower half.
  CompleteFactors(const EliminationPlan& plan, bool symmetric);

  // Of a matrix with the plan's pattern. False: a pivot is zero or not finite, and there are no factors.
  bool factorise(const BlockMatrix<Size>& matrix);

  // of D in L D Lᵀ of a symmetric matrix: as many as it has negative eigenvalues (Sylvester's law of inertia)
  int negative_pivots() const;

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::VectorXd solve_transposed(const Eigen::VectorXd& b) const;

 private:
  // of a supernode, by columns
  struct Panel {
    std::vector<double> lower;  // all rows: unit lower factor, and the upper one's square
    std::vector<double> upper;  // of unsymmetric matrices: the upper factor beyond the square
    std::vector<int> swapped;   // likewise: the row with which each was exchanged
  };

  void assemble(const BlockMatrix<Size>& matrix, int node, std::vector<std::vector<double>>& updates);
  bool eliminate(int columns, int all, std::vector<int>& swapped);

  Eigen::VectorXd ordered(const Eigen::VectorXd& b) const;
  Eigen::VectorXd unordered(const Eigen::VectorXd& x) const;

  const EliminationPlan& plan;
  bool is_symmetric;
  std::vector<std::vector<int>> children;  // by supernode
  std::vector<int> place;                  // by row of the matrix: when it is eliminated
  std::vector<Panel> panels;

  // while a front is eliminated
  std::vector<std::vector<std::array<int, 3>>> entries;  // by supernode: block, row, column
  std::vector<int> local;                                // by row: of the front
  std::vector<double> front, beside, packed;
};

}  // namespace voussoir
