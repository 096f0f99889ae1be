// What the potential particle's radius r does to the contact normal, and the rule that picks it.
#pragma once

#include <vector>

namespace voussoir::trade {

// A face contact whose point lies `distance` from an edge of either block, on opposite sides: both gradients turn
// towards their edge, by atan(<r - distance>/(r - overlap/2)), and so does the normal.
struct EdgeTilt {
  double radius;       // fraction of the size
  double distance;     // to the edge, over r
  double tilt, exact;  // rad
};
std::vector<EdgeTilt> edge_tilts();

// One radius over many contacts of equal overlap. Tilt: of face contacts, against the face's normal; change: how far
// the normal of a corner or edge contact turns when the overlap grows by a hundredth.
struct AtRadius {
  double radius;        // over the overlap
  double tilt, change;  // rad, means
  double without;       // fraction of contacts where a part's gradient vanished: a face's normal stood in
  double deep;          // fraction of contacts reported as deeper than r
  int unsaid;           // contacts without a gradient that were not
};
std::vector<AtRadius> at_radii(double overlap);

// the smallest radius at which no contact is deeper than r or without a gradient
const AtRadius& ruled(const std::vector<AtRadius>& settings_tried);

}  // namespace voussoir::trade
