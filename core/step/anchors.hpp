// A spring between anchors in two bodies.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// positions of a spring's two anchors, world axes, m
template <int Dim>
struct Stretched {
  Vector<Dim> apart;         // distance vector of its anchors
  Vector<Dim> arm_a, arm_b;  // of the second anchor from each centroid

  template <class Spring>
  Stretched(const BodiesState<Dim>& bodies, const Spring& spring) {
    const CachedPose<Dim>&a = bodies.poses[spring.body_a], &b = bodies.poses[spring.body_b];
    arm_b = b.axes * spring.place_b;
    arm_a = between(a, b) + arm_b;
    apart = arm_a - a.axes * spring.place_a;
  }
};

// change of a force on the second body at a spring's second anchor, world axes
template <int Dim>
PairStiffness<Dim> pair_of(const BodiesState<Dim>& bodies, int body_a, int body_b, const Vector<Dim>& arm_b,
                           const Matrix<Dim>& k, const Vector<Dim>& force) {
  constexpr int S = spin_freedoms<Dim>;
  PairStiffness<Dim> pair;
  pair.contact = -1;
  pair.body_a = body_a;
  pair.body_b = body_b;
  pair.apart = between(bodies.poses[body_a], bodies.poses[body_b]);
  pair.wrench.template head<Dim>() = force;
  pair.wrench.template tail<S>() = moment(arm_b, force);
  for (int f = 0; f < freedoms<Dim>; ++f) {
    // displacement of the second anchor as the second body moves along this degree of freedom
    const Vector<Dim> way =
        f < Dim ? Vector<Dim>(Vector<Dim>::Unit(f % Dim)) : cross(Spin<Dim>(Spin<Dim>::Unit((f + S - Dim) % S)), arm_b);
    const Vector<Dim> lost = k * way;
    pair.stiffness.template block<Dim, 1>(0, f) = lost;
    pair.stiffness.template block<S, 1>(Dim, f) = moment(arm_b, lost);
    if (f >= Dim) pair.stiffness.template block<S, 1>(Dim, f) -= moment(way, force);
  }
  return pair;
}

}  // namespace voussoir
