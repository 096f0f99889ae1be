#include "core/solvers/block_matrix.hpp"

#include <algorithm>

#include "core/base/on_threads.hpp"

namespace voussoir {

template <int Size>
void BlockMatrix<Size>::assign(int threads, const std::vector<std::vector<Entry>>& rows) {
  const int count = static_cast<int>(rows.size());
  std::vector<std::vector<Entry>> sorted(rows.size());
  each_on_threads(threads, rows.size(), [&](int i) {
    std::vector<Entry> row = rows[i];
    std::stable_sort(row.begin(), row.end(), [](const Entry& x, const Entry& y) { return x.column < y.column; });
    for (const Entry& e : row)
      if (sorted[i].empty() || sorted[i].back().column != e.column)
        sorted[i].push_back(e);
      else
        sorted[i].back().block += e.block;
  });
  first.assign(1, 0);
  column.clear();
  blocks.clear();
  diagonal.assign(count, -1);
  for (int i = 0; i < count; ++i) {
    for (const Entry& e : sorted[i]) {
      if (e.column == i) diagonal[i] = static_cast<int>(column.size());
      column.push_back(e.column);
      blocks.push_back(e.block);
    }
    first.push_back(static_cast<int>(column.size()));
  }
}

template <int Size>
void BlockMatrix<Size>::add_diagonal(const Eigen::VectorXd& more) {
  for (int i = 0; i < rows(); ++i)
    blocks[diagonal[i]].diagonal() += more.segment<Size>(Size * i);
}

template <int Size>
Eigen::VectorXd BlockMatrix<Size>::times(int threads, const Eigen::VectorXd& x) const {
  Eigen::VectorXd y(x.size());
  each_on_threads(threads, diagonal.size(), [&](int i) {
    FixedMatrix<Size, 1> sum = FixedMatrix<Size, 1>::Zero();
    for (int p = first[i]; p < first[i + 1]; ++p)
      sum.noalias() += blocks[p] * x.segment<Size>(Size * column[p]);
    y.segment<Size>(Size * i) = sum;
  });
  return y;
}

template struct BlockMatrix<3>;
template struct BlockMatrix<6>;

}  // namespace voussoir
