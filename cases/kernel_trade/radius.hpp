// The effect of the potential particle's radius r on the contact normal, and the rule for choosing it.
#pragma once

#include <vector>

namespace voussoir::trade {

// A face contact whose point is at `distance` from an edge of either block, on opposite sides: both gradients rotate
// towards their edge, by atan(<r - distance>/(r - overlap/2)), and so does the normal.
struct EdgeTilt {
  double radius;       // fraction of the size
  double distance;     // to the edge, over r
  double tilt, exact;  // rad
};
std::vector<EdgeTilt> edge_tilts();

// One radius over many contacts of equal overlap. Tilt: of face contacts, against the face's normal; change: the
// rotation of the normal of a corner or edge contact if the overlap grows by a hundredth.
struct AtRadius {
  double radius;        // over the overlap
  double tilt, change;  // rad, means
  double without;       // fraction of contacts at which a part's gradient vanished and a face's normal replaced it
  double deep;          // fraction of contacts reported as deeper than r
  int unsaid;           // contacts without a gradient that were not
};
std::vector<AtRadius> at_radii(double overlap);

// the smallest radius at which no contact is deeper than r or without a gradient
const AtRadius& ruled(const std::vector<AtRadius>& settings_tried);

}  // namespace voussoir::trade
