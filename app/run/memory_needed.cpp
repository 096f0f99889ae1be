#include "app/run/memory_needed.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace voussoir {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

// of /proc/meminfo: with what caches can give back
double available_in_system() {
  std::ifstream list("/proc/meminfo");
  std::string name;
  double kilobytes = 0;
  while (list >> name >> kilobytes) {
    if (name == "MemAvailable:") return 1024 * kilobytes;
    list.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return unknown;
}

double left_of_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unknown;
  double pages = 0;  // that the process has
  std::ifstream("/proc/self/statm") >> pages;
  return static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

double available_memory() {
  return std::min(available_in_system(), left_of_limit());
}

void require_memory(const std::string& scene, double needed, double available, bool newton) {
  if (needed <= available) return;
  throw NotEnoughMemory(fmt::format(
      "{}: the run takes up to {:.2g} GB of memory, {:.2g} GB are available: cut fewer blocks (domain, joint_sets "
      "intensity){}, or run it where there is more",
      scene, 1e-9 * needed, 1e-9 * std::max(available, 0.0),
      newton ? ", or solve without linear systems (statics = \"adaptive\", which takes longer)" : ""));
}

}  // namespace voussoir
