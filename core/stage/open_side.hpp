// Sides that waves leave, in the changes of a stage.
#pragma once

#include "core/model/model.hpp"
#include "core/stage/medium.hpp"

namespace voussoir {

// Opens a side of the model: plates on its outer faces, blocks that were fixed for its sake released, and at a free
// field the column of rock beyond it. Throws ClosedSide if it cannot be.
template <int Dim>
void open_side(Model<Dim>& model, const BoundaryPlan& plan);

// The same for all such sides of a stage, whose other changes are made; quiet sides come first, since a column has the
// same base as the side. The plans must not be refused by it.
template <int Dim>
void open_sides(Model<Dim>& model, const std::vector<BoundaryPlan>& plans);

// The motions of the columns' bodies and images while a stage lasts: as those of the bodies of the side, and as those
// of their column. Those of the stage have been prescribed.
template <int Dim>
void prescribe_columns(Model<Dim>& model);

}  // namespace voussoir
