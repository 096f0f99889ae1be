// Work in processes of its own: cddlib has global state, so that threads cannot share it.
#pragma once

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace voussoir::workers {

// The results of `work(worker, progress)` in each process, by worker. It notes its position in `progress`, so that the
// position of a process that dies is reported: std::runtime_error.
inline std::vector<std::string> in_processes(int count,
                                             const std::function<std::string(int, volatile long long&)>& work) {
  const std::size_t bytes = sizeof(long long) * count;
  void* shared = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) throw std::runtime_error("no shared memory");
  auto* progress = static_cast<volatile long long*>(shared);
  std::vector<int> ends;
  std::vector<pid_t> children;
  for (int worker = 0; worker < count; ++worker) {
    int ends_of_pipe[2];
    if (pipe(ends_of_pipe) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
      close(ends_of_pipe[0]);
      int status = 0;
      try {
        const std::string text = work(worker, progress[worker]);
        for (std::size_t written = 0; written < text.size();) {
          const ssize_t n = write(ends_of_pipe[1], text.data() + written, text.size() - written);
          if (n <= 0) _exit(2);
          written += static_cast<std::size_t>(n);
        }
      } catch (const std::exception& problem) {
        fmt::print(stderr, "worker {}, at {}: {}\n", worker, progress[worker], problem.what());
        status = 1;
      }
      _exit(status);  // no exit handlers: they are the parent's
    }
    close(ends_of_pipe[1]);
    ends.push_back(ends_of_pipe[0]);
    children.push_back(child);
  }
  std::vector<std::string> texts(count);
  std::string problems;
  for (int worker = 0; worker < count; ++worker) {
    char buffer[4096];
    for (ssize_t n; (n = read(ends[worker], buffer, sizeof buffer)) > 0;)
      texts[worker].append(buffer, static_cast<std::size_t>(n));
    close(ends[worker]);
    int status = 0;
    waitpid(children[worker], &status, 0);
    if (status != 0)
      problems += fmt::format("worker {} ended at {} with {}; ", worker, progress[worker],
                              WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                                  : fmt::format("status {}", WEXITSTATUS(status)));
  }
  munmap(shared, bytes);
  if (!problems.empty()) throw std::runtime_error(problems);
  return texts;
}

}  // namespace voussoir::workers
