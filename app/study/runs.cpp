#include "app/study/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <memory>
#include <thread>

#include "app/base/exit_codes.hpp"
#include "app/base/interruption.hpp"
#include "app/base/progress_line.hpp"
#include "app/run_folder/child_process.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// short against the shortest run, long against the time of one check
constexpr std::chrono::milliseconds time_between_looks{5};

// s, in which a run that was asked to stop writes its checkpoint; a hanging one never does
constexpr double patience = 10;

constexpr std::uintmax_t longest_note = 1 << 20;  // bytes

constexpr int bad_input = static_cast<int>(ExitCode::bad_input);

struct ActiveRun {
  const StudyRun* run;
  std::optional<FileLock> lock;  // released when the process has ended
  std::unique_ptr<ChildProcess> process;
  bool resumed = false, too_long = false;
  std::optional<double> asked_to_stop;  // s of its run time at which it was asked to stop
};

std::string last_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line, last;
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  const std::string prefix = "voussoir: ";
  return printable(last.starts_with(prefix) ? last.substr(prefix.size()) : last);
}

// a run holds its folder's lock until it ends
bool is_being_written(const fs::path& folder) {
  try {
    const ReadingLock lock(folder);
    return false;
  } catch (const FolderInUse&) {
    return true;
  }
}

using Clock = std::chrono::steady_clock;

class Runs {
 public:
  Runs(const std::vector<StudyRun>& runs, const RunsOptions& options) : options_(options) {
    for (const StudyRun& run : runs)
      if (failures_.try_emplace(run.name).second) {
        if (options_.keeps(folder_of(run))) {
          ++kept_;
          require_worth(run);
        } else {
          waiting_.push_back(&run);
        }
      }
    total_ = waiting_.size();
  }

  // false: a signal stopped it
  bool go() {
    while (!active_.empty() || (!waiting_.empty() && !interruption())) {
      // each at most once: a run that must wait for another process moves to the end of the list
      for (std::size_t left = waiting_.size(); left > 0 && !interruption() && has_room(); --left) {
        const StudyRun* const next = waiting_.front();
        waiting_.pop_front();
        if (!begin(*next)) waiting_.push_back(next);
      }
      for (std::size_t k = 0; k < active_.size();)
        if (look_after(active_[k]))
          active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(k));
        else
          ++k;
      show_progress();
      std::this_thread::sleep_for(time_between_looks);
    }
    line_.clear();
    return interruption() == 0;
  }

  const std::string& failure(const StudyRun& run) const { return failures_.at(run.name); }
  std::string holder(const StudyRun& run) const {
    const auto found = holders_.find(run.name);
    return found == holders_.end() ? "" : found->second;
  }
  int different() const { return static_cast<int>(failures_.size()); }
  int kept() const { return kept_; }

 private:
  fs::path folder_of(const StudyRun& run) const { return options_.folder / run.name; }
  fs::path messages_of(const StudyRun& run) const { return folder_of(run) / messages_file; }

  bool has_room() const { return static_cast<int>(active_.size()) < options_.jobs; }

  // false: later, when another process has ended
  bool begin(const StudyRun& run) {
    const fs::path folder = folder_of(run);
    prepare_folder(folder);
    std::optional<FileLock> lock;
    if (options_.others != Others::nobody) {
      std::string holder;
      lock = FileLock::taken(folder / worker_file, false, holder);
      if (!lock && options_.others == Others::wait_for_theirs) return false;
      if (!lock) {
        holders_[run.name] = holder;
        --total_;
        return true;
      }
      if (options_.keeps(folder)) {  // completed since the last check
        ++kept_;
        --total_;
        require_worth(run);
        return true;
      }
      // the run of a killed worker: it is about to write its checkpoint
      if (is_being_written(folder) && orphaned_.try_emplace(run.name, Clock::now()).first->second +
                                              std::chrono::seconds(static_cast<int>(patience)) >
                                          Clock::now())
        return false;
      remove_file(folder / failure_file);
    }
    start(run, std::move(lock));
    return true;
  }

  void start(const StudyRun& run, std::optional<FileLock> lock) {
    const fs::path folder = folder_of(run);
    if (holds_results(folder)) remove_file(folder / "results.json");
    const bool resume = holds_unfinished_run(folder) && holds_checkpoints(folder);
    std::vector<std::string> arguments;
    if (resume) {
      arguments = {"resume", folder.string()};
    } else {
      arguments = {run.other ? run.other->name : "run", run.scene.string(), "--overwrite", "--out", folder.string()};
      for (const std::string& text : run.overrides)
        arguments.insert(arguments.end(), {"--set", text});
      if (run.other) arguments.insert(arguments.end(), run.other->options.begin(), run.other->options.end());
    }
    if (!resume && !run.until.empty()) arguments.insert(arguments.end(), {"--until", run.until});
    if (!resume && !run.begin.empty()) arguments.insert(arguments.end(), {"--begin", run.begin.string()});
    if (!run.other) arguments.insert(arguments.end(), {"--quiet", "--threads", std::to_string(options_.threads)});
    active_.push_back(
        {&run, std::move(lock), std::make_unique<ChildProcess>(arguments, messages_of(run)), resume, false, {}});
  }

  // a study of a quantity that no run has ends with its first run instead of its last
  void require_worth(const StudyRun& run) {
    if (worth_ || !options_.doubt) return;
    const std::optional<std::string> doubt = options_.doubt(folder_of(run));
    if (doubt && !doubt->empty()) throw BadInput(*doubt);
    worth_ = doubt.has_value();
  }

  // true: it has ended
  bool look_after(ActiveRun& active) {
    ChildProcess& process = *active.process;
    if (const std::optional<ChildEnd> end = process.ended()) {
      took_ += process.seconds();
      // with an unusable checkpoint the run starts again
      if (active.resumed && end->code == bad_input) {
        remove_checkpoints(folder_of(*active.run));
        waiting_.push_front(active.run);
        return true;
      }
      ++done_;
      if (holds_results(folder_of(*active.run))) require_worth(*active.run);
      std::string& failure = failures_.at(active.run->name);
      failure = reason(active, *end);
      if (active.lock && !failure.empty() && (!interruption() || active.too_long))
        note_failure(folder_of(*active.run), failure);
      return true;
    }
    const double seconds = process.seconds();
    if (!active.asked_to_stop && (interruption() || (options_.time_limit > 0 && seconds > options_.time_limit))) {
      active.asked_to_stop = seconds;
      active.too_long = !interruption();
      process.send(SIGTERM);
    }
    if (active.asked_to_stop && seconds > *active.asked_to_stop + patience) process.send(SIGKILL);
    return false;
  }

  std::string reason(const ActiveRun& active, const ChildEnd& end) const {
    if (holds_results(folder_of(*active.run))) return "";
    if (active.too_long) return fmt::format("not done after {:g} s", options_.time_limit);
    if (end.signal) return fmt::format("ended by signal {} ({})", end.signal, ::strsignal(end.signal));
    const std::string said = last_line(messages_of(*active.run));
    return said.empty() ? fmt::format("ended with exit code {} and no results", end.code) : said;
  }

  void show_progress() {
    if (!line_.is_due()) return;
    std::string line = fmt::format("{} of {} runs done, {} under way", done_, total_, active_.size());
    if (done_ > 0) {
      double left = took_ / done_ * static_cast<double>(total_ - done_);
      for (const ActiveRun& active : active_)
        left -= std::min(active.process->seconds(), took_ / done_);
      line += ", about " + duration_text(left / options_.jobs) + " left";
    }
    line_.show(line);
  }

  RunsOptions options_;
  std::map<std::string, std::string> failures_;        // by name of each different run
  std::map<std::string, std::string> holders_;         // of runs that are left to another process
  std::map<std::string, Clock::time_point> orphaned_;  // time since which their own lock was found held
  std::deque<const StudyRun*> waiting_;
  std::vector<ActiveRun> active_;
  std::size_t total_ = 0, done_ = 0;
  int kept_ = 0;
  bool worth_ = false;  // some run has the quantity
  double took_ = 0;     // s, of all completed runs
  StatusLine line_{!options_.quiet};
};

}  // namespace

std::string noted_failure(const fs::path& folder) {
  try {
    return read_file(folder / failure_file, longest_note);
  } catch (const ReadFault&) {
    return "";
  }
}

void note_failure(const fs::path& folder, const std::string& failure) {
  try {
    write_file(folder / failure_file, failure);
  } catch (const OutputError&) {
  }
}

RunsEnded carry_out_runs(const std::vector<StudyRun>& study, const RunsOptions& options) {
  prepare_folder(options.folder);
  note_interruptions();
  Runs runs(study, options);
  RunsEnded ended;
  ended.interrupted = !runs.go();
  for (const StudyRun& run : study) {
    ended.failures.push_back(runs.failure(run));
    ended.holders.push_back(runs.holder(run));
  }
  ended.runs = runs.different();
  ended.kept = runs.kept();
  return ended;
}

}  // namespace voussoir
