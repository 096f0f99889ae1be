#include "core/solvers/complete_factors.hpp"

#include <algorithm>
#include <cmath>

#include "core/solvers/dense_kernels.hpp"

namespace voussoir {
namespace {

constexpr int panel_width = 32;  // columns that are eliminated before the rest of a front is updated

// the rows of a front out of a vector, and back
template <int Size>
void gather(const Supernode& node, const Eigen::VectorXd& x, std::vector<double>& part) {
  part.assign(x.data() + Size * node.first, x.data() + Size * (node.first + node.columns));
  for (const int row : node.below)
    part.insert(part.end(), x.data() + Size * row, x.data() + Size * (row + 1));
}

template <int Size>
void scatter(const Supernode& node, const std::vector<double>& part, Eigen::VectorXd& x) {
  const double* from = part.data();
  std::copy(from, from + Size * node.columns, x.data() + Size * node.first);
  from += Size * node.columns;
  for (const int row : node.below) {
    std::copy(from, from + Size, x.data() + Size * row);
    from += Size;
  }
}

}  // namespace

template <int Size>
CompleteFactors<Size>::CompleteFactors(const EliminationPlan& elimination, bool symmetric)
    : plan(elimination),
      is_symmetric(symmetric),
      children(plan.supernodes.size()),
      place(plan.order.size()),
      panels(plan.supernodes.size()),
      local(plan.order.size()) {
  for (std::size_t at = 0; at < plan.parent.size(); ++at)
    if (plan.parent[at] >= 0) children[plan.parent[at]].push_back(static_cast<int>(at));
  for (std::size_t i = 0; i < plan.order.size(); ++i)
    place[plan.order[i]] = static_cast<int>(i);
}

template <int Size>
bool CompleteFactors<Size>::factorise(const BlockMatrix<Size>& matrix) {
  std::vector<int> node_of(plan.order.size());
  for (std::size_t at = 0; at < plan.supernodes.size(); ++at)
    for (int k = 0; k < plan.supernodes[at].columns; ++k)
      node_of[plan.supernodes[at].first + k] = static_cast<int>(at);
  entries.assign(plan.supernodes.size(), {});
  for (int i = 0; i < matrix.rows(); ++i)
    for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p) {
      const int row = place[i], column = place[matrix.column[p]];
      entries[node_of[std::min(row, column)]].push_back({p, row, column});
    }

  std::vector<std::vector<double>> updates(plan.supernodes.size());
  for (std::size_t at = 0; at < plan.supernodes.size(); ++at) {
    const Supernode& node = plan.supernodes[at];
    const int columns = Size * node.columns, below = Size * static_cast<int>(node.below.size()), all = columns + below;
    assemble(matrix, static_cast<int>(at), updates);
    Panel& panel = panels[at];
    if (!eliminate(columns, all, panel.swapped)) return false;
    panel.lower.assign(front.begin(), front.begin() + static_cast<long>(columns) * all);
    panel.upper.resize(is_symmetric ? 0 : static_cast<std::size_t>(columns) * below);
    updates[at].resize(static_cast<std::size_t>(below) * below);
    for (int j = 0; j < below; ++j) {
      const double* const column = front.data() + static_cast<long>(columns + j) * all;
      if (!is_symmetric) std::copy(column, column + columns, panel.upper.data() + static_cast<long>(columns) * j);
      std::copy(column + columns, column + all, updates[at].data() + static_cast<long>(below) * j);
    }
  }
  return true;
}

// the front of a supernode: its blocks of the matrix, and what its children leave
template <int Size>
void CompleteFactors<Size>::assemble(const BlockMatrix<Size>& matrix, int at,
                                     std::vector<std::vector<double>>& updates) {
  const Supernode& node = plan.supernodes[at];
  const int all = Size * (node.columns + static_cast<int>(node.below.size()));
  front.assign(static_cast<std::size_t>(all) * all, 0);
  for (int k = 0; k < node.columns; ++k)
    local[node.first + k] = Size * k;
  for (std::size_t k = 0; k < node.below.size(); ++k)
    local[node.below[k]] = Size * (node.columns + static_cast<int>(k));

  for (const auto& [p, row, column] : entries[at]) {
    const typename BlockMatrix<Size>::Block& block = matrix.blocks[p];
    const bool turned = is_symmetric && row < column;
    for (int c = 0; c < Size; ++c)
      for (int r = 0; r < Size; ++r) {
        const int i = local[row] + r, j = local[column] + c;
        front[turned ? j + static_cast<long>(all) * i : i + static_cast<long>(all) * j] = block(r, c);
      }
  }
  for (const int child : children[at]) {
    const std::vector<int>& rows = plan.supernodes[child].below;
    const long below = Size * static_cast<long>(rows.size());
    const double* from = updates[child].data();
    for (std::size_t j = 0; j < rows.size(); ++j)
      for (int c = 0; c < Size; ++c, from += below) {
        double* const to = front.data() + static_cast<long>(local[rows[j]] + c) * all;
        for (std::size_t i = is_symmetric ? j : 0; i < rows.size(); ++i)
          for (int r = 0; r < Size; ++r)
            to[local[rows[i]] + r] += from[Size * static_cast<long>(i) + r];
      }
    std::vector<double>().swap(updates[child]);
  }
}

// Eliminates the front's first columns. Of a symmetric one the lower half alone is valid.
template <int Size>
bool CompleteFactors<Size>::eliminate(int columns, int all, std::vector<int>& swapped) {
  const auto column_at = [&](int j) { return front.data() + static_cast<long>(all) * j; };
  swapped.clear();
  for (int begin = 0; begin < columns; begin += panel_width) {
    const int end = std::min(begin + panel_width, columns);
    for (int k = begin; k < end; ++k) {
      double* const column = column_at(k);
      if (is_symmetric) {
        for (int i = k + 1; i < end; ++i)
          column_at(i)[k] = column[i];
      } else {
        int pivot = k;
        for (int i = k + 1; i < columns; ++i)
          if (std::abs(column[i]) > std::abs(column[pivot])) pivot = i;
        swapped.push_back(pivot);
        if (pivot != k)
          for (int j = 0; j < all; ++j)
            std::swap(column_at(j)[k], column_at(j)[pivot]);
      }
      if (!std::isfinite(column[k]) || column[k] == 0) return false;
      for (int i = k + 1; i < all; ++i)
        column[i] /= column[k];
      for (int j = k + 1; j < end; ++j) {
        const int from = is_symmetric ? j : k + 1;
        subtract_multiple(all - from, column_at(j)[k], column + from, column_at(j) + from);
      }
    }
    if (!is_symmetric)
      for (int j = end; j < all; ++j)
        for (int k = begin; k < end; ++k)
          subtract_multiple(end - k - 1, column_at(j)[k], column_at(k) + k + 1, column_at(j) + k + 1);
    const int rest = all - end, width = end - begin;
    if (is_symmetric) {
      beside.resize(static_cast<std::size_t>(width) * rest);
      for (int k = 0; k < width; ++k) {
        const double* const column = column_at(begin + k);
        for (int i = 0; i < rest; ++i)
          beside[k + static_cast<std::size_t>(width) * i] = column[begin + k] * column[end + i];
      }
    }
    const DenseView lower{column_at(begin) + end, rest, width, all},
        upper = is_symmetric ? DenseView{beside.data(), width, rest, width}
                             : DenseView{column_at(end) + begin, width, rest, all};
    subtract_product(lower, upper, {column_at(end) + end, rest, rest, all}, is_symmetric, packed);
  }
  return true;
}

template <int Size>
int CompleteFactors<Size>::negative_pivots() const {
  int count = 0;
  for (std::size_t at = 0; at < panels.size(); ++at) {
    const Supernode& node = plan.supernodes[at];
    const long columns = Size * node.columns, all = columns + Size * static_cast<long>(node.below.size());
    for (long k = 0; k < columns; ++k)
      count += panels[at].lower[k * all + k] < 0;
  }
  return count;
}

template <int Size>
Eigen::VectorXd CompleteFactors<Size>::ordered(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x(b.size());
  for (std::size_t i = 0; i < plan.order.size(); ++i)
    x.segment<Size>(Size * i) = b.segment<Size>(Size * plan.order[i]);
  return x;
}

template <int Size>
Eigen::VectorXd CompleteFactors<Size>::unordered(const Eigen::VectorXd& x) const {
  Eigen::VectorXd b(x.size());
  for (std::size_t i = 0; i < plan.order.size(); ++i)
    b.segment<Size>(Size * plan.order[i]) = x.segment<Size>(Size * i);
  return b;
}

template <int Size>
Eigen::VectorXd CompleteFactors<Size>::solve(const Eigen::VectorXd& b) const {
  Eigen::VectorXd x = ordered(b);
  std::vector<double> part;
  for (std::size_t at = 0; at < panels.size(); ++at) {
    const Panel& panel = panels[at];
    gather<Size>(plan.supernodes[at], x, part);
    const int columns = Size * plan.supernodes[at].columns, all = static_cast<int>(part.size());
    for (std::size_t k = 0; k < panel.swapped.size(); ++k)
      std::swap(part[k], part[panel.swapped[k]]);
    for (int k = 0; k < columns; ++k)
      subtract_multiple(all - k - 1, part[k], panel.lower.data() + static_cast<long>(all) * k + k + 1, &part[k] + 1);
    scatter<Size>(plan.supernodes[at], part, x);
  }
  for (std::size_t at = panels.size(); at-- > 0;) {
    const Panel& panel = panels[at];
    gather<Size>(plan.supernodes[at], x, part);
    const int columns = Size * plan.supernodes[at].columns, all = static_cast<int>(part.size());
    const auto lower = [&](int k) { return panel.lower.data() + static_cast<long>(all) * k; };
    if (is_symmetric) {
      for (int k = columns; k-- > 0;)
        part[k] = part[k] / lower(k)[k] - dot_product(all - k - 1, lower(k) + k + 1, &part[k] + 1);
    } else {
      for (int j = columns; j < all; ++j)
        subtract_multiple(columns, part[j], panel.upper.data() + static_cast<long>(columns) * (j - columns),
                          part.data());
      for (int k = columns; k-- > 0;) {
        part[k] /= lower(k)[k];
        subtract_multiple(k, part[k], lower(k), part.data());
      }
    }
    scatter<Size>(plan.supernodes[at], part, x);
  }
  return unordered(x);
}

template <int Size>
Eigen::VectorXd CompleteFactors<Size>::solve_transposed(const Eigen::VectorXd& b) const {
  if (is_symmetric) return solve(b);
  Eigen::VectorXd x = ordered(b);
  std::vector<double> part;
  for (std::size_t at = 0; at < panels.size(); ++at) {
    const Panel& panel = panels[at];
    gather<Size>(plan.supernodes[at], x, part);
    const int columns = Size * plan.supernodes[at].columns, all = static_cast<int>(part.size());
    for (int k = 0; k < columns; ++k) {
      const double* const upper = panel.lower.data() + static_cast<long>(all) * k;
      part[k] = (part[k] - dot_product(k, upper, part.data())) / upper[k];
    }
    for (int j = columns; j < all; ++j)
      part[j] -= dot_product(columns, panel.upper.data() + static_cast<long>(columns) * (j - columns), part.data());
    scatter<Size>(plan.supernodes[at], part, x);
  }
  for (std::size_t at = panels.size(); at-- > 0;) {
    const Panel& panel = panels[at];
    gather<Size>(plan.supernodes[at], x, part);
    const int columns = Size * plan.supernodes[at].columns, all = static_cast<int>(part.size());
    for (int k = columns; k-- > 0;)
      part[k] -= dot_product(all - k - 1, panel.lower.data() + static_cast<long>(all) * k + k + 1, &part[k] + 1);
    for (std::size_t k = panel.swapped.size(); k-- > 0;)
      std::swap(part[k], part[panel.swapped[k]]);
    scatter<Size>(plan.supernodes[at], part, x);
  }
  return unordered(x);
}

template class CompleteFactors<3>;
template class CompleteFactors<6>;

}  // namespace voussoir
