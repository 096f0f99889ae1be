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
  double farthest = 0;                       // m: the largest offset so far, and
  double rise_there = 0;                     // m: the rise at it, of Barton and Bandis' law
};

// m: of Barton and Bandis' law, at an offset not beyond the farthest: asperities slide back on their faces
template <int Dim>
double rise_within(const JointRise<Dim>& rise, double offset) {
  return rise.farthest > 0 ? rise.rise_there * offset / rise.farthest : 0;
}

}  // namespace voussoir
