// What `voussoir check` tells: numbers that follow from a scene, and what in them looks like a mistake. Nothing here is
// an error; a warning is one line with file, line, key and value.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace voussoir {

struct StageEstimate {
  std::string name, kind;
  std::optional<double> steps;  // where the plan tells them
  int trials = 0;               // of a reduction in steps or by bisection
};

struct ScenePlausibility {
  int bodies = 0, free_bodies = 0;
  double smallest_size = 0;  // m: smallest inscribed radius of the blocks
  double largest_size = 0;   // m: largest distance of a vertex from its block's centroid
  double overlap = 0;        // under own weight on the largest face, as a share of the block's inscribed radius
  double time_step = 0;      // s, as given
  std::vector<StageEstimate> stages;
  std::vector<std::string> warnings;
};

// `time_step` is the estimate for the prepared scene, 0 when neither a contact nor the scene gives one.
template <int Dim>
ScenePlausibility judge_plausibility(const Scene& scene, const Prepared<Dim>& prepared, double time_step);

}  // namespace voussoir
