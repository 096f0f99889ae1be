// One line on the terminal that shows the progress of a run, or of a study.
#pragma once

#include <chrono>
#include <string>

#include "core/run/simulate.hpp"

namespace voussoir {

// "12 s", "3 min 20 s", "2 h 05 min"
std::string duration_text(double seconds);

// whether stderr is one
bool is_terminal();

// On a terminal it rewrites its line a few times a second. Elsewhere, in a file or a pipe, it adds a line once a
// minute: nothing for short work, and for long work enough to see that it continues.
class StatusLine {
 public:
  explicit StatusLine(bool wanted, bool terminal = is_terminal(),
                      std::chrono::milliseconds between_added = std::chrono::minutes(1));
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  bool is_due() const;
  void show(const std::string& text);  // if it is due
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool wanted_, terminal_, shown_ = false;
  std::chrono::milliseconds between_;
  Clock::time_point last_shown_ = Clock::now();
};

// of a run
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted, bool terminal = is_terminal(),
                        std::chrono::milliseconds between_added = std::chrono::minutes(1))
      : line_(wanted, terminal, between_added) {}

  void show(const ProgressReport& report);
  void clear() { line_.clear(); }

 private:
  using Clock = std::chrono::steady_clock;

  std::string text(const ProgressReport& report) const;

  StatusLine line_;
  Clock::time_point stage_began_ = Clock::now();
  int stage_ = 0;
};

}  // namespace voussoir
