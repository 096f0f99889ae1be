// Seeded pairs of potential particles that touch, or nearly, at a depth that is known without a solution.
#pragma once

#include "core/potential/contact.hpp"
#include "core/potential/support.hpp"
#include "core/potential/valid_shape.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::shapes {

template <int Dim>
struct PotentialCase {
  PotentialShape<Dim> a, b;
  Matrix<Dim> rotation;
  Vector<Dim> offset, normal;  // the surfaces' extreme points along the normal overlap by `depth`
  double depth;                // m; negative: a gap
  PotentialPair<Dim> pair() const { return {&a, &b, rotation, offset}; }
};

// Size 1: a random polyhedron whose half extents are 1 and down to 1/aspect; r 1e-4 to 0.5; k from `least_k` to 1, one
// in eight a sphere; R the enclosing radius, up to a fifth more.
template <int Dim>
PotentialShape<Dim> random_potential(Random& random, double least_k) {
  PotentialShape<Dim> shape;
  HalfSpaces<Dim> planes = random_planes<Dim>(random, integer(random, 0, 12), 1);
  Vector<Dim> extent = Vector<Dim>::Ones();
  for (int k = 1; k < Dim; ++k)
    extent[k] = power_of_ten(random, -std::log10(20.0), 0);
  for (HalfSpace<Dim>& plane : planes) {
    const Vector<Dim> normal = plane.normal.cwiseQuotient(extent);
    plane = {normal.normalized(), plane.offset / 1.2 / normal.norm()};
  }
  shape.planes = planes;
  shape.corner_radius = power_of_ten(random, -4, std::log10(0.5));
  shape.sphericity = integer(random, 0, 7) == 0 ? 1 : least_k > 0 ? power_of_ten(random, std::log10(least_k), 0) : 0;
  shape.sphere_radius =
      uniform(random, 1, 1.2) * enclosing_radius<Dim>(shape.planes, shape.corner_radius, Vector<Dim>::Zero());
  return shape;
}

// The second particle is turned at random and put where its farthest point against a random direction is `depth` short
// of the first one's farthest point along it.
template <int Dim>
PotentialCase<Dim> random_potential_case(Random& random, double least_k) {
  PotentialCase<Dim> c;
  c.a = random_potential<Dim>(random, least_k);
  c.b = random_potential<Dim>(random, least_k);
  c.rotation = matrix(orientation<Dim>(random));
  c.normal = direction<Dim>(random);
  c.depth = power_of_ten(random, -9, -1) * (integer(random, 0, 3) == 0 ? -1 : 1);
  RayScratch scratch;
  PlacedPotential<Dim> turned;
  place<Dim>(c.b, c.rotation, Vector<Dim>::Zero(), turned);
  const Vector<Dim> of_a = find_support<Dim>(placed<Dim>(c.a), c.normal, scratch).point;
  const Vector<Dim> of_b = find_support<Dim>(turned, -c.normal, scratch).point;
  c.offset = of_a - of_b - c.depth * c.normal;
  return c;
}

}  // namespace voussoir::shapes
