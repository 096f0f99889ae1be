// A jointed rock mass that is exactly isotropic: three persistent joint sets at 60° to each other, of equal spacing s,
// cut blocks that do not deform themselves. Under a uniform stress every joint of a set opens and slips alike, blocks
// only shift, and the strain sum over sets of (n jump + jump n)/2s is that of an isotropic solid in plane strain:
//
//   G = (2 s/3) kn ks/(kn + ks),   nu = (kn - ks)/(2 (kn + ks))
//
// wherever the lines are: if the outer shifts add up to the middle one they make triangles, else triangles and
// hexagons. If the stress varies, the finite size of the blocks matters: corrections of the order of s over its length.
#pragma once

#include <array>
#include <vector>

#include "reference/tunnel/blocks.hpp"

namespace voussoir::reference::network {

struct IsotropicModuli {
  double shear_modulus = 0;  // Pa
  double poisson_ratio = 0;
};

// Throws std::invalid_argument unless spacing (m) and stiffnesses (Pa/m) are positive.
IsotropicModuli isotropic_moduli(double spacing, double normal_stiffness, double shear_stiffness);

// kn and ks (Pa/m) that give these moduli at a spacing. 0 <= nu < 0.5.
std::array<double, 2> isotropic_stiffnesses(const IsotropicModuli& moduli, double spacing);

// Joints per metre of a straight line, mean over its directions: 3 (2/pi)/s; between sqrt(3)/s and 2/s in any.
double mean_crossings(double spacing);

// An opening with a wall of many straight sides in such a mass, held beyond a radius.
struct IsotropicOpening {
  double radius = 0;        // a, m: the circle of the wall's area
  double fixed_radius = 0;  // blocks with centroids beyond it are held
  int sides = 0;            // of the wall
  double spacing = 0;       // s, m
  double first_angle = 0;   // rad, of the first set's normal
  std::array<double, 3> shifts{};
  IsotropicModuli moduli;
  int cells = 2;  // points a face
};

struct OpeningNetwork {
  Network network;          // blocks and joint springs
  Polygon outline;          // of the opening
  std::vector<Face> faces;  // joints
  std::vector<Face> wall;
};

OpeningNetwork build(const IsotropicOpening& opening);

// `count` bolts from the wall outwards, at angles (k + 1/2) 2 pi/count.
void add_fan(OpeningNetwork& built, int count, double length, double stiffness, double offset);

// A closed ring with a node at every corner of the outline, on an interface K_L in both directions (Pa/m).
void add_ring(OpeningNetwork& built, double axial, double bending, double interface);

double sum_of_bolt_forces(const Solution& solution);  // N, over all springs
double mean_thrust(const Solution& solution);         // N, over the beams

}  // namespace voussoir::reference::network
