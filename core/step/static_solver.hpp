// Newton's method on the joints: equilibrium without marching. The unknown q is the motion of all free bodies since the
// base of an increment. Kernel, joint laws and loads are those of every step: with velocities that are the motion since
// the base and a time step of one, the laws return the forces at base + q by return mapping over the whole increment,
// from the histories of the base. The tangent K of every pair, with the turning of its forces, is regularised by the
// bodies' own stiffness D (pseudo-transient continuation; Kelley & Keyes 1998):
//
//   (K + lambda D) dq = r,   q += dq,
//
// lambda falling with the residual r. A step is accepted when the residual does not grow, or as long as what is left
// drives the same way: a slope that fails is followed, not refused. An increment that lingers looks at the work along
// the step alone, as a line search: what is soft beside stiff joints is followed, too. At rest the increment's end
// becomes the next base; after the last one relaxation takes over, confirms the rest or finds what Newton's method
// could not.
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Whether Newton's method follows a joint's laws: all but softening, by which the force of an increment falls as it
// goes on. Bonds are followed as long as they are whole: a trial that breaks one is refused, and where no shorter step
// spares it, the increment is left to relaxation.
bool newton_follows(const JointProperties& joint);

// whether it follows those of all joints; else all is left to relaxation
template <int Dim>
bool newton_applies(const Model<Dim>& model);

// The bodies are at rest and relaxation has begun: from here on a step is an evaluation at a trial. `ramp` (s): how
// long the schedules of gravity and friction continue, which the increments divide between them; 0 where they stand.
// `elastic`: of a trial of a search, StaticIncrement::elastic.
template <int Dim>
void begin_newton(const Model<Dim>& model, const Settings& settings, double ramp, const std::vector<double>& elastic,
                  State<Dim>& state);

// The loads at a trial have been found: judges it and sets the bodies to the next one, and all else but candidates and
// settings to what it was at the base: of the state, nearly everything. Where all increments have come
// to rest, or one does not within its iterations, State::increment is over and relaxation goes on from there.
template <int Dim>
void iterate(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// what a trial has come to, for people; empty while none is under way
template <int Dim>
std::string progress_of_newton(const State<Dim>& state);

// Bytes that it keeps besides the state, at most: histories of the base, and of every pair its stiffness and what it
// puts into the linear system, its factors and the lists that they are sorted in.
template <int Dim>
double memory_of_newton(const State<Dim>& state);

// by body: at the last trial that was accepted
template <int Dim>
std::vector<Placement<Dim>> accepted_placements(const Model<Dim>& model, const StaticIncrement<Dim>& increment);

}  // namespace voussoir
