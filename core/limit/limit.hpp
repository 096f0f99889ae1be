// Rigid-block limit analysis of a 2-D assembly (Livesley 1978): blocks are rigid, a joint carries normal and shear
// forces at the two ends of every interface, within Coulomb's cone and without tension. An equilibrium within the cone
// gives a lower bound of the supported load; the multipliers of the same linear program are the velocities of a
// mechanism. The mechanism opens a joint by tan(friction) of its slip (associated flow), so that the result is an upper
// bound for blocks that slip without opening: if blocks topple it may be several degrees unsafe.
#pragma once

#include <string>
#include <vector>

#include "core/limit/evidence.hpp"
#include "core/limit/interfaces.hpp"
#include "core/limit/linear_program.hpp"
#include "core/load/load.hpp"

namespace voussoir {

// the force at one end of an interface, on body_b
struct EndForce {
  double normal = 0;  // N (per metre of thickness), pressure positive
  double shear = 0;   // N, along the normal rotated by a right angle, counter-clockwise
};

// velocities of a mechanism: only their ratios have a meaning. For the fastest body, the speed of the centroid plus
// that of the farthest corner about it is 1.
struct BodyVelocity {
  Vector<2> velocity = Vector<2>::Zero();  // of the centroid
  double spin = 0;                         // 1/m, counter-clockwise
};

// One limit state: forces that support the load, and velocities of the collapse mechanism.
struct LimitState {
  std::vector<std::array<EndForce, 2>> forces;  // by interface; empty if no forces support the load
  std::vector<BodyVelocity> velocities;         // by body; zero for fixed ones; all zero if nothing collapses
};

struct LoadFactor {
  LimitStatus status = LimitStatus::found;
  double factor = 0;         // of the live load
  bool self_stress = false;  // as in CriticalStrength
  LimitState state;
  Evidence evidence;
};

// Loads on each body, by id, in the reference configuration.
using Loads = std::vector<Load<2>>;
Loads loads_of_acceleration(const Model<2>& model, const Vector<2>& acceleration);  // m/s²
Loads loads_of_applied_forces(const Model<2>& model);                               // at a factor of 1

// The largest factor of the live loads that is supported together with the dead ones, with the friction and cohesion of
// the interfaces. The gap is that of the largest ratio of live load to a body's weight, relative to the larger of 1 and
// this ratio. Joints after Barton and Bandis have their peak envelope here and in a factor of safety.
LoadFactor find_load_factor(const Model<2>& model, const std::vector<Interface>& interfaces, const Loads& dead,
                            const Loads& live);

// The strength at which loads are just supported, between a stable and a collapsing one.
struct StrengthBracket {
  LimitStatus status = LimitStatus::found;
  double collapses = 0, stands = 0;  // friction angle in rad, or factor of safety
  double missing = 0;  // at `collapses`: the least sum of added forces, over their bodies' weights, for equilibrium
  Evidence evidence;   // gap: of the missing force at `collapses`; out_of_balance at `stands`
};

struct CriticalStrength : StrengthBracket {
  // It may depend on normal forces between walls that the loads do not require: at 1.01 times the strength joints that
  // move in the mechanism can have self-stress, and without them the loads are not supported.
  bool self_stress = false;
  LimitState state;  // forces at `stands`, velocities at `collapses`
};

// The friction angle at which the model's gravity is just supported, by bisection over linear programs for the least
// force to be added, to 1e-6 degrees (for jammed blocks, self_stress, to 1 % at worst, as the bracket states: forces
// grow without bound towards it). It applies to all interfaces with named properties, the others keep theirs; no name:
// all; joints after Barton and Bandis must not be among them. Cohesion is unchanged. `besides`: further dead loads, by
// body. Unknown names throw std::out_of_range with the name.
CriticalStrength find_critical_friction(const Model<2>& model, const std::vector<Interface>& interfaces,
                                        const std::vector<std::string>& properties = {}, const Loads& besides = {});

// The factor of safety F: gravity is just supported if tan(friction) and cohesion of the interfaces with named
// properties are divided by F, those of the others unchanged. Likewise, to about 1e-7 of itself; it is searched from
// 1e-3 (carries_nothing: not even a thousand times the strength is enough) to infinity (carries_any: no strength is
// needed).
CriticalStrength find_factor_of_safety(const Model<2>& model, const std::vector<Interface>& interfaces,
                                       const std::vector<std::string>& properties = {}, const Loads& besides = {});

}  // namespace voussoir
