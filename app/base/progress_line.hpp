// One line on the terminal that shows the progress of a run.
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
// minute: nothing for a short run, and for a long one enough to see that it continues.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted, bool terminal = is_terminal(),
                        std::chrono::milliseconds between_added = std::chrono::minutes(1));
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const ProgressReport& report);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string text(const ProgressReport& report, Clock::time_point now) const;

  bool wanted_, terminal_, shown_ = false;
  std::chrono::milliseconds between_;
  Clock::time_point stage_began_ = Clock::now(), last_shown_ = Clock::now();
  int stage_ = 0;
};

}  // namespace voussoir
