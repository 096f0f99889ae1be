// What `voussoir blocks --kinematics` prints and writes.
#pragma once

#include <string>
#include <vector>

#include "core/key_blocks/kinematics.hpp"

namespace voussoir {

// zones with counts, and block theory's verdicts on the pairs beside them
std::string kinematics_summary(const KinematicRequest& request, const KinematicCounts& counts,
                               const std::vector<PairVerdict>& pairs, const std::string& title);

// a row for every pair whose line leaves the face
std::string kinematic_pairs_csv(const std::vector<PairVerdict>& pairs, const std::vector<std::string>& names);

}  // namespace voussoir
