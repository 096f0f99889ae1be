// What stages take out, in their order, and what they let off of the forces by which it held the rest.
#pragma once

#include <string>

#include "core/scene/scene_spec.hpp"

namespace voussoir {

// The share of the forces of excavated rock that acts once a stage has ended, of several excavations the largest, and
// the last stage that let off some.
struct ActingShare {
  double share = 0;
  std::string stage = {};  // empty: none yet

  void follow(const StagePlan& plan);
};

// Refuses stages that take out what does not exist or is gone, or let off what does not act.
void check_excavations(const Scene& scene);

}  // namespace voussoir
