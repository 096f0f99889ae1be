// Which program made a result.
#pragma once

#include <string>

namespace voussoir {

// the project's version, e.g. "0.1.0"
std::string version();

// the commit that was built, "-dirty" behind it when files differed from it; "unknown" outside a git checkout
std::string commit();

// e.g. "GNU 12.2.0"
std::string compiler();

// whether the contact kernel was built with CMake's VOUSSOIR_FAST_ARITHMETIC: its bits are then no other build's
bool fast_arithmetic();

}  // namespace voussoir
