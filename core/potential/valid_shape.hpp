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
  open,                    // the planes leave a direction open, so that no R encloses the body
  no_inside,               // no point has f < 0
  centre_outside,          // f has an inside, but the sphere's centre lies outside it
  sphere_does_not_enclose  // R is smaller than the body of planes and r
};

struct ShapeVerdict {
  ShapeProblem problem = ShapeProblem::none;
  int plane = -1;    // the first plane concerned, if any
  double least = 0;  // m: for sphere_does_not_enclose an R that does
  bool ok() const { return problem == ShapeProblem::none; }
};

template <int Dim>
ShapeVerdict check_shape(const PotentialShape<Dim>& shape);

// a sentence with the error, the permitted values and the repair
template <int Dim>
std::string describe(const ShapeVerdict& verdict, const PotentialShape<Dim>& shape);

// The radius of the smallest sphere around `centre` that encloses Σ <a_i·x - d_i>² <= r²; infinite if the planes are
// open, 0 if that set is empty. The farthest point lies near a corner of the planes moved out by r: from each of them
// |x - centre| is increased by supports. Exact to rounding if the ascent from each corner ends at its own farthest
// point, else too small, so that a refusal based on it is always justified.
template <int Dim>
double enclosing_radius(const HalfSpaces<Dim>& planes, double corner_radius, const Vector<Dim>& centre);

}  // namespace voussoir
