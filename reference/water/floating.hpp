#pragma once

#include <vector>

// Blocks that float, and the part of a block below a level of still water. SI units, radians.
namespace voussoir::reference {

// A rectangular block, upright, of any length across the section: per metre of it.
struct FloatingBlock {
  double width = 1;             // m, > 0: the side on the water, across the axis about which it rolls
  double height = 1;            // m, > 0
  double relative_density = 1;  // of the block to the water's, 0 < s < 1
  double gravity = 9.81;        // m/s^2, > 0
};

// d = s h: weight is buoyancy (Archimedes), m.
double draught(const FloatingBlock& block);

// GM = I/V - BG = b^2/(12 d) + d/2 - h/2, m: positive if the upright block is stable (Bouguer 1746, any textbook of
// naval architecture).
double metacentric_height(const FloatingBlock& block);

// Of small motions without damping and without the water's own inertia (added mass), s: 2 pi sqrt(d/g), and omega^2 =
// 12 g GM/(b^2 + h^2). A block of finite length pitches as it rolls, with its length for its width. The roll throws
// std::invalid_argument if the upright block is not stable.
double heave_period(const FloatingBlock& block);
double roll_period(const FloatingBlock& block);

// The ratio of width to height above which a block of this relative density floats upright: sqrt(6 s (1 - s)).
double least_stable_ratio(double relative_density);

// GZ, m: the arm of the moment that turns a heeled block back, sin(heel) (GM + BM tan^2(heel)/2), while its sides cut
// the water and neither its deck nor its keel does (wall-sided formula). Throws std::invalid_argument beyond.
double righting_arm(const FloatingBlock& block, double heel);

// The heel (rad, >= 0) at which a block that does not float upright is in equilibrium: tan^2(heel) = -2 GM/BM; 0 if it
// floats upright. Throws std::invalid_argument beyond the range of the wall-sided formula.
double angle_of_loll(const FloatingBlock& block);

// the part of a block below a level
struct Submerged {
  double volume = 0;    // m^3; m^2 in the plane
  double x = 0, y = 0;  // m: its centroid, y above the level (negative, or above the cube's corner), x to the right
};

// A rectangle, turned counter-clockwise by `turn` (rad) about its centre, which is at x = 0, `above` (m) over the
// level: the polygon cut at the level. If nothing is submerged: all zero.
Submerged submerged_rectangle(double width, double height, double turn, double above);

// A cube of edge 1 m with its lowest corner down and the diagonal vertical, `level` (m, 0..sqrt(3)) above that corner:
// tetrahedra by inclusion and exclusion, of edge e = sqrt(3) level, e - 1 (three) and e - 2 (three). y is above the
// corner, x zero.
Submerged submerged_cube_on_corner(double level);

}  // namespace voussoir::reference
