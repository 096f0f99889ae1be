// Whether numbers make a potential particle, and if not, by name, why.
#pragma once

#include <string>

#include "core/potential/shape.hpp"

namespace voussoir {

enum class ShapeProblem {
  none,
  not_finite,              // a number is infinite or not a number
  corner_radius,           // r is not positive
  sphericity,              // k is outside 0 to 1
  sphere_radius,           // R is not positive
  no_planes,               // k < 1 needs planes
  normal_not_unit,         // a plane's normal
  open,                    // the planes leave a direction open, so that no R encloses what they make
  no_inside,               // no point has f < 0
  centre_outside,          // f has an inside, but the sphere's centre lies outside it
  sphere_does_not_enclose  // R is smaller than what planes and r make
};

struct ShapeVerdict {
  ShapeProblem problem = ShapeProblem::none;
  int plane = -1;    // the first plane concerned, where one is
  double least = 0;  // m: for sphere_does_not_enclose an R that does
  bool ok() const { return problem == ShapeProblem::none; }
};

template <int Dim>
ShapeVerdict check_shape(const PotentialShape<Dim>& shape);

// a sentence that says what is wrong, what is allowed and what to do
template <int Dim>
std::string describe(const ShapeVerdict& verdict, const PotentialShape<Dim>& shape);

// The radius of the smallest sphere around `centre` that encloses Σ <a_i·x - d_i>² <= r²; infinite where the planes are
// open, 0 where that set is empty. The farthest point lies near a corner of the planes moved out by r: from each of
// them |x - centre| is climbed by supports. Right to rounding where each corner's climb ends at its own farthest point,
// else too small, so that a refusal for its sake is always justified.
template <int Dim>
double enclosing_radius(const HalfSpaces<Dim>& planes, double corner_radius, const Vector<Dim>& centre);

}  // namespace voussoir
