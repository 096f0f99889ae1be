// Leapfrog motion of one rigid body (velocities half a step behind positions) with Cundall's local damping.
#pragma once

#include <span>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// the two halves of a step: velocities are kicked over half the last and half this time step, positions drift over this
// one; the last is 0 only at the start, where velocities are given at the same time as positions
struct StepTimes {
  double kick, drift;  // s
  bool at_start() const { return kick == 0.5 * drift; }
  double worked() const { return at_start() ? drift : kick; }  // duration of the loads' work
};

// The path of a body's loads during a kick, in two halves: at the velocity before the kick and at the one after it. At
// the start the velocity before is that half a step earlier that would have led to the given one.
template <int Dim>
struct Kick {
  Vector<Dim> path_before = Vector<Dim>::Zero(), path_after = Vector<Dim>::Zero();  // m
  Spin<Dim> turn_before = Spin<Dim>::Zero(), turn_after = Spin<Dim>::Zero();        // rad
  Load<Dim> damping;   // contribution of local damping to the load
  double kinetic = 0;  // J, between the halves: leapfrog's own, ½ m v₋·v₊ and the same for spins
};

// change of a velocity by a kick: v -> keeps v + gain kick f/m, where f is the force after local damping
struct KickRule {
  double local_damping = 0;
  double keeps = 1, gain = 1;
};

// Advances a free body by one step under its load. Translation: v by the kick, u += drift v along free directions.
// Rotation in 3-D: angular momentum is kicked by the moment, then the free rotation is split into rotations about the
// principal axes (Dullweber, Leimkuhler & McLachlan 1997): reversible, symplectic, momentum conserved exactly, exact
// inertia.
template <int Dim>
Kick<Dim> advance(const Body<Dim>& body, const Load<Dim>& load, const KickRule& rule, StepTimes times,
                  Motion<Dim>& motion);

// Advances every free body under its load, on as many threads; `rules` has one for each body, or one for all. The
// kicks, by body, are valid until the next call on this thread.
template <int Dim>
std::vector<Kick<Dim>>& advance_bodies(const Model<Dim>& model, int threads, std::span<const KickRule> rules,
                                       StepTimes times, const std::vector<Load<Dim>>& loads,
                                       std::vector<Motion<Dim>>& motions);

// force after damping each component against its velocity: f - α |f| sign(v)
double damped(double force, double velocity, double local_damping);

// The largest unbalanced ratio of a body, force and momentum (see EquilibriumSettings), over the mean force of contacts
// and supports, or of supports, relief loads, applied forces or water only, whichever is largest; infinity if bodies
// move and none of these acts. Under relaxation the momentum is that of the fictitious inertia, which oscillates.
// Bodies left behind do not count. Computed on that many threads.
template <int Dim>
double unbalanced_ratio(const Model<Dim>& model, int threads, const State<Dim>& state);

}  // namespace voussoir
