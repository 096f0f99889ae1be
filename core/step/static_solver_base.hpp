// The base state from which the implicit static solver starts, and the trials near it.
#pragma once

#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// The unknowns: all degrees of freedom of the free bodies, in order.
template <int Dim>
struct Unknowns {
  static constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  std::vector<int> bodies, place;  // the free ones; by body: index among them, or -1
  std::vector<int> upwards;        // indices of the free ones, the lowest first
  std::vector<double> radius;      // m, by body: the inscribed one
  Eigen::VectorXd scale, free;     // by degree of freedom: D, N/m and N m; 1, or 0 if it is restrained

  // D: the stiffest joint times the body's largest face
  explicit Unknowns(const Model<Dim>& model);

  std::size_t count() const { return bodies.size(); }
};

// The state, with its bodies stopped, as a base: nothing has moved from it yet.
template <int Dim>
StaticBase<Dim> base_of(const State<Dim>& state);

// Sorts the base's histories in the order of the contacts if these have been listed again since; `listed`:
// Counters::neighbour_builds. Closed joints are kept if they are still listed.
template <int Dim>
void follow_list(const ContactsState<Dim>& contacts, long long listed, StaticBase<Dim>& base,
                 std::vector<PairStiffness<Dim>>& closed);

// Sets bodies to base + q and the rest to the state of the base, ready to be evaluated: the velocities are q per time
// step of one.
template <int Dim>
void set_trial(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const StaticBase<Dim>& base,
               const Eigen::VectorXd& q, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts,
               SupportsState<Dim>& supports, Ledger& ledger, TimeStep& time_step);

// Adds the work of the loads over the motion q since the base, by the mean of those at its ends: exact for linear
// loads. All of it counts as removed, as under relaxation.
template <int Dim>
void add_work_of_increment(const Unknowns<Dim>& unknowns, const LoadsBySource<Dim>& then, const Eigen::VectorXd& q,
                           const LoadsBySource<Dim>& now, EnergyBalance& energy);

// of all contact forces: in contacts that the base does not have
template <int Dim>
double fraction_in_new_contacts(const ContactsState<Dim>& contacts, const JointHistories<Dim>& of_base);

// by body: at the last trial that was accepted
template <int Dim>
std::vector<Placement<Dim>> accepted_placements(const Model<Dim>& model, const StaticIncrement<Dim>& increment);

}  // namespace voussoir
