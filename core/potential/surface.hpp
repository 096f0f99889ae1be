// The point at which a ray leaves a potential particle.
#pragma once

#include "core/potential/shape.hpp"

namespace voussoir {

// t > 0 with f(point + t direction) = 0, to rounding of the coordinates; the point lies inside, f < 0, the direction
// has any length but 0. By bracketing, Eq. 3.37: along the ray f is a sequence of parabolas; the root of the one at
// hand is the next t, or the interval's middle if it is outside the interval, until t moves by rounding.
template <int Dim>
double distance_to_surface(const PlacedPotential<Dim>& potential, const Vector<Dim>& point,
                           const Vector<Dim>& direction);

}  // namespace voussoir
