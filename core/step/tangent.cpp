#include "core/step/tangent.hpp"

namespace voussoir {
namespace {

template <int Dim>
using Block = typename PairStiffness<Dim>::Block;

// displacement at the second body's centroid due to the first body's motion
template <int Dim>
Block<Dim> lever(const Vector<Dim>& apart) {
  Block<Dim> j = Block<Dim>::Identity();
  for (int s = 0; s < spin_freedoms<Dim>; ++s)
    j.template block<Dim, 1>(0, Dim + s) = cross(Spin<Dim>(Spin<Dim>::Unit(s)), apart);
  return j;
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

}  // namespace

template <int Dim>
BlockMatrix<freedoms<Dim>> tangent_of(int threads, const std::vector<const PairStiffness<Dim>*>& pairs,
                                      const std::vector<Block<Dim>>& own, const std::vector<int>& place,
                                      const Eigen::VectorXd& free) {
  constexpr int F = freedoms<Dim>;
  using Entry = typename BlockMatrix<F>::Entry;
  std::vector<std::vector<Entry>> rows(free.size() / F);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].push_back({static_cast<int>(i), Block<Dim>::Zero()});
  const auto put = [&](int row, int column, const Block<Dim>& block) {
    if (row < 0 || column < 0) return;
    rows[row].push_back(
        {column, Block<Dim>(free.segment<F>(F * row).asDiagonal() * block * free.segment<F>(F * column).asDiagonal())});
  };
  for (const PairStiffness<Dim>* p : pairs) {
    const int a = place[p->body_a], b = place[p->body_b];
    const Block<Dim> j = lever<Dim>(p->apart);
    const Turning<Dim> t = turning_of(*p);
    put(b, b, p->stiffness);
    put(a, a, j.transpose() * p->stiffness * j + t.aa);
    put(a, b, -(j.transpose() * p->stiffness) + t.ab);
    put(b, a, -(p->stiffness * j) + t.ba);
  }
  for (std::size_t b = 0; b < own.size(); ++b)
    put(place[b], place[b], own[b]);
  BlockMatrix<F> k;
  k.assign(threads, rows);
  return k;
}

template BlockMatrix<freedoms<2>> tangent_of<2>(int, const std::vector<const PairStiffness<2>*>&,
                                                const std::vector<Block<2>>&, const std::vector<int>&,
                                                const Eigen::VectorXd&);
template BlockMatrix<freedoms<3>> tangent_of<3>(int, const std::vector<const PairStiffness<3>*>&,
                                                const std::vector<Block<3>>&, const std::vector<int>&,
                                                const Eigen::VectorXd&);

}  // namespace voussoir
