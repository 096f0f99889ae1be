#include "app/commands/study_runs.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <map>
#include <memory>
#include <thread>

#include "app/child_process.hpp"
#include "app/commands/commands.hpp"
#include "app/commands/progress_line.hpp"
#include "app/interruption.hpp"
#include "app/message.hpp"
#include "app/run_folder.hpp"
#include "core/output/atomic_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// short beside the shortest run, long beside what it takes to look
constexpr std::chrono::milliseconds time_between_looks{5};

// s: a run that was told to stop writes its checkpoint; one that hangs never will
constexpr double patience = 10;

constexpr int bad_input = static_cast<int>(ExitCode::bad_input);

struct Going {
  const StudyRun* run;
  std::unique_ptr<ChildProcess> process;
  bool resumed = false, too_long = false;
  std::optional<double> told;  // s of its time when it was told to stop
};

std::string last_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line, last;
  while (std::getline(stream, line))
    if (!line.empty()) last = line;
  const std::string prefix = "voussoir: ";
  return printable(last.starts_with(prefix) ? last.substr(prefix.size()) : last);
}

class Runs {
 public:
  Runs(const std::vector<StudyRun>& runs, const RunsConduct& conduct) : conduct_(conduct) {
    for (const StudyRun& run : runs)
      if (failures_.try_emplace(run.name).second) {
        if (holds_results(folder_of(run))) {
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
    while (!going_.empty() || (!waiting_.empty() && !interruption())) {
      while (!waiting_.empty() && !interruption() && static_cast<int>(going_.size()) < conduct_.jobs) {
        start(*waiting_.front());
        waiting_.pop_front();
      }
      for (std::size_t k = 0; k < going_.size();)
        if (look_after(going_[k]))
          going_.erase(going_.begin() + static_cast<std::ptrdiff_t>(k));
        else
          ++k;
      show_progress();
      std::this_thread::sleep_for(time_between_looks);
    }
    if (watched_) rewrite_line("");
    return interruption() == 0;
  }

  const std::string& failure(const StudyRun& run) const { return failures_.at(run.name); }
  int different() const { return static_cast<int>(failures_.size()); }
  int kept() const { return kept_; }

 private:
  fs::path folder_of(const StudyRun& run) const { return conduct_.folder / run.name; }
  fs::path messages_of(const StudyRun& run) const { return folder_of(run) / messages_file; }

  void start(const StudyRun& run) {
    const fs::path folder = folder_of(run);
    prepare_folder(folder);
    const bool resume = holds_unfinished_run(folder) && holds_checkpoints(folder);
    std::vector<std::string> arguments;
    if (resume) {
      arguments = {"resume", folder.string()};
    } else {
      arguments = {"run", run.scene.string(), "--overwrite", "--out", folder.string()};
      for (const std::string& text : run.overrides)
        arguments.insert(arguments.end(), {"--set", text});
    }
    arguments.insert(arguments.end(), {"--quiet", "--threads", std::to_string(conduct_.threads)});
    going_.push_back({&run, std::make_unique<ChildProcess>(arguments, messages_of(run)), resume, false, {}});
  }

  // a study of something that no run yields ends with its first run instead of its last
  void require_worth(const StudyRun& run) {
    if (worth_ || !conduct_.doubt) return;
    const std::optional<std::string> doubt = conduct_.doubt(folder_of(run));
    if (doubt && !doubt->empty()) throw BadInput(*doubt);
    worth_ = doubt.has_value();
  }

  // true: it has ended
  bool look_after(Going& going) {
    ChildProcess& process = *going.process;
    if (const std::optional<ChildEnd> end = process.ended()) {
      took_ += process.seconds();
      // a checkpoint that cannot be used is no reason to have no result
      if (going.resumed && end->code == bad_input) {
        remove_checkpoints(folder_of(*going.run));
        waiting_.push_front(going.run);
        return true;
      }
      ++done_;
      if (holds_results(folder_of(*going.run))) require_worth(*going.run);
      failures_.at(going.run->name) = reason(going, *end);
      return true;
    }
    const double seconds = process.seconds();
    if (!going.told && (interruption() || (conduct_.time_limit > 0 && seconds > conduct_.time_limit))) {
      going.told = seconds;
      going.too_long = !interruption();
      process.send(SIGTERM);
    }
    if (going.told && seconds > *going.told + patience) process.send(SIGKILL);
    return false;
  }

  std::string reason(const Going& going, const ChildEnd& end) const {
    if (holds_results(folder_of(*going.run))) return "";
    if (going.too_long) return fmt::format("not done after {:g} s", conduct_.time_limit);
    if (end.signal) return fmt::format("ended by signal {} ({})", end.signal, ::strsignal(end.signal));
    const std::string said = last_line(messages_of(*going.run));
    return said.empty() ? fmt::format("ended with exit code {} and no results", end.code) : said;
  }

  void show_progress() {
    if (!watched_ || Clock::now() - shown_ < std::chrono::milliseconds(200)) return;
    shown_ = Clock::now();
    std::string line = fmt::format("{} of {} runs done, {} going on", done_, total_, going_.size());
    if (done_ > 0) {
      double left = took_ / done_ * static_cast<double>(total_ - done_);
      for (const Going& going : going_)
        left -= std::min(going.process->seconds(), took_ / done_);
      line += ", about " + duration_text(left / conduct_.jobs) + " left";
    }
    rewrite_line(line);
  }

  using Clock = std::chrono::steady_clock;

  RunsConduct conduct_;
  std::map<std::string, std::string> failures_;  // by name of every different run
  std::deque<const StudyRun*> waiting_;
  std::vector<Going> going_;
  std::size_t total_ = 0, done_ = 0;
  int kept_ = 0;
  bool worth_ = false;  // some run has what is sought
  double took_ = 0;     // s, of all that are done
  bool watched_ = !conduct_.quiet && ::isatty(STDERR_FILENO);
  Clock::time_point shown_{};
};

}  // namespace

RunsEnded carry_out_runs(const std::vector<StudyRun>& study, const RunsConduct& conduct) {
  prepare_folder(conduct.folder);
  note_interruptions();
  Runs runs(study, conduct);
  RunsEnded ended;
  ended.interrupted = !runs.go();
  for (const StudyRun& run : study)
    ended.failures.push_back(runs.failure(run));
  ended.runs = runs.different();
  ended.kept = runs.kept();
  return ended;
}

}  // namespace voussoir
