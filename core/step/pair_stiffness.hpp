// How the forces of the contacts change as bodies move: what Newton's method on the joints needs of every pair.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/joint_forces.hpp"

namespace voussoir {

// StaticSystem::stiffness: of every contact that touches and has a free body, over the freedoms of its second body,
// from the histories of the increment's base. Geometry of this step and its sensitivity; the law, and the kernel where
// a contact has no sensitivity, by differences.
template <int Dim>
void find_pair_stiffness(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                         const JointStep& joint_step, const BodiesState<Dim>& bodies,
                         const ContactsState<Dim>& contacts, const JointHistories<Dim>& histories, Counters& counters,
                         std::vector<PairStiffness<Dim>>& stiffness);

// StaticSystem::closed: joints that are closed where the increment begins but carry nothing, as blocks just cut do:
// their faces lie on each other without overlap, so they have no stiffness and no history, and what they slip until
// they press would meet no resistance. Found by drawing each pair together by a hundred-thousandth of its size; they
// get a history without force.
template <int Dim>
void find_closed_joints(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
                        const ContactsState<Dim>& contacts, JointHistories<Dim>& histories, Counters& counters,
                        std::vector<PairStiffness<Dim>>& closed);

}  // namespace voussoir
