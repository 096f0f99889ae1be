// Leapfrog motion of one rigid body (velocities half a step behind positions) with Cundall's local damping.
#pragma once

#include "core/model.hpp"
#include "core/settings.hpp"
#include "core/state.hpp"

namespace voussoir {

// the two halves of a step: velocities are kicked over half the last and half this time step, positions drift over this
// one; the last is 0 at the start, where velocities are given at the same time as positions
struct StepTimes {
  double kick, drift;  // s
};

// Advances a free body by one step under its load. Translation: v += kick f/m, u += drift v on free freedoms. Rotation
// in 3-D: angular momentum is kicked by the moment, then the free rotation is split into turns about the principal axes
// (Dullweber, Leimkuhler & McLachlan 1997): reversible, symplectic, momentum kept exactly, exact inertia.
template <int Dim>
void advance(const Body<Dim>& body, const Load<Dim>& load, double local_damping, StepTimes times, Motion<Dim>& motion);

// force left after damping each component against its velocity: f - α |f| sign(v)
double damped(double force, double velocity, double local_damping);

// The largest share of the mean contact force that a body's unbalanced force and momentum still amount to (see
// EquilibriumSettings); infinity when bodies move without any contact.
template <int Dim>
double unbalanced_ratio(const Model<Dim>& model, const State<Dim>& state);

}  // namespace voussoir
