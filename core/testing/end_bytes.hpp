#pragma once

#include <string>

#include "core/run/fields.hpp"
#include "core/run/simulate.hpp"

namespace voussoir {

// the results at the end of a run, without the clock
template <int Dim>
std::string end_of(Progress<Dim> progress) {
  progress.results.seconds = 0;
  return bytes_of(progress);
}

}  // namespace voussoir
