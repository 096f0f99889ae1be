#include "core/run/record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/multiples.hpp"
#include "core/run/history.hpp"
#include "core/run/stable_state.hpp"
#include "core/step/static_solver.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr long long steps_between_reports = 1000;

// an evaluation of the static solver costs as much as many steps
template <int Dim>
bool reports(const State<Dim>& state) {
  return state.increment.under_way || state.counters.steps % steps_between_reports == 0;
}

// now and then, and when some are new
template <int Dim>
void look_at_bonds(const StageInForce<Dim>& stage, const State<Dim>& state, Progress<Dim>& progress) {
  if (state.ledger.bonds.made != progress.bonded.made || reports(state))
    remember_bonds(stage.model, state, progress.bonded);
}

template <int Dim>
std::function<bool()> pause_of(const Watcher<Dim>& watcher, const Progress<Dim>& progress) {
  if (!watcher.pause) return {};
  return [&] { return watcher.pause(progress); };
}

std::string trial_text(const ReducePlan& plan, double target) {
  return plan.searched == Searched::factor ? fmt::format("trial at a factor of {:.4f}", target)
                                           : fmt::format("trial at {:.4f} deg", to_degrees(target));
}

}  // namespace

std::string and_more(const std::string& detail) {
  return detail.empty() ? "" : "; " + detail;
}

template <int Dim>
std::vector<double> row_of(const StageInForce<Dim>& stage, const State<Dim>& state,
                           const std::vector<StageEnd<Dim>>& ends, int trial) {
  return history_row(stage.scene, stage.model, state, stage.place + 1, trial, ends);
}

template <int Dim>
void add_frame(const StageInForce<Dim>& stage, const State<Dim>& state, const Watcher<Dim>& watcher,
               Progress<Dim>& progress) {
  const OutputPlan& output = stage.scene.output;
  if (!output.any_frames()) return;
  const double time = state.schedule.time, interval = output.frame_interval;
  if (watcher.frame) watcher.frame(stage.model, state, time);
  progress.frames.push_back(time);
  if (interval > 0) progress.next_frame = next_multiple(time, interval);
}

template <int Dim>
void add_trial_frame(const StageInForce<Dim>& stage, const State<Dim>& state, int trial, const Watcher<Dim>& watcher,
                     Progress<Dim>& progress) {
  if (!stage.scene.output.any_frames()) return;
  if (watcher.trial_frame) watcher.trial_frame(stage.model, state, trial);
  progress.trial_frames.push_back(trial);
}

template <int Dim>
void report_progress(const StageInForce<Dim>& stage, const State<Dim>& state, const std::string& detail,
                     double unbalanced, double done, const Watcher<Dim>& watcher) {
  if (!watcher.progress) return;
  ProgressReport p;
  p.stage = stage.plan().name;
  p.stage_number = stage.place + 1;
  p.stage_count = static_cast<int>(stage.scene.stages.size());
  p.detail = detail;
  p.steps = state.counters.steps;
  p.time = state.schedule.time;
  p.unbalanced = unbalanced;
  p.done = done;
  watcher.progress(p);
}

template <int Dim>
RunHooks<Dim> record_run(const StageInForce<Dim>& stage, std::optional<double> end, const Watcher<Dim>& watcher,
                         Progress<Dim>& progress) {
  const double begin = progress.stage_began;
  return {.with_forces =
              [&, stage](const State<Dim>& state) {
                const double time = state.schedule.time, frames = stage.scene.output.frame_interval;
                if (progress.record.due(time)) progress.record.add(row_of(stage, state, progress.ends));
                if (frames > 0 && is_reached(time, progress.next_frame, frames))
                  add_frame(stage, state, watcher, progress);
              },
          .after_step =
              [&, stage, begin, end](const State<Dim>& state, double unbalanced) {
                look_at_bonds(stage, state, progress);
                if (reports(state))
                  report_progress(stage, state, progress_of_newton(state), unbalanced,
                                  end ? (state.schedule.time - begin) / (*end - begin) : -1, watcher);
              },
          .pause = pause_of(watcher, progress)};
}

template <int Dim>
RunHooks<Dim> report_trials(const StageInForce<Dim>& stage, const Watcher<Dim>& watcher, Progress<Dim>& progress) {
  return {.with_forces = {},
          .after_step =
              [&, stage](const State<Dim>& state, double unbalanced) {
                look_at_bonds(stage, state, progress);
                if (!reports(state)) return;
                const std::string trial =
                    trial_text(std::get<ReducePlan>(stage.plan().plan), progress.reduction.target);
                report_progress(stage, state, trial + and_more(progress_of_newton(state)), unbalanced, -1, watcher);
              },
          .pause = pause_of(watcher, progress)};
}

template <int Dim>
void finish_rows(const StageInForce<Dim>& stage, const State<Dim>& state, Progress<Dim>& progress) {
  std::vector<std::vector<double>>& rows = progress.results.history.rows;
  for (std::vector<double>& r : progress.record.rows)
    rows.push_back(std::move(r));
  progress.record.rows.clear();
  std::vector<double> last = row_of(stage, state, progress.ends);
  if (rows.empty() || rows.back() != last) rows.push_back(std::move(last));
}

template <int Dim>
void note_stable(const StageInForce<Dim>& stage, const State<Dim>& state, Progress<Dim>& progress,
                 const std::optional<TrialRow>& trial) {
  remember_bonds(stage.model, state, progress.bonded);
  StableState at{stage.plan().name, kind_of(stage.plan()), {}, ""};
  if (trial) {
    at.level = trial->level;
    at.unit = trial->unit;
    at.trial = trial;
  }
  note_stable_state(stage.scene, stage.model, state, progress.bonded, at, progress.results.at_last_stable_state);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                     \
  template std::vector<double> row_of<Dim>(const StageInForce<Dim>&, const State<Dim>&,                               \
                                           const std::vector<StageEnd<Dim>>&, int);                                   \
  template void add_frame<Dim>(const StageInForce<Dim>&, const State<Dim>&, const Watcher<Dim>&, Progress<Dim>&);     \
  template void add_trial_frame<Dim>(const StageInForce<Dim>&, const State<Dim>&, int, const Watcher<Dim>&,           \
                                     Progress<Dim>&);                                                                 \
  template void report_progress<Dim>(const StageInForce<Dim>&, const State<Dim>&, const std::string&, double, double, \
                                     const Watcher<Dim>&);                                                            \
  template RunHooks<Dim> record_run<Dim>(const StageInForce<Dim>&, std::optional<double>, const Watcher<Dim>&,        \
                                         Progress<Dim>&);                                                             \
  template RunHooks<Dim> report_trials<Dim>(const StageInForce<Dim>&, const Watcher<Dim>&, Progress<Dim>&);           \
  template void finish_rows<Dim>(const StageInForce<Dim>&, const State<Dim>&, Progress<Dim>&);                        \
  template void note_stable<Dim>(const StageInForce<Dim>&, const State<Dim>&, Progress<Dim>&,                         \
                                 const std::optional<TrialRow>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
