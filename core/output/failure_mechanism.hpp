// What fails: clusters of blocks that move as one rigid body, how they move, and the joints at which they do.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace voussoir {

enum class FailureMotion {
  slides,            // translation along joints that are in contact
  falls,             // translation without contact, within 45° of gravity
  lifts,             // likewise, in another direction
  topples,           // turns about an edge that is in contact, below its centroid
  slumps,            // slides and turns back: its top stays behind
  slides_and_turns,  // slides and turns forward
  turns              // any other rotation
};

// a joint at which a cluster moves against other blocks
struct MovingJoint {
  std::string joint;             // empty: faces that no joint made
  double slip = 0, opening = 0;  // m: largest of its contacts, of the motion
  double force = 0;              // N: normal forces at its end (2-D: N/m)
  bool slips = false, opens = false, carries = false;
};

struct MovingCluster {
  std::vector<int> bodies;        // ascending
  double volume = 0, weight = 0;  // m³, N (2-D: m², N/m)
  double free_share = 0;          // of the mass of all free blocks
  FailureMotion motion = FailureMotion::slides;
  double displacement = 0;            // m, of its centroid
  double farthest = 0;                // m, of the corner that moved most
  double plunge = 0, trend = 0;       // deg, of that displacement; in the plane the trend is 90 (right) or 270 (left)
  double turn = 0;                    // deg, in the plane counter-clockwise
  std::vector<double> about{};        // m, world coordinates: point of the axis of rotation, or of the edge
  bool at_edge = false;               // that point is on an edge that is in contact
  std::vector<double> axis{};         // unit; in space only
  bool along_line = false;            // it slides on two joints that are not parallel
  std::vector<MovingJoint> joints{};  // the largest force first
};

// bonds that a motion has broken, and those at its end that have slipped or are whole
struct BondsOfMotion {
  long long broken = 0, slipped = 0, whole = 0;
};

struct FailureMechanism {
  int dimension = 3;
  std::vector<MovingCluster> clusters;   // the heaviest first; empty: not known
  double free_share = 0;                 // of the mass of all free blocks
  std::optional<BondsOfMotion> bonds{};  // if there were any

  bool known() const { return !clusters.empty(); }
  std::vector<int> bodies() const;  // of all clusters, ascending
};

// "slides", "falls", …
const char* word_of(FailureMotion motion);

// A sentence without its full stop: "blocks 2 and 5 (29.5 m³, 768 kN, all of the free mass) slide along the line of A1
// and B1, 38/169 (plunge/trend)". Empty if nothing is known.
std::string sentence_of(const FailureMechanism& mechanism);

}  // namespace voussoir
