#include "core/solvers/elimination.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>

namespace voussoir {
namespace {

// Zeros in a merged supernode's panel: a tenth is paid back by the speed of larger dense products, more is not. In the
// smallest ones, which are slow anyhow, twice as many.
constexpr double few_zeros = 0.12, zeros_in_small = 0.3;
constexpr int columns_of_small = 4;

struct Merged {
  std::vector<int> columns;  // in the first order
  std::vector<int> below, children;
  int parent = -1;
  double zeros = 0;  // blocks
};

// blocks on and below the diagonal of a panel
double blocks_of(double columns, double below) {
  return columns * (columns + 1) / 2 + columns * below;
}

// supernodes of one column each, with the rows below it
std::vector<Merged> single_columns(const Neighbours& lower) {
  std::vector<Merged> nodes(lower.size());
  for (int i = 0; i < static_cast<int>(lower.size()); ++i) {
    nodes[i].columns = {i};
    for (const int k : lower[i])
      nodes[k].below.push_back(i);
  }
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i)
    if (!nodes[i].below.empty()) {
      nodes[i].parent = nodes[i].below.front();
      nodes[nodes[i].parent].children.push_back(i);
    }
  return nodes;
}

// Merges children into their parents, the largest first, where few zeros come in.
void merge(std::vector<Merged>& nodes) {
  for (Merged& parent : nodes) {  // children before parents
    std::vector<int> left = std::move(parent.children);
    parent.children.clear();
    std::stable_sort(left.begin(), left.end(),
                     [&](int p, int q) { return nodes[p].below.size() > nodes[q].below.size(); });
    for (const int at : left) {
      Merged& child = nodes[at];
      const double of_child = child.columns.size(), of_parent = parent.columns.size(),
                   zeros =
                       child.zeros + parent.zeros + of_child * (of_parent + parent.below.size() - child.below.size()),
                   most = of_child + of_parent <= columns_of_small ? zeros_in_small : few_zeros;
      if (zeros > most * blocks_of(of_child + of_parent, parent.below.size())) {
        parent.children.push_back(at);
        continue;
      }
      child.columns.insert(child.columns.end(), parent.columns.begin(), parent.columns.end());
      parent.columns.swap(child.columns);
      parent.zeros = zeros;
      parent.children.insert(parent.children.end(), child.children.begin(), child.children.end());
      child = {};  // without columns: it is gone
    }
  }
}

}  // namespace

template <int Size>
Neighbours neighbours_in(const BlockMatrix<Size>& matrix) {
  Neighbours rows(matrix.rows());
  for (int i = 0; i < matrix.rows(); ++i)
    for (int p = matrix.first[i]; p < matrix.first[i + 1]; ++p)
      if (const int j = matrix.column[p]; j != i) {
        rows[i].push_back(j);
        rows[j].push_back(i);
      }
  for (std::vector<int>& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  return rows;
}

template Neighbours neighbours_in<3>(const BlockMatrix<3>&);
template Neighbours neighbours_in<6>(const BlockMatrix<6>&);

std::vector<int> minimum_degree(const Neighbours& rows) {
  const int count = static_cast<int>(rows.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) {
    entries.emplace_back(i, i, 1);  // a row without its own column would go to the end
    for (const int j : rows[i])
      entries.emplace_back(i, j, 1);
  }
  Eigen::SparseMatrix<double> graph(count, count);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType permutation;
  Eigen::AMDOrdering<int>()(graph, permutation);
  return {permutation.indices().data(), permutation.indices().data() + count};
}

Neighbours lower_pattern(const Neighbours& rows, const std::vector<int>& order, double most) {
  const int count = static_cast<int>(rows.size());
  std::vector<int> place(count), parent(count, -1), met(count, -1);
  for (int i = 0; i < count; ++i)
    place[order[i]] = i;
  Neighbours lower(count);
  std::vector<double> below(count, 0);  // by column: blocks so far
  double products = 0;                  // the sum of their squares
  for (int i = 0; i < count; ++i) {
    met[i] = i;
    for (const int neighbour : rows[order[i]])
      for (int k = place[neighbour]; k < i && met[k] != i; k = parent[k]) {
        met[k] = i;
        lower[i].push_back(k);
        products += 2 * below[k]++ + 1;
        if (parent[k] < 0) parent[k] = i;
      }
    if (products > most) return {};
    std::sort(lower[i].begin(), lower[i].end());
  }
  return lower;
}

EliminationPlan::EliminationPlan(const Neighbours& rows) {
  const std::vector<int> by_degree = minimum_degree(rows);
  std::vector<Merged> nodes = single_columns(lower_pattern(rows, by_degree, std::numeric_limits<double>::infinity()));
  merge(nodes);

  // children before parents, each subtree together: the work beside the factors is then a stack
  std::vector<int> place(rows.size()), number(nodes.size(), -1);
  struct Visit {
    int node;
    std::size_t child;
  };
  std::vector<Visit> path;
  for (int root = 0; root < static_cast<int>(nodes.size()); ++root) {
    if (nodes[root].columns.empty() || !nodes[root].below.empty()) continue;
    path.push_back({root, 0});
    while (!path.empty()) {
      Visit& visit = path.back();
      const Merged& node = nodes[visit.node];
      if (visit.child < node.children.size()) {
        path.push_back({node.children[visit.child++], 0});
        continue;
      }
      number[visit.node] = static_cast<int>(supernodes.size());
      supernodes.push_back({static_cast<int>(order.size()), static_cast<int>(node.columns.size()), node.below});
      for (const int column : node.columns) {
        place[column] = static_cast<int>(order.size());
        order.push_back(by_degree[column]);
      }
      path.pop_back();
    }
  }
  parent.assign(supernodes.size(), -1);
  for (std::size_t at = 0; at < nodes.size(); ++at)
    for (const int child : nodes[at].children)
      parent[number[child]] = number[at];
  for (Supernode& node : supernodes) {
    for (int& row : node.below)
      row = place[row];
    std::sort(node.below.begin(), node.below.end());
  }
}

EliminationPlan::Cost EliminationPlan::cost(int block_size, bool symmetric) const {
  Cost cost;
  double waiting = 0, peak = 0, widest = 0;  // numbers: of updates that no parent has taken yet; of a front
  std::vector<double> of_children(supernodes.size(), 0);
  for (std::size_t at = 0; at < supernodes.size(); ++at) {
    const double columns = block_size * static_cast<double>(supernodes[at].columns),
                 below = block_size * static_cast<double>(supernodes[at].below.size()), all = columns + below;
    cost.entries += columns * all + (symmetric ? 0 : columns * below);
    for (double rest = all - 1; rest >= below; --rest)
      cost.operations += rest + (symmetric ? rest * (rest + 1) : 2 * rest * rest);
    widest = std::max(widest, all * all);
    waiting += below * below - of_children[at];
    peak = std::max(peak, waiting);
    if (parent[at] >= 0) of_children[parent[at]] += below * below;
  }
  cost.bytes = sizeof(double) * (cost.entries + widest + peak);
  return cost;
}

}  // namespace voussoir
