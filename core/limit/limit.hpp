// Rigid-block limit analysis of a 2-D assembly (Livesley 1978): blocks are rigid, a joint carries normal and shear
// forces at the two ends of every interface, within Coulomb's cone and without tension. An equilibrium within the cone
// is a lower bound of what is carried; the multipliers of the same linear program are the velocities of a mechanism.
// The mechanism opens a joint by tan(friction) of its slip (associated flow), so that the result is an upper bound of
// the strength of blocks that slip without opening: where blocks topple it may be several degrees unsafe.
#pragma once

#include <string>
#include <vector>

#include "core/limit/interfaces.hpp"
#include "core/limit/linear_program.hpp"
#include "core/load/load.hpp"

namespace voussoir {

// the force at one end of an interface, on body_b
struct EndForce {
  double normal = 0;  // N (per metre of thickness), pressure positive
  double shear = 0;   // N, along the normal turned by a right angle, counter-clockwise
};

// velocities of a mechanism: only their ratios mean something. Of the fastest body, the speed of the centroid plus that
// of the farthest corner about it is 1.
struct BodyVelocity {
  Vector<2> velocity = Vector<2>::Zero();  // of the centroid
  double spin = 0;                         // 1/m, counter-clockwise
};

// One limit state: forces that carry the load, and velocities at which it would be exceeded.
struct LimitState {
  std::vector<std::array<EndForce, 2>> forces;  // by interface; empty where no forces carry the load
  std::vector<BodyVelocity> velocities;         // by body; zero for fixed ones; all zero where nothing collapses
};

enum class LimitStatus {
  found,
  nothing_free,     // no body has a freedom
  no_load,          // the load does nothing to any freedom, or gravity is zero
  carries_any,      // stands at every factor up to 1e6 times the blocks' weight; or without any friction
  carries_nothing,  // the dead load alone is not carried; or no friction up to 89 degrees is enough
  not_attained,     // carried at any strength above zero by normal forces without bound, but not at zero
  solver_failed     // GLPK gave up
};

// How well the result is proven, from our own sums over the program's numbers; GLPK's word is not needed.
struct Evidence {
  double gap = 0;             // difference of the bounds from both sides
  double out_of_balance = 0;  // largest force missing on a body, of its weight (a moment: of that times its radius)
  double inadmissible = 0;    // largest velocity that closes a joint or works against its cone, of the fastest body's
  int programs = 0;           // linear programs solved
};

struct LoadFactor {
  LimitStatus status = LimitStatus::found;
  double factor = 0;         // of the live load
  bool self_stress = false;  // as in CriticalStrength
  LimitState state;
  Evidence evidence;
};

// What acts on each body, by id, where the model has it.
using Loads = std::vector<Load<2>>;
Loads loads_of_acceleration(const Model<2>& model, const Vector<2>& acceleration);  // m/s²
Loads loads_of_applied_forces(const Model<2>& model);                               // at a factor of 1

// The largest factor of the live loads that is carried together with the dead ones, at the friction and cohesion of the
// interfaces. The gap is that of the largest fraction that the live load then is of a body's weight, relative to the
// larger of 1 and it.
LoadFactor find_load_factor(const Model<2>& model, const std::vector<Interface>& interfaces, const Loads& dead,
                            const Loads& live);

// The strength at which loads are just carried, between one that stands and one that collapses.
struct CriticalStrength {
  LimitStatus status = LimitStatus::found;
  double collapses = 0, stands = 0;  // the bracket: friction angle in rad, or factor of safety
  double missing = 0;  // at `collapses`: the least sum of added forces, of their bodies' weights, that would stand
  // It may rest on normal forces between walls that the loads do not ask for: at 1.01 times the strength joints that
  // move in the mechanism can press on each other without any load, and without them the loads are not carried.
  bool self_stress = false;
  LimitState state;   // forces at `stands`, velocities at `collapses`
  Evidence evidence;  // gap: of what is missing at `collapses`; out_of_balance at `stands`
};

// The friction angle at which the model's gravity is just carried, by bisection over linear programs that ask for the
// least force to be added, to 1e-6 degrees (of blocks that are jammed, self_stress, to 1 % at worst, as the bracket
// says: forces grow without bound towards it). Interfaces whose properties are named all take it, the others keep
// theirs; no name: all. Cohesion stays. `besides`: further dead loads, by body. Unknown names throw std::out_of_range
// with the name.
CriticalStrength find_critical_friction(const Model<2>& model, const std::vector<Interface>& interfaces,
                                        const std::vector<std::string>& properties = {}, const Loads& besides = {});

// The factor F of safety: gravity is just carried where tan(friction) and cohesion of the interfaces whose properties
// are named are divided by F, those of the others as they are. Likewise, to some 1e-7 of itself; it is looked for from
// 1e-3 (carries_nothing: not even a thousand times the strength is enough) to infinity (carries_any: no strength is
// needed).
CriticalStrength find_factor_of_safety(const Model<2>& model, const std::vector<Interface>& interfaces,
                                       const std::vector<std::string>& properties = {}, const Loads& besides = {});

}  // namespace voussoir
