// This program, started as a child process: a crash or hang there does no harm here.
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

// Does not receive the terminal's signals, which its parent may pass on, and receives SIGTERM when its parent dies for
// any reason.
class ChildProcess {
 public:
  // its output is written to `messages`; throws OutputError if it cannot be started
  ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& messages);
  // kills it if it is still running
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // does not wait; empty while it is running
  std::optional<ChildEnd> ended();
  void send(int signal) const;
  double seconds() const;  // since it was started

 private:
  pid_t pid_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

// Of the file that this process was started from. Throws BadInput if that cannot be read.
const std::string& program_digest();

}  // namespace voussoir
