// search.csv: the trials of all searches, in their order. Columns:
//   stage, trial            from 1
//   level, unit             the strength of the trial: a friction angle (deg), or a factor (1)
//   outcome                 stable, failed, undecided (neither within the step limit), broken (a numerical failure)
//   body, displacement_m    the body that has moved most since the search began, and how far; no body has: empty
//   elastic_displacements   that displacement over the elastic one of the bodies that move; empty if it is not known
//   required                the level that the motion of a failed trial required at its end, if it was watched
//   bolts_turned_deg        the bolt that has turned most since its installation, against the block at its collar
//   bolts_use               utilisation: the largest force of a bolt over its capacity
//   moving_blocks, motion   of a failed trial: number of blocks that move, and how the heaviest cluster of them does
//   water_lost              fraction of the water's force on that body, when the search began, that is gone
#pragma once

#include <string>

#include "core/output/results.hpp"

namespace voussoir {

// empty without trials
std::string search_csv(const std::vector<TrialRow>& trials);

}  // namespace voussoir
