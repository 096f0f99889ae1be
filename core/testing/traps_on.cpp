// Linked into every test program: floating-point traps are on before main, and in every `voussoir` that a test starts.
#include <cstdlib>

#include "core/base/floating_point_traps.hpp"

namespace {

const bool traps_on = [] {
  voussoir::trap_floating_point_errors();
  setenv("VOUSSOIR_TRAPS", "1", 1);
  return true;
}();

}  // namespace
