// What a search of limit analysis varies: the friction angle of some faces, or the part of their strength that is left.
#pragma once

#include <functional>
#include <vector>

#include "core/limit/corner_cones.hpp"

namespace voussoir {

template <int Dim>
struct Strength {
  double strongest;          // of the measure, from 0 up
  double tolerance;          // width of its bracket
  std::vector<bool> chosen;  // faces
  std::function<void(double at, CornerAssembly<Dim>& trial)> weaken;
  // the change of what is missing (Shortfall) with the measure
  std::function<double(double at, const std::vector<Sensitivity>& of_faces)> slope;
};

// The measure is the friction angle, rad.
template <int Dim>
Strength<Dim> friction_of(const std::vector<bool>& chosen);

// The measure is s/(1 + s) with s = 1/F the part of tan φ and cohesion that is left: all factors F from 1e-3 to
// infinity have one of at most 1000/1001. Refers to the assembly.
template <int Dim>
Strength<Dim> remaining_strength(const CornerAssembly<Dim>& assembly, const std::vector<bool>& chosen);

double factor_at(double remaining_strength);  // F

}  // namespace voussoir
