#pragma once

#include <optional>
#include <vector>

#include "reference/wedge/wedge.hpp"

// Limit analysis of rigid blocks in space by hand: joints that dilate by their friction (associated flow) and joints
// that slip without opening. Angles in radians, forces in any one unit.
namespace voussoir::reference {

// The friction angle, equal on all planes, at which a block above them that only translates is just supported against
// a resultant, if its joints dilate: it moves along a unit v across the resultant with v·n >= sin φ on every plane, so
// sin φ is the distance of the origin from the convex hull of the normals' projections across the resultant. Normals
// are units that point into the block. Derived for any number of planes; here the hull of two or one. A resultant that
// pulls the block off both at once moves it along n_A + n_B: sin φ = |n_A + n_B|/2.
double dilating_friction(const Vector3& normal_a, const Vector3& normal_b, const Vector3& resultant);

// The acceleration, a fraction of gravity, along a unit direction at which a wedge on two planes of one friction angle
// fails: by `dilating_friction`, and without dilation by solve_wedge (Hoek & Bray 1974). Found by bisection between -1
// and 10, to rounding. Empty if the planes hold the block against any: from half their angle on, if joints dilate.
std::optional<double> dilating_push(const Wedge& wedge, const Vector3& direction, double friction);
std::optional<double> plain_push(const Wedge& wedge, const Vector3& direction, double friction);

// A block `along` x `across` x `height` on a plane that dips by `dip`, pushed by an acceleration (fraction of gravity),
// horizontal, at the angle `azimuth` from the dip direction: it slides, or topples about one of its four edges. The
// least positive factor; with and without dilation alike.
struct BlockPushedOnIncline {
  double along = 1, across = 1, height = 1;
  double dip = 0, friction = 0;
};
double push_on_incline(const BlockPushedOnIncline& block, double azimuth);

// A wall in running bond on a rigid floor, `courses` of `bricks` of length x height, half bricks at the ends of every
// other course, pushed in its plane: the bricks from one brick of a course up to the free end, and all that rest on
// them, turn as one about the end's lower corner, without friction of their sides: Σ w (x_toe - x)/Σ w (z - z_course),
// the least over all bricks. The wall slides at tan φ.
struct RunningBond {
  int courses = 1, bricks = 1;
  double length = 1, height = 1;
};
double push_on_wall(const RunningBond& wall, double friction);

// Goodman & Bray's (1976) slope of columns on a stepped base: the critical friction angle of limit equilibrium by their
// recursion for the force at the toe. Columns have the thickness t on a base that dips by `dip` and rises by `step` a
// column; the slope's surface falls by `below` a step under the crest and by `above` over it.
struct TopplingSlope {
  int columns = 16, crest = 10;
  double thickness = 10, step = 1, below = 5, above = 5.2;
  double dip = 0.5235987755982988;

  double height(int column) const;  // from 1 at the toe
};
double toppling_friction(const TopplingSlope& slope);

}  // namespace voussoir::reference
