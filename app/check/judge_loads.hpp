// Warnings about in-situ stresses, and about water in searches, before a run.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

template <int Dim>
void judge_loads(const Prepared<Dim>& prepared, std::vector<std::string>& warnings);

}  // namespace voussoir
