// The lines of `voussoir check` about earthquake records.
#pragma once

#include "core/model/prepared.hpp"

namespace voussoir {

// their measures, what a correction took off, the response, and how many blocks a wavelength has
template <int Dim>
void print_records(const Prepared<Dim>& prepared);

}  // namespace voussoir
