// Warnings about the records of a stage.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// Appends one line for each doubt: a drift at the end, a peak that suggests another unit or a cut record, a begin that
// is not at rest, an azimuth other than the file's, a record that continues beyond the stage.
void judge_records(const StageSpec& stage, std::vector<std::string>& warnings);

}  // namespace voussoir
