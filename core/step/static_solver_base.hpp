// The base that Newton's method on the joints starts from, and the trials that it sets beside it.
#pragma once

#include <vector>

#include "core/model/model.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// The unknowns: all freedoms of the bodies that are free, in their order.
template <int Dim>
struct Unknowns {
  static constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  std::vector<int> bodies, place;  // the free ones; by body: among them, or -1
  Eigen::VectorXd scale, free;     // by freedom: D, N/m and N m; 1, or 0 where it is held

  // D: the stiffest joint times the body's largest face
  explicit Unknowns(const Model<Dim>& model);

  std::size_t count() const { return bodies.size(); }
};

// The state, whose bodies are at rest, as a base: nothing has moved from it yet.
template <int Dim>
StaticBase<Dim> base_of(const State<Dim>& state);

// Puts the base's histories in the order of the contacts if they have been listed again since; `listed`:
// Counters::neighbour_builds. Of closed joints stay those that are still listed.
template <int Dim>
void follow_list(const ContactsState<Dim>& contacts, long long listed, StaticBase<Dim>& base,
                 std::vector<PairStiffness<Dim>>& closed);

// Sets bodies at base + q and all else as the base has it, ready to be evaluated: the velocities are q per time step of
// one.
template <int Dim>
void set_trial(const Model<Dim>& model, const Unknowns<Dim>& unknowns, const StaticBase<Dim>& base,
               const Eigen::VectorXd& q, BodiesState<Dim>& bodies, ContactsState<Dim>& contacts,
               SupportsState<Dim>& supports, Ledger& ledger, TimeStep& time_step);

}  // namespace voussoir
