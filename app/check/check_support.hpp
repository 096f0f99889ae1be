// The lines of `voussoir check` about bolts and linings, and about potential particles.
#pragma once

#include "core/model/prepared.hpp"

namespace voussoir {

template <int Dim>
void print_particles(const Model<Dim>& model);

template <int Dim>
void print_support(const Prepared<Dim>& prepared);

}  // namespace voussoir
