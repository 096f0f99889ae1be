// Options of a study's runs.
#pragma once

namespace voussoir {

struct WorkOptions {
  int jobs = 0;                // at the same time; 0: as many as there are cores
  int threads = 1;             // of each run
  double time_limit = 0;       // s of wall clock for each run; 0: none
  bool portable_math = false;  // with the C library's functions that every x86-64 processor has
  bool quiet = false;
};

}  // namespace voussoir
