#include "app/base/interruption.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <initializer_list>

namespace voussoir {
namespace {

// SIGXCPU: a batch system's limit of processor time; SIGUSR1: its notice before it kills
constexpr int asking[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGXCPU};

volatile std::sig_atomic_t noted = 0;

// The next one from a keyboard ends the program. The others are repeated by machines and must not disturb the
// checkpoint: a batch system sends SIGTERM to each process of a job and so does the study that started us, and SIGXCPU
// is repeated at every further second of processor time.
void note(int signal) {
  noted = signal;
  for (const int other : asking)
    std::signal(other, other == SIGINT || other == SIGQUIT ? SIG_DFL : SIG_IGN);
}

}  // namespace

void note_interruptions() {
  struct sigaction action = {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESTART);  // a signal must not make the opening of a file fail
  for (const int signal : asking)
    ::sigaddset(&action.sa_mask, signal);
  for (const int signal : asking) {
    // the parent process may have asked us to ignore it: nohup, or a shell that runs us in the background
    struct sigaction before = {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
}

int interruption() {
  return noted;
}

void prepare_process() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF && ::open("/dev/null", O_RDWR) < 0) return;
}

}  // namespace voussoir
