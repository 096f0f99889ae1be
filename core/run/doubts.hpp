// What of a run is to be doubted: an energy balance that does not close, an angle below what its level promises.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/energy.hpp"
#include "core/base/settings.hpp"
#include "core/output/results.hpp"

namespace voussoir {

// A warning with which of the two balances is open and what of the run opens it; empty when the balance closes.
// `stages`: those that were begun, under the scene's settings.
std::string doubts_of(const EnergyBalance& energy, std::span<const StagePlan> stages, const Settings& scene);

// A warning for each critical angle below those for which an accuracy level, empty for none, keeps its promise.
std::vector<std::string> doubts_of_level(std::string_view level, const Results& results);

}  // namespace voussoir
