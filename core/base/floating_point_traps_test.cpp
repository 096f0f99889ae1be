// The traps that every test program runs with are on, here and in its threads, and can be suspended.
#include "core/base/floating_point_traps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <thread>

namespace voussoir::floating_point_traps_test {
namespace {

// not known to the compiler, so that the operation happens when it runs
volatile double zero = 0, one = 1, largest = std::numeric_limits<double>::max();

// a sanitizer's own handler would turn the signal into an exit
template <class Operation>
void with_default_action(Operation operation) {
  std::signal(SIGFPE, SIG_DFL);
  volatile double result = operation();
  (void)result;
}

TEST(TrapsDeathTest, AnInvalidOperationADivisionByZeroAndAnOverflowEndTheProgram) {
  const testing::KilledBySignal by_trap(SIGFPE);
  EXPECT_EXIT(with_default_action([] { return zero / zero; }), by_trap, "");
  EXPECT_EXIT(with_default_action([] { return one / zero; }), by_trap, "");
  EXPECT_EXIT(with_default_action([] { return largest * largest; }), by_trap, "");
  // in a new thread too
  EXPECT_EXIT(std::thread([] { with_default_action([] { return zero / zero; }); }).join(), by_trap, "");
  // and again once they were suspended
  { const WithoutTraps without_traps; }
  EXPECT_EXIT(with_default_action([] { return zero / zero; }), by_trap, "");
}

TEST(Traps, AreSuspendedInAScope) {
  const WithoutTraps without_traps;
  EXPECT_TRUE(std::isnan(zero / zero));
}

TEST(Traps, UnderflowAndRoundingAreNoErrors) {
  volatile double smallest = std::numeric_limits<double>::min();
  EXPECT_EQ(smallest * smallest, 0);
  EXPECT_NE(one / 3, 0);
}

}  // namespace
}  // namespace voussoir::floating_point_traps_test
