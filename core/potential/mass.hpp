// Volume, centroid and second moment of a potential particle.
#pragma once

#include "core/geometry/polytope.hpp"
#include "core/potential/shape.hpp"

namespace voussoir {

template <int Dim>
struct PotentialMass {
  MassProperties<Dim> mass;  // about the body's origin, per unit density
  // What volume, centroid and second moment may be off by, as a fraction of the volume times powers of the half extents
  // along the axes: a bound as derived below.
  double error = 0;
  long long cells = 0;
};

// Rays from the centre through the faces of a cube as wide as the body measure how far the surface lies; in pyramids
// over cells of the faces the integrals are those of powers of that distance, by Gauss's rule of three points each way
// over the cell's halves (quarters in space). What a cell may be off by:
// - where every plane counts on all of its surface or on none of it, the distance is an analytic function, and the rule
// on
//   the whole cell, which is off by some 16 times as much (64 in space), differs from the one that is kept by no less;
// - elsewhere, the volume between the surface's chords and a plane that touches it: the body is convex, so that its
//   surface lies between them whatever the rays have missed, an edge as thin as r included.
// Whether a plane counts is decided at the corners of that enclosure, for all points between them. The worst cell is
// divided next until the sum, which is `error`, is below `tolerance` of the volume, or there are `cell_limit` cells.
template <int Dim>
PotentialMass<Dim> integrate(const PotentialShape<Dim>& shape, double tolerance, long long cell_limit = 1000000);

}  // namespace voussoir
