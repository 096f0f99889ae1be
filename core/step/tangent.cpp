#include "core/step/tangent.hpp"

#include <utility>

#include "core/base/on_threads.hpp"

namespace voussoir {
namespace {

template <int Dim>
using Block = typename PairStiffness<Dim>::Block;

// displacement at the second body's centroid due to the first body's turns
template <int Dim>
FixedMatrix<Dim, spin_freedoms<Dim>> lever_of(const Vector<Dim>& apart) {
  FixedMatrix<Dim, spin_freedoms<Dim>> lever;
  for (int s = 0; s < spin_freedoms<Dim>; ++s)
    lever.col(s) = cross(Spin<Dim>(Spin<Dim>::Unit(s)), apart);
  return lever;
}

// The forces rotate with the first body and keep their lines of action: the contribution to the two blocks of its
// column, and to the first body's row in the second's column.
template <int Dim>
struct Turning {
  Block<Dim> aa = Block<Dim>::Zero(), ba = Block<Dim>::Zero(), ab = Block<Dim>::Zero();
};

template <int Dim>
Turning<Dim> turning_of(const PairStiffness<Dim>& p) {
  constexpr int S = spin_freedoms<Dim>;
  Turning<Dim> t;
  const Vector<Dim> force = p.wrench.template head<Dim>();
  for (int s = 0; s < S; ++s) {
    const Spin<Dim> e = Spin<Dim>::Unit(s);
    const Vector<Dim> change = cross(e, force);
    Spin<Dim> couple = Spin<Dim>::Zero();
    if constexpr (Dim == 3) couple = e.cross(Vector<3>(p.wrench.template tail<3>()));
    t.ba.template block<Dim, 1>(0, Dim + s) = -change;
    t.ba.template block<S, 1>(Dim, Dim + s) = -couple;
    t.aa.template block<Dim, 1>(0, Dim + s) = change;
    t.aa.template block<S, 1>(Dim, Dim + s) = couple + moment(p.apart, change);
  }
  for (int k = 0; k < Dim; ++k) {
    const Spin<Dim> couple = moment(Vector<Dim>(Vector<Dim>::Unit(k)), force);
    t.ab.template block<S, 1>(Dim, k) = couple;
    t.aa.template block<S, 1>(Dim, k) = -couple;
  }
  return t;
}

// The blocks of one pair. The lever J of its first body is the identity but for its upper right corner L.
template <int Dim>
struct PairBlocks {
  static constexpr int S = spin_freedoms<Dim>;
  const PairStiffness<Dim>& pair;
  FixedMatrix<Dim, S> lever;

  explicit PairBlocks(const PairStiffness<Dim>& p) : pair(p), lever(lever_of<Dim>(p.apart)) {}

  Block<Dim> times_lever() const {  // K J
    Block<Dim> product = pair.stiffness;
    product.template rightCols<S>() += pair.stiffness.template leftCols<Dim>().lazyProduct(lever);
    return product;
  }
  Block<Dim> lever_times(const Block<Dim>& k) const {  // J' K
    Block<Dim> product = k;
    product.template bottomRows<S>() += lever.transpose().lazyProduct(k.template topRows<Dim>());
    return product;
  }
};

}  // namespace

template <int Dim>
void find_tangent(int threads, const std::vector<const PairStiffness<Dim>*>& pairs, const std::vector<Block<Dim>>& own,
                  const std::vector<int>& place, const Eigen::VectorXd& free, BlockMatrix<freedoms<Dim>>& k) {
  constexpr int F = freedoms<Dim>;
  const std::size_t count = free.size() / F;
  std::vector<std::vector<int>> pairs_of(count), columns(count);
  for (int k = 0; k < static_cast<int>(pairs.size()); ++k) {
    const int a = place[pairs[k]->body_a], b = place[pairs[k]->body_b];
    if (a >= 0) pairs_of[a].push_back(k);
    if (b >= 0) pairs_of[b].push_back(k);
    if (a < 0 || b < 0) continue;
    columns[a].push_back(b);
    columns[b].push_back(a);
  }
  k.lay_out(std::move(columns));
  const bool all_free = free.size() > 0 && free.minCoeff() > 0;
  // each row by itself: no two threads write to one block, and sums are in the order of the pairs
  each_on_threads(threads, count, [&](int row) {
    const auto put = [&](int column, const Block<Dim>& block) {
      Block<Dim>& to = k.at(row, column);
      if (all_free)
        to += block;
      else
        to += free.segment<F>(F * row).asDiagonal() * block * free.segment<F>(F * column).asDiagonal();
    };
    for (const int p : pairs_of[row]) {
      const PairBlocks<Dim> of(*pairs[p]);
      const Turning<Dim> turning = turning_of(*pairs[p]);
      const int a = place[pairs[p]->body_a], b = place[pairs[p]->body_b];
      if (b == row) {
        put(b, pairs[p]->stiffness);
        if (a >= 0) put(a, turning.ba - of.times_lever());
      } else {
        put(a, of.lever_times(of.times_lever()) + turning.aa);
        if (b >= 0) put(b, turning.ab - of.lever_times(pairs[p]->stiffness));
      }
    }
  });
  for (std::size_t b = 0; b < own.size(); ++b)
    if (const int i = place[b]; i >= 0)
      k.at(i, i) += free.segment<F>(F * i).asDiagonal() * own[b] * free.segment<F>(F * i).asDiagonal();
}

template void find_tangent<2>(int, const std::vector<const PairStiffness<2>*>&, const std::vector<Block<2>>&,
                              const std::vector<int>&, const Eigen::VectorXd&, BlockMatrix<freedoms<2>>&);
template void find_tangent<3>(int, const std::vector<const PairStiffness<3>*>&, const std::vector<Block<3>>&,
                              const std::vector<int>&, const Eigen::VectorXd&, BlockMatrix<freedoms<3>>&);

}  // namespace voussoir
