// Complete factors of a sparse matrix of blocks, without pivots beyond the diagonal blocks, if elimination fills in
// little, as for chains and for blocks in a plane: block by block in an order of minimum degree (elimination.hpp).
#pragma once

#include "core/solvers/block_matrix.hpp"

namespace voussoir {

template <int Size>
class BlockFactors {
 public:
  explicit BlockFactors(const BlockMatrix<Size>& matrix);

  // false: elimination would fill in too much, and there are no factors
  bool complete() const { return !order.empty(); }
  // no pivot block is singular
  bool regular() const { return is_regular; }

  void solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;

 private:
  // unit lower blocks, upper blocks and inverted diagonal blocks
  void factorise();

  std::vector<int> order;  // the matrix's row that is the factors' i-th
  BlockMatrix<Size> factors;
  bool is_regular = true;
};

}  // namespace voussoir
