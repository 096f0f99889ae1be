// Contact between two convex parts (Boon 2013, chapter 3.3): whether, where, in which direction, how far and how wide
// they overlap.
#pragma once

#include <span>

#include "core/base/settings.hpp"
#include "core/contact/contact.hpp"
#include "core/contact/kernel_counters.hpp"
#include "core/contact/pair.hpp"
#include "core/solvers/solvers.hpp"

namespace voussoir {

// as many as the nearest caches contain with their contacts
inline constexpr std::size_t pairs_together = 64;

// Resolves each pair into the contact at the same place: status, geometry and proof. A contact that has a proof starts
// from it; a new one starts cold, so its result depends on the pair alone; one that rounding hid starts where the
// program ended. The result of a pair is bitwise independent of the batch. History is not touched.
template <int Dim>
void narrow_phase(std::span<const Pair<Dim>> pairs, const ContactSettings& settings, const Solvers<Dim>& solvers,
                  std::span<Contact<Dim>* const> contacts, KernelCounters& counters);

}  // namespace voussoir
