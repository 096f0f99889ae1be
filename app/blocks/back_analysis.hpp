// Back-analysis: the strengths of one joint property at which a mass that moves is just in equilibrium.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/key_blocks/block_survey.hpp"

namespace voussoir {

struct StrengthPair {
  double friction = 0;  // rad
  double cohesion = 0;  // Pa: the least with which every block and cluster has a factor of 1 at this friction
};

struct BackAnalysis {
  std::string properties;
  std::optional<double> critical_friction;  // rad, without cohesion; none: no friction below 89 degrees is enough
  std::vector<StrengthPair> line;  // by rising friction; its last has no cohesion, if there is a critical friction
  bool needs_none = false;         // nothing moves, or it stands without any strength of these joints
};

// Other properties keep their strength. To a relative 1e-9. Throws BadInput if there are no such properties, if their
// friction is not Coulomb's, or if blocks fall whatever their strength.
template <int Dim>
BackAnalysis back_analysis(const Prepared<Dim>& prepared, const SurveyRequest& request, const std::string& properties);

std::string back_analysis_csv(const BackAnalysis& analysis);
// results.json: critical_friction, cohesion_without_friction
std::string back_analysis_json(const BackAnalysis& analysis, const std::string& title, const std::string& input_hash);
std::string back_analysis_text(const BackAnalysis& analysis, const std::string& title);

}  // namespace voussoir
