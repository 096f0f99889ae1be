// A part of a body that is a potential particle, and the form of a part of half-spaces that meets one.
#pragma once

#include <memory>

#include "core/potential/drawing.hpp"
#include "core/potential/mass.hpp"

namespace voussoir {

// Points are seen from the part's `centre` (Polytope), along the body's axes: a motion of the part moves them.
template <int Dim>
struct Particle {
  PotentialShape<Dim> shape;
  bool inner = false;             // represents a part of half-spaces, and lies within it
  double steepness = 0;           // 1/m: sqrt(f + 1) changes by no more than this times the distance, anywhere
  PotentialMass<Dim> mass;        // per unit density; none of an inner one
  PotentialDrawing<Dim> drawing;  // nor of an inner one
};

template <int Dim>
Particle<Dim> make_particle(const PotentialShape<Dim>& shape);

// Volume, centroid and second moment: closed forms of a sphere, else `integrate`. A scene has many particles of few
// shapes: the last ones are kept.
template <int Dim>
PotentialMass<Dim> mass_of(const PotentialShape<Dim>& shape, double tolerance);

// The inner potential particle of a part of half-spaces (Boon 2013, 3.3.4): its planes moved in by r, a fraction of the
// inscribed radius, and k = 0, so that f = 0 on its faces. Only an edge is rounded: between two faces at an inner angle
// θ it recedes by (1 - sqrt(1/2)) r / sin(θ/2).
template <int Dim>
Particle<Dim> inner_particle(const Polytope<Dim>& part, double fraction);

// whether the part itself is one
template <int Dim>
bool is_particle(const Polytope<Dim>& part) {
  return part.particle && !part.particle->inner;
}

// m: lower bound of the distance of a point of the body's frame from a particle; at most 0 inside
template <int Dim>
double outside_by(const Polytope<Dim>& part, const Vector<Dim>& point);

}  // namespace voussoir
