// The place of a joint at one point: beside its history, and only for joints whose laws depend on it.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

// Where a joint is against the place at which it was mated. It outlives the loss of contact while the pair is near, as
// a block that flies lands on the risen plane.
template <int Dim>
struct JointRise {
  Vector<Dim> offset = Vector<Dim>::Zero();  // m: plastic slip since, along the shear force on the second body
  Vector<Dim> normal = Vector<Dim>::Zero();  // of the step before, along which the joint has risen
  double rise = 0;                           // m
  double stress = 0;                         // Pa, normal, of the step before
  double largest_closure = 0;                // m, overlap and rise, of a law with irrecoverable closure
};

}  // namespace voussoir
