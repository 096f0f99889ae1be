// The bolts of a model as ties between blocks: rigid and plastic, at each joint that one crosses, up to its yield.
#pragma once

#include "core/limit/corner_cones.hpp"

namespace voussoir {

// Of all Model::bolts, between bodies that are not both held. End-anchored bolts tie the first block to the last;
// grouted ones may cross one joint, and pull no more than the bond holds on either side of it. Throws BadInput for
// grouted bolts that cross more, and for a bolt whose tension has no bound.
template <int Dim>
std::vector<CornerTie<Dim>> ties_of(const Model<Dim>& model);

}  // namespace voussoir
