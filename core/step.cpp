#include "core/step.hpp"

#include "core/implicit/implicit_step.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/loads.hpp"
#include "core/step/motion.hpp"
#include "core/step/neighbours.hpp"
#include "core/step/open_sides.hpp"
#include "core/step/static_solver.hpp"
#include "core/step/support_table.hpp"

namespace voussoir {

// Parts of the state that a line only reads are written `now.part`.
template <int Dim>
void find_forces(const Model<Dim>& model, const Settings& settings, State<Dim>& state) {
  const State<Dim>& now = state;
  auto& [bodies, contacts, supports, loads, schedule, ledger, counters, time_step, relaxation, increment] = state;

  // pairs that may touch: bounding boxes with a skin, renewed only when a body has left it
  find_neighbours(model, settings, bodies, contacts, counters);

  // pairs that do: point, normal, overlap and area of each, and the force of its joint, with its new history
  const JointStep last = joint_step(settings, now.time_step, now.relaxation);
  const auto find = by_implicit_steps(settings, now) ? find_point_forces<Dim> : find_joint_forces<Dim>;
  find(model, settings, now.schedule, last, bodies, contacts, ledger, counters);

  // forces of bolts at the displaced anchors, of linings at the displaced rock, and through sides that waves leave
  for (const StepSupport<Dim>& row : step_supports<Dim>)
    row.find_forces(model, now.schedule, last, now.bodies, supports, ledger, counters);
  find_open_sides(model, now.schedule, now.bodies, now.contacts, loads, ledger);

  // loads on each body: joint forces in the order of the contacts, then gravity
  sum_loads(model, settings, now.schedule, now.bodies, now.contacts, now.supports, loads);
}

template <int Dim>
void step(const Model<Dim>& model, const Settings& settings, State<Dim>& state,
          const std::function<void(State<Dim>&)>& with_forces) {
  find_forces(model, settings, state);
  if (with_forces) with_forces(state);

  // motion: velocities, then positions and rotations; or the next trial of a static increment
  const State<Dim>& now = state;
  auto& [bodies, contacts, supports, loads, schedule, ledger, counters, time_step, relaxation, increment] = state;
  if (increment.under_way)
    iterate(model, settings, state);
  else if (by_implicit_steps(settings, now))
    move_implicitly(model, settings, state);
  else
    move_bodies(model, settings, now.counters, bodies, contacts, loads, schedule, ledger, time_step, relaxation);
  ++counters.steps;
}

template void find_forces<2>(const Model<2>&, const Settings&, State<2>&);
template void find_forces<3>(const Model<3>&, const Settings&, State<3>&);
template void step<2>(const Model<2>&, const Settings&, State<2>&, const std::function<void(State<2>&)>&);
template void step<3>(const Model<3>&, const Settings&, State<3>&, const std::function<void(State<3>&)>&);

}  // namespace voussoir
