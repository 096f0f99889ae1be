#include "core/run/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "core/model/state_hash.hpp"
#include "core/run/doubts.hpp"
#include "core/run/excavate.hpp"
#include "core/run/history.hpp"
#include "core/run/stable_state.hpp"
#include "core/stage/install_bolts.hpp"
#include "core/stage/install_linings.hpp"
#include "core/step.hpp"
#include "core/step/free_fall.hpp"
#include "core/step/joint_forces.hpp"
#include "core/step/relaxation.hpp"
#include "core/step/static_solver.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr long long steps_between_reports = 1000;

template <int Dim>
bool anything_moves(const Model<Dim>& model) {
  return std::any_of(model.bodies.begin(), model.bodies.end(),
                     [](const Body<Dim>& body) { return body.present && !body.immobile(); });
}

const char* kind_of(const StagePlan& stage) {
  constexpr const char* kinds[] = {"settle", "run", "reduce"};  // in the order of the variant
  return kinds[stage.plan.index()];
}

// what a search yields, and the number that people read for a level
struct SearchedQuantity {
  const char *name, *unit, *found;
  double (*number)(double level);
};

SearchedQuantity sought_by(const ReducePlan& plan) {
  if (plan.searched == Searched::factor)
    return {"factor_of_safety", "1", "factor of safety found", [](double factor) { return factor; }};
  return {"critical_friction", "deg", "critical friction found", to_degrees};
}

std::string and_more(const std::string& detail) {
  return detail.empty() ? "" : "; " + detail;
}

// a stage that has ended
struct StageOutcome {
  std::string ended;
  double unbalanced = -1;  // StageResult::unbalanced
};

template <int Dim>
struct Simulation {
  const Prepared<Dim>& scene;
  const Watcher<Dim>& watcher;
  Progress<Dim>& progress;
  Model<Dim> model;   // of the stage
  Settings settings;  // of the stage
  State<Dim>& state = progress.state;
  Results& results = progress.results;
  double seconds_before = progress.results.seconds;
  std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();

  const StagePlan& plan() const { return scene.stages[progress.stage]; }

  // of the history; trial 0: the path to the answer
  std::vector<double> row(const State<Dim>& now, int trial = 0) const {
    return history_row(scene, model, now, progress.stage + 1, trial, progress.ends);
  }

  void frame(const State<Dim>& now) {
    if (!scene.output.any_frames()) return;
    if (watcher.frame) watcher.frame(model, now, now.schedule.time);
    progress.frames.push_back(now.schedule.time);
    const double interval = scene.output.frame_interval;
    if (interval > 0) progress.next_frame = (std::floor(now.schedule.time / interval) + 1) * interval;
  }

  // The state with the forces at its positions, which a step leaves at those before: rows and frames are of one time.
  // Where a run failed, its forces are what there is to see.
  State<Dim> with_forces(const State<Dim>& now, bool failed) const {
    State<Dim> copy = now;
    if (!failed) find_forces(model, settings, copy);
    return copy;
  }

  void trial_frame(const State<Dim>& now, int trial) {
    if (!scene.output.any_frames()) return;
    if (watcher.trial_frame) watcher.trial_frame(model, now, trial);
    progress.trial_frames.push_back(trial);
  }

  void report_progress(const State<Dim>& now, const std::string& detail, double unbalanced, double done) {
    if (!watcher.progress) return;
    ProgressReport p;
    p.stage = plan().name;
    p.stage_number = progress.stage + 1;
    p.stage_count = static_cast<int>(scene.stages.size());
    p.detail = detail;
    p.steps = now.counters.steps;
    p.time = now.schedule.time;
    p.unbalanced = unbalanced;
    p.done = done;
    watcher.progress(p);
  }

  // an evaluation of Newton's method costs as much as many steps
  bool reports(const State<Dim>& now) const {
    return now.increment.under_way || now.counters.steps % steps_between_reports == 0;
  }

  std::function<bool()> pause() {
    if (!watcher.pause) return {};
    return [this] {
      count_seconds();
      return watcher.pause(progress);
    };
  }

  void count_seconds() {
    results.seconds = seconds_before + std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  }

  // rows, frames and progress while a run continues; `end` is its end time if known
  RunHooks<Dim> record_run(std::optional<double> end) {
    const double begin = progress.stage_began;
    return {.with_forces =
                [this](const State<Dim>& now) {
                  if (progress.record.due(now.schedule.time)) progress.record.add(row(now));
                  if (scene.output.frame_interval > 0 && now.schedule.time >= progress.next_frame) frame(now);
                },
            .after_step =
                [this, begin, end](const State<Dim>& now, double unbalanced) {
                  look_at_bonds(now);
                  if (reports(now))
                    report_progress(now, progress_of_newton(now), unbalanced,
                                    end ? (now.schedule.time - begin) / (*end - begin) : -1);
                },
            .pause = pause()};
  }

  std::string trial_text() const {
    const double target = progress.reduction.target;
    return std::get<ReducePlan>(plan().plan).searched == Searched::factor
               ? fmt::format("trial at a factor of {:.4f}", target)
               : fmt::format("trial at {:.4f} deg", to_degrees(target));
  }

  // a search records the end of each trial
  RunHooks<Dim> report_trials() {
    return {.with_forces = {},
            .after_step =
                [this](const State<Dim>& now, double unbalanced) {
                  look_at_bonds(now);
                  if (reports(now))
                    report_progress(now, trial_text() + and_more(progress_of_newton(now)), unbalanced, -1);
                },
            .pause = pause()};
  }

  void finish_rows(const State<Dim>& now) {
    for (std::vector<double>& r : progress.record.rows)
      results.history.rows.push_back(std::move(r));
    progress.record.rows.clear();
    std::vector<double> last = row(now);
    if (results.history.rows.empty() || results.history.rows.back() != last)
      results.history.rows.push_back(std::move(last));
  }

  // now and then, and where some are new
  void look_at_bonds(const State<Dim>& now) {
    if (now.ledger.bonds.made != progress.bonded.made || reports(now)) remember_bonds(model, now, progress.bonded);
  }

  void note_stable(const State<Dim>& now, std::optional<double> level = {}, const char* unit = "") {
    remember_bonds(model, now, progress.bonded);
    note_stable_state(scene, model, now, progress.bonded, {plan().name, kind_of(plan()), level, unit},
                      results.at_last_stable_state);
  }

  void fail(Outcome outcome, const std::string& message) {
    results.outcome = outcome;
    results.message = "stage " + plan().name + ": " + message;
  }

  void judge(const RunReport& report, bool goal_reached) {
    if (report.reason == StopReason::no_contact_answer || report.reason == StopReason::not_finite)
      fail(Outcome::failed, describe(report.reason) + "; " + report.detail);
    else if (!goal_reached)
      fail(Outcome::incomplete,
           fmt::format("no equilibrium: {} (unbalanced {:.2g}, wanted {:.2g}){}{}", describe(report.reason),
                       report.unbalanced, settings.equilibrium.unbalanced, report.unreached, and_more(report.detail)));
  }

  // each `execute` continues with the stage under way; nothing: interrupted

  // nothing that ties it, and nothing below: before the first step of a stage that would wait for rest
  std::optional<StageOutcome> falls_from_begin(const State<Dim>& now) {
    const int body = tied_to_nothing(model, now);
    if (body < 0) return {};
    fail(Outcome::incomplete,
         fmt::format("no equilibrium: {} falls free: no chain of near blocks, bolts or linings ties it to a block that "
                     "is held, and nothing lies below it; fix what should hold it",
                     label_of(model, body)));
    return StageOutcome{describe(StopReason::falls_free), std::numeric_limits<double>::infinity()};
  }

  std::optional<StageOutcome> execute(const SettlePlan& settle) {
    if (!progress.run.under_way) {
      const State<Dim> now = with_forces(state, false);
      const StagePlan* const before = progress.stage > 0 ? &plan() - 1 : nullptr;
      progress.settle = settle_begin(model, now, before && std::holds_alternative<RunPlan>(before->plan));
      const bool weighs = settle.gravity.to.value_or(settle.gravity.ramp > 0 ? 1 : now.schedule.gravity_factor) != 0;
      if (std::optional<StageOutcome> ended = weighs ? falls_from_begin(now) : std::nullopt) return ended;
    }
    RunGoal goal;
    goal.rest = true;
    goal.time_limit = progress.stage_began + settle.time_limit;
    goal.step_limit = settle.step_limit;
    return go(goal, settle.gravity, StopReason::equilibrium);
  }

  std::optional<StageOutcome> execute(const RunPlan& timed) {
    RunGoal goal;
    goal.end_time = progress.stage_began + timed.duration;
    return go(goal, timed.gravity, StopReason::end_time);
  }

  std::optional<StageOutcome> go(const RunGoal& goal, const GravityPlan& gravity, StopReason wanted) {
    const RunSchedule schedule{.gravity = gravity, .properties = {}, .water = plan().water, .let_off = plan().let_off};
    const RunReport report = run(model, settings, goal, schedule, state, progress.run, record_run(goal.end_time));
    if (report.reason == StopReason::interrupted) return {};
    judge(report, report.reason == wanted);
    if (report.reason == StopReason::equilibrium) note_stable(state);
    return StageOutcome{describe(report.reason), report.unbalanced};
  }

  // A search has the ends of its trials recorded, the detours with their number; at constant rate, where the trial is
  // the whole stage, all that happens.
  std::optional<StageOutcome> execute(const ReducePlan& reduction) {
    const bool continuous = reduction.method == ReductionMethod::rate;
    const bool begins = progress.reduction.begin.empty() && reduction.failure_fraction == 0;
    if (begins && state.schedule.gravity_factor != 0)
      if (std::optional<StageOutcome> ended = falls_from_begin(with_forces(state, false))) return ended;
    const TrialHook<Dim> on_trial = [&](const State<Dim>& moved, double level, Trial outcome) {
      if (outcome == Trial::stable) note_stable(moved, sought_by(reduction).number(level), sought_by(reduction).unit);
      if (continuous) return;
      const State<Dim> now = with_forces(moved, outcome == Trial::broken);
      const int number = progress.reduction.trial + 1;
      const bool detour = is_detour(reduction.method, progress.reduction.trial, outcome);
      results.history.rows.push_back(row(now, detour ? number : 0));
      if (detour) trial_frame(now, number);
    };
    const ReductionReport report = reduce(model, settings, reduction, state, progress.reduction,
                                          continuous ? record_run({}) : report_trials(), on_trial);
    if (report.last.reason == StopReason::interrupted) return {};
    judge(report.last, true);
    const SearchedQuantity sought = sought_by(reduction);
    if (report.bracketed) {
      const bool unique = !results.find(sought.name);
      const std::string name = unique ? sought.name : plan().name + "_" + sought.name;
      Value value{sought.number(report.critical), sought.unit, sought.number(report.error_bar), report.rule};
      if (reduction.searched == Searched::factor) value.divides = divided_by_factor(reduction.properties);
      results.values.emplace_back(name, std::move(value));
    }
    const bool found = report.message.empty();
    if (!found && results.outcome != Outcome::failed)
      fail(Outcome::incomplete,
           (report.bracketed ? "the bracket is wider than asked: " : "no bracket: ") + report.message);
    return StageOutcome{found ? sought.found : describe(report.last.reason), report.unbalanced};
  }

  // A stage that cannot be done ends here: what was done before it is kept.
  std::optional<StageOutcome> execute_stage() {
    if (results.outcome != Outcome::done) return StageOutcome{"bolts that cannot be installed"};
    if (!anything_moves(model)) {
      fail(Outcome::incomplete,
           "no block is free to move: this stage, or one before it, fixed or removed the last; leave one free, or "
           "end with the stage before");
      return StageOutcome{"no block is free to move"};
    }
    try {
      return std::visit([this](const auto& p) { return execute(p); }, plan().plan);
    } catch (const std::logic_error& error) {  // the kernels' word for what makes no sense; files fail otherwise
      fail(Outcome::failed, error.what());
      return StageOutcome{error.what()};
    }
  }

  // model and settings of the stage, whether it begins or continues
  void enter_stage() {
    settings = settings_of(plan(), scene.settings);
    if (!progress.stage_under_way && !plan().change.excavate.empty()) {
      const Excavated<Dim> moved = excavate(plan().change.excavate, settings, plan().let_off.has_value(), model, state);
      for (StageEnd<Dim>& end : progress.ends)
        carry(moved, end);
      carry(moved, progress.bonded);
    }
    model = apply(std::move(model), plan().change);
  }

  void install_bolts() {
    try {
      for (const std::string& idle : voussoir::install_bolts(model, plan().change.install, state))
        results.warnings.push_back(fmt::format(
            "stage {}: the bolts '{}' cross no joint between two blocks and hold nothing; lengthen or move them, or "
            "install them before their blocks are taken out",
            plan().name, idle));
    } catch (const std::invalid_argument& error) {  // grout that does not hold what they are tightened to
      fail(Outcome::failed, error.what());
    }
  }

  void install_linings() {
    release_linings(model, state);
    for (const std::string& idle : voussoir::install_linings(model, plan().change.install, state))
      results.warnings.push_back(fmt::format(
          "stage {}: no block has a face on the outline of the lining '{}', so that nothing holds it; install it after "
          "its excavation is taken out",
          plan().name, idle));
  }

  // where all bodies stand, for the monitors that count from the end of this stage
  void remember_end() {
    const auto counts = [&](const Monitor& m) { return m.since == progress.stage; };
    if (std::ranges::any_of(scene.monitors, counts)) progress.ends.push_back(stage_end(progress.stage, state));
  }

  void begin_stage() {
    for (const int p : properties_changed(model, plan().change)) {
      state.schedule.friction[p] = model.properties[p].friction;
      if (!state.schedule.strength_factor.empty()) state.schedule.strength_factor[p] = 1;
    }
    add_bodies(model, state);  // bolts ask where all bodies are
    remove_bonds(model, state);
    remove_springs(model, state);
    install_bolts();
    install_linings();
    if (plan().change.zero_slip) zero_slip(state);
    if (plan().change.bond) make_bonds(model, settings, state);
    // candidates and time step belong to the stage
    state.bodies.listed_at.clear();
    state.time_step.frequency.clear();
    state.time_step.allowed = 0;
    state.schedule.started = state.schedule.time;
    for (ReliefLoad<Dim>& held : state.loads.relief)
      held.begun = held.share;
    std::erase_if(state.loads.relief,
                  [&](const ReliefLoad<Dim>& held) { return held.share == 0 || !model.bodies[held.body].present; });
    if (state.ledger.energy.phase == LedgerPhase::running) state.ledger.energy.phase = LedgerPhase::model_changed;
    progress.stage_began = state.schedule.time;
    progress.record = {};
    progress.record.interval = scene.output.history_interval;
    progress.run = {};
    progress.reduction = {};
    progress.stage_under_way = true;
  }

  // what has come to rest somewhere else: a later search would judge another slope than the scene's
  void judge_moved(const State<Dim>& now) {
    std::vector<MovedBody> moved = moved_bodies(model, progress.settle, now);
    if (moved.empty()) return;
    const bool left = std::ranges::any_of(moved, &MovedBody::left_all);
    const bool searched = std::any_of(scene.stages.begin() + progress.stage, scene.stages.end(),
                                      [](const StagePlan& s) { return std::holds_alternative<ReducePlan>(s.plan); });
    const std::string told = moved_text(model, moved);
    for (MovedBody& m : moved) {
      m.stage = plan().name;
      results.moved.push_back(std::move(m));
    }
    results.warnings.push_back(fmt::format("stage {}: {}", plan().name, told));
    if (left || searched)
      fail(Outcome::incomplete,
           told + (searched ? "; the search that follows needs the blocks where the scene has them" : ""));
  }

  void end_stage(const StageOutcome& done) {
    StageResult r;
    r.name = plan().name;
    r.kind = kind_of(plan());
    r.ended = done.ended;
    r.relaxed = ends_relaxed(plan(), settings.damping);
    r.steps = state.counters.steps - progress.steps_before;
    r.time = state.schedule.time - progress.stage_began;
    r.time_step = state.time_step.length;
    r.unbalanced = done.unbalanced;
    results.stages.push_back(r);
    std::ranges::copy(doubts_about(results.at_last_stable_state, r.name), std::back_inserter(results.warnings));
    // a stage that lasts for a time is not ended by blocks that have left, but they are hardly what was wanted
    if (const int body = falling_free(model, state); body >= 0 && std::holds_alternative<RunPlan>(plan().plan))
      results.warnings.push_back(
          fmt::format("stage {}: {} falls free, {:.3g} m from where it began: nothing lies below", r.name,
                      label_of(model, body), state.bodies.motions[body].displacement.norm()));
    progress.steps_before = state.counters.steps;
    progress.stage_under_way = false;
    remember_end();
    const State<Dim> now = with_forces(state, results.outcome == Outcome::failed);
    if (std::holds_alternative<SettlePlan>(plan().plan) && results.outcome == Outcome::done) judge_moved(now);
    finish_rows(now);
    for (BoltRow& bolt : bolt_rows(model, now, progress.stage + 1))
      results.bolts.push_back(std::move(bolt));
    for (LiningRow& node : lining_rows(model, now, progress.stage + 1))
      results.linings.push_back(std::move(node));
    frame(now);
    report_progress(state, r.ended, r.unbalanced, 1);
  }

  void add_final_results() {
    std::ranges::move(doubts_of_level(scene.accuracy_level, results), std::back_inserter(results.warnings));
    const std::vector<Column> columns = monitor_columns<Dim>(scene.monitors);
    const std::vector<double> values = monitor_values<Dim>(
        scene.monitors, model, with_forces(state, results.outcome == Outcome::failed), progress.ends);
    for (std::size_t k = 0; k < columns.size(); ++k)
      results.values.push_back({columns[k].name, {values[k], columns[k].unit, {}, "at the end"}});
    results.counters = state.counters;
    count_all_bonds(scene, state, results);
    results.state_hash = state_hash(model, state);
    results.energy = state.ledger.energy;
    for (const ReliefLoad<Dim>& held : state.loads.relief)
      if (model.bodies[held.body].present) results.relief_left = std::max(results.relief_left, held.share);
    const auto begun = std::span(scene.stages).first(std::min<std::size_t>(progress.stage + 1, scene.stages.size()));
    if (std::string doubts = doubts_of(state.ledger.energy, begun, scene.settings); !doubts.empty())
      results.warnings.push_back(std::move(doubts));
  }

  // false: interrupted
  bool execute_all() {
    for (int s = 0; s < progress.stage; ++s)
      model = apply(std::move(model), scene.stages[s].change);
    const int last = scene.last_stage.value_or(static_cast<int>(scene.stages.size()) - 1);
    while (progress.stage <= last) {
      enter_stage();
      if (!progress.stage_under_way) begin_stage();
      const std::optional<StageOutcome> done = execute_stage();
      if (!done) return false;
      end_stage(*done);
      if (results.outcome != Outcome::done) break;
      ++progress.stage;
    }
    if (watcher.ended) watcher.ended(progress);
    add_final_results();
    return true;
  }
};

}  // namespace

template <int Dim>
Progress<Dim> initial_progress(const Prepared<Dim>& scene) {
  Progress<Dim> progress;
  progress.state = scene.state;
  progress.results.history.columns = history_columns(scene);
  return progress;
}

template <int Dim>
bool simulate(const Prepared<Dim>& scene, Progress<Dim>& progress, const Watcher<Dim>& watcher) {
  Simulation<Dim> simulation{
      .scene = scene, .watcher = watcher, .progress = progress, .model = scene.model, .settings = {}};
  const bool done = simulation.execute_all();
  simulation.count_seconds();
  return done;
}

template <int Dim>
History history_so_far(const Progress<Dim>& progress) {
  History history = progress.results.history;
  history.rows.insert(history.rows.end(), progress.record.rows.begin(), progress.record.rows.end());
  return history;
}

template History history_so_far<2>(const Progress<2>&);
template History history_so_far<3>(const Progress<3>&);
template Progress<2> initial_progress(const Prepared<2>&);
template Progress<3> initial_progress(const Prepared<3>&);
template bool simulate<2>(const Prepared<2>&, Progress<2>&, const Watcher<2>&);
template bool simulate<3>(const Prepared<3>&, Progress<3>&, const Watcher<3>&);

}  // namespace voussoir
