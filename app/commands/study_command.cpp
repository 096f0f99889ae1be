#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "app/bad_input.hpp"
#include "app/child_process.hpp"
#include "app/claimed_folder.hpp"
#include "app/commands/commands.hpp"
#include "app/commands/study_found.hpp"
#include "app/commands/study_plan.hpp"
#include "app/commands/study_runs.hpp"
#include "app/interruption.hpp"
#include "app/message.hpp"
#include "app/run_folder.hpp"
#include "app/run_scene.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/fingerprint.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/shared_stages.hpp"
#include "text/csv_table.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// one line of study.csv
struct StudyRow {
  std::string curve;  // the sweep's name; extrapolations from it are a curve of their own
  std::string key, value, unit;
  std::optional<double> result, error_bar;  // without a result: the run failed
  std::string result_unit;
  std::string status = "ok";  // or what went wrong
  long long contact_evaluations = 0, steps = 0;
  double seconds = 0;
};

std::vector<std::string> overrides_of(const Sweep& sweep, std::size_t place) {
  std::vector<std::string> overrides = sweep.overrides;
  if (!sweep.key.empty()) overrides.push_back(sweep.key + "=" + sweep.values[place]);
  for (const TiedKey& tied : sweep.with)
    overrides.push_back(tied.key + "=" + tied.values[place]);
  // pictures cost time and say nothing here
  overrides.push_back("output.frames=false");
  return overrides;
}

std::string shown(const std::string& value) {
  return value.starts_with('"') ? value.substr(1, value.size() - 2) : value;
}

// what a run shares with all that are the same up to the end of a stage, what they record included
std::string shared_text(const StudyPlan& plan, const Sweep& sweep, const Scene& scene) {
  std::vector<std::string> names;
  for (const StageSpec& stage : scene.stages)
    names.push_back(stage.plan.name);
  const auto found = std::find(names.begin(), names.end(), plan.begin);
  if (found == names.end())
    throw BadInput(fmt::format("begin = \"{}\": no stage of '{}' has this name; {}", one_line(plan.begin, 60),
                               sweep.scene.string(), suggestion(plan.begin, names)));
  std::string text = canonical_text(shared_part(scene, static_cast<int>(found - names.begin()) + 1));
  for (const char* key : {"monitors", "output"})
    if (const Node* part = scene.tree->find(key)) text += canonical_text(*part);
  return text;
}

// Every setting of every sweep, in order. Reading them all first: a mistake in the last should not show after an hour.
std::vector<StudyRun> runs_of(const StudyPlan& plan) {
  const std::string program = fingerprint(program_bytes());
  std::vector<StudyRun> runs;
  for (const Sweep& sweep : plan.sweeps)
    for (std::size_t k = 0; k < sweep.values.size(); ++k) {
      StudyRun run{sweep.scene, overrides_of(sweep, k), sweep.limit, {}, ""};
      const LoadedScene scene = load_scene(run.scene, run.overrides);
      run.files = scene.files;
      std::string what = scene.hash + program;
      for (const std::string& option : run.limit.value_or(std::vector<std::string>()))
        what += " " + option;
      if (run.limit) what += " limit";
      run.name = folder_name(what);
      if (!plan.begin.empty() && !run.limit)
        run.begin = folder_name("until " + shared_text(plan, sweep, *scene.stated) + program);
      runs.push_back(std::move(run));
    }
  return runs;
}

// The runs that make what others begin with: of each the first that needs it, up to the stage. What is there is kept;
// where all that need it are done it is not made again.
std::vector<StudyRun> generations_of(const StudyPlan& plan, const std::vector<StudyRun>& runs) {
  std::vector<StudyRun> generations;
  std::set<fs::path> listed;
  for (const StudyRun& run : runs)
    if (!run.begin.empty() && listed.insert(run.begin).second)
      generations.push_back({run.scene, run.overrides, {}, run.files, run.begin.string(), plan.begin});
  return generations;
}

std::vector<StudyRun> needed(const std::vector<StudyRun>& generations, const std::vector<StudyRun>& runs,
                             const fs::path& folder) {
  std::vector<StudyRun> needed;
  for (const StudyRun& generation : generations)
    if (std::any_of(runs.begin(), runs.end(), [&](const StudyRun& run) {
          return run.begin == fs::path(generation.name) && !holds_results(folder / run.name);
        }))
      needed.push_back(generation);
  return needed;
}

std::vector<StudyRun> in_folder(std::vector<StudyRun> runs, const fs::path& folder) {
  for (StudyRun& run : runs)
    if (!run.begin.empty()) run.begin = folder / run.begin;
  return runs;
}

// a run that had nothing to begin with says why that is
void tell_generations(const std::vector<StudyRun>& generations, const RunsEnded& generated,
                      const std::vector<StudyRun>& runs, RunsEnded& ended) {
  for (std::size_t g = 0; g < generations.size(); ++g)
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (!generated.failures[g].empty() && !ended.failures[k].empty() && runs[k].begin == generations[g].name)
        ended.failures[k] = fmt::format("the run up to stage '{}' failed: {}", one_line(generations[g].until, 60),
                                        generated.failures[g]);
}

// a folder for each different run, by its name
Outputs outputs_of(const std::vector<StudyRun>& runs) {
  Outputs outputs{"study", {"study.csv"}, false, {}, true};
  for (const StudyRun& run : runs)
    outputs.folders.push_back("runs/" + run.name);
  std::sort(outputs.folders.begin(), outputs.folders.end());
  outputs.folders.erase(std::unique(outputs.folders.begin(), outputs.folders.end()), outputs.folders.end());
  return outputs;
}

std::vector<fs::path> inputs_of(const fs::path& plan, const std::vector<StudyRun>& runs) {
  std::set<fs::path> inputs{plan};
  for (const StudyRun& run : runs)
    inputs.insert(run.files.begin(), run.files.end());
  return {inputs.begin(), inputs.end()};
}

StudyRow row_of(const StudyPlan& plan, const Sweep& sweep, const std::string& value, const fs::path& folder,
                const std::string& failure) {
  StudyRow row;
  row.curve = sweep.name;
  row.key = sweep.key;
  row.value = shown(value);
  row.unit = sweep.unit;
  const RunFound found = failure.empty() ? found_in(folder, plan) : RunFound{.status = failure};
  row.status = found.status;
  row.contact_evaluations = found.contact_evaluations;
  row.steps = found.steps;
  row.seconds = found.seconds;
  if (found.result) {
    row.result = found.result->value;
    row.error_bar = found.result->error_bar;
    row.result_unit = found.result->unit;
  }
  return row;
}

// Two results and result = limit + constant · value^power give the limit at value 0. Its error bar is how far it lies
// from the nearer of the two; once there is an extrapolation from coarser runs, how far it lies from that. Its cost is
// that of both runs.
StudyRow extrapolate(const Sweep& sweep, const StudyRow& first, double a, const StudyRow& second, double b) {
  StudyRow row;
  row.curve = sweep.name + " (extrapolated)";
  row.key = sweep.key;
  row.unit = sweep.unit;
  row.value = fmt::format("extrapolated {}->{}", first.value, second.value);
  row.contact_evaluations = first.contact_evaluations + second.contact_evaluations;
  row.steps = first.steps + second.steps;
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

void add_extrapolations(const Sweep& sweep, std::vector<StudyRow>& rows) {
  const std::size_t first = rows.size() - sweep.values.size();
  std::optional<double> coarser;
  for (std::size_t k = 0; k + 1 < sweep.values.size(); ++k) {
    StudyRow row = extrapolate(sweep, rows[first + k], *sweep.numbers[k], rows[first + k + 1], *sweep.numbers[k + 1]);
    if (row.result && coarser) row.error_bar = std::abs(*row.result - *coarser);
    coarser = row.result;
    rows.push_back(row);
  }
}

std::vector<StudyRow> rows_of(const StudyPlan& plan, const std::vector<StudyRun>& runs, const RunsEnded& ended,
                              const fs::path& folder) {
  std::vector<StudyRow> rows;
  std::size_t next = 0;
  for (const Sweep& sweep : plan.sweeps) {
    for (const std::string& value : sweep.values) {
      rows.push_back(row_of(plan, sweep, value, folder / runs[next].name, ended.failures[next]));
      ++next;
    }
    if (sweep.power) add_extrapolations(sweep, rows);
  }
  return rows;
}

std::string study_csv(const StudyPlan& plan, const std::vector<StudyRow>& rows) {
  std::string text =
      "sweep,key,value,unit,quantity,result,error_bar,result_unit,status,contact_evaluations,steps,seconds\n";
  for (const StudyRow& row : rows)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{:.3f}\n", csv_cell(row.curve), csv_cell(row.key),
                        csv_cell(row.value), csv_cell(row.unit), csv_cell(plan.quantity), csv_cell(row.result),
                        csv_cell(row.error_bar), csv_cell(row.result_unit), csv_cell(row.status),
                        row.contact_evaluations, row.steps, row.seconds);
  return text;
}

ExitCode tell_end(const std::vector<StudyRow>& rows, const RunsEnded& ended, const fs::path& file) {
  const auto failed = std::count_if(rows.begin(), rows.end(), [](const StudyRow& row) { return !row.result; });
  fmt::print("{} settings, {} failed: {}\n", rows.size(), failed, file.string());
  fmt::print("{} different runs, {} of them kept from before\n", ended.runs, ended.kept);
  for (const StudyRow& row : rows)
    if (!row.result) fmt::print("failed: {}: {} = {}: {}\n", row.curve, row.key, row.value, row.status);
  return failed > 0 ? ExitCode::incomplete : ExitCode::done;
}

}  // namespace

ExitCode study_command(const StudyArguments& arguments) {
  const StudyPlan plan = read_study_plan(arguments.plan);
  const std::vector<StudyRun> runs = runs_of(plan);
  const std::vector<StudyRun> generations = generations_of(plan, runs);
  std::vector<StudyRun> all = generations;
  all.insert(all.end(), runs.begin(), runs.end());
  const ClaimedFolder claim(arguments.out, outputs_of(all), inputs_of(arguments.plan, runs), arguments.overwrite);

  RunsOptions options{arguments.out / "runs", arguments.jobs, arguments.threads, arguments.time_limit, arguments.quiet};
  if (options.jobs == 0) options.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const std::vector<StudyRun> made = needed(generations, runs, options.folder);
  const RunsEnded generated = carry_out_runs(made, options);
  options.doubt = [&](const fs::path& folder) {
    std::optional<std::string> missing = missing_quantity(folder, plan);
    if (missing && !missing->empty()) missing = arguments.plan.string() + ": " + *missing;
    return missing;
  };
  RunsEnded ended = generated.interrupted ? generated : carry_out_runs(in_folder(runs, options.folder), options);
  if (ended.interrupted) {
    tell("voussoir: interrupted: the same command continues with what is done in '{}'\n", arguments.out.string());
    return static_cast<ExitCode>(static_cast<int>(ExitCode::signal) + interruption());
  }
  tell_generations(made, generated, runs, ended);
  const std::vector<StudyRow> rows = rows_of(plan, runs, ended, options.folder);
  const fs::path file = arguments.out / "study.csv";
  write_file(file, study_csv(plan, rows));
  return tell_end(rows, ended, file);
}

}  // namespace voussoir
