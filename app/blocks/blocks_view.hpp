// The interactive page of `voussoir blocks --view`.
#pragma once

#include <filesystem>

#include "core/key_blocks/block_survey.hpp"

namespace voussoir {

// Writes view.bin and view.html: the blocks that were judged, coloured by factor of safety, with a sentence for each.
// Throws OutputError.
template <int Dim>
void write_blocks_view(const std::filesystem::path& folder, const Prepared<Dim>& prepared, const Survey<Dim>& survey);

}  // namespace voussoir
