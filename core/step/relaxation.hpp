// Adaptive dynamic relaxation: the fast static solution method (Underwood 1983). A run to equilibrium needs only the
// final positions of the bodies, so their motion may be fictitious:
//
//   inertia  every body's mass and moments are scaled until its own stability limit equals the common step: soft or
//   heavy bodies then move
// as fast as stiff or light ones;
//   damping  proportional to it, c = 2 sqrt(v'K v / v'M v): critical for the slowest mode still moving, K v from the
//   change of the forces
// of contacts and water over the last step, without the part that changing water has imposed.
//
// Contacts, friction and weight are the true ones. Time (and with it the ramp of gravity), velocities and dashpots are
// not: the step is a constant near the stability limit, and bodies are stopped when a relaxation begins and ends.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Whether a run relaxes: one to equilibrium, unless by true motion.
inline bool relaxes(bool seeks_rest, const StaticsSettings& statics) {
  return seeks_rest && statics.method != Statics::local;
}

// Whether a stage with these settings begins by relaxation, which stops every body; every reduction begins in
// equilibrium.
bool begins_relaxing(const StagePlan& stage, const StaticsSettings& statics);

// Whether it ends by relaxation, so that its time and its velocities are fictitious; a reduction at constant rate ends
// in true motion.
bool ends_relaxed(const StagePlan& stage, const StaticsSettings& statics);

// Stops all bodies; from here on the steps relax. Changes all but contacts, supports, schedule and counters.
template <int Dim>
void begin_relaxation(State<Dim>& state);

// Stops all bodies; from here on the steps are true motion again. Changes the same.
template <int Dim>
void end_relaxation(State<Dim>& state);

// to be called before a run that moves bodies: after a relaxation they start with zero velocity, at the same time as
// positions
template <int Dim>
void begin_motion(TimeStep& time_step, Relaxation<Dim>& relaxation);

// One step of relaxation under the loads found: the last line of the step. The time step is settings.time.step, or
// else near the limit of the first step's contacts; later ones change only the fictitious inertia. Throws
// std::domain_error if nothing determines the step.
template <int Dim>
void relax_bodies(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                  ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Schedule& schedule, Ledger& ledger,
                  TimeStep& time_step, Relaxation<Dim>& relaxation);

}  // namespace voussoir
