// The reference kernel: any solver of the two convex programs, any definition of the contact point, plain loops. Slower
// than the SIMD kernel (kernel/), and its fallback: it resolves the pairs that that kernel could not prove.
#pragma once

#include "core/base/settings.hpp"
#include "core/contact/contact.hpp"
#include "core/contact/kernel_counters.hpp"
#include "core/contact/pair.hpp"
#include "core/solvers/solvers.hpp"

namespace voussoir {

// As narrow_phase, for one pair. A proof by an interior point that is valid at this very pose (`fresh`) is not checked:
// the pair touches, whatever the rounding of this kernel.
template <int Dim>
void resolve_by_reference(const Pair<Dim>& pair, const ContactSettings& settings, const Solvers<Dim>& solvers,
                          Contact<Dim>& contact, bool fresh, KernelCounters& counters);

}  // namespace voussoir
