#pragma once

#include <vector>

// How an opening in jointed rock fails, from the motion of its blocks and the joints that bound the moved blocks: a
// stated rule for the terms of Boon (2013), Table 5.1.
//
// Plane, x to the right, y up, origin at the opening's centre; m, m2 and radians. Angles of joints and motions are
// counter-clockwise from x.
namespace voussoir::reference {

// a block, in its initial position before excavation and with its displacement since
struct BlockMotion {
  double x = 0, y = 0;    // centroid
  double area = 0;        // m2
  double dx = 0, dy = 0;  // displacement of the centroid
  double turn = 0;        // counter-clockwise
};

// A length of joint between two blocks before the opening was excavated.
struct JointStretch {
  int first = 0, second = 0;  // places in the list of blocks
  double nx = 0, ny = 0;      // unit normal from the first to the second
  double length = 0;          // m
  int set = -1;               // place in the list of sets; -1: of no set
};

// mean trace of a joint set: dips by `dip` to the right or to the left
struct JointSet {
  double dip = 0;  // 0 to pi/2
  bool to_right = true;
};

enum class Place { roof, left_wall, right_wall, floor };
enum class Kind { none, fall, slide, wedge, topple };

// thresholds of the rule
struct MechanismRule {
  double moved = 0.25;      // m: a block with a larger displacement is lost; half of the smallest block of 0.5 m
  double least_area = 0.1;  // m2: a smaller area, a splinter or two, is no mechanism
  double roof_half_angle = 0.7854;  // of the quarter above the centre, from the vertical
  double along = 0.2618;            // 15 degrees: a motion this close to a trace counts as along it
  double flank_share = 0.25;  // of the length that bounds the moved blocks, for a joint set to be one of their flanks
  double turned_share = 0.5;  // of the moved area that must turn rather than translate, to topple
};

// The mechanism at one place.
struct Mechanism {
  Place place = Place::roof;
  Kind kind = Kind::none;
  int first_set = -1, second_set = -1;  // slide: along the first; wedge: of both, left flank first
  double area = 0;                      // m2 that moved
  double dx = 0, dy = 0;                // its mean displacement, m
};

// The four places in the order of `Place`, each block by the place of its centroid; kinds, the first that fits:
//   none    less than `least_area` moved
//   topple  blocks with |turn| sqrt(area) > |displacement|/2 make up `turned_share` of the moved area; not in the
//           roof, in which a block may turn as it falls
//   wedge   two different sets bound it, one to the left and one to the right, each over `flank_share` of the length
//           that bounds it towards rock that did not move, and the two narrow upwards
//   slide   the mean motion is down the trace of a set, within `along`, and joints of this set are beneath the moved
//           blocks, over `flank_share`
//   fall    anything else
// Of several sets the longest counts. Throws std::invalid_argument if a joint names a block or a set that does not
// exist.
std::vector<Mechanism> mechanisms(const std::vector<BlockMotion>& blocks, const std::vector<JointStretch>& joints,
                                  const std::vector<JointSet>& sets, const MechanismRule& rule = {});

}  // namespace voussoir::reference
