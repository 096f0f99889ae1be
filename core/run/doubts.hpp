// Doubtful results of a run: an energy balance that does not close, an angle below the range of its accuracy level.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/energy.hpp"
#include "core/base/settings.hpp"
#include "core/output/results.hpp"

namespace voussoir {

// A warning that names the open one of the two balances and its causes; empty if both close.
// Of stages that are all solved by Newton's method, whose increments do not follow the work of contacts, only the
// balance of the motion. `stages`: those that were begun, with the scene's settings.
std::string doubts_of(const EnergyBalance& energy, std::span<const StagePlan> stages, const Settings& scene);

// A warning if implicit steps have taken much energy out of swings and impacts that they do not resolve; or empty.
std::string doubts_of_implicit_steps(const EnergyBalance& energy);

// A warning for each critical angle below the range of the accuracy level (empty: none).
std::vector<std::string> doubts_of_level(std::string_view level, const Results& results);

}  // namespace voussoir
