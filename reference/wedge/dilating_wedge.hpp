#pragma once

#include <functional>

#include "reference/wedge/wedge.hpp"

// A rigid wedge that slides on both planes while its joints dilate. It moves along v, which leaves each plane by that
// plane's dilation, v·n = sin ψ; shear acts against the part of v in the plane, τ = σ tan φ/F. The three equations of
// equilibrium have three unknowns, both normal forces and F. Without dilation v is the line of intersection. Strength
// and dilation may depend on the normal stress.
namespace voussoir::reference {

struct DilatingJoint {
  std::function<double(double stress)> tan_friction, dilation;  // 1, rad
};

struct DilatingWedge {
  Wedge wedge;  // its planes' angles and its weight; friction, cohesion and water do not count
  double area_a = 1, area_b = 1;
  DilatingJoint joint;
};

struct DilatingSolution {
  double factor_of_safety = 0;
  double stress_a = 0, stress_b = 0;
  Vector3 direction{};  // unit, of the motion
};

// By substitution, to rounding. Throws std::invalid_argument if a normal force is not pressure.
DilatingSolution solve_dilating_wedge(const DilatingWedge& wedge);

}  // namespace voussoir::reference
