#include "app/study/work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <thread>

#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/base/row_ranges.hpp"
#include "app/run_folder/child_process.hpp"
#include "app/run_folder/origin.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/study/found.hpp"
#include "core/base/bad_input.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

bool is_sound(const StudyFolder& study, const fs::path& run) {
  return check_results(run, study.plan.history.has_value()).state == ResultsState::sound;
}

// an existing initial state is kept; it is not made again if all rows that need it are done
std::vector<StudyRun> needed_generations(const StudyFolder& study, const std::vector<PlannedRow>& rows) {
  std::vector<StudyRun> needed;
  for (const StudyRun& generation : generations_of(study.rows, study.plan.begin))
    if (std::any_of(rows.begin(), rows.end(), [&](const PlannedRow& row) {
          return row.run.begin == fs::path(generation.name) && !is_sound(study, run_folder_of(study, row));
        }))
      needed.push_back(generation);
  return needed;
}

// a run without its initial state reports the reason
void tell_generations(const std::vector<StudyRun>& generations, const RunsEnded& generated,
                      const std::vector<StudyRun>& runs, RunsEnded& ended) {
  for (std::size_t g = 0; g < generations.size(); ++g)
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (!generated.failures[g].empty() && !ended.failures[k].empty() &&
          runs[k].begin.filename() == generations[g].name) {
        ended.failures[k] = fmt::format("the run up to stage '{}' failed: {}", one_line(generations[g].until, 60),
                                        generated.failures[g]);
        note_failure(runs[k].begin.parent_path() / runs[k].name, ended.failures[k]);
      }
}

void require_program(const StudyFolder& study, bool any) {
  if (any || program_digest() == study.program_digest) return;
  throw BadInput(
      fmt::format("'{}' was planned by another program, {}: run it with that one, plan it again, or add "
                  "--any-program",
                  study.folder.string(), study.program));
}

// Distributed in turn by their hash, most expensive first, so that chunks cost about the same and share no run.
std::vector<PlannedRow> chosen_rows(const StudyFolder& study, const WorkArguments& arguments) {
  std::set<int> wanted;
  if (!arguments.rows.empty()) wanted = rows_of_ranges(arguments.rows, static_cast<int>(study.rows.size()));
  const Chunk chunk = arguments.chunk.empty() ? Chunk{} : chunk_of(arguments.chunk);
  std::map<std::string, int> places;
  std::vector<PlannedRow> chosen;
  for (const PlannedRow& row : study.rows) {
    if (!arguments.rows.empty() && !wanted.contains(row.row)) continue;
    const int place = places.try_emplace(row.run.name, static_cast<int>(places.size())).first->second;
    if (place % chunk.count == chunk.place - 1) chosen.push_back(row);
  }
  return chosen;
}

// if rows are left to others, by their worker
void refuse_held(const fs::path& folder, const std::vector<PlannedRow>& rows, const RunsEnded& ended) {
  std::map<std::string, std::set<int>> held;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (!ended.holders[k].empty()) held[ended.holders[k]].insert(rows[k].row);
  if (held.empty()) return;
  std::string text;
  for (const auto& [holder, numbers] : held)
    text += fmt::format("{}{} by {}", text.empty() ? "" : ", ", ranges_of_rows(numbers), holder);
  throw FolderInUse(
      fmt::format("'{}': rows in use by other processes: {}; wait for them, or name other "
                  "rows",
                  folder.string(), text));
}

}  // namespace

fs::path run_folder_of(const StudyFolder& study, const PlannedRow& row) {
  return study.folder / "runs" / row.run.name;
}

RunsEnded work_at(const StudyFolder& study, const std::vector<PlannedRow>& rows, const WorkOptions& how,
                  const std::string& plan_name) {
  if (how.portable_math) ask_for_portable_math();
  RunsOptions options{study.folder / "runs", how.jobs, how.threads, how.time_limit, how.quiet};
  if (options.jobs == 0) options.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  options.others = Others::wait_for_theirs;
  const std::vector<StudyRun> generations = needed_generations(study, rows);
  const RunsEnded generated = carry_out_runs(generations, options);
  if (generated.interrupted) return generated;

  options.others = Others::leave_theirs;
  options.keeps = [&](const fs::path& folder) { return is_sound(study, folder); };
  options.doubt = [&](const fs::path& folder) {
    std::optional<std::string> missing = missing_quantity(folder, study.plan);
    if (missing && !missing->empty()) missing = plan_name + ": " + *missing;
    return missing;
  };
  std::vector<StudyRun> runs;
  for (const PlannedRow& row : rows) {
    runs.push_back(row.run);
    if (!row.run.begin.empty()) runs.back().begin = options.folder / row.run.begin;
  }
  RunsEnded ended = carry_out_runs(runs, options);
  if (!ended.interrupted) tell_generations(generations, generated, runs, ended);
  return ended;
}

ExitCode tell_interruption(const fs::path& folder) {
  tell("voussoir: interrupted: the same command continues with the completed runs in '{}'\n", folder.string());
  return ended_by(interruption());
}

ExitCode study_run_command(const WorkArguments& arguments) {
  const StudyFolder study = read_study_folder(arguments.folder);
  require_program(study, arguments.any_program);
  const std::vector<PlannedRow> rows = chosen_rows(study, arguments);
  const SharedFolderLock lock(arguments.folder);
  const RunsEnded ended = work_at(study, rows, arguments.options, arguments.folder.string());
  if (ended.interrupted) return tell_interruption(arguments.folder);

  std::vector<std::string> failed;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!ended.holders[k].empty()) continue;
    const RunFound found = ended.failures[k].empty() ? found_in(run_folder_of(study, rows[k]), study.plan)
                                                     : RunFound{.status = ended.failures[k]};
    if (!found.result) failed.push_back(fmt::format("failed: row {}: {}\n", rows[k].row, found.status));
  }
  fmt::print("{} rows, {} failed\n{} different runs, {} of them kept from before\n", rows.size(), failed.size(),
             ended.runs, ended.kept);
  for (const std::string& line : failed)
    fmt::print("{}", line);
  refuse_held(arguments.folder, rows, ended);
  return failed.empty() ? ExitCode::done : ExitCode::incomplete;
}

}  // namespace voussoir
