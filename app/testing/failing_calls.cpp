// A library for LD_PRELOAD that makes one call of the program fail, as a disk, a signal or a lack of memory would.
//
//   FAIL_CALL    write, fsync, rename, open, unlink or malloc; all but malloc count on paths that begin with
//   FAIL_FOLDER FAIL_AT      which of them, from 1; 0: none FAIL_LAST    up to which (default: FAIL_AT) FAIL_ERRNO what
//   it reports; "short": a write that takes half of what it is given FAIL_REPORT  a file that is made when a call was
//   made to fail
//
// Calls of malloc are counted from the begin of main: what comes before is the loader's.
#include <dlfcn.h>
#include <fcntl.h>
#include <stdarg.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

// kept in plain memory: no call of ours may allocate
char failing_call[16], folder[512], report[512];
long first = 0, last = 0, every = 1;
int error_number = EIO;
bool halve = false;
std::atomic<bool> armed = false;
std::atomic<long> count = 0;

void copy(char* target, std::size_t size, const char* name) {
  const char* value = std::getenv(name);
  std::snprintf(target, size, "%s", value ? value : "");
}

__attribute__((constructor)) void read_environment() {
  copy(failing_call, sizeof failing_call, "FAIL_CALL");
  copy(folder, sizeof folder, "FAIL_FOLDER");
  copy(report, sizeof report, "FAIL_REPORT");
  const char* at = std::getenv("FAIL_AT");
  const char* until = std::getenv("FAIL_LAST");
  const char* stride = std::getenv("FAIL_EVERY");
  const char* error = std::getenv("FAIL_ERRNO");
  first = at ? std::atol(at) : 0;
  last = until ? std::atol(until) : first;
  every = stride ? std::atol(stride) : 1;
  halve = error && std::strcmp(error, "short") == 0;
  if (error && !halve) error_number = std::atoi(error);
}

bool fails(const char* call) {
  if (!armed || std::strcmp(call, failing_call) != 0) return false;
  const long number = ++count;
  if (number < first || number > last || (number - first) % every != 0) return false;
  if (number == first && report[0]) {
    const long file = ::syscall(SYS_openat, AT_FDCWD, report, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file >= 0) ::syscall(SYS_close, file);
  }
  return true;
}

bool watched(const char* path) {
  return std::strncmp(path, folder, std::strlen(folder)) == 0;
}

bool watched(int file) {
  char link[64], path[1024];
  std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = ::readlink(link, path, sizeof path - 1);
  if (length < 0) return false;
  path[length] = 0;
  return watched(path);
}

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

int (*program_main)(int, char**, char**) = nullptr;

int armed_main(int argument_count, char** arguments, char** environment) {
  armed = true;
  const int code = program_main(argument_count, arguments, environment);
  armed = false;
  return code;
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t size);

int __libc_start_main(int (*main)(int, char**, char**), int argument_count, char** arguments, void (*init)(),
                      void (*fini)(), void (*loader_fini)(), void* stack_end) {
  program_main = main;
  return next<decltype(__libc_start_main)>("__libc_start_main")(armed_main, argument_count, arguments, init, fini,
                                                                loader_fini, stack_end);
}

void* malloc(std::size_t size) {
  if (fails("malloc")) {
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(size);
}

ssize_t write(int file, const void* data, std::size_t size) {
  if (watched(file) && fails("write")) {
    if (halve && size > 1) return ::syscall(SYS_write, file, data, size / 2);
    if (!halve) {
      errno = error_number;
      return -1;
    }
  }
  return ::syscall(SYS_write, file, data, size);
}

int fsync(int file) {
  if (watched(file) && fails("fsync")) {
    errno = error_number;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_fsync, file));
}

int rename(const char* from, const char* to) noexcept {
  if (watched(to) && fails("rename")) {
    errno = error_number;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_rename, from, to));
}

int unlink(const char* path) noexcept {
  if (watched(path) && fails("unlink")) {
    errno = error_number;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_unlink, path));
}

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(list, mode_t) : 0;
  va_end(list);
  if (watched(path) && fails("open")) {
    errno = error_number;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

}  // extern "C"
