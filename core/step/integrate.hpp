// Leapfrog motion of one rigid body (velocities half a step behind positions) with Cundall's local damping.
#pragma once

#include <span>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// the two halves of a step: velocities are kicked over half the last and half this time step, positions drift over this
// one; the last is 0 at the start alone, where velocities are given at the same time as positions
struct StepTimes {
  double kick, drift;  // s
  bool at_start() const { return kick == 0.5 * drift; }
  double worked() const { return at_start() ? drift : kick; }  // how long the loads work
};

// The path that a body's loads act along during a kick, in two halves: at the velocity before the kick and at the one
// after it. At the start the velocity before is the one half a step earlier that would have led to the given one.
template <int Dim>
struct Kick {
  Vector<Dim> path_before = Vector<Dim>::Zero(), path_after = Vector<Dim>::Zero();  // m
  Spin<Dim> turn_before = Spin<Dim>::Zero(), turn_after = Spin<Dim>::Zero();        // rad
  Load<Dim> damping;   // what local damping adds to the load
  double kinetic = 0;  // J, between the halves: leapfrog's own, ½ m v₋·v₊ and the same for spins
};

// what a kick makes of a velocity: v -> keeps v + gain kick f/m, f the force that local damping leaves
struct KickRule {
  double local_damping = 0;
  double keeps = 1, gain = 1;
};

// Advances a free body by one step under its load. Translation: v by the kick, u += drift v on free freedoms. Rotation
// in 3-D: angular momentum is kicked by the moment, then the free rotation is split into turns about the principal axes
// (Dullweber, Leimkuhler & McLachlan 1997): reversible, symplectic, momentum kept exactly, exact inertia.
template <int Dim>
Kick<Dim> advance(const Body<Dim>& body, const Load<Dim>& load, const KickRule& rule, StepTimes times,
                  Motion<Dim>& motion);

// Advances every free body under its load, on as many threads; `rules` has one for each body, or one for all. The
// kicks, by body: until the next call on this thread.
template <int Dim>
std::vector<Kick<Dim>>& advance_bodies(const Model<Dim>& model, int threads, std::span<const KickRule> rules,
                                       StepTimes times, const std::vector<Load<Dim>>& loads,
                                       std::vector<Motion<Dim>>& motions);

// force left after damping each component against its velocity: f - α |f| sign(v)
double damped(double force, double velocity, double local_damping);

// The largest fraction that a body's unbalanced force and momentum still amount to (see EquilibriumSettings) of the
// mean force of contacts and supports, or of supports, relief loads, applied forces or water alone, whichever is
// largest; infinity when bodies move and none of these acts. Under relaxation the momentum is that of the
// fictitious inertia, since this is what swings. Bodies left behind do not count. Found on as many threads.
template <int Dim>
double unbalanced_ratio(const Model<Dim>& model, int threads, const State<Dim>& state);

}  // namespace voussoir
