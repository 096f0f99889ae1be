// Rigid-block limit analysis (Livesley 1978): blocks are rigid, joints carry forces at the corners of faces (in the
// plane at the ends of interfaces) within Coulomb's exact cones, without tension. Forces in equilibrium within the
// cones are a lower bound of the supported load; the multipliers of the same cone program are the velocities of a
// mechanism, an upper bound. The mechanism opens a joint by tan(friction) of its slip (associated flow): both bounds
// enclose the factor of joints that dilate so. Of joints that do not dilate it is an upper bound of what they support.
#pragma once

#include <string>
#include <vector>

#include "core/limit/corner_cones.hpp"
#include "core/limit/evidence.hpp"

namespace voussoir {

// One limit state: forces that support the load, and velocities of the collapse mechanism.
template <int Dim>
struct LimitState {
  CornerForces<Dim> forces;                   // by face; empty if no forces support the load
  std::vector<double> tensions;               // N, by tie, likewise
  std::vector<BodyVelocity<Dim>> velocities;  // by body; zero for fixed ones; all zero if nothing collapses
};

template <int Dim>
Loads<Dim> loads_of_acceleration(const Model<Dim>& model, const Vector<Dim>& acceleration);  // m/s²
template <int Dim>
Loads<Dim> loads_of_applied_forces(const Model<Dim>& model, const std::vector<AppliedForce<Dim>>& forces);  // at 1

// m/s², the unit of weights: the largest load over its body's mass, a moment divided by the body's radius too
template <int Dim>
double acceleration_of(const Model<Dim>& model, const Loads<Dim>& loads);

template <int Dim>
struct LoadFactor {
  LimitStatus status = LimitStatus::found;
  double factor = 0;  // of the live load
  // Not empty: the load may be supported by normal forces which it does not require. At 0.99 of the factor these faces,
  // which move in the mechanism, can have self-stress, and without it the load is not supported.
  std::vector<int> self_stress;
  LimitState<Dim> state;
  Evidence evidence;
};

// The largest factor of the live loads that is supported together with the dead ones, with the friction and cohesion of
// the faces. The gap is that of the largest ratio of live load to a body's weight, relative to the larger of 1 and this
// ratio. Joints after Barton and Bandis have their peak envelope here and in a factor of safety.
template <int Dim>
LoadFactor<Dim> find_load_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live);

// The strength at which loads are just supported, between a stable and a collapsing one.
struct StrengthBracket {
  LimitStatus status = LimitStatus::found;
  double collapses = 0, stands = 0;  // friction angle in rad, or factor of safety
  double missing = 0;  // at `collapses`: the least sum of added forces, over their bodies' weights, for equilibrium
  std::vector<int> self_stress;  // as in LoadFactor, at 1.01 times the strength
  Evidence evidence;             // gap: of the missing force at `collapses`; out_of_balance at `stands`
};

template <int Dim>
struct CriticalStrength : StrengthBracket {
  LimitState<Dim> state;  // forces at `stands`, velocities at `collapses`
};

// The friction angle of the chosen faces at which the loads are just supported, to 1e-6 degrees. Those faces must not
// follow Barton and Bandis. Cohesion is unchanged.
template <int Dim>
CriticalStrength<Dim> find_critical_friction(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                             const std::vector<bool>& chosen);

// The factor of safety F: the loads are just supported if tan(friction) and cohesion of the chosen faces are divided by
// F, those of the others unchanged. To 1e-7 of itself; it is searched from 1e-3 (carries_nothing: not even a thousand
// times the strength is enough) to infinity (carries_any: no strength is needed).
template <int Dim>
CriticalStrength<Dim> find_factor_of_safety(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                            const std::vector<bool>& chosen);

// the faces with properties of these names; no name: all. Unknown names throw std::out_of_range with the name.
template <int Dim>
std::vector<bool> faces_of(const CornerAssembly<Dim>& assembly, const std::vector<std::string>& properties);

}  // namespace voussoir
