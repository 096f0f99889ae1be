// The step's second line: contacts among the candidate pairs, and the forces of their joints.
#pragma once

#include <utility>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/model.hpp"
#include "core/model/state.hpp"
#include "core/step/pair_motion.hpp"

namespace voussoir {

// the last step, over which joints slip
struct JointStep {
  double length;         // s
  double viscous_ratio;  // of their dashpots; 0: none, as under relaxation
};

template <int Dim>
JointStep joint_step(const Settings& settings, const TimeStep& last, const Relaxation<Dim>& relaxation) {
  return {last.length, relaxation.under_way ? 0 : settings.damping.viscous_ratio};
}

// Finds the contacts, and for each its joint's force from the overlap and from the slip over the last step. The
// ledger's elastic energy is set to theirs.
template <int Dim>
void find_joint_forces(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                       const JointStep& step, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts, Ledger& ledger,
                       Counters& counters);

// only the forces, of contacts that have been found
template <int Dim>
void apply_joint_laws(const Model<Dim>& model, const Settings& settings, const Schedule& schedule,
                      const JointStep& step, const BodiesState<Dim>& bodies, ContactsState<Dim>& contacts,
                      Ledger& ledger, Counters& counters);

// Force on the second body of a contact and its moment about that body's centroid
template <int Dim>
using PairWrench = typename PairStiffness<Dim>::Wrench;

// The force of a contact's joint for this geometry and this motion of its bodies, from these histories, which are not
// changed; those of the sub-contacts in their order. `drawn`, m: by this the pair was drawn together (flight.hpp).
// `face`: of an integrated face contact, else none; `slip_normal`: as in face_forces.hpp.
template <int Dim>
PairWrench<Dim> joint_wrench(const Model<Dim>& model, const Schedule& schedule, const JointStep& step,
                             const Contact<Dim>& contact, std::span<const SubContact<Dim>> subs,
                             const IntegratedContact<Dim>* face, const PairMotion<Dim>& motion,
                             const JointState<Dim>& history, std::span<const JointState<Dim>> sub_histories,
                             std::span<const JointRise<Dim>> rises, double drawn, Vector<3>* slip_normal = nullptr);

// Bonds every closed joint that has tensile strength or cohesion: immediately if it is compressed, otherwise when it
// first is, unless its faces have parted by more than a thousandth of the smallest inscribed radius before. A slipped
// bond gives way to a new one. No force changes. `between`: only joints of these pairs of bodies, (a < b), ascending.
template <int Dim>
void make_bonds(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                ContactsState<Dim>& contacts, BondTally& bonds, Counters& counters,
                const std::vector<std::pair<int, int>>* between = nullptr);

// removes the bonds of bodies that the model no longer has from the count of those not lost
template <int Dim>
void remove_bonds(const Model<Dim>& model, ContactsState<Dim>& contacts, BondTally& bonds);

// Sets the plastic slip of every joint to 0, so that hardening or softening of friction starts again. No force changes.
template <int Dim>
void zero_slip(ContactsState<Dim>& contacts);

template <int Dim>
BondCount count_bonds(const ContactsState<Dim>& contacts, const BondTally& bonds);

}  // namespace voussoir
