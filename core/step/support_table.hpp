// Supports in a step, a row for each kind.
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

// An entry may be empty if a kind has nothing of its own: the joints of a grouted bar are springs of bolts, and the row
// of bolts handles what all springs have in common.
template <int Dim>
struct StepSupport {
  SupportKind kind;
  // Forces and histories at the present poses, which must be cached; the ledger gets their stored energy, added to that
  // of the contacts, and the lost energy.
  void (*find_forces)(const Model<Dim>&, const Schedule&, const JointStep&, const BodiesState<Dim>&,
                      SupportsState<Dim>&, Ledger&, Counters&);
  // loads on the bodies, and an upper bound of their stiffness; `find` is empty if another row gives the loads
  LoadRow<Dim> load;
  // adds pairs without contact (-1) to the system of Newton's method; the state is that of a trial
  void (*add_pairs)(const Model<Dim>&, const Settings&, const State<Dim>&, std::vector<PairStiffness<Dim>>&);
  // reports every two bodies that they connect
  void (*tie)(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&);
  // adds their forces to the reference of unbalanced forces
  void (*add_forces)(const SupportsState<Dim>&, ForcesAtRest&) = nullptr;
  // reports every two bodies whose relative step must be short, like that of bodies in contact
  void (*touch)(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&) = nullptr;
  // whether a body is supported by one of them without touching another body
  bool (*hangs)(const SupportsState<Dim>&, int body) = nullptr;
  // typical stiffness of the unknowns of their own bodies; `place` by body, each `freedoms` entries of `scale` for one
  // body
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
