// What stages excavate, in their order, and how much of the forces by which it supported the rest remains.
#pragma once

#include <string>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// The excavation forces that act once a stage has ended, as a fraction of those before the excavation (of several
// excavations the largest), and the last stage that states them.
struct ActingForces {
  double remaining = 0;
  std::string stage = {};  // empty: none yet

  void follow(const StagePlan& plan);
};

// "remaining 0.40 (relaxed λ = 0.60)", λ of the convergence-confinement method
std::string remaining_text(double remaining);

// Refuses stages that excavate what does not exist or is gone, or state excavation forces that do not act.
void check_excavations(const Scene& scene);

}  // namespace voussoir
