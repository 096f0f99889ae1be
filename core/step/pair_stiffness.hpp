// The change of contact forces as bodies move: the stiffness of each pair for the implicit static solver.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/joint_forces.hpp"

namespace voussoir {

// StaticSystem::stiffness: of every contact that touches and has a body with a place (by body: -1 without), over the
// degrees of freedom of its second body, from the histories of the increment's base. Geometry of this step and its
// sensitivity; the law by differences, and the kernel too if a contact has no sensitivity.
template <int Dim>
void find_pair_stiffness(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                         const JointStep& joint_step, const BodiesState<Dim>& bodies,
                         const ContactsState<Dim>& contacts, const JointHistories<Dim>& histories,
                         const std::vector<int>& place, Counters& counters, std::vector<PairStiffness<Dim>>& stiffness);

// StaticSystem::closed: joints that are closed at the start of the increment but without force, as between blocks just
// cut: their faces touch without overlap, so they have no stiffness and no history, and slip before compression would
// meet no resistance. Found by moving each pair together by a hundred-thousandth of its size; they get a history
// without force.
template <int Dim>
void find_closed_joints(const Model<Dim>& model, const Settings& settings, const BodiesState<Dim>& bodies,
                        const ContactsState<Dim>& contacts, JointHistories<Dim>& histories, Counters& counters,
                        std::vector<PairStiffness<Dim>>& closed);

}  // namespace voussoir
