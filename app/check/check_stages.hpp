// The lines of `voussoir check` about the stages: what each changes, prescribes and seeks.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

std::string damping_text(const DampingSettings& damping, bool seeks_rest = true);

void print_stages(const std::vector<StagePlan>& stages, const std::vector<Water>& waters);

}  // namespace voussoir
