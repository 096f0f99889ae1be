// Rock cut by joints that end, and its moduli in an oedometer: the mass of Boon (2013), section 5.4.1, made again by
// another slicer and the network.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/tunnel/blocks.hpp"

namespace voussoir::reference::network {

// A joint in the plane: a segment about its middle, `angle` (rad) from x.
struct Trace {
  Point middle;
  double angle = 0, length = 0;
};

// Middles uniform over the box from low to high, `density` (1/m²) times its area of them to the nearest whole, angles
// normally scattered. The same for a seed on every platform.
std::vector<Trace> draw_traces(const Point& low, const Point& high, double density, double angle, double deviation,
                               double length, std::uint64_t seed);

// Radius of the largest circle in a convex polygon, m.
double inscribed_radius(const Polygon& polygon);

// Trace by trace, in turn: each block that it enters is cut right through, unless a piece would have an inscribed
// circle of less than `least_radius` (m).
std::vector<Polygon> cut_by_traces(const Polygon& whole, const std::vector<Trace>& traces, double least_radius);

// The traces of several sets, one of each in turn.
std::vector<Trace> in_turn(const std::vector<std::vector<Trace>>& sets);

// Moduli of rock with a joint every `spacing` (m), of stiffness kn and ks (Pa/m), between blocks that do not deform
// (Goodman 1989; Boon 2013, table 5.3). Throws std::invalid_argument unless all are positive and 0 <= nu < 0.5.
struct SpacedJointsModuli {
  double young_modulus = 0;            // kn s, Pa: Eq. 5.6
  double shear_modulus = 0;            // ks s, Pa: Eq. 5.7
  double isotropic_shear_modulus = 0;  // kn s/(2 (1 + nu)), Pa: Eq. 5.9, which is Eq. 5.8 with Eq. 5.6
};
SpacedJointsModuli spaced_joints_moduli(double spacing, double normal_stiffness, double shear_stiffness,
                                        double poisson_ratio);

struct OedometerAnswer {
  double shear_modulus = 0;    // (s1 - s3)/(2 e1), Pa: Eq. 5.12
  double poisson_ratio = 0;    // s3/(s1 + s3): Eq. 5.13
  double axial = 0, side = 0;  // s1, s3 over e1, Pa, compression positive
};

// Blocks that fill the box from low to high, pressed along x or y (`along` 0 or 1) between four rigid walls without
// friction, with contacts as between blocks. For a mass much larger than its blocks: the two joints at the walls count
// as joints of the mass do.
OedometerAnswer oedometer(std::vector<Block> blocks, const Point& low, const Point& high, int cells,
                          double normal_stiffness, double shear_stiffness, int along, double tolerance);

}  // namespace voussoir::reference::network
