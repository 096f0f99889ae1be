// Floating-point traps: an invalid operation, a division by zero or an overflow ends the program where it happens
// (SIGFPE), instead of a NaN that shows up a thousand steps later. On in every test program, and in `voussoir` when the
// environment has VOUSSOIR_TRAPS=1; off otherwise. Threads inherit them from the thread that starts them.
#pragma once

#include <cfenv>

namespace voussoir {

void trap_floating_point_errors();

// Suspends the traps for a scope and forgets what was raised in it: for external libraries that divide by zero on
// purpose, and for tests that feed NaN.
class WithoutTraps {
 public:
  WithoutTraps() { std::feholdexcept(&environment_); }
  ~WithoutTraps() { std::fesetenv(&environment_); }
  WithoutTraps(const WithoutTraps&) = delete;
  WithoutTraps& operator=(const WithoutTraps&) = delete;

 private:
  std::fenv_t environment_;
};

}  // namespace voussoir
