// The changing side of a simulation. Positions are reference + displacement, so small steps far from the origin
// survive.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

#include "core/base/energy.hpp"
#include "core/contact/broad_phase.hpp"
#include "core/contact/contact.hpp"
#include "core/contact/integrated_contact.hpp"
#include "core/geometry/types.hpp"
#include "core/load/water.hpp"
#include "core/model/model.hpp"
#include "core/support/grouted_bolt.hpp"

namespace voussoir {

template <int Dim>
struct Motion {
  Vector<Dim> displacement = Vector<Dim>::Zero();  // m
  Rotation<Dim> rotation;                          // of the body's frame
  Vector<Dim> velocity = Vector<Dim>::Zero();      // m/s, half a step behind the displacement
  Spin<Dim> angular_momentum = Spin<Dim>::Zero();  // principal axes, kg m²/s, half a step behind
};

// where a body stands
template <int Dim>
struct Placement {
  Vector<Dim> displacement;  // m
  Rotation<Dim> rotation;
};

// where a body is and how it goes, as its contacts ask; rebuilt every step
template <int Dim>
struct CachedPose {
  Vector<Dim> reference, displacement;  // m
  Matrix<Dim> axes;                     // its frame in world axes
  Vector<Dim> velocity;                 // m/s
  Spin<Dim> spin;                       // rad/s, world axes
  double inverse_mass;                  // 1/kg; 0: fixed
};

// The contacts of each body in their order: those of body b lie in `places` from first[b] up to first[b + 1].
struct ContactsByBody {
  std::vector<int> first, places;
};

// What a contact does to its bodies, apart from all else that is known of it: bodies ask for it in another order than
// contacts lie in.
template <int Dim>
struct ContactLoad {
  int second = -1;                             // the second body; -1: they do not touch
  Vector<Dim> force = Vector<Dim>::Zero();     // N on the second body
  Spin<Dim> about_first = Spin<Dim>::Zero();   // N m: this force's moment about the first body's centroid
  Spin<Dim> about_second = Spin<Dim>::Zero();  // N m: about its own
};

// of bodies, by source
template <int Dim>
using LoadsBySource = BySource<std::vector<Load<Dim>>, load_count>;

// Adaptive dynamic relaxation (step/relaxation.hpp): what it keeps from step to step.
template <int Dim>
struct Relaxation {
  bool under_way = false;               // the run seeks rest by it: inertia, velocities and time are fictitious
  bool rested = false;                  // it has stopped every body, and none has moved since
  std::vector<double> inertia;          // by body: fictitious over true mass and moments of inertia
  std::vector<Load<Dim>> contact_load;  // by body: of the step before, without weight
  std::vector<Load<Dim>> imposed;       // by body: how a change of water has changed its load; none where it stands
  int until_renewal = 0;                // steps until the inertia is chosen again
};

// How the force and moment of a contact's second body, about its centroid, change with that body's motion against the
// first: translations, then turns.
template <int Dim>
struct PairStiffness {
  using Block = FixedMatrix<freedoms<Dim>, freedoms<Dim>>;
  using Wrench = FixedMatrix<freedoms<Dim>, 1>;
  int contact = 0;  // place in State::contacts; -1: of a bolt or a lining
  int body_a = 0, body_b = 0;
  Block stiffness = Block::Zero();          // minus the derivative, N/m, N and N m
  Wrench wrench = Wrench::Zero();           // as it is, N and N m
  Vector<Dim> apart = Vector<Dim>::Zero();  // m, of the second centroid from the first
};

// Bonds, each contact or sub-contact that carries one counted: what led to this state. Those whole are in the contacts.
struct BondTally {
  long long made = 0, removed = 0;  // removed: whole when a block of theirs was
};

// What a contact's joint remembers where an increment begins.
template <int Dim>
struct BaseHistory {
  int part_a = 0, part_b = 0;
  int divided_face = -1;
  bool bond_due = false;
  JointState<Dim> history;
};

// Newton's method on the joints (step/static_solver.hpp): what an increment keeps from one evaluation to the next.
template <int Dim>
struct StaticIncrement {
  // what the next evaluation is; `last`: of what has been accepted, before it is left to relaxation
  enum class Trial { waiting, start, step, forced, last };
  bool under_way = false;
  Trial trial = Trial::start;
  int increments_left = 0;    // after this one
  double increment_time = 0;  // s: by how much the schedules go on with each
  double ends = 0;            // s: where the last one puts them
  int iteration = 0;          // accepted ones of this increment
  int since_commit = 0, tries = 0, flat = 0, polished = 0;
  double regularisation = 1;                   // lambda
  double overshoot = 0;                        // how many times the largest step the last one wanted to be
  std::vector<Motion<Dim>> base;               // by body
  std::vector<BaseHistory<Dim>> histories;     // by contact
  std::vector<BoltSpring<Dim>> springs;        // as they were at the base
  std::vector<GroutedBolt<Dim>> grouted;       // the same
  std::vector<LiningState> linings;            // likewise
  BondTally bonds;                             // at the base
  long long whole_bonds = 0;                   // there
  std::vector<JointState<Dim>> sub_histories;  // as many places for each contact
  long long listed = 0;                        // Counters::neighbour_builds that they belong to
  LoadsBySource<Dim> loads_begin;              // at the base, under the loads of now
  EnergyLedger energy;                         // at the base
  std::vector<double> accepted, residual,
      change;                  // by freedom: motion since the base, what was out of balance, last step
  std::vector<double> merits;  // of the accepted ones
  std::vector<PairStiffness<Dim>> stiffness, closed;  // of the contacts that touch; of those that touch without force
  std::vector<typename PairStiffness<Dim>::Block> of_water;  // by body; none without water
};

// What excavated rock did to a body that it held, as far as it is not yet let off.
template <int Dim>
struct ReliefLoad {
  int body = 0;
  Load<Dim> load;    // at a share of 1; it keeps its direction and acts at the centroid
  double begun = 1;  // the share when the stage began
  double share = 1;  // that acts now
};

// values that vary within a stage
struct Schedule {
  double gravity_factor = 1;
  double last_gravity_factor = 1;                         // of the step before
  std::vector<double> friction;                           // rad, for each of Model::properties
  std::vector<double> strength_factor;                    // for each: divides tan φ (done in `friction`) and cohesion;
                                                          // empty: no factor has been searched
  WaterValues water, last_water;                          // the numbers of Model::waters, and those of the step before
  double started = 0;                                     // s: when the schedules began to run
  double ends = std::numeric_limits<double>::infinity();  // s: when the run that is under way is complete; its last
                                                          // step ends there
};

// the tally, and what has become of the bonds
struct BondCount {
  long long made = 0, whole = 0, broken = 0, removed = 0;
  long long due = 0;  // contacts whose joint is to be bonded where it first presses, and has not pressed yet
};

struct Counters {
  long long steps = 0;
  long long contact_evaluations = 0;  // pairs that went through the narrow phase
  long long motion_skips = 0;         // separated pairs whose bodies have not moved enough to meet
  long long axis_hits = 0;            // pairs still separated by the plane of the step before
  long long cold_starts = 0;          // pairs resolved from nothing
  long long lp_solves = 0;
  long long lp_pivots = 0;
  long long newton_iterations = 0;
  long long centre_fallbacks = 0;  // Newton failed, Ipopt answered
  long long areas = 0;
  long long undecided = 0;         // pairs nearer to touching than rounding can tell
  long long unconverged = 0;       // contacts without an answer: the run fails
  long long normal_fallbacks = 0;  // normals taken from a face or from the LP's multipliers
  long long deep_overlaps = 0;     // overlaps beyond the potential particle's radius
  long long snap_backs = 0;        // slips in which friction fell faster than the shear spring could unload
  long long neighbour_builds = 0;
  long long static_iterations = 0;  // Newton's method on the joints: steps accepted
  long long static_rejections = 0;  // and refused
  long long linear_iterations = 0;  // of its linear systems
  long long static_fallbacks = 0;   // increments that it left to relaxation
};

// their names in results
struct CounterRow {
  const char* name;
  long long Counters::*value;
};
inline constexpr CounterRow counter_table[] = {
    {"steps", &Counters::steps},
    {"contact_evaluations", &Counters::contact_evaluations},
    {"motion_skips", &Counters::motion_skips},
    {"axis_hits", &Counters::axis_hits},
    {"cold_starts", &Counters::cold_starts},
    {"lp_solves", &Counters::lp_solves},
    {"lp_pivots", &Counters::lp_pivots},
    {"newton_iterations", &Counters::newton_iterations},
    {"centre_fallbacks", &Counters::centre_fallbacks},
    {"areas", &Counters::areas},
    {"undecided", &Counters::undecided},
    {"unconverged", &Counters::unconverged},
    {"normal_fallbacks", &Counters::normal_fallbacks},
    {"deep_overlaps", &Counters::deep_overlaps},
    {"snap_backs", &Counters::snap_backs},
    {"neighbour_builds", &Counters::neighbour_builds},
    {"static_iterations", &Counters::static_iterations},
    {"static_rejections", &Counters::static_rejections},
    {"linear_iterations", &Counters::linear_iterations},
    {"static_fallbacks", &Counters::static_fallbacks},
};
static_assert(std::size(counter_table) * sizeof(long long) == sizeof(Counters), "every counter has a row");

template <int Dim>
struct State {
  std::vector<Motion<Dim>> motions;      // by body
  std::vector<Load<Dim>> loads;          // by body: of all sources together, before damping
  LoadsBySource<Dim> loads_of;           // by body; none of a source that the scene does not use
  std::vector<BodyStiffness> stiffened;  // by body: what loads other than the contacts add; none where none does
  std::vector<Contact<Dim>> contacts;    // candidate pairs by (part a, part b); those that touch carry history
  std::vector<SubContact<Dim>> subs;     // as many places for each contact, in their order; none where no joint has any
  std::vector<IntegratedContact<Dim>> faces;  // by contact: of those carried as a whole; found every step; none where
                                              // no joint is
  std::vector<Placement<Dim>> built;       // where the bodies stood when the candidates were last listed
  std::vector<Placement<Dim>> counted_at;  // by body: up to where its travel is counted
  std::vector<double> path_bounds;         // m, by body: how far any of its points may have gone, all ways added up
  std::vector<char> left_behind;  // by body: has failed in a search that its failure does not end, and counts no more
                                  // where rest is judged; empty: none
  std::vector<CachedPose<Dim>> poses;           // by body; rebuilt every step
  ContactsByBody by_body;                       // places in `contacts`; rebuilt with them
  std::vector<ContactLoad<Dim>> contact_loads;  // by contact; found every step
  std::vector<double> frequency;                // rad/s, by body: stiffest mode of the last time-step estimate
  Relaxation<Dim> relaxation;
  StaticIncrement<Dim> newton;
  Schedule schedule;
  std::vector<ReliefLoad<Dim>> held;          // by excavation, then by body
  std::vector<BoltSpring<Dim>> bolt_springs;  // of the bolts installed so far, in their order
  std::vector<GroutedBolt<Dim>> grouted;      // bars of those that are grouted, in the order of their springs
  std::vector<LiningState> linings;           // installed so far
  BondTally bonds;
  double time = 0;          // s
  double time_step = 0;     // s: of the last step; 0 at the start
  double step_allowed = 0;  // s: of the next; 0: to be estimated
  EnergyLedger energy;
  Counters counters;
};

// the places of a contact's sub-contacts among those of all contacts
template <int Dim>
std::size_t sub_stride(const State<Dim>& state) {
  return state.contacts.empty() ? 0 : state.subs.size() / state.contacts.size();
}

// The sub-contacts that carry a contact of a State, none where it carries itself; `place` counts in State::contacts.
template <class AnyState>
auto subs_of(AnyState& state, std::size_t place) {
  const std::size_t stride = sub_stride(state);
  return std::span(state.subs).subspan(place * stride, std::min<std::size_t>(stride, state.contacts[place].cells));
}

// how many of a contact's bonds are whole: its own, or those of its sub-contacts
template <int Dim>
long long whole_bonds(const State<Dim>& state, std::size_t place) {
  const Contact<Dim>& c = state.contacts[place];
  if (c.cells == 0) return c.history.bonded;
  const auto whole = [](const SubContact<Dim>& s) { return s.area > 0 && s.history.bonded; };
  return std::ranges::count_if(subs_of(state, place), whole);
}

// of all contacts
template <int Dim>
long long whole_bonds(const State<Dim>& state) {
  long long whole = 0;
  for (std::size_t i = 0; i < state.contacts.size(); ++i)
    whole += whole_bonds(state, i);
  return whole;
}

// the places of a body's contacts in State::contacts
template <int Dim>
std::span<const int> contacts_of(const State<Dim>& state, int body) {
  const auto& [first, places] = state.by_body;
  if (first.empty()) return {};  // no candidates have been listed
  return std::span(places).subspan(first[body], first[body + 1] - first[body]);
}

// Bodies that the model has got since follow at rest.
template <int Dim>
void add_bodies(const Model<Dim>& model, State<Dim>& state);

// Lists, poses and loads that are found again from motions and contacts.
template <int Dim>
void forget_lists(State<Dim>& state);

// rest at the reference configuration
template <int Dim>
State<Dim> initial_state(const Model<Dim>& model);

// Puts in force what a search is at: the friction angle, rad, of some joint properties, or the factor that divides
// their tan φ and cohesion, both as the model states them.
template <int Dim>
void set_strength(const Model<Dim>& model, Searched searched, const std::vector<int>& properties, double level,
                  Schedule& schedule);

// The second body's centroid seen from the first's, m: reference positions first, so that small displacements are not
// lost.
template <int Dim>
Vector<Dim> between(const CachedPose<Dim>& a, const CachedPose<Dim>& b);

// where the body stands as loads ask
template <int Dim>
Standing<Dim> standing(const CachedPose<Dim>& pose);

// State::poses from the motions
template <int Dim>
void cache_poses(const Model<Dim>& model, int threads, State<Dim>& state);

// State::by_body from the contacts
template <int Dim>
void list_by_body(const Model<Dim>& model, State<Dim>& state);

// of a body under the gravity of now, N
template <int Dim>
Vector<Dim> weight(const Model<Dim>& model, const State<Dim>& state, std::size_t body);

// a body as a node of a lining
BeamNode moved_node(const State<2>& state, int body);

// the forces of an installed lining's beams, in their order
std::vector<BeamForces> forces_of_beams(const Lining& lining, const State<2>& state);

// angular velocity in world axes, rad/s
template <int Dim>
Spin<Dim> angular_velocity(const Body<Dim>& body, const Motion<Dim>& motion);

// angular momentum in principal axes of a body that spins at `velocity` (world axes)
template <int Dim>
Spin<Dim> angular_momentum(const Body<Dim>& body, const Rotation<Dim>& rotation, const Spin<Dim>& velocity);

}  // namespace voussoir
