#include "core/simulate.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "core/monitor.hpp"
#include "core/reduction/reduction.hpp"

namespace voussoir {
namespace {

constexpr double degrees = 180 / std::numbers::pi;
constexpr long long steps_between_reports = 1000;

// a stage that was run
struct Executed {
  std::string kind, ended;
  RunReport report;
};

template <int Dim>
struct Simulation {
  Prepared<Dim> scene;
  const Watcher<Dim>& watcher;
  Results results;
  Model<Dim> model;
  State<Dim> state;
  Settings settings;           // of the stage
  int stage = 0;               // from 0
  long long steps_before = 0;  // of the stages that ended
  double next_frame = 0;       // s

  // a row of the history: time, friction angle, monitors
  std::vector<double> row(const State<Dim>& now) const {
    std::vector<double> values{now.time, static_cast<double>(stage + 1)};
    values.push_back(now.schedule.friction.empty() ? 0 : now.schedule.friction.front() * degrees);
    const std::vector<double> monitored = monitor_values<Dim>(scene.monitors, model, now);
    values.insert(values.end(), monitored.begin(), monitored.end());
    return values;
  }

  void prepare_history() {
    results.history.columns = {"time_s", "stage", "friction_deg"};
    for (const Column& c : monitor_columns<Dim>(scene.monitors))
      results.history.columns.push_back(c.header());
  }

  void frame(const State<Dim>& now) {
    if (watcher.frame && scene.output.frames) watcher.frame(model, now, now.time);
  }

  void tell(const State<Dim>& now, const std::string& detail, double unbalanced, double done) {
    if (!watcher.progress) return;
    ProgressReport p;
    p.stage = scene.stages[stage].name;
    p.stage_number = stage + 1;
    p.stage_count = static_cast<int>(scene.stages.size());
    p.detail = detail;
    p.steps = now.counters.steps;
    p.time = now.time;
    p.unbalanced = unbalanced;
    p.done = done;
    watcher.progress(p);
  }

  // rows, frames and progress while a run goes on; `end` is its end time if known
  StepHook<Dim> recorder(StageRecord& record, double begin, double end) {
    return [this, &record, begin, end](const State<Dim>& now, double unbalanced) {
      if (record.due(now.time)) record.add(row(now));
      if (scene.output.frame_interval > 0 && now.time >= next_frame) {
        frame(now);
        next_frame = (std::floor(now.time / scene.output.frame_interval) + 1) * scene.output.frame_interval;
      }
      if (now.counters.steps % steps_between_reports == 0)
        tell(now, "", unbalanced, end < 1e299 ? (now.time - begin) / (end - begin) : -1);
    };
  }

  void finish_rows(StageRecord& record) {
    for (std::vector<double>& r : record.take())
      results.history.rows.push_back(std::move(r));
    std::vector<double> last = row(state);
    if (results.history.rows.empty() || results.history.rows.back() != last)
      results.history.rows.push_back(std::move(last));
  }

  void fail(Outcome outcome, const std::string& message) {
    results.outcome = outcome;
    results.message = "stage " + scene.stages[stage].name + ": " + message;
  }

  void judge(const RunReport& report, bool goal_reached) {
    if (report.reason == StopReason::no_contact_answer || report.reason == StopReason::not_finite)
      fail(Outcome::failed, describe(report.reason) + "; " + report.detail);
    else if (!goal_reached)
      fail(Outcome::incomplete,
           fmt::format("no equilibrium: {} (unbalanced {:.2g}, wanted {:.2g})", describe(report.reason),
                       report.unbalanced, settings.equilibrium.unbalanced));
  }

  RunReport go(const RunGoal& goal, const RunSchedule& schedule, double end) {
    StageRecord record(scene.output.history_interval);
    const RunReport report = run(model, settings, goal, schedule, state, recorder(record, state.time, end));
    finish_rows(record);
    return report;
  }

  Executed execute(const SettlePlan& plan) {
    RunGoal goal;
    goal.rest = true;
    goal.time_limit = state.time + plan.time_limit;
    goal.step_limit = plan.step_limit;
    const RunReport report = go(goal, {.gravity_ramp = plan.gravity_ramp, .properties = {}}, 1e300);
    judge(report, report.reason == StopReason::equilibrium);
    return {"settle", describe(report.reason), report};
  }

  Executed execute(const RunPlan& plan) {
    RunGoal goal;
    goal.end_time = state.time + plan.duration;
    const RunReport report = go(goal, {.gravity_ramp = plan.gravity_ramp, .properties = {}}, goal.end_time);
    judge(report, report.reason == StopReason::end_time);
    return {"run", describe(report.reason), report};
  }

  // a reduction records the end of each trial; at constant rate, where the trial is the whole stage, all along
  Executed execute(const ReducePlan& plan) {
    StageRecord record(scene.output.history_interval);
    const bool continuous = plan.method == ReductionMethod::rate;
    const StepHook<Dim> record_all = recorder(record, state.time, 1e300);
    std::string trial;
    const StepHook<Dim> on_step = [&](const State<Dim>& now, double unbalanced) {
      if (continuous)
        record_all(now, unbalanced);
      else if (now.counters.steps % steps_between_reports == 0)
        tell(now, trial, unbalanced, -1);
    };
    const TrialHook<Dim> on_trial = [&](const State<Dim>& now, double friction, Trial outcome) {
      if (!continuous) results.history.rows.push_back(row(now));
      if (outcome == Trial::failed) frame(now);
      trial = fmt::format("after {:.4f} deg: {}", friction * degrees, outcome == Trial::stable ? "stable" : "failed");
    };
    const ReductionReport report = reduce(model, settings, plan, state, on_step, on_trial);
    finish_rows(record);
    judge(report.last, true);
    if (report.bracketed) {
      const bool unique = !results.find("critical_friction");
      const std::string name = unique ? "critical_friction" : scene.stages[stage].name + "_critical_friction";
      results.values.push_back({name, {report.critical * degrees, "deg", report.error_bar * degrees, report.rule}});
    } else if (results.outcome != Outcome::failed) {
      fail(Outcome::incomplete, "no bracket: " + report.message);
    }
    return {"reduce", report.bracketed ? "critical friction found" : describe(report.last.reason), report.last};
  }

  void begin_stage(const StagePlan& plan) {
    settings = scene.settings;
    if (plan.damping) settings.damping = *plan.damping;
    model = apply(std::move(model), plan.change);
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      if (!model.bodies[b].fixed) continue;
      state.motions[b].velocity.setZero();
      state.motions[b].angular_momentum.setZero();
    }
    if (plan.change.friction)
      for (std::size_t p = 0; p < model.properties.size(); ++p)
        state.schedule.friction[p] = model.properties[p].friction;
    // candidates and time step belong to the stage
    state.built.clear();
    state.frequency.clear();
    state.step_allowed = 0;
    state.schedule.started = state.time;
  }

  void end_stage(const std::string& kind, const std::string& ended, const RunReport& report) {
    StageResult r;
    r.name = scene.stages[stage].name;
    r.kind = kind;
    r.ended = ended;
    r.steps = state.counters.steps - steps_before;
    r.time = state.time - state.schedule.started;
    r.time_step = state.time_step;
    r.unbalanced = report.unbalanced;
    results.stages.push_back(r);
    steps_before = state.counters.steps;
    frame(state);
    tell(state, r.ended, report.unbalanced, 1);
  }

  void add_final_values() {
    const std::vector<Column> columns = monitor_columns<Dim>(scene.monitors);
    const std::vector<double> values = monitor_values<Dim>(scene.monitors, model, state);
    for (std::size_t k = 0; k < columns.size(); ++k)
      results.values.push_back({columns[k].name, {values[k], columns[k].unit, {}, "at the end"}});
  }

  void execute_all() {
    prepare_history();
    for (stage = 0; stage < static_cast<int>(scene.stages.size()); ++stage) {
      const StagePlan& plan = scene.stages[stage];
      begin_stage(plan);
      const Executed done = std::visit([this](const auto& p) { return execute(p); }, plan.plan);
      end_stage(done.kind, done.ended, done.report);
      if (results.outcome != Outcome::done) break;
    }
    add_final_values();
    results.counters = state.counters;
  }
};

}  // namespace

template <int Dim>
Results simulate(Prepared<Dim> scene, const Watcher<Dim>& watcher) {
  const auto begin = std::chrono::steady_clock::now();
  Simulation<Dim> simulation{
      .scene = std::move(scene), .watcher = watcher, .results = {}, .model = {}, .state = {}, .settings = {}};
  simulation.model = simulation.scene.model;
  simulation.state = simulation.scene.state;
  simulation.execute_all();
  simulation.results.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return std::move(simulation.results);
}

template Results simulate<2>(Prepared<2>, const Watcher<2>&);
template Results simulate<3>(Prepared<3>, const Watcher<3>&);

}  // namespace voussoir
