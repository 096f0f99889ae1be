// Adaptive dynamic relaxation: the fast way to rest (Underwood 1983). A run that seeks rest asks
// only where the bodies come to lie, so what moves them may be fictitious:
//
//   inertia  every body's mass and moments are scaled until its own stability limit equals the common step: what is
//            soft or heavy then moves as fast as what is stiff or light;
//   damping  proportional to it, c = 2 sqrt(v'K v / v'M v): critical for the slowest mode still moving, K v taken
//            from how the forces of contacts and water have changed over the last step, but for what a water that rises
//            has imposed.
//
// Contacts, friction and weight are the true ones. Time (and with it the ramp of gravity), velocities and dashpots are
// not: the step is a constant near the stability limit, and bodies are at rest when a relaxation begins and ends.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Whether a run relaxes: one that seeks rest, unless it is to come there in true motion.
inline bool relaxes(bool seeks_rest, const StaticsSettings& statics) {
  return seeks_rest && statics.method != Statics::local;
}

// Whether a stage under these settings begins by relaxation, which stops every body; every reduction begins at rest.
bool begins_relaxing(const StagePlan& stage, const StaticsSettings& statics);

// Whether it ends by relaxation, so that its time and its velocities are fictitious; a reduction at constant rate ends
// in true motion.
bool ends_relaxed(const StagePlan& stage, const StaticsSettings& statics);

// Stops all bodies; from here on the step relaxes. Changes all but contacts, supports, schedule and counters.
template <int Dim>
void begin_relaxation(State<Dim>& state);

// Stops all bodies; from here on the step moves them again. Changes the same.
template <int Dim>
void end_relaxation(State<Dim>& state);

// to be called before a run that moves bodies: after a relaxation they start from rest, half a step is not ahead
template <int Dim>
void begin_motion(TimeStep& time_step, Relaxation<Dim>& relaxation);

// One step of relaxation under the loads found: the last of the step's stages. The time step is settings.time.step, or
// else near the limit of the first step's contacts; later ones change the fictitious inertia alone. Throws
// std::domain_error when nothing determines the step.
template <int Dim>
void relax_bodies(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                  ContactsState<Dim>& contacts, LoadsState<Dim>& loads, Schedule& schedule, Ledger& ledger,
                  TimeStep& time_step, Relaxation<Dim>& relaxation);

}  // namespace voussoir
