// Whether a run fits into the memory that is free, before it begins.
#pragma once

#include <stdexcept>
#include <string>

namespace voussoir {

// one line; the program ends with exit code 8
class NotEnoughMemory : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// bytes that this process can still get: what the system reports as available, or what is left of the process's own
// limit (ulimit -v) if that is less; infinite if neither is known
double available_memory();

// Throws NotEnoughMemory if a run needs more bytes than are available. `newton`: whether a stage solves linear systems
// (statics = "newton"), which another method would not need.
void require_memory(const std::string& scene, double needed, double available, bool newton);

}  // namespace voussoir
