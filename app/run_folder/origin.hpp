// The program, and the functions of the C library, that this process computes with.
#pragma once

#include <string>

#include "core/output/origin.hpp"

namespace voussoir {

Origin this_origin();

// From now on the programs that this one starts use the functions of the C library that every x86-64 processor has, not
// those with fused multiply-adds, whose last bits differ. Throws BadInput if the C library offers no such
// choice.
void ask_for_portable_math();

// the present GLIBC_TUNABLES, and the same with this choice
std::string with_portable_math(const std::string& tunables);

}  // namespace voussoir
