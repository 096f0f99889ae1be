#include "app/run_folder/child_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "app/base/digest.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"

namespace voussoir {
namespace {

// the file of this process, even after another was built in its place
const char* const this_program = "/proc/self/exe";

// between fork and exec: no allocation and no lock
[[noreturn]] void become_program(char* const* arguments, int input, int messages, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);  // the parent died before it could be watched
  ::dup2(input, STDIN_FILENO);
  ::dup2(messages, STDOUT_FILENO);
  ::dup2(messages, STDERR_FILENO);
  ::execv(this_program, arguments);
  ::_exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& messages) {
  std::vector<char*> pointers{const_cast<char*>("voussoir")};
  for (const std::string& argument : arguments)
    pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);

  // always a new file: a link would lead elsewhere, a pipe would block
  remove_file(messages);
  const int output = ::open(messages.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (output < 0) throw output_error(messages, errno);
  const int input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become_program(pointers.data(), input, output, parent);
  const int error = errno;
  ::close(output);
  ::close(input);
  if (pid_ < 0) throw output_error("a process for a run", error);
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

std::optional<ChildEnd> ChildProcess::ended() {
  int status = 0;
  if (::waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  return ChildEnd{WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0};
}

void ChildProcess::send(int signal) const {
  if (pid_ > 0) ::kill(pid_, signal);
}

double ChildProcess::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

// Mapped: to read its ten megabytes into memory took three quarters of the time of a small run.
const std::string& program_digest() {
  static const std::string of_program = [] {
    const int file = ::open(this_program, O_RDONLY | O_CLOEXEC);
    struct stat status = {};
    void* bytes = MAP_FAILED;
    if (file >= 0 && ::fstat(file, &status) == 0)
      bytes = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE | MAP_POPULATE, file, 0);
    if (file >= 0) ::close(file);
    if (bytes == MAP_FAILED)
      throw BadInput("the program cannot read its own file, so results cannot be distinguished from older ones");
    const auto size = static_cast<std::size_t>(status.st_size);
    std::string text = digest({static_cast<const char*>(bytes), size});
    ::munmap(bytes, size);
    return text;
  }();
  return of_program;
}

}  // namespace voussoir
