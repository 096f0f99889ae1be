// A square sparse matrix of small dense blocks, and the solution of its linear systems: BiCGStab (van der Vorst 1992)
// with an incomplete block factorisation of the matrix's own pattern, ILU(0) (Meijerink and van der Vorst 1977). All
// sums are in a fixed order, so that no bit depends on the number of threads.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace voussoir {

template <int Size>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, Size, Size>;

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

struct LinearAnswer {
  Eigen::VectorXd x;
  int iterations = 0;
  double residual = 0;  // |b - A x| / |b|; infinite when a pivot block is singular
};

// Solves A x = b until |b - A x| <= tolerance |b|, or gives the best it met within the limit.
template <int Size>
LinearAnswer solve_blocks(const BlockMatrix<Size>& matrix, const Eigen::VectorXd& b, double tolerance,
                          int iteration_limit, int threads);

}  // namespace voussoir
