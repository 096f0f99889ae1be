// Loads on a body.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

// force and moment on a body
template <int Dim>
struct Load {
  Vector<Dim> force = Vector<Dim>::Zero();  // N
  Spin<Dim> moment = Spin<Dim>::Zero();     // N m about the centroid

  Load& operator+=(const Load& more);
};

// Upper bound of a load's part in the stiffness of a body, for the time step.
struct BodyStiffness {
  double translation = 0;  // N/m
  double rotation = 0;     // N m/rad
};

// a force that keeps its size and direction while the body moves
template <int Dim>
struct DeadLoad {
  Vector<Dim> place = Vector<Dim>::Zero();  // point of action, body frame, m
  Vector<Dim> force = Vector<Dim>::Zero();  // world axes, N (2-D: N/m)
};

// as it acts on a body whose frame is `axes`
template <int Dim>
Load<Dim> load_of(const DeadLoad<Dim>& load, const Matrix<Dim>& axes);

}  // namespace voussoir
