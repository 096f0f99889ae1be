// The general road through the contact kernel: any solver of the two convex programs, any definition of the contact
// point, plain loops. Slower than the kernel/ and its net: it answers what that could not prove.
#pragma once

#include "core/contact/narrow_phase.hpp"

namespace voussoir {

// as narrow_phase, for one pair
template <int Dim>
void resolve_generally(const Pair<Dim>& pair, const ContactSettings& settings, const Solvers<Dim>& solvers,
                       Contact<Dim>& contact, KernelCounters& counters);

}  // namespace voussoir
