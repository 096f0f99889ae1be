#include "core/base/floating_point_traps.hpp"

#include <fenv.h>  // feenableexcept is glibc's, not the standard library's

namespace voussoir {

void trap_floating_point_errors() {
  std::feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}

}  // namespace voussoir
