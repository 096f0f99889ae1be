// Prescribed motion: bodies, or some of their freedoms, that move as the scene says whatever the load. Displacement
// control and base shaking.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/integrate.hpp"

namespace voussoir {

// Moves the forced freedoms of a body by one step at the velocity of the middle of the step, `middle` seconds after the
// motion began. Returns what holds against the load along them, N and N m: its work is what the motion costs. The
// body's own inertia along a forced freedom is left out, with its kinetic energy, for a shaken base of any mass is the
// same base.
template <int Dim>
Load<Dim> apply_prescribed_motion(const Body<Dim>& body, const PrescribedMotion<Dim>& prescribed, const Load<Dim>& load,
                                  double middle, StepTimes times, Motion<Dim>& motion, Kick<Dim>& kick);

// When a run begins: stops whatever is held and not forced, also what a motion that has ended left moving.
template <int Dim>
void stop_held(const Model<Dim>& model, std::vector<Motion<Dim>>& motions);

}  // namespace voussoir
