// The relative motion of the two bodies of a contact.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

template <int Dim>
struct PairMotion {
  Vector<Dim> between;  // m
  Vector<Dim> drift;    // m/s, of the second centroid relative to the first
  const Spin<Dim>&spin_a, &spin_b;
  double inverse_mass;  // of both together, 1/kg

  // of the second body relative to the first; `point` relative to the first one's centroid, `apart` from there to the
  // second one's
  [[gnu::always_inline]] Vector<Dim> velocity_at(const Vector<Dim>& point, const Vector<Dim>& apart) const {
    return drift + cross(spin_b, point - apart) - cross(spin_a, point);
  }
  [[gnu::always_inline]] Vector<Dim> velocity_at(const Vector<Dim>& point) const { return velocity_at(point, between); }
  // the position of the contact before the step
  [[gnu::always_inline]] Vector<Dim> velocity_before_at(const Vector<Dim>& point, double dt) const {
    return velocity_at(point, between - dt * drift);
  }
};

}  // namespace voussoir
