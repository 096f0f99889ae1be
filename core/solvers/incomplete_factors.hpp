// Incomplete factors of a sparse matrix of blocks, in its own pattern: ILU(0) (Meijerink and van der Vorst 1977), the
// preconditioner of solve_blocks where complete factors would fill in too much. In single precision, of the matrix
// scaled to a diagonal of one: they change the way to an answer, not what is an answer.
#pragma once

#include "core/solvers/block_matrix.hpp"

namespace voussoir {

template <int Size>
class IncompleteFactors {
 public:
  // `order`: the matrix's rows in the order of elimination. Storage of the factors before is used again.
  void factorise(const BlockMatrix<Size>& matrix, const std::vector<int>& order);

  // no pivot block is singular
  bool regular() const { return is_regular; }

  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

 private:
  static constexpr int numbers = Size * Size;  // of a block

  float* block(int at) { return &blocks[static_cast<std::size_t>(at) * numbers]; }
  const float* block(int at) const { return &blocks[static_cast<std::size_t>(at) * numbers]; }

  void copy_row(const BlockMatrix<Size>& matrix, int row);
  bool invert(int place);

  std::vector<int> order;
  std::vector<int> place;                    // by row of the matrix: where it is in the order
  std::vector<int> first, column, diagonal;  // as in BlockMatrix, in the order
  std::vector<double> scale;                 // by row of numbers: one over the root of the matrix's diagonal
  std::vector<float> blocks;                 // unit lower blocks, upper blocks and inverted diagonal blocks
  bool is_regular = true;
};

}  // namespace voussoir
