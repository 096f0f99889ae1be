// How far a potential particle reaches in a direction: its bounding box.
#pragma once

#include "core/potential/descent.hpp"

namespace voussoir {

template <int Dim>
struct Support {
  bool converged = false;
  Vector<Dim> point = Vector<Dim>::Zero();  // of the surface, farthest along the direction, to rounding
  double bound = 0;  // m: no point of the body has a larger direction·x; proven but for rounding
  int iterations = 0;
};

// direction: unit. max direction·x subject to f(x) <= 0, by the multiplier: f - τ direction·x is least on the surface.
template <int Dim>
Support<Dim> find_support(const PlacedPotential<Dim>& potential, const Vector<Dim>& direction, RayScratch& scratch);

template <int Dim>
struct PotentialBox {
  Vector<Dim> low, high;  // m; no point of the body lies outside
};

// in the frame in which the potential is placed
template <int Dim>
PotentialBox<Dim> bounding_box(const PlacedPotential<Dim>& potential, RayScratch& scratch);

}  // namespace voussoir
