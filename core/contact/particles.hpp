// Contacts of which one part at least is a potential particle (core/potential), beside those of half-spaces.
#pragma once

#include "core/contact/narrow_phase.hpp"

namespace voussoir {

// As narrow_phase, if every part has a particle (Polytope) and some parts are one: those pairs are resolved by
// core/potential/contact. They have neither faces nor area.
template <int Dim>
void narrow_phase_with_particles(std::span<const Pair<Dim>> pairs, const ContactSettings& settings,
                                 const Solvers<Dim>& solvers, std::span<Contact<Dim>* const> contacts,
                                 KernelCounters& counters);

}  // namespace voussoir
