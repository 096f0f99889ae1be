// What acts on a body.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

// what acts on a body
template <int Dim>
struct Load {
  Vector<Dim> force = Vector<Dim>::Zero();  // N
  Spin<Dim> moment = Spin<Dim>::Zero();     // N m about the centroid

  Load& operator+=(const Load& more);
};

// What a load adds to the stiffness of a body, at most, for the time step.
struct BodyStiffness {
  double translation = 0;  // N/m
  double rotation = 0;     // N m/rad
};

// a force that keeps its size and direction while the body moves
template <int Dim>
struct DeadLoad {
  Vector<Dim> place = Vector<Dim>::Zero();  // where it acts, body frame, m
  Vector<Dim> force = Vector<Dim>::Zero();  // world axes, N (2-D: N/m)
};

// on a body whose frame is `axes`
template <int Dim>
Load<Dim> load_of(const DeadLoad<Dim>& load, const Matrix<Dim>& axes);

}  // namespace voussoir
