// One joint of unit area on the paths of laboratory tests: the response of a law without any block.
#pragma once

#include <vector>

#include "core/joint_laws/joint_law.hpp"

namespace voussoir {

// One path: first the normal stress is raised from none to `normal_stress` and, if `unload` is set, lowered again as
// far as possible; then the joint is sheared to `slip`, or `cycles` times to slip, -slip and back to 0.
//   Constant normal load: `surroundings` is 0. Constant normal stiffness: the joint is pressed by a spring of stiffness
//   `surroundings`, which it compresses as it rises: by its own law, or, if it has none, by `dilation` times the slip.
struct JointPath {
  double normal_stress = 0;  // Pa, at which shear begins; the largest of a path without shear
  bool unload = false;
  double slip = 0;          // m
  int cycles = 0;           // 0: one way only
  double surroundings = 0;  // Pa/m
  double dilation = 0;      // rise over slip, of a joint that does not dilate
  bool bonded = false;      // once the normal stress is reached
  int steps = 200;          // along each leg
};

struct JointPathPoint {
  double overlap = 0, slip = 0;                        // m, of the walls
  double rise = 0, offset = 0;                         // m, by its own dilation; plastic, from where it was mated
  double normal_stress = 0, shear_stress = 0;          // Pa; shear along the slip
  double normal_stiffness = 0, shear_stiffness = 0;    // Pa/m, tangents of the elastic springs
  double plastic_slip = 0;                             // m, accumulated
  double friction = 0;                                 // coefficient available
  double cohesion = 0;                                 // Pa, available
  double elastic = 0, dissipated = 0, stiffening = 0;  // J/m², the last two since the start
  double dilation = 0, crushing = 0;                   // J/m², since the start: to the normal spring, and lost
  Bond bond = Bond::lost;
  bool snap_back = false;
};

// from the unloaded joint on, which is the first point
std::vector<JointPathPoint> follow(const JointProperties& properties, const JointPath& path);

}  // namespace voussoir
