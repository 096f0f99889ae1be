#include "core/run/half_error.hpp"

#include <algorithm>

#include "core/implicit/implicit_step.hpp"

namespace voussoir {

template <int Dim>
bool run_by_half_error(const RunPlan& timed, const StageInForce<Dim>& stage, const Watcher<Dim>& watcher,
                       Progress<Dim>& progress) {
  Settings finer = stage.settings;
  finer.time.error = 0.5 * (finer.time.error > 0 ? finer.time.error : default_step_error(stage.model));
  RunGoal goal;
  goal.end_time = progress.stage_began + timed.duration;
  const RunSchedule schedule{.gravity = timed.gravity,
                             .properties = {},
                             .water = stage.plan().water,
                             .excavation_forces = stage.plan().excavation_forces};
  State<Dim> state = progress.state;
  RunProgress<Dim> own;
  RunHooks<Dim> hooks;
  if (watcher.pause) hooks.pause = [&] { return watcher.pause(progress); };
  if (run(stage.model, finer, goal, schedule, state, own, hooks).reason == StopReason::interrupted) return false;
  progress.by_half_error.clear();
  for (const Motion<Dim>& motion : state.bodies.motions)
    progress.by_half_error.push_back(motion.displacement);
  return true;
}

template <int Dim>
std::optional<HalfErrorResult> judge_half_error(const Model<Dim>& model, const Progress<Dim>& progress) {
  if (progress.by_half_error.empty()) return {};
  HalfErrorResult result;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed || !model.bodies[b].present) continue;
    const Vector<Dim>& end = progress.state.bodies.motions[b].displacement;
    result.change = std::max(result.change, (end - progress.by_half_error[b]).norm());
    const double moved = (end - progress.settle.placed[b].displacement).norm();
    if (result.body >= 0 && moved <= result.displacement) continue;
    result.body = static_cast<int>(b);
    result.name = model.bodies[b].name;
    result.displacement = moved;
  }
  return result;
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                      \
  template bool run_by_half_error<Dim>(const RunPlan&, const StageInForce<Dim>&, const Watcher<Dim>&, Progress<Dim>&); \
  template std::optional<HalfErrorResult> judge_half_error<Dim>(const Model<Dim>&, const Progress<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
