#pragma once

// A block on an incline: stays, slides, topples, or both. SI units, radians.
namespace voussoir::reference {

struct InclinedBlock {
  double breadth = 1;         // m along the slope, b
  double height = 2;          // m, h
  double slope = 0;           // of the plane below horizontal, 0 .. < pi/2
  double friction_angle = 0;  // 0 .. < pi/2, the same at rest and in motion
};

enum class BlockMode { stays, slides, topples, slides_and_topples };

const char* name_of(BlockMode mode);

// The map of four quadrants (Ashby 1971; Hoek & Bray 1977): slides if slope > friction, topples if tan slope > b/h.
// Right in equilibrium; once it moves, inertia enters the balance.
BlockMode block_mode_of_statics(const InclinedBlock& block);

// The mode in which a rigid block starts from rest (Sagaseta 1986, Rock Mech. Rock Eng. 19, 261-266).
//   Sliding alone needs no more moment than N b/2 from its friction N tan f, not from the weight: tan f <= b/h.
//   Toppling alone, about its lower corner, at the angular acceleration
//     a = 3 g (h sin s - b cos s)/(2 (b^2 + h^2)),
//   needs the friction (g sin s - a h/2)/(g cos s + a b/2) of least_toppling_friction, which is less than tan s.
BlockMode block_mode(const InclinedBlock& block);

// rad: the friction angle above which the block topples without sliding; tan slope >= b/h
double least_toppling_friction(const InclinedBlock& block);

// The angle at which a block on an elastic joint (Pa/m, no tension) overturns, below atan(b/h). Pressed in a triangle
// of length a, the joint transfers N a/3 from its end and turns by t = 2 N/(k a^2), and the rotation moves the centroid
// out by t h (1 + tan^2)/2 of the apparent weight's direction: the remaining arm is largest at a/3 = (2 N h (1 +
// tan^2)/(9 k))^(1/3), and is reduced by 3/2 of it. The apparent weight (true and inertial forces per metre of width)
// leans by the sought angle itself; `normal_force` (N/m) is its part into the plane.
double overturning_angle(double breadth, double height, double normal_force, double normal_stiffness);

// Columns on a stepped base (Goodman & Bray 1976), numbered from the toe: each is `shortening_below` less its step
// higher than the one before up to the crest, and `shortening_above` and its step lower above it.
struct SteppedColumns {
  int columns = 16, crest = 10;
  double thickness = 10, step = 1;                      // m
  double shortening_below = 5, shortening_above = 5.2;  // m
  double base_dip = 0.52359877559829887308;             // 30 degrees

  double height(int column) const;  // m
};

// The friction angle of base and columns, equal, at which the toe needs no support: limit equilibrium, each column
// toppling or sliding, whichever pushes more on the one below. 38.15 degrees for the slope above (Hoek & Bray 1981,
// chapter 9).
double stepped_columns_friction(const SteppedColumns& slope);

}  // namespace voussoir::reference
