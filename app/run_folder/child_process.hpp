// This program, started once more beside itself: what crashes or hangs there does no harm here.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voussoir {

struct ChildEnd {
  int code = -1;   // exit code
  int signal = 0;  // that ended it; then there is no code
};

// Does not hear the terminal's signals, which its parent passes on as it sees fit, and is asked to stop (SIGTERM) when
// its parent dies, however that happens.
class ChildProcess {
 public:
  // what it prints goes to `messages`; throws OutputError when it cannot be started
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& messages);
  // kills it, if it still continues
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // does not wait; empty while it continues
  std::optional<ChildEnd> ended();
  void send(int signal) const;
  double seconds() const;  // since it was started

 private:
  pid_t pid_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

// Of the file that this process was started from. Throws BadInput where that cannot be read.
const std::string& program_digest();

}  // namespace voussoir
