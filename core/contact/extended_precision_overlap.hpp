// The overlap in extended (double-double) precision, if rounding would show. Along the normal the distance to a face
// is its slack over the cosine between both, so a face that the normal grazes, as in slivers and blocks inside others,
// magnifies the rounding of its slack.
#pragma once

#include "core/contact/contact.hpp"
#include "core/contact/pair.hpp"

namespace voussoir {

// The overlap against the point's margin bounds both cosines from below. A slack is exact to a few ulp of the pair's
// size, so that below this an overlap is within 64; ordinary contacts stay below 10.
inline constexpr double most_magnified = 16;

// Measures a touching contact's overlap and the faces that end it again, at the point and along the axis of its
// proof, from the parts' own planes.
template <int Dim>
void measure_overlap_in_extended_precision(const Pair<Dim>& pair, Contact<Dim>& contact);

// whether an overlap needs it, against the margin of the point that it was measured at
inline bool magnified(double overlap, double margin) {
  return overlap > most_magnified * margin;
}

}  // namespace voussoir
