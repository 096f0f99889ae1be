#include "app/run/memory_needed.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <string>

namespace voussoir::memory_needed_test {
namespace {

std::string refusal(double needed, double available, bool newton) {
  try {
    require_memory("scene.toml", needed, available, newton);
  } catch (const NotEnoughMemory& refused) {
    return refused.what();
  }
  return {};
}

TEST(MemoryNeeded, RefusesARunThatDoesNotFit) {
  EXPECT_EQ(refusal(1e9, 1e9, true), "");
  EXPECT_EQ(refusal(1e9, INFINITY, true), "");
  const std::string with_systems = refusal(12e9, 7.9e9, true), without = refusal(12e9, -1, false);
  EXPECT_NE(with_systems.find("scene.toml: the run takes up to 12 GB of memory, 7.9 GB are available"),
            std::string::npos)
      << with_systems;
  EXPECT_NE(with_systems.find("statics = \"adaptive\""), std::string::npos);
  EXPECT_EQ(without.find("statics"), std::string::npos);
  EXPECT_NE(without.find("0 GB are available"), std::string::npos);
}

TEST(MemoryNeeded, KnowsTheLimitOfTheProcess) {
  EXPECT_GT(available_memory(), 0);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  constexpr double spare = 256e6;  // bytes
  rlimit lower = before;
  lower.rlim_cur = static_cast<rlim_t>(pages * static_cast<double>(sysconf(_SC_PAGESIZE)) + spare);
  ASSERT_EQ(setrlimit(RLIMIT_AS, &lower), 0);
  const double left = available_memory();
  ASSERT_EQ(setrlimit(RLIMIT_AS, &before), 0);
  EXPECT_LE(left, spare);
  EXPECT_GT(left, 0.5 * spare);
}

}  // namespace
}  // namespace voussoir::memory_needed_test
