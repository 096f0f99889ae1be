#include "app/study/gather.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <nlohmann/json.hpp>

#include "app/base/message.hpp"
#include "app/base/row_ranges.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/study/findings.hpp"
#include "app/study/found.hpp"
#include "app/study/idle.hpp"
#include "app/study/work.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "text/plain_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

fs::path runs_of(const fs::path& folder, const PlannedRow& row) {
  return folder / "runs" / row.run.name;
}

// The contents on which two computers must agree: not the clock, the program's name, and warnings, which name the
// folder. Empty if it cannot be read.
std::string agreed_bits(const fs::path& folder, const RunFound& found) {
  try {
    nlohmann::json results = nlohmann::json::parse(read_file(folder / "results.json", largest_results));
    for (const char* key : {"timing", "program", "warnings"})
      results.erase(key);
    return results.dump() + (found.result ? fmt::format(" {}", found.result->value) : "");
  } catch (const std::exception&) {
    return "";
  }
}

struct RowFound {
  RunFound found{.status = "not run"};
  bool is_missing = true, has_results = false;
  std::vector<CheckedResults> damaged = {}, changed = {};
  std::optional<std::pair<fs::path, fs::path>> differing = {};
  bool other_origins = false;  // of these two
};

RowFound found_at(const PlannedRow& row, const StudyPlan& plan, const std::vector<fs::path>& folders) {
  RowFound at;
  std::optional<fs::path> first;
  std::string bits;
  for (const fs::path& folder : folders) {
    const fs::path run = runs_of(folder, row);
    const CheckedResults checked = check_results(run, plan.history.has_value());
    if (checked.state == ResultsState::none) {
      const std::string failure = noted_failure(run);
      if (failure.empty() || !at.is_missing) continue;
      at.found = {.status = one_line(failure, 1000)};
      at.is_missing = false;
      continue;
    }
    if (checked.state == ResultsState::changed) at.changed.push_back(checked);
    if (checked.state == ResultsState::damaged) {
      if (at.is_missing) at.found.status = describe(checked);
      at.damaged.push_back(checked);
    }
    if (checked.state != ResultsState::sound) continue;
    const RunFound found = found_in(run, plan);
    const std::string these = agreed_bits(run, found);
    if (!first) {
      at.found = found;
      at.is_missing = false;
      at.has_results = true;
      first = folder;
      bits = these;
    } else if (these != bits && !at.differing) {
      at.differing = std::pair(*first, folder);
      at.other_origins = found.origins != at.found.origins;
    }
  }
  return at;
}

// "row 5 (stiffness: joint_properties.rock.normal_stiffness = 1.2e8)"
std::string name_of_row(const StudyPlan& plan, int row) {
  std::size_t place = static_cast<std::size_t>(row) - 1;
  for (const Sweep& sweep : plan.sweeps) {
    if (place < sweep.values.size()) {
      const std::string name = one_line(sweep.name, 60), value = one_line(shown_value(sweep.values[place]), 60);
      return sweep.key.empty() ? fmt::format("row {} ({})", row, name)
                               : fmt::format("row {} ({}: {} = {})", row, name, one_line(sweep.key, 100), value);
    }
    place -= sweep.values.size();
  }
  return fmt::format("row {}", row);
}

void refuse_changed(const StudyFolder& study, const std::map<int, RowFound>& found) {
  std::set<int> rows;
  std::string first;
  for (const auto& [row, at] : found) {
    if (at.changed.empty()) continue;
    if (rows.empty()) first = fmt::format("{}: {}", name_of_row(study.plan, row), describe(at.changed.front()));
    rows.insert(row);
  }
  if (rows.empty()) return;
  const std::string others = rows.size() == 1 ? "" : fmt::format(", as do those of rows {}", ranges_of_rows(rows));
  throw BadInput(fmt::format("{}{}; restore the file, or repeat the run with 'voussoir study run {} --rows {}'", first,
                             others, study.folder.string(), ranges_of_rows(rows)));
}

}  // namespace

Gathered gather(const StudyFolder& study, const std::vector<fs::path>& folders) {
  std::map<int, RowFound> found;
  Gathered gathered;
  for (const PlannedRow& row : study.rows) {
    RowFound& at = found[row.row] = found_at(row, study.plan, folders);
    if (at.is_missing) gathered.missing.insert(row.row);
    for (const CheckedResults& damaged : at.damaged)
      gathered.damaged.push_back(fmt::format("{}: {}", name_of_row(study.plan, row.row), describe(damaged)));
  }
  refuse_changed(study, found);
  for (const auto& [row, at] : found) {
    if (at.differing)
      gathered.differences.push_back(fmt::format(
          "row {}: its results in '{}' and '{}' differ{}", row, at.differing->first.string(),
          at.differing->second.string(), at.other_origins ? ", and so do the programs that computed them" : ""));
    if (!at.has_results) continue;
    add_row(gathered.origins, row, at.found.origins);
    add_row(gathered.warnings, row, at.found.warnings);
  }
  gathered.rows = table_of(study.plan, [&](int row) { return found.at(row).found; });
  return gathered;
}

ExitCode write_gathered(const StudyFolder& study, const Gathered& gathered, const std::string& remark,
                        const WorkOptions& how) {
  const fs::path file = study.folder / "study.csv";
  const Findings findings = findings_of(
      study.plan, gathered.rows, [&](const Sweep& sweep) { return evaluations_of(study, sweep, how); }, how.quiet);
  if (findings.interrupted) return tell_interruption(study.folder);
  write_file(file, study_csv(study.plan, gathered.rows));
  for (const auto& [name, content] : findings.files)
    write_file(study.folder / name, content);
  const auto has_failed = [&](const StudyRow& row) {
    return row.row > 0 && !row.result && !gathered.missing.contains(row.row);
  };
  const auto failed = std::ranges::count_if(gathered.rows, has_failed);
  const std::string not_run = gathered.missing.empty() ? "" : fmt::format(", {} not run", gathered.missing.size());
  fmt::print("{} settings, {} failed{}: {}\n{}", gathered.rows.size(), failed, not_run, file.string(), remark);
  for (const std::string& line : origin_lines(gathered.origins, study.program_digest))
    fmt::print("{}\n", line);
  tell_warnings(origin_warnings(gathered.origins));
  tell_warnings(flat_results(study.plan, gathered.rows));
  tell_warnings(warning_lines(gathered.warnings));
  for (const std::string& line : findings.lines)
    fmt::print("{}\n", line);
  std::set<std::string> divided(findings.divides.begin(), findings.divides.end());
  for (const StudyRow& row : gathered.rows)
    if (!row.divides.empty()) divided.insert(row.divides);
  for (const std::string& sentence : divided)
    if (!sentence.empty()) fmt::print("{} {}\n", study.plan.quantity, one_line(sentence, 1000));
  for (const StudyRow& row : gathered.rows)
    if (has_failed(row)) fmt::print("failed: {}: {}\n", name_of_row(study.plan, row.row), row.status);
  if (!gathered.missing.empty())
    fmt::print("not run: {0}; run them with 'voussoir study run {1} --rows {0}'\n", ranges_of_rows(gathered.missing),
               study.folder.string());
  for (const std::string& damaged : gathered.damaged)
    fmt::print("{}\n", damaged);
  for (const std::string& difference : gathered.differences)
    fmt::print("{}\n", difference);
  return failed > 0 || findings.failed || !gathered.missing.empty() || !gathered.differences.empty()
             ? ExitCode::incomplete
             : ExitCode::done;
}

ExitCode study_gather_command(const std::vector<fs::path>& folders) {
  const StudyFolder study = read_study_folder(folders.front());
  for (const fs::path& folder : folders)
    if (read_study_folder(folder).manifest_digest != study.manifest_digest)
      throw BadInput(fmt::format("'{}' contains another study than '{}': its manifest.jsonl differs", folder.string(),
                                 study.folder.string()));
  const SharedFolderLock lock(study.folder);
  return write_gathered(study, gather(study, folders), "", {});
}

ExitCode study_status_command(const fs::path& folder) {
  const StudyFolder study = read_study_folder(folder);
  std::map<std::string, std::set<int>> running;  // by their worker, and since when
  std::map<int, std::string> failures;
  std::set<int> missing, failed;
  std::vector<std::string> doubtful;
  int done = 0;
  for (const PlannedRow& row : study.rows) {
    const fs::path worker = runs_of(folder, row) / worker_file;
    const RowFound at = found_at(row, study.plan, {folder});
    for (const std::vector<CheckedResults>& list : {at.damaged, at.changed})
      for (const CheckedResults& checked : list)
        doubtful.push_back(fmt::format("{}: {}", name_of_row(study.plan, row.row), describe(checked)));
    if (at.found.result) {
      ++done;
    } else if (const std::optional<std::string> holder = holder_of_lock(worker)) {
      std::error_code error;
      const auto since = fs::last_write_time(worker, error);
      const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::file_clock::to_sys(since));
      running[fmt::format("{}, since {:%F %T}", *holder, fmt::localtime(time))].insert(row.row);
    } else if (at.is_missing) {
      missing.insert(row.row);
    } else {
      failures[row.row] = at.found.status;
      failed.insert(row.row);
    }
  }
  fmt::print("{} of {} rows done\n", done, study.rows.size());
  for (const auto& [who, rows] : running)
    fmt::print("running: {} by {}\n", ranges_of_rows(rows), who);
  for (const auto& [row, failure] : failures)
    fmt::print("failed: row {}: {}\n", row, failure);
  if (!failed.empty()) fmt::print("failed: {}\n", ranges_of_rows(failed));
  for (const std::string& line : doubtful)
    fmt::print("{}\n", line);
  fmt::print("not run: {}\n", missing.empty() ? "none" : ranges_of_rows(missing));
  return ExitCode::done;
}

}  // namespace voussoir
