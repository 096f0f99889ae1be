// The step's second line: which candidate pairs touch, and what their joints answer.
#pragma once

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/pair_motion.hpp"

namespace voussoir {

// of the step that led here, over which joints slip
struct JointStep {
  double length;         // s
  double viscous_ratio;  // of their dashpots; 0: none, as under relaxation
};

template <int Dim>
JointStep joint_step(const Settings& settings, const TimeStep& last, const Relaxation<Dim>& relaxation) {
  return {last.length, relaxation.under_way ? 0 : settings.damping.viscous_ratio};
}

// Finds the contacts, and for each its joint's force from overlap and from the slip over the last step. The ledger's
// elastic energy becomes theirs.
template <int Dim>
void find_joint_forces(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                       const JointStep& step, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, Ledger& ledger,
                       Counters& counters);

// the forces alone, of contacts that have been found
template <int Dim>
void apply_joint_laws(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                      const JointStep& step, const BodiesState<Dim>& bodies, ContactsState<Dim>& contacts,
                      Ledger& ledger, Counters& counters);

// Force on the second body of a contact and its moment about that body's centroid
template <int Dim>
using PairWrench = typename PairStiffness<Dim>::Wrench;

// What the joint of a contact would answer to this geometry and this motion of its bodies, from these histories, which
// stay; those of the sub-contacts in their order. `face`: of a contact that is carried as a whole, else none.
template <int Dim>
PairWrench<Dim> joint_wrench(const Model<Dim>& model, const Schedule& schedule, const JointStep& step,
                             const Contact<Dim>& contact, std::span<const SubContact<Dim>> subs,
                             const IntegratedContact<Dim>* face, const PairMotion<Dim>& motion,
                             const JointState<Dim>& history, std::span<const JointState<Dim>> sub_histories);

// Bonds every closed joint that has tensile strength or cohesion: where it presses at once, elsewhere as soon as it
// first does, unless its faces part by more than a thousandth of the smallest inscribed radius before. No force
// changes.
template <int Dim>
void make_bonds(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                ContactsState<Dim>& contacts, BondTally& bonds, Counters& counters);

// takes the bonds of bodies that the model no longer has out of the count of those whole
template <int Dim>
void remove_bonds(const Model<Dim>& model, ContactsState<Dim>& contacts, BondTally& bonds);

// Sets the plastic slip of every joint to 0, so that friction that hardens or softens begins again. No force is
// touched.
template <int Dim>
void zero_slip(ContactsState<Dim>& contacts);

template <int Dim>
BondCount count_bonds(const ContactsState<Dim>& contacts, const BondTally& bonds);

}  // namespace voussoir
