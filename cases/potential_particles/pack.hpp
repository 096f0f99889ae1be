// A settled pack of half-space blocks that are rounded in place and then settle again.
#pragma once

#include "cases/potential_particles/problems.hpp"

namespace voussoir::cases {

// Forty regular polyhedra have fallen into a box (the case free_fall) and have then settled on contacts with the
// stiffness that the least radius requires.
struct Pack {
  Model<3> model;
  State<3> state;
  double height = 0;  // m, mean of the centroids above the plate
  double size = 0;    // m, the smallest inscribed radius
};
Pack settle_pack();

// Mean settlement of the centroids within half a second, over their height before.
Trial settled_pack(const Pack& pack, const RelativeRounding& rounding);

}  // namespace voussoir::cases
