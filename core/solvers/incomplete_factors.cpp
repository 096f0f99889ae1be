#include "core/solvers/incomplete_factors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/solvers/row_sum.hpp"

namespace voussoir {

template <int Size>
void IncompleteFactors<Size>::factorise(const BlockMatrix<Size>& matrix, const std::vector<int>& eliminated) {
  const int count = matrix.rows();
  is_regular = true;
  order = eliminated;
  place.resize(order.size());
  first.assign(1, 0);
  column.clear();
  diagonal.resize(order.size());
  scale.resize(Size * count);
  for (int i = 0; i < count; ++i) {
    place[order[i]] = i;
    const auto here = matrix.blocks[matrix.diagonal[i]].diagonal();
    for (int k = 0; k < Size; ++k)
      scale[Size * i + k] = here[k] == 0 ? 1 : 1 / std::sqrt(std::abs(here[k]));
  }
  column.reserve(matrix.column.size());
  blocks.resize(matrix.column.size() * numbers);
  std::vector<int> at(count, -1);  // of a column in the row at hand
  float lower[numbers], product[numbers];
  for (int i = 0; i < count; ++i) {
    copy_row(matrix, i);
    for (int p = first[i]; p < first[i + 1]; ++p)
      at[column[p]] = p;
    for (int p = first[i]; p < diagonal[i]; ++p) {
      const int k = column[p];
      for (int c = 0; c < Size; ++c) {
        RowSum<Size, float> sum = RowSum<Size, float>::zero();
        sum.add(block(p), block(diagonal[k]) + Size * c);
        sum.keep(lower + Size * c);
      }
      std::copy_n(lower, numbers, block(p));
      for (int u = diagonal[k] + 1; u < first[k + 1]; ++u) {
        const int to = at[column[u]];
        if (to < 0) continue;
        for (int c = 0; c < Size; ++c) {
          RowSum<Size, float> sum = RowSum<Size, float>::of(block(to) + Size * c);
          sum.subtract(lower, block(u) + Size * c);
          sum.keep(product + Size * c);
        }
        std::copy_n(product, numbers, block(to));
      }
    }
    is_regular = invert(diagonal[i]);
    if (!is_regular) return;
    for (int p = first[i]; p < first[i + 1]; ++p)
      at[column[p]] = -1;
  }
}

// scaled, in single precision, its columns sorted in the order
template <int Size>
void IncompleteFactors<Size>::copy_row(const BlockMatrix<Size>& matrix, int row) {
  using Row = Eigen::Map<const Eigen::Matrix<double, Size, 1>>;
  static thread_local std::vector<std::pair<int, int>> sorted;  // columns, places in the matrix
  sorted.clear();
  const int from = order[row];
  for (int p = matrix.first[from]; p < matrix.first[from + 1]; ++p)
    sorted.emplace_back(place[matrix.column[p]], p);
  std::ranges::sort(sorted);
  for (const auto& [c, p] : sorted) {
    const int to = static_cast<int>(column.size());
    if (c == row) diagonal[row] = to;
    column.push_back(c);
    Eigen::Map<Eigen::Matrix<float, Size, Size>>(block(to)) =
        (Row(&scale[Size * from]).asDiagonal() * matrix.blocks[p] * Row(&scale[Size * matrix.column[p]]).asDiagonal())
            .template cast<float>();
  }
  first.push_back(static_cast<int>(column.size()));
}

// a diagonal block, in double precision; false: it is singular
template <int Size>
bool IncompleteFactors<Size>::invert(int at) {
  using Block = typename BlockMatrix<Size>::Block;
  using Single = Eigen::Map<Eigen::Matrix<float, Size, Size>>;
  const Eigen::PartialPivLU<Block> pivot(Block(Single(block(at)).template cast<double>()));
  const auto sizes = pivot.matrixLU().diagonal().cwiseAbs();
  if (!(sizes.allFinite() && sizes.minCoeff() > 0)) return false;
  Single(block(at)) = Block(pivot.inverse()).template cast<float>();
  return true;
}

template <int Size>
void IncompleteFactors<Size>::solve(const Eigen::VectorXd& b, Eigen::VectorXd& answer) const {
  using Sum = RowSum<Size, float>;
  static thread_local std::vector<float> x;
  x.resize(static_cast<std::size_t>(b.size()));
  float part[Size];
  const double largest =
      Eigen::Map<const Eigen::VectorXd>(scale.data(), b.size()).cwiseProduct(b).cwiseAbs().maxCoeff();
  answer.setZero(b.size());
  if (!(largest > 0)) return;
  const int count = static_cast<int>(order.size());
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < Size; ++k)
      part[k] = static_cast<float>(scale[Size * order[i] + k] * b[Size * order[i] + k] / largest);
    Sum sum = Sum::of(part);
    for (int p = first[i]; p < diagonal[i]; ++p)
      sum.subtract(block(p), &x[Size * column[p]]);
    sum.keep(&x[Size * i]);
  }
  for (int i = count; i-- > 0;) {
    Sum sum = Sum::of(&x[Size * i]);
    for (int p = diagonal[i] + 1; p < first[i + 1]; ++p)
      sum.subtract(block(p), &x[Size * column[p]]);
    sum.keep(part);
    Sum solved = Sum::zero();
    solved.add(block(diagonal[i]), part);
    solved.keep(&x[Size * i]);
    for (int k = 0; k < Size; ++k)
      answer[Size * order[i] + k] = scale[Size * order[i] + k] * largest * x[Size * i + k];
  }
}

template class IncompleteFactors<3>;
template class IncompleteFactors<6>;

}  // namespace voussoir
