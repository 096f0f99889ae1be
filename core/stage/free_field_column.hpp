// The column of rock beyond a free-field side: the side's own blocks once more, beside the model and not loaded by it,
// joined to themselves through their images.
#pragma once

#include <vector>

#include "core/model/model.hpp"
#include "core/stage/medium.hpp"

namespace voussoir {

// Adds the columns beyond a side, number in Model::open_sides, and their images; returns the body beside each of these
// faces. Each pile of blocks, as wide as the side's, must repeat: every block's face on the side, and in space its
// faces across, must be those opposite moved along their normal. Throws ClosedSide if they are not.
template <int Dim>
std::vector<int> add_columns(Model<Dim>& model, int side, const std::vector<SideFace>& faces);

}  // namespace voussoir
