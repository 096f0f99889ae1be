// How near two parts are: parts that a face's plane keeps apart need no contact.
#pragma once

#include "core/contact/pair.hpp"

namespace voussoir {

// Two parts are near each other until a face's plane of either keeps all of the other farther away than the smaller of
// their inscribed radii: the same for any skin, and a block's own thickness keeps its two neighbours apart.
struct Nearness {
  bool near = true;
  double lasts = 0;  // m: as long as the paths of any point of the two bodies add up to less than this
};

// radii: the largest distances of any point of the two bodies from their centroids, m
template <int Dim>
Nearness nearness(const Pair<Dim>& pair, double radius_a, double radius_b);

// whether two parts may be near each other before a point of either body has moved by more than `way`, m
template <int Dim>
bool may_come_near(const Pair<Dim>& pair, double radius_a, double radius_b, double way);

}  // namespace voussoir
