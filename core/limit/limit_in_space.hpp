// Rigid-block limit analysis in space: forces at the corners of faces within Coulomb's exact cones, by cone programs.
// Joints dilate as they slip (associated flow), as in the plane (limit.hpp): forces and mechanism enclose the factor of
// such joints. Of joints that do not dilate the factor is an upper bound of what they support.
#pragma once

#include <string>
#include <vector>

#include "core/limit/corner_cones.hpp"
#include "core/limit/limit.hpp"

namespace voussoir {

struct LimitStateInSpace {
  CornerForces forces;                    // by face; empty if no forces support the load
  std::vector<MotionInSpace> velocities;  // by body; all zero if nothing collapses
};

struct LoadFactorInSpace {
  LimitStatus status = LimitStatus::found;
  double factor = 0;
  LimitStateInSpace state;
  Evidence evidence;
};

// The largest factor of the live loads that is supported together with the dead ones. Loads are by body.
LoadFactorInSpace find_load_factor(const CornerAssembly& assembly, const std::vector<Load<3>>& dead,
                                   const std::vector<Load<3>>& live);

struct CriticalStrengthInSpace : StrengthBracket {
  LimitStateInSpace state;  // forces at `stands`, velocities at `collapses`
};

// The friction angle of the chosen faces at which the loads are just supported, to 3e-6 degrees.
CriticalStrengthInSpace find_critical_friction(const CornerAssembly& assembly, const std::vector<Load<3>>& loads,
                                               const std::vector<bool>& chosen);

// The factor that divides tan φ and cohesion of the chosen faces when the loads are just supported.
CriticalStrengthInSpace find_factor_of_safety(const CornerAssembly& assembly, const std::vector<Load<3>>& loads,
                                              const std::vector<bool>& chosen);

// m/s², the unit of weights: the largest load over its body's mass
double acceleration_of(const Model<3>& model, const std::vector<Load<3>>& loads);

}  // namespace voussoir
