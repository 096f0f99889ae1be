// All bits of a state or a run: two are the same if these are equal. Compiled once, since the templates of the
// checkpoint's library cost more compile time than the tests that use them.
#pragma once

#include <string>

#include "core/run/progress.hpp"

namespace voussoir {

template <int Dim>
std::string bits_of(const State<Dim>& state);

template <int Dim>
std::string bits_of(const Progress<Dim>& progress);

// the results at the end of a run, without the clock
template <int Dim>
std::string end_of(Progress<Dim> progress);

}  // namespace voussoir
