// What moves the least factor of a mass of blocks: derivatives of block theory's answer by re-slicing.
#pragma once

#include "app/derivatives/derivative_table.hpp"
#include "core/key_blocks/block_survey.hpp"
#include "core/scene/scene.hpp"

namespace voussoir {

// Derivatives of the least factor of blocks and clusters. Of the joints of the scene only those are varied that bound
// the blocks that give it. Throws BadInput for scenes that block theory cannot judge.
DerivativeTable blocks_derivatives(const Scene& scene, const SurveyRequest& request, const KeyHook& hook = {});

}  // namespace voussoir
