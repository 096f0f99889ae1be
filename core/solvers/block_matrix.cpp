#include "core/solvers/block_matrix.hpp"

#include <algorithm>

#include "core/base/on_threads.hpp"
#include "core/solvers/row_sum.hpp"

namespace voussoir {

template <int Size>
void BlockMatrix<Size>::lay_out(std::vector<std::vector<int>> columns) {
  first.assign(1, 0);
  column.clear();
  diagonal.clear();
  for (int i = 0; i < static_cast<int>(columns.size()); ++i) {
    std::vector<int>& row = columns[i];
    row.push_back(i);
    std::ranges::sort(row);
    row.erase(std::unique(row.begin(), row.end()), row.end());
    diagonal.push_back(first.back() + static_cast<int>(std::ranges::lower_bound(row, i) - row.begin()));
    column.insert(column.end(), row.begin(), row.end());
    first.push_back(static_cast<int>(column.size()));
  }
  blocks.assign(column.size(), Block::Zero());
}

template <int Size>
typename BlockMatrix<Size>::Block& BlockMatrix<Size>::at(int row, int in_column) {
  return blocks[std::lower_bound(column.begin() + first[row], column.begin() + first[row + 1], in_column) -
                column.begin()];
}

template <int Size>
void BlockMatrix<Size>::add_diagonal(const Eigen::VectorXd& more) {
  for (int i = 0; i < rows(); ++i)
    blocks[diagonal[i]].diagonal() += more.segment<Size>(Size * i);
}

template <int Size>
void BlockMatrix<Size>::times(int threads, const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.resize(x.size());
  each_on_threads(threads, diagonal.size(), [&](int i) {
    RowSum<Size, double> sum = RowSum<Size, double>::zero();
    for (int p = first[i]; p < first[i + 1]; ++p)
      sum.add(blocks[p].data(), x.data() + Size * column[p]);
    sum.keep(y.data() + Size * i);
  });
}

template struct BlockMatrix<3>;
template struct BlockMatrix<6>;

}  // namespace voussoir
