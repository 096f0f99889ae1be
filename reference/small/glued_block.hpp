#pragma once

// A block that one vertical face glues to a wall, under its weight: a cantilever on an elastic joint. SI units,
// radians, per metre of width.
namespace voussoir::reference {

struct GluedBlock {
  double length = 1, height = 0.5;  // m
  double density = 2500;            // kg/m3
  double gravity = 9.81;            // m/s2
  double normal_stiffness = 1e9;    // Pa/m, spread along the face
  double shear_stiffness = 1e9;     // Pa/m
};

// The joint's normal stress is linear along the face, its moment that of the weight at half the length:
//   rotation M/(k_n h^3/12), stress at the edge 6 M/h^2, drop of the centre W/(k_s h) + rotation l/2.
double glued_rotation(const GluedBlock& block);      // rad, the free end down
double glued_drop(const GluedBlock& block);          // m, of the centre
double glued_edge_tension(const GluedBlock& block);  // Pa: the tensile strength below which a brittle bond opens

// The same stress where n equal parts of the face have one spring each: at the middle of the outermost part. The
// bending stiffness is 1 - 1/n^2 of the whole face's, the distance (1 - 1/n) h/2.
double glued_part_tension(const GluedBlock& block, int parts);

}  // namespace voussoir::reference
