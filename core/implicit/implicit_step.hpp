// True motion by implicit steps: the length of a step follows the motion, not the stiffness of the joints.
// Energy-momentum midpoint rule with dissipation of what the step does not resolve (core/implicit/README.md).
#pragma once

#include <string>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

struct JointStep;

// Moves the bodies on by a step whose own error is within the settings' tolerance, or of the stated length. The forces
// of the state are those at its positions, found without slip (JointStep::length 0).
template <int Dim>
void move_implicitly(const Model<Dim>& model, const Settings& settings, State<Dim>& state);

template <int Dim>
bool by_implicit_steps(const Settings& settings, const State<Dim>& state) {
  return settings.time.integration == Integration::implicit_steps && !state.relaxation.under_way;
}

// Finds the contacts, and their joints' forces as implicit steps take them: loads of the contacts, and the energy of
// the springs. In place of find_joint_forces; without slip.
template <int Dim>
void find_point_forces(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                       const JointStep& step, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, Ledger& ledger,
                       Counters& counters);

// m: the tolerance of a step if none is stated: 1e-5 of the median of the free blocks' inscribed radii. Slivers, which
// are the smallest of a sliced mass, do not set it.
template <int Dim>
double default_step_error(const Model<Dim>& model);

// Why a model's motion is not followed by implicit steps, as a sentence with the repair; empty: it is.
template <int Dim>
std::string not_followed_implicitly(const Model<Dim>& model, const Settings& settings);

}  // namespace voussoir
