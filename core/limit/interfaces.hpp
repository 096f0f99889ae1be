// The segments in which faces of two blocks of a 2-D assembly touch: limit analysis has forces there.
#pragma once

#include <array>
#include <vector>

#include "core/model/model.hpp"

namespace voussoir {

struct Interface {
  int body_a = 0, body_b = 0;     // a < b
  Vector<2> normal;               // unit, from a to b
  std::array<Vector<2>, 2> ends;  // m, model coordinates
  int joint = no_joint;           // of the two faces' joints the later cut, as in a contact
  int properties = 0;             // index into Model::properties
  double friction = 0;            // rad
  bool one_joint = false;         // both faces are of this joint
  double cohesion = 0;            // Pa; there is no tension

  double length() const { return (ends[1] - ends[0]).norm(); }  // m
};

// Every segment in which faces of two present bodies, not both fixed, touch in the reference configuration. Faces count
// as touching if they are no farther apart than 1e-6 of the smaller inscribed radius along the complete segment, and if
// it is longer than that. Sorted by bodies, then by position. Corners that touch a face or another corner are not
// interfaces. They have the cohesion that their properties state where bonds are as sliced, between faces of one joint;
// `bonded`: everywhere.
std::vector<Interface> find_interfaces(const Model<2>& model, bool bonded = false);

}  // namespace voussoir
