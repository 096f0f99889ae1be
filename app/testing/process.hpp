// A program that a test starts, watches and kills, and whose end it checks.
#pragma once

#include <fcntl.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace voussoir {

inline std::string read(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A folder for the runs of one test program, in memory if the system has such a folder: hundreds of runs would wait for
// the disk.
inline std::filesystem::path scratch_folder(const std::string& name) {
  return (::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : std::filesystem::temp_directory_path()) /
         std::filesystem::path("voussoir_" + name + "_" + std::to_string(::getpid()));
}

struct Launch {
  std::vector<std::string> arguments = {};                            // without the program's name
  std::vector<std::pair<std::string, std::string>> environment = {};  // besides ours
  std::filesystem::path out = {};                                     // stdout, if not caught
  std::optional<rlim_t> largest_file = {};                            // bytes
  bool ordinary_user = false;                                         // gives up root's rights
  bool deaf_to_hangup = false;                                        // as nohup does
};

struct Ended {
  int code = -1;   // exit code
  int signal = 0;  // that ended it, then there is no code
  std::string out, err;
};

// it ended by itself, with this exit code and one line on stderr that contains the part
inline void expect_one_line(const Ended& ended, int code, const std::string& part, const std::string& what = "") {
  EXPECT_EQ(ended.signal, 0) << what << ended.err;
  EXPECT_EQ(ended.code, code) << what << ended.err;
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << what << ended.err;
  EXPECT_NE(ended.err.find(part), std::string::npos) << what << ended.err;
}

inline constexpr int cannot_start = 126;  // exit code of a child that could not become the program

class Process {
 public:
  // its output is caught in files next to `scratch`
  Process(const std::string& program, const Launch& launch, const std::filesystem::path& scratch)
      : out_(scratch.string() + ".out"), err_(scratch.string() + ".err"), pid_(::fork()) {
    if (pid_ == 0) become(program, launch);
  }
  ~Process() {
    if (pid_ > 0) {
      ::kill(pid_, SIGKILL);
      wait();
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int pid() const { return pid_; }
  void send(int signal) const { ::kill(pid_, signal); }

  // by itself or by a signal; wait() still has to collect it
  bool has_ended() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_;
  }

  // stops it by SIGSTOP; false: it had ended before
  bool hold() const {
    send(SIGSTOP);
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WSTOPPED | WNOWAIT) == 0 &&
           info.si_code == CLD_STOPPED;
  }

  Ended wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    Ended ended{WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0, read(out_),
                read(err_)};
    std::filesystem::remove(out_);
    std::filesystem::remove(err_);
    return ended;
  }

 private:
  [[noreturn]] void become(const std::string& program, const Launch& launch) const {
    const auto redirect = [](const std::string& path, int flags, int stream) {
      ::dup2(::open(path.c_str(), flags, 0666), stream);
    };
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(launch.out.empty() ? out_ : launch.out.string(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);

    if (launch.largest_file) {
      const rlimit limit{*launch.largest_file, *launch.largest_file};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (launch.deaf_to_hangup) std::signal(SIGHUP, SIG_IGN);
    for (const auto& [name, value] : launch.environment)
      ::setenv(name.c_str(), value.c_str(), 1);

    // opened before the rights are dropped: the folder of the program may be closed to others
    const int file = ::open(program.c_str(), O_PATH);
    constexpr unsigned nobody = 65534;
    if (launch.ordinary_user && ::geteuid() == 0 &&
        (::setgroups(0, nullptr) != 0 || ::setresgid(nobody, nobody, nobody) != 0 ||
         ::setresuid(nobody, nobody, nobody) != 0))
      ::_exit(cannot_start);
    std::vector<char*> arguments{const_cast<char*>("voussoir")};
    for (const std::string& argument : launch.arguments)
      arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    ::fexecve(file, arguments.data(), environ);
    ::_exit(cannot_start);
  }

  std::string out_, err_;
  int pid_;
};

// false: it did not become true within a minute
inline bool wait_until(const std::function<bool()>& condition) {
  for (int k = 0; k < 60'000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace voussoir
