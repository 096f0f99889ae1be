// One line on the terminal that tells how far a run has come.
#pragma once

#include <chrono>
#include <string>

#include "core/simulate.hpp"

namespace voussoir {

// "12 s", "3 min 20 s", "2 h 05 min"
std::string duration_text(double seconds);

// Rewrites its line a few times a second, and only where someone can see it: not when stderr is a file or a pipe.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const ProgressReport& report);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string text(const ProgressReport& report, Clock::time_point now) const;

  bool active_, shown_ = false;
  Clock::time_point stage_began_ = Clock::now(), last_shown_{};
  int stage_ = 0;
};

}  // namespace voussoir
