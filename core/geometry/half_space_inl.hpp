// Functions of half-spaces for inner loops, inline. Not installed: a program's own flags would round it otherwise, and
// the linker might take its copy for the library's.
#pragma once

#include "core/geometry/half_space.hpp"

namespace voussoir {

template <int Dim>
inline double signed_distance(const HalfSpace<Dim>& plane, const Vector<Dim>& point) {
  return plane.normal.dot(point) - plane.offset;
}

}  // namespace voussoir
