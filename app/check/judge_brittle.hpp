// Warnings about searches of a factor of safety over bonds that the first slip breaks, before a run.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

// With the least factor that the closed form of such bonds has for a block or a cluster, if it applies to one.
template <int Dim>
void judge_brittle_bonds(const Prepared<Dim>& prepared, std::vector<std::string>& warnings);

}  // namespace voussoir
