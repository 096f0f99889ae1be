// The numbers of a mass that one verdict for each block gives: what studies and samples ask for.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/key_blocks/block_survey.hpp"

namespace voussoir {

template <int Dim>
struct MassValues {
  std::optional<double> least_factor;                // of blocks and clusters that move; none: nothing moves
  const SurveyRow<Dim>* least = nullptr;             // its row in the survey, which lives longer
  double volume_below_1 = 0;                         // m³ (2-D: m²), of successive failure and of clusters
  std::set<int> below_1;                             // these blocks
  std::optional<double> least_critical_coefficient;  // none without an earthquake of any direction
  bool undecided = false;  // a projection reached its limit of steps: its block has no verdict
};

// as results.json has them; the last one only with an earthquake of any direction
inline std::vector<std::string> names_of_mass_values(bool with_earthquake = false) {
  std::vector<std::string> names{"least_factor", "volume_below_1", "blocks_below_1"};
  if (with_earthquake) names.emplace_back("least_critical_coefficient");
  return names;
}

template <int Dim>
MassValues<Dim> mass_values(const Survey<Dim>& survey);

}  // namespace voussoir
