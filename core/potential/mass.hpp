// Volume, centroid and second moment of a potential particle.
#pragma once

#include "core/geometry/polytope.hpp"
#include "core/potential/shape.hpp"

namespace voussoir {

template <int Dim>
struct PotentialMass {
  MassProperties<Dim> mass;  // about the body's origin, per unit density
  // Bound of the errors of volume, centroid and second moment, as a fraction of the volume times powers of the half
  // extents along the axes, as derived below.
  double error = 0;
  long long cells = 0;
};

// Rays from the centre through the faces of a cube as wide as the body measure the distance of the surface; in pyramids
// over cells of the faces the integrals are those of powers of that distance, by Gauss's rule of three points in each
// direction over the cell's halves (quarters in space). The error of a cell is at most:
// - if every plane counts on all of its surface or on none of it, the difference from the rule on the undivided cell:
//   the distance is an analytic function, and that rule's error is some 16 times as large (64 in space);
// - otherwise, the volume between the surface's chords and a plane that touches it: the body is convex, so that its
//   surface is between them, even if the rays have missed features, an edge as thin as r included.
// Whether a plane counts is decided at the corners of that enclosure, for all points between them. The worst cell is
// divided next until the sum, which is `error`, is below `tolerance` of the volume, or there are `cell_limit` cells.
template <int Dim>
PotentialMass<Dim> integrate(const PotentialShape<Dim>& shape, double tolerance, long long cell_limit = 1000000);

}  // namespace voussoir
