// The lines of `voussoir check` about joints that miss the domain, and about the blocks that cost most.
#pragma once

#include "core/model/prepared.hpp"
#include "core/scene/scene_spec.hpp"

namespace voussoir {

// of those that the scene states; of sets only joints that meet the domain are drawn
template <int Dim>
void print_missing_joints(const Scene& scene, const Model<Dim>& model);

// Three of each: smallest volume (2-D: area), shortest edge of a part, largest aspect ratio of the box along the axes.
// Potential particles are left out.
template <int Dim>
void print_worst_blocks(const Model<Dim>& model);

}  // namespace voussoir
