// Where a ray leaves a potential particle.
#pragma once

#include "core/potential/shape.hpp"

namespace voussoir {

// t > 0 with f(point + t direction) = 0, to rounding; the point lies inside, f < 0, the direction has any length but 0.
// By bracketing, Eq. 3.37: the interval shrinks until it holds no other number, or until Newton's method on sqrt(f +
// 1), which is convex along the ray and falls to the root from outside, moves by rounding.
template <int Dim>
double distance_to_surface(const PlacedPotential<Dim>& potential, const Vector<Dim>& point,
                           const Vector<Dim>& direction);

}  // namespace voussoir
