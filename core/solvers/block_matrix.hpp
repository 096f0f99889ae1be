// A square sparse matrix of small dense blocks. All sums are in a fixed order, so that no bit depends on the number of
// threads.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Size>
struct BlockMatrix {
  using Block = FixedMatrix<Size, Size>;

  // Blocks of zero in these columns of each row, which may be repeated and in any order, and on the diagonal, in the
  // storage of before.
  void lay_out(std::vector<std::vector<int>> columns);

  // of a row and a column that it has
  Block& at(int row, int in_column);

  // adds to the diagonal, as many numbers as the matrix has rows
  void add_diagonal(const Eigen::VectorXd& more);

  void times(int threads, const Eigen::VectorXd& x, Eigen::VectorXd& y) const;  // y = A x

  int rows() const { return static_cast<int>(diagonal.size()); }

  std::vector<int> first, column, diagonal;  // blocks of row i: first[i] up to first[i + 1]; the place of its diagonal
  std::vector<Block> blocks;
};

}  // namespace voussoir
