// Where the energy of a simulation is and where it went, in J (2-D: J per metre). Two balances are kept apart: what all
// forces did to the motion, which leapfrog closes to rounding; and what the contacts gave and took, which closes as far
// as they are conservative: not where area, normal or point of a contact change on the way, nor where a step is long
// for an impact.
//
// On the way to rest by relaxation, inertia and velocities are fictitious (motion/relaxation.hpp): there is no kinetic
// energy, all work of the forces is booked as taken out by the relaxation, and the first balance says nothing. The
// second one knows no inertia and holds as ever.
#pragma once

namespace voussoir {

// Sums over the steps so far. Every force is credited with its work at the mean of the velocities before and after its
// kick.
struct EnergyFlows {
  double gravity = 0;     // work of gravity on the bodies
  double contacts = 0;    // work of the contact forces on the bodies
  double friction = 0;    // lost to slip
  double dashpots = 0;    // lost to viscous damping
  double stiffening = 0;  // lost by shear springs that grew stiffer with stress under their force; negative: made
  double local = 0;       // lost to local damping
  double relaxation = 0;  // taken out by relaxation
  double ramp = 0;        // put in by gravity that grows
  double changes = 0;     // put in by changes of the model between stages, and where a motion is stopped to relax
  double prescribed = 0;  // put in by prescribed motions
};

enum class LedgerPhase { not_begun, model_changed, running };

struct EnergyLedger {
  EnergyFlows flows;
  double kinetic = 0;  // ½ m v₋·v₊ and the same for spins (v₋, v₊: half a step before and after): negative at a turn
  double elastic = 0;                             // held by the springs of the touching contacts
  double kinetic_origin = 0, elastic_origin = 0;  // at the first step, moved by changes of the model
  double motion_error = 0, contact_error = 0;     // what each balance could not account for
  double widest = 0;                              // the largest |motion_error + contact_error| so far
  double turnover = 0;                            // the largest entry so far
  LedgerPhase phase = LedgerPhase::not_begun;

  double potential() const { return flows.ramp - flows.gravity; }  // of gravity, against the start
  double damping() const { return flows.local + flows.dashpots + flows.relaxation; }
  double external() const { return flows.ramp + flows.changes + flows.prescribed; }

  // kinetic + elastic + potential + friction + damping - external, against the start
  double unexplained() const { return motion_error + contact_error; }

  // the unexplained at its worst as a share of the largest energy the ledger saw
  double closure() const { return turnover > 0 ? widest / turnover : 0; }
};

// Strikes both balances at the time of the positions: `kinetic`, `elastic` and the flows must be those of this time.
void balance(EnergyLedger& ledger);

}  // namespace voussoir
