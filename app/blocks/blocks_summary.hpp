// What `voussoir blocks` prints.
#pragma once

#include <string>

#include "core/key_blocks/block_survey.hpp"

namespace voussoir {

// header, a line a class, the worst blocks and clusters, rounds, notes; kN and m³ (2-D: per metre)
template <int Dim>
std::string blocks_summary(const Survey<Dim>& survey, const std::string& title, int top);

}  // namespace voussoir
