// Implicit static solver (Newton-Raphson): equilibrium without time steps. The unknown q is the motion of all free
// bodies since the base of an increment. Kernel, joint laws and loads are those of every step: with velocities that are
// the motion since the base and a time step of one, the laws return the forces at base + q by return mapping over the
// whole increment, from the histories of the base. The tangent K of every pair, with the rotation of its forces, is
// regularised by the bodies' own stiffness D (pseudo-transient continuation; Kelley & Keyes 1998):
//
//   (K + lambda D) dq = r,   q += dq,
//
// with lambda falling with the residual r. A step is accepted if the residual does not grow, or as long as it has the
// same direction: a failing slope is followed, not refused. A slow increment uses only the work along the step, as a
// line search, so that modes softer than the joints are followed, too. In equilibrium the increment's end becomes the
// next base; after the last one relaxation takes over, and confirms the equilibrium or finds the one that Newton's
// method could not.
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// Whether Newton's method supports a joint's laws: all except softening and Barton and Bandis' mobilisation, by which
// the force falls within an increment, and dilation, by which an increment may end in another equilibrium than small
// steps (core/step/NOTES.md). Bonds are followed as long as they are intact: a trial that breaks one is refused, and if
// no shorter step avoids this, the increment is left to relaxation.
bool newton_follows(const JointProperties& joint);

// whether it supports those of all joints; else everything is left to relaxation
template <int Dim>
bool newton_applies(const Model<Dim>& model);

// The bodies are stopped and relaxation has begun: from here on a step is an evaluation at a trial. `ramp` (s):
// remaining duration of the schedules of gravity and friction, which the increments divide between them; 0 if they are
// constant.
// `elastic`: of a trial of a search, StaticIncrement::elastic.
template <int Dim>
void begin_newton(const Model<Dim>& model, const Settings& settings, double ramp, const std::vector<double>& elastic,
                  State<Dim>& state);

// The loads at a trial have been found: judges it and sets the bodies to the next one, and the rest of the state,
// except candidates and settings, to that of the base. If all increments have converged, or one does not within its
// iterations, State::increment is over and relaxation continues from there.
template <int Dim>
void iterate(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

// progress of the trials as text; empty if none is under way
template <int Dim>
std::string progress_of_newton(const State<Dim>& state);

// Bytes that it keeps besides the state, at most: histories of the base, and of every pair its stiffness and its
// entries in the linear system, its factors and sorted lists.
template <int Dim>
double memory_of_newton(const State<Dim>& state);

}  // namespace voussoir
