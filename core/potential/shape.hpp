// A potential particle (Houlsby 2009; Boon 2013, appendix A): a convex body as one function of planes, rounded where
// they meet. Eq. A.2 (Eq. A.1 over squares of lengths), its constants added up to one:
//   f(x) = (1 - k) Σ <a_i·x - d_i>² / r² + k |x - c|² / R² - 1,   <s> = max(s, 0);
// inside f < 0, on the surface f = 0. f is convex and once differentiable; its second derivative jumps when the point
// passes a plane.
#pragma once

#include "core/geometry/half_space.hpp"

namespace voussoir {

// In the body's frame. At k = 0 each face is r outside its plane; at k = 1 the planes do not count and the body is
// the sphere. The thesis' c is the frame's origin; a body's frame starts at its centroid, which may be elsewhere.
template <int Dim>
struct PotentialShape {
  HalfSpaces<Dim> planes;                    // a_i (unit, outward) and d_i
  double corner_radius = 0;                  // r > 0, m
  double sphericity = 0;                     // k, 0..1
  double sphere_radius = 0;                  // R > 0, m: the sphere encloses the body
  Vector<Dim> centre = Vector<Dim>::Zero();  // c, m: lies inside the body
};

// A particle in a chosen frame, with the weights of a sum: f = plane_weight Σ <a_i·x - d_i>² + sphere_weight
// |x - centre|² - 1. Its memory is kept from one placing to the next.
template <int Dim>
struct PlacedPotential {
  HalfSpaces<Dim> planes;                    // none if k = 1
  double plane_weight = 0;                   // (1 - k) / r², 1/m²
  double sphere_weight = 0;                  // k / R², 1/m²
  Vector<Dim> centre = Vector<Dim>::Zero();  // of the sphere, m
  double reach = 0;                          // R, m
};

// `rotation` takes the body's frame to the chosen one, `origin` is the body's origin in it
template <int Dim>
void place(const PotentialShape<Dim>& shape, const Matrix<Dim>& rotation, const Vector<Dim>& origin,
           PlacedPotential<Dim>& placed);
// in its own frame
template <int Dim>
void place(const PotentialShape<Dim>& shape, PlacedPotential<Dim>& placed);
template <int Dim>
PlacedPotential<Dim> placed(const PotentialShape<Dim>& shape);

template <int Dim>
double value(const PlacedPotential<Dim>& potential, const Vector<Dim>& point);

// The gradient in 1/m, the Hessian in 1/m²: planes that the point lies on do not count.
template <int Dim>
struct PotentialDerivatives {
  double value = 0;
  double squares = 0;  // of the slacks, their sum, m²
  int planes = 0;      // beyond which the point lies
  Vector<Dim> gradient = Vector<Dim>::Zero();
  Matrix<Dim> hessian = Matrix<Dim>::Zero();
};
template <int Dim>
PotentialDerivatives<Dim> derivatives(const PlacedPotential<Dim>& potential, const Vector<Dim>& point);

// bound of the rounding of the value computed at the point, that of placing the planes included
template <int Dim>
double value_rounding(const PlacedPotential<Dim>& potential, const Vector<Dim>& point,
                      const PotentialDerivatives<Dim>& at);
template <int Dim>
double value_rounding(const PlacedPotential<Dim>& potential, const Vector<Dim>& point) {
  return value_rounding<Dim>(potential, point, derivatives<Dim>(potential, point));
}

}  // namespace voussoir
