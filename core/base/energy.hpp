// Where the energy of a simulation is and where it went, in J (2-D: J per metre). Two balances are kept apart: the work
// of all forces on the motion, which leapfrog closes to rounding; and the energy exchanged by the contact springs,
// which closes as far as they are conservative: not when the area, normal or point of a contact changes along the path,
// nor when a step is long for an impact.
//
// During relaxation to equilibrium, inertia and velocities are fictitious (step/relaxation.hpp): there is no kinetic
// energy, all work of the forces counts as removed by the relaxation, and the first balance is meaningless. The second
// one has no inertia in it and remains valid.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace voussoir {

// Sources and sinks of energy. The first ones are loads: forces and moments on bodies (State::loads.by_source), which
// work along the bodies' paths; the others are counted where they arise.
enum class Source {
  contacts,
  gravity,
  boundary_stress,
  boundary_reactions,
  plates,
  free_field,
  applied_forces,
  water,
  water_pressure,
  excavation_forces,
  bolts,
  lining,
  prescribed_motion,
  local_damping,
  relaxation,
  unresolved_motion,
  // no loads from here on
  friction,
  lost_area,
  dashpots,
  stiffening,
  dilation,
  irrecoverable_closure,
  unresolved_springs,
  bolt_yield,
  lining_slip,
  gravity_ramp,
  water_change,
  incoming_waves,
  outgoing_waves,
  stage_changes
};
inline constexpr std::size_t load_count = static_cast<std::size_t>(Source::friction);
inline constexpr std::size_t source_count = static_cast<std::size_t>(Source::stage_changes) + 1;

// A source's name in results, and how its flow enters each sum: +1, -1 or 0. A load's flow is its work on the bodies,
// or, if it removes energy from the motion (motion < 0), the energy removed.
struct SourceRow {
  Source source;
  std::string_view name;
  std::string_view monitored;  // as a quantity of monitors, which adds up all sources of one word; empty: none
  int motion;                  // gained by the motion
  int springs;    // lost by springs that store energy (EnergyBalance::elastic); loads with a spring have 1 here
  int potential;  // potential energy of gravity and of water
  int damping;    // lost to damping
  int external;   // put in from outside
};
inline constexpr std::array<SourceRow, source_count> source_table{{
    {Source::contacts, "contacts", "contact_load", 1, 1, 0, 0, 0},
    {Source::gravity, "gravity", "gravity_load", 1, 0, -1, 0, 0},
    {Source::boundary_stress, "boundary_stress", "boundary_load", 1, 0, 0, 0, 1},
    {Source::boundary_reactions, "boundary_reactions", "boundary_load", 1, 0, 0, 0, 1},  // of supports that a quiet
                                                                                         // side has replaced
    {Source::plates, "plates", "boundary_load", 1, 1, 0, 0, 0},          // of quiet sides, behind half a joint
    {Source::free_field, "free_field", "boundary_load", 1, 0, 0, 0, 1},  // stress that waves make in its column
    {Source::applied_forces, "applied_forces", "applied_load", 1, 0, 0, 0, 1},
    {Source::water, "water", "water_load", 1, 0, -1, 0, 0},  // one table on all faces: it has a potential
    {Source::water_pressure, "water_pressure", "water_load", 1, 0, 0, 0, 1},  // others: on some faces, or several
    {Source::excavation_forces, "excavation_forces", "", 1, 0, 0, 0, 1},      // relief loads of excavated rock
    {Source::bolts, "bolts", "bolt_load", 1, 1, 0, 0, 0},
    {Source::lining, "lining", "lining_load", 1, 1, 0, 0, 0},  // its beams and its interface
    {Source::prescribed_motion, "prescribed_motion", "", 1, 0, 0, 0, 1},
    {Source::local_damping, "local_damping", "", -1, 0, 0, 1, 0},
    {Source::relaxation, "relaxation", "", -1, 0, 0, 1, 0},
    {Source::unresolved_motion, "unresolved_motion", "", -1, 0, 0, 1, 0},  // implicit steps: swings too fast for them
    {Source::friction, "friction", "", 0, 1, 0, 0, 0},                     // lost to slip
    {Source::lost_area, "lost_area", "", 0, 1, 0, 0, 0},    // lost when a joint under shear loses or gains area
    {Source::dashpots, "dashpots", "", 0, 1, 0, 1, 0},      // lost to viscous damping
    {Source::stiffening, "stiffening", "", 0, 1, 0, 0, 0},  // lost by shear springs that stiffened with stress under
                                                            // their force; negative: gained
    {Source::dilation, "dilation", "", 0, 1, 0, 0, 0},      // lost by normal springs as joints rise; negative: gained
    {Source::irrecoverable_closure, "irrecoverable_closure", "", 0, 1, 0, 0, 0},  // lost by joints that stay closed
    {Source::unresolved_springs, "unresolved_springs", "", 0, 1, 0, 1, 0},        // the same, taken off the springs
    {Source::bolt_yield, "bolt_yield", "", 0, 1, 0, 0, 0},      // lost by bolts that yield, slip or break
    {Source::lining_slip, "lining_slip", "", 0, 1, 0, 0, 0},    // lost when a lining slips on rock, or its bond breaks
    {Source::gravity_ramp, "gravity_ramp", "", 0, 0, 1, 0, 1},  // put in by gravity that grows
    {Source::water_change, "water_change", "", 0, 0, 1, 0, 1},  // put in by a table on all faces that rises
    {Source::incoming_waves, "incoming_waves", "", 0, -1, 0, 0, 1},  // put in at quiet sides and free fields
    {Source::outgoing_waves, "outgoing_waves", "", 0, 1, 0, 0, -1},  // left through their dashpots; never negative
    {Source::stage_changes, "stage_changes", "", 0, 0, 0, 0, 1},  // put in by changes of the model between stages, and
                                                                  // when a motion is stopped to relax
}};

// One number for each load, or for each source.
template <class T, std::size_t Size>
struct BySource {
  std::array<T, Size> values{};
  T& operator[](Source s) { return values[static_cast<std::size_t>(s)]; }
  const T& operator[](Source s) const { return values[static_cast<std::size_t>(s)]; }
};

// Sums over the steps so far. Every load is credited with its work at the mean of the velocities before and after its
// kick.
using EnergyFlows = BySource<double, source_count>;

enum class BalancePhase { not_begun, model_changed, running };

struct EnergyBalance {
  EnergyFlows flows;
  double kinetic = 0;  // ½ m v₋·v₊ and the same for spins (v₋, v₊: half a step before and after): negative at a turn
  double elastic = 0;                             // stored in the springs of touching contacts, of bolts and linings
  double kinetic_origin = 0, elastic_origin = 0;  // at the first step, moved by changes of the model
  double motion_error = 0, contact_error = 0;     // unaccounted for in each balance
  double worst_error = 0;                         // the largest |motion_error + contact_error| so far
  double largest_energy = 0;                      // the largest entry so far
  BalancePhase phase = BalancePhase::not_begun;

  // the sum of the flows, each weighted by its row's entry in that column
  double sum(int SourceRow::*column) const;

  double potential() const { return sum(&SourceRow::potential); }  // of gravity and water, against the start
  double damping() const { return sum(&SourceRow::damping); }
  double external() const { return sum(&SourceRow::external); }

  // kinetic + elastic + potential + friction + damping + stiffening - external, against the start
  double unexplained() const { return motion_error + contact_error; }

  // the largest unexplained energy as a fraction of the largest energy so far
  double relative_error() const { return largest_energy > 0 ? worst_error / largest_energy : 0; }
};

// Checks both balances at the time of the positions: `kinetic`, `elastic` and the flows must be those of this time.
void balance(EnergyBalance& energy);

}  // namespace voussoir
