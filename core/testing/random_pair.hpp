#pragma once

#include "core/testing/shapes.hpp"

namespace voussoir::shapes {

// two random parts a distance apart: they overlap, nearly touch or are separate
template <int Dim>
HalfSpaces<Dim> random_pair(Random& random, int extra) {
  HalfSpaces<Dim> planes = random_planes<Dim>(random, extra, 0.5);
  const Vector<Dim> shift = uniform(random, 0.8, 1.7) * direction<Dim>(random);
  for (const HalfSpace<Dim>& p :
       placed<Dim>(random_planes<Dim>(random, extra, 0.5), matrix(orientation<Dim>(random)), shift))
    planes.push_back(p);
  return planes;
}

}  // namespace voussoir::shapes
