// Where two blocks of a 2-D assembly lie face on face: the joints' stretches that limit analysis puts forces on.
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
  double cohesion = 0;            // Pa; no tension is ever carried

  double length() const { return (ends[1] - ends[0]).norm(); }  // m
};

// Every stretch where faces of two present bodies, not both fixed, lie on each other in the reference configuration.
// Faces count as lying on each other when they are no farther apart than 1e-6 of the smaller inscribed radius along
// the whole stretch, and when it is longer than that. Sorted by bodies, then by place. Corners that touch a face or
// another corner are no interface. `bonded`: they have the cohesion that their properties state, else none.
std::vector<Interface> find_interfaces(const Model<2>& model, bool bonded = false);

}  // namespace voussoir
