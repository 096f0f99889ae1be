// What supports do in a step, a row for each kind.
#pragma once

#include <string>
#include <vector>

#include "core/base/settings.hpp"
#include "core/model/supports_state.hpp"
#include "core/step/bolt_forces.hpp"
#include "core/step/lining_forces.hpp"
#include "core/step/load_row.hpp"
#include "core/step/support_questions.hpp"

namespace voussoir {

// An entry may be empty where a kind has nothing of its own: the joints of a grouted bar are springs of bolts, and the
// row of bolts does what all springs have in common.
template <int Dim>
struct StepSupport {
  SupportKind kind;
  // Forces and histories at the poses of now, which must be cached; the ledger gets the energy that they hold, which it
  // must already have of the contacts, and what was lost.
  void (*find_forces)(const Model<Dim>&, const Schedule&, const JointStep&, const BodiesState<Dim>&,
                      SupportsState<Dim>&, Ledger&, Counters&);
  // what they do to the bodies, and at most stiffen each by; `find` is empty where the bodies get it by another row
  LoadRow<Dim> load;
  // adds pairs without contact (-1) to what Newton's method solves; the state is that of a trial
  void (*add_pairs)(const Model<Dim>&, const Settings&, const State<Dim>&, std::vector<PairStiffness<Dim>>&);
  // tells each two bodies that they tie together
  void (*tie)(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&);
  // adds what they carry to what unbalanced forces are measured against
  void (*add_forces)(const SupportsState<Dim>&, ForcesAtRest&) = nullptr;
  // tells each two bodies whose step against each other must be short, as that of bodies in contact
  void (*touch)(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&) = nullptr;
  // whether a body hangs on one of them though it touches no other
  bool (*hangs)(const SupportsState<Dim>&, int body) = nullptr;
  // typical stiffness of the unknowns of bodies of their own; `place` by body, each `freedoms` of `scale` those of one
  void (*scale_unknowns)(const Model<Dim>&, const std::vector<int>& place, Eigen::VectorXd& scale) = nullptr;
  // the support that has left its rock, as a sentence; empty: none
  std::string (*loose)(const Model<Dim>&, const SupportsState<Dim>&) = nullptr;
};

// in the order in which forces and loads are summed
template <int Dim>
constexpr StepSupport<Dim> step_supports[] = {
    {.kind = SupportKind::bolt,
     .find_forces = find_spring_forces<Dim>,
     .load = {Source::bolts, has_springs<Dim>, bolt_loads<Dim>, add_spring_stiffness<Dim>},
     .add_pairs = add_spring_pairs<Dim>,
     .tie = tie_springs<Dim>,
     .add_forces = add_spring_forces<Dim>,
     .hangs = hangs_on_spring<Dim>},
    {.kind = SupportKind::grouted_bolt,
     .find_forces = find_bar_forces<Dim>,
     .load = {Source::bolts, has_bars<Dim>, nullptr, add_bar_stiffness<Dim>},
     .add_pairs = add_bar_pairs<Dim>,
     .tie = tie_bars<Dim>},
    {.kind = SupportKind::lining,
     .find_forces = find_lining_forces<Dim>,
     .load = {Source::lining, has_linings<Dim>, lining_loads<Dim>, add_lining_stiffness<Dim>},
     .add_pairs = add_lining_pairs<Dim>,
     .tie = tie_linings<Dim>,
     .add_forces = add_interface_forces<Dim>,
     .touch = tell_touching_nodes<Dim>,
     .scale_unknowns = scale_nodes<Dim>,
     .loose = loose_lining<Dim>},
};
static_assert(has_each_kind(step_supports<2>) && has_each_kind(step_supports<3>), "a row for each kind of support");

}  // namespace voussoir
