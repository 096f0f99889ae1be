// Prescribed motion: bodies, or some of their degrees of freedom, that move as the scene states whatever the load.
// Displacement control and base shaking.
#pragma once

#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/integrate.hpp"

namespace voussoir {

// Moves a body along its prescribed directions by one step at the velocity of the middle of the step, `middle` seconds
// after the motion began, or at the mean velocity of a record over the step. Returns the force that balances the load
// along them, N and N m: its work is that of the prescribed motion. The body's inertia along these directions is left
// out, with its kinetic energy, because the mass of a shaken base does not matter.
template <int Dim>
Load<Dim> apply_prescribed_motion(const Body<Dim>& body, const PrescribedMotion<Dim>& prescribed, const Load<Dim>& load,
                                  double middle, StepTimes times, Motion<Dim>& motion, Kick<Dim>& kick);

// m: between two times, in s since the stage began; exact
template <int Dim>
Vector<Dim> path_of(const PrescribedMotion<Dim>& prescribed, double from, double to);

// m/s, at a time since the stage began
template <int Dim>
Vector<Dim> velocity_at(const PrescribedMotion<Dim>& prescribed, double time);

// When a run begins: stops everything that is held and not prescribed, also bodies left moving by a prescribed motion
// that has ended.
template <int Dim>
void stop_held(const Model<Dim>& model, std::vector<Motion<Dim>>& motions);

}  // namespace voussoir
