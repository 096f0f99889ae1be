// Which program, and which functions of the C library, this process computes with.
#pragma once

#include <string>

#include "core/output/origin.hpp"

namespace voussoir {

Origin this_origin();

// From now on the programs that this one starts take the functions of the C library that every x86-64 processor has,
// not those with fused multiply-adds, whose last bits differ. Throws BadInput where the C library offers no such
// choice.
void ask_for_portable_math();

// GLIBC_TUNABLES as it stands and the same with that asked for
std::string with_portable_math(const std::string& tunables);

}  // namespace voussoir
