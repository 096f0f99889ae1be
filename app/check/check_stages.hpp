// The lines of `voussoir check` about the stages: what each changes, prescribes and seeks.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

std::string statics_text(const StaticsSettings& statics);
std::string damping_text(const DampingSettings& damping);

void print_stages(const std::vector<StagePlan>& stages, const std::vector<Water>& waters);

}  // namespace voussoir
