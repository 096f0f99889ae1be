// What `voussoir blocks --kinematics` prints and writes.
#pragma once

#include <string>
#include <vector>

#include "core/key_blocks/kinematics.hpp"

namespace voussoir {

// a zone of a net, and how many joints or lines fall into it
struct ZoneCount {
  std::string zone;
  long count = 0, of = 0;
};
std::vector<ZoneCount> zone_counts(const KinematicRequest& request, const KinematicCounts& counts);

// how many pairs block theory judges how, by the zone of their line
struct ZonePairs {
  std::string zone;
  long below_one = 0, at_least_one = 0, buried = 0;
};
std::vector<ZonePairs> zone_pairs(const std::vector<PairVerdict>& pairs);

// zones with counts, and block theory's verdicts on the pairs beside them
std::string kinematics_summary(const KinematicRequest& request, const KinematicCounts& counts,
                               const std::vector<PairVerdict>& pairs, const std::string& title);

// what the page of `voussoir report` draws: face, friction, limits, joints with set and normal, the counts
struct NamedJoint {
  std::string name, set;
  Vector<3> normal;
};
std::string kinematics_json(const KinematicRequest& request, const KinematicCounts& counts,
                            const std::vector<PairVerdict>& pairs, const std::vector<NamedJoint>& joints,
                            const std::string& title, const std::string& hash);

// a row for every pair whose line leaves the face
std::string kinematic_pairs_csv(const std::vector<PairVerdict>& pairs, const std::vector<NamedJoint>& joints);

}  // namespace voussoir
