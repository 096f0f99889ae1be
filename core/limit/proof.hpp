// Both bounds of a load factor, proved without rounding: forces within the cones whose sum with the loads is exactly
// zero, and velocities that close no joint. Both enclose the factor of joints that dilate as they slip. Of joints that
// do not dilate the upper bound remains one; the forces of the lower one need not be those of such joints.
#pragma once

#include "core/limit/exact_balance.hpp"

namespace voussoir {

// The statement is about `assembly`, whose places are multiples of a power of two, within 1e-13 of the largest
// coordinate of the given ones. Friction is the double `tangents`, |T| <= tangent N + cohesion of the corner.
template <int Dim>
struct LimitProof {
  CornerAssembly<Dim> assembly;
  Loads<Dim> dead, live;
  std::vector<double> tangents;               // by face
  std::vector<std::vector<double>> cohesion;  // by face and corner, N

  std::optional<double> lower;     // the forces balance dead + lower · live
  std::optional<double> upper;     // the power of the velocities against dead + upper · live is not positive
  std::string no_lower, no_upper;  // why, if there is none
  BalancedForces<Dim> forces;      // of `lower`
  std::vector<BodyVelocity<Dim>> velocities;  // of `upper`

  double share = 0;         // in the velocities: of those that open every joint, besides the mechanism's own
  bool still_held = false;  // bodies that hardly move in the mechanism were held to find them
  int programs = 0;         // solved

  bool proved() const { return lower && upper; }
};

// Of a found factor of joints with straight cones. The lower bound is 1e-6 of the factor below it (of a body's weight
// if the load is smaller), or up to 1e-2 if the forces there cannot be balanced.
template <int Dim>
LimitProof<Dim> prove_load_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live,
                                  const LoadFactor<Dim>& found);

}  // namespace voussoir
