// Shared by the fuzz targets: an invariant that ends the program if it is broken, and the time limit of one input.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace voussoir::fuzz {

// libFuzzer keeps the input of a program that aborts
inline void require(bool holds, const char* invariant) {
  if (holds) return;
  std::fprintf(stderr, "broken invariant: %s\n", invariant);
  std::abort();
}

// A hang is more than one second of processor time for one input; wall-clock time would include the machine's other
// work.
class Stopwatch {
 public:
  ~Stopwatch() { require(std::clock() - begin_ <= CLOCKS_PER_SEC, "an input takes at most one second"); }

 private:
  std::clock_t begin_ = std::clock();
};

}  // namespace voussoir::fuzz
