// What a run says of an energy ledger that does not close.
#pragma once

#include <span>
#include <string>

#include "core/energy.hpp"
#include "core/settings.hpp"

namespace voussoir {

// A warning with which of the two balances is open and what of the run opens it; empty when the ledger closes.
// `stages`: those that were begun, under the scene's settings.
std::string doubts_of(const EnergyLedger& energy, std::span<const StagePlan> stages, const Settings& scene);

}  // namespace voussoir
