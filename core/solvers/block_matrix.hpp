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

  struct Entry {
    int column;
    Block block;
  };

  // Rows of entries in any order; those of one column are added in their order. Every row has a diagonal block.
  void assign(int threads, const std::vector<std::vector<Entry>>& rows);

  // adds to the diagonal, as many numbers as the matrix has rows
  void add_diagonal(const Eigen::VectorXd& more);

  Eigen::VectorXd times(int threads, const Eigen::VectorXd& x) const;

  int rows() const { return static_cast<int>(diagonal.size()); }

  std::vector<int> first, column, diagonal;  // blocks of row i: first[i] up to first[i + 1]; the place of its diagonal
  std::vector<Block> blocks;
};

}  // namespace voussoir
