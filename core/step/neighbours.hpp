// Which parts may touch: pairs of neighbours, and how near each is.
#pragma once

#include <algorithm>
#include <span>
#include <stdexcept>

#include "core/base/settings.hpp"
#include "core/contact/particles.hpp"
#include "core/model/bodies_state.hpp"
#include "core/model/contacts_state.hpp"
#include "core/model/ledger.hpp"
#include "core/model/model.hpp"

namespace voussoir {

// Refusal of an impossible number of pairs: one line with the place where so many blocks meet, and the repair.
class TooManyNeighbours : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Largest number of listed pairs, on any machine: two million (2 GB), or two hundred per part if that is more. Blocks
// have about twenty neighbours; joints through one point bring all their blocks together there.
std::size_t most_candidates(std::size_t parts);

// Candidate pairs, listed again when a body may have moved out of its skin: all that may come near each other until
// then. Throws TooManyNeighbours before it allocates memory for them.
template <int Dim>
void find_neighbours(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies,
                     ContactsState<Dim>& contacts, Counters& counters);

// adds the displacement of each body since the last step; rounded upwards, so that it is a bound
template <int Dim>
void count_travels(const Model<Dim>& model, const Settings& settings, BodiesState<Dim>& bodies);

// m, sum for the bodies of a contact
template <int Dim>
double travelled(const Model<Dim>& model, const BodiesState<Dim>& bodies, const Contact<Dim>& c) {
  return bodies.path_bounds[model.parts[c.part_a].body] + bodies.path_bounds[model.parts[c.part_b].body];
}

// two parts in the form that the kernel takes, in the poses of their bodies
template <int Dim>
void set_pair(const Model<Dim>& model, const BodiesState<Dim>& bodies, int part_a, int part_b, QueryLevel level,
              Pair<Dim>& pair) {
  const CachedPose<Dim>&at_a = bodies.poses[model.parts[part_a].body], &at_b = bodies.poses[model.parts[part_b].body];
  pair.a = &model.polytope(part_a);
  pair.b = &model.polytope(part_b);
  pair.axes = at_a.axes;
  pair.rotation.noalias() = at_a.axes.transpose() * at_b.axes;
  pair.offset.noalias() = at_a.axes.transpose() * between(at_a, at_b);
  pair.level = level;
}

template <int Dim>
Pair<Dim> pair_of(const Model<Dim>& model, const BodiesState<Dim>& bodies, int part_a, int part_b, QueryLevel level) {
  Pair<Dim> pair;
  set_pair(model, bodies, part_a, part_b, level, pair);
  return pair;
}

// Draws a pair together against the rise of its joint (flight.hpp): its contact is where the faces would meet without
// it, with the area and the normal of these faces, and its overlap is the closure of the joint's spring.
template <int Dim>
void draw_together(double drawn, const Vector<Dim>& normal, Pair<Dim>& pair) {
  if (drawn > 0) pair.offset -= drawn * (pair.axes.transpose() * normal);
}

// narrow_phase, or, if the model has potential particles, that of all kinds of pairs
template <int Dim>
void resolve_pairs(const Model<Dim>& model, const ContactSettings& settings, std::span<const Pair<Dim>> pairs,
                   std::span<Contact<Dim>* const> contacts, KernelCounters& counters) {
  const auto resolve = model.particles ? &narrow_phase_with_particles<Dim> : &narrow_phase<Dim>;
  resolve(pairs, settings, model.solvers, contacts, counters);
}

// The joint of a contact: of the two faces' joints the later cut. Contacts of potential particles have none.
template <int Dim>
int joint_of(const Model<Dim>& model, const Contact<Dim>& c) {
  if (model.joints.empty() || c.geometry.face_a < 0) return no_joint;
  return std::max(model.polytope(c.part_a).joints[c.geometry.face_a],
                  model.polytope(c.part_b).joints[c.geometry.face_b]);
}

// m: a joint that is to be bonded (make_bonds) must not open by more before it is compressed; 0 if no joint has
// strength
template <int Dim>
double closed_gap(const Model<Dim>& model);

// Whether a pair is near: its boxes meet and, unless it touched in the step before, no face separates it
// (contact/nearness). Examined only when its bodies have moved by the distance that decided it, and at every step if a
// bond is due, which lapses when the pair is farther apart than `gap`, closed_gap.
template <int Dim>
bool is_near(const Model<Dim>& model, const BodiesState<Dim>& bodies, double gap, Contact<Dim>& c);

// A pair whose joint has risen is examined at every step, by its boxes, and is near up to twice that `rise`.
template <int Dim>
bool is_near_risen(const Model<Dim>& model, const BodiesState<Dim>& bodies, double rise, Contact<Dim>& c);

}  // namespace voussoir
