#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/commands.hpp"
#include "app/commands/progress_line.hpp"
#include "app/commands/study_plan.hpp"
#include "app/message.hpp"
#include "app/run_folder.hpp"
#include "app/run_scene.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/results_json.hpp"

namespace voussoir {
namespace {

// one line of study.csv
struct StudyRow {
  std::string curve;  // the sweep's name; extrapolations from it are a curve of their own
  const Sweep* sweep = nullptr;
  std::string value;
  std::optional<double> result, error_bar;  // without a result: the run failed
  std::string result_unit;
  std::string status = "ok";  // or what went wrong
  Counters counters;
  double seconds = 0;
};

std::vector<std::string> overrides_of(const Sweep& sweep, const std::string& value) {
  std::vector<std::string> overrides = sweep.overrides;
  overrides.push_back(sweep.key + "=" + value);
  // pictures cost time and say nothing here
  overrides.push_back("output.frames=false");
  return overrides;
}

std::string shown(const std::string& value) {
  return value.starts_with('"') ? value.substr(1, value.size() - 2) : value;
}

// a mistake in the last sweep should not show after an hour
void check_every_run(const StudyPlan& plan) {
  for (const Sweep& sweep : plan.sweeps)
    for (const std::string& value : sweep.values)
      load_scene(sweep.scene, overrides_of(sweep, value));
}

StudyRow run_row(const StudyPlan& plan, const Sweep& sweep, const std::string& value, const StudyArguments& arguments) {
  ProgressLine progress(!arguments.quiet);
  const ProgressHook show = [&](const ProgressReport& report) { progress.show(report); };
  const Results results = run_scene(sweep.scene, overrides_of(sweep, value), arguments.threads, show).results;

  StudyRow row;
  row.sweep = &sweep;
  row.curve = sweep.name;
  row.value = shown(value);
  row.counters = results.counters;
  row.seconds = results.seconds;
  const Value* found = results.find(plan.quantity);
  if (results.outcome != Outcome::done) {
    row.status = outcome_name(results.outcome) + ": " + results.message;
  } else if (!found || !std::isfinite(found->value)) {
    row.status = "no value of this name";
  } else {
    row.result = found->value;
    row.error_bar = found->error_bar;
    row.result_unit = found->unit;
  }
  return row;
}

// Two results and result = limit + constant · value^power give the limit at value 0. Its error bar is how far it lies
// from the nearer of the two; once there is an extrapolation from coarser runs, how far it lies from that. Its cost is
// that of both runs.
StudyRow extrapolate(const Sweep& sweep, const StudyRow& first, double a, const StudyRow& second, double b) {
  StudyRow row;
  row.sweep = &sweep;
  row.curve = sweep.name + " (extrapolated)";
  row.value = fmt::format("extrapolated {}->{}", first.value, second.value);
  row.counters.contact_evaluations = first.counters.contact_evaluations + second.counters.contact_evaluations;
  row.counters.steps = first.counters.steps + second.counters.steps;
  row.seconds = first.seconds + second.seconds;
  if (!first.result || !second.result) {
    row.status = "a run to extrapolate from failed";
    return row;
  }
  const double pa = std::pow(a, *sweep.power), pb = std::pow(b, *sweep.power);
  row.result = (*second.result * pa - *first.result * pb) / (pa - pb);
  row.error_bar = std::min(std::abs(*row.result - *first.result), std::abs(*row.result - *second.result));
  row.result_unit = second.result_unit;
  return row;
}

std::string study_csv(const StudyPlan& plan, const std::vector<StudyRow>& rows) {
  std::string text =
      "sweep,key,value,unit,quantity,result,error_bar,result_unit,status,contact_evaluations,steps,seconds\n";
  for (const StudyRow& row : rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{:.3f}\n", csv_cell(row.curve), csv_cell(row.sweep->key),
                        csv_cell(row.value), csv_cell(row.sweep->unit), csv_cell(plan.quantity),
                        row.result ? csv_cell(*row.result) : "", row.error_bar ? csv_cell(*row.error_bar) : "",
                        csv_cell(row.result_unit), csv_cell(row.status), row.counters.contact_evaluations,
                        row.counters.steps, row.seconds);
  return text;
}

void tell_row(const StudyArguments& arguments, const StudyPlan& plan, const StudyRow& row) {
  if (arguments.quiet) return;
  const std::string result =
      row.result ? fmt::format("{} = {:.8g} {}", plan.quantity, *row.result, row.result_unit) : row.status;
  tell("{}: {} = {}: {} ({} contact evaluations, {})\n", row.curve, row.sweep->key, row.value, result,
       row.counters.contact_evaluations, duration_text(row.seconds));
}

std::vector<StudyRow> run_sweep(const StudyPlan& plan, const Sweep& sweep, const StudyArguments& arguments) {
  std::vector<StudyRow> rows;
  for (const std::string& value : sweep.values) {
    rows.push_back(run_row(plan, sweep, value, arguments));
    tell_row(arguments, plan, rows.back());
  }
  if (!sweep.power) return rows;
  std::optional<double> coarser;
  for (std::size_t k = 0; k + 1 < sweep.values.size(); ++k) {
    StudyRow row = extrapolate(sweep, rows[k], *sweep.numbers[k], rows[k + 1], *sweep.numbers[k + 1]);
    if (row.result && coarser) row.error_bar = std::abs(*row.result - *coarser);
    coarser = row.result;
    rows.push_back(row);
    tell_row(arguments, plan, rows.back());
  }
  return rows;
}

}  // namespace

ExitCode study_command(const StudyArguments& arguments) {
  const StudyPlan plan = read_study_plan(arguments.plan);
  check_every_run(plan);
  const FolderLock lock(arguments.out);

  std::vector<StudyRow> rows;
  for (const Sweep& sweep : plan.sweeps) {
    const std::vector<StudyRow> more = run_sweep(plan, sweep, arguments);
    rows.insert(rows.end(), more.begin(), more.end());
  }
  write_file(arguments.out / "study.csv", study_csv(plan, rows));

  const auto failed = std::count_if(rows.begin(), rows.end(), [](const StudyRow& row) { return !row.result; });
  fmt::print("{} settings, {} failed: {}\n", rows.size(), failed, (arguments.out / "study.csv").string());
  return failed > 0 ? ExitCode::incomplete : ExitCode::done;
}

}  // namespace voussoir
