#pragma once

#include <array>

// A wedge in a flat roof, held by the in-situ stress on three joints: the joint relaxation of Goodman, Shi & Boyle
// (1982), Calculation of support for hard, jointed rock using the keyblock principle; Boon (2013), section 4.9.
//
// x east, y north, z up; SI, angles in radians. The three planes meet in an apex above the roof, the wedge is below all
// of them and above the roof at z = 0. It translates only.
namespace voussoir::reference {

using Vector3 = std::array<double, 3>;

struct RoofPlane {
  double dip = 0, dip_direction = 0;  // 0 < dip < pi/2; clockwise from north
  double strength = 1;                // tan of its friction angle over that of the common one, which is sought
};

struct RoofWedge {
  std::array<RoofPlane, 3> planes;
  double height = 1;                                         // m, of the apex above the roof
  double density = 2000, gravity = 9.81;                     // kg/m³, m/s²
  double normal_stiffness = 10e6, shear_stiffness = 10e6;    // Pa/m
  std::array<double, 6> stress{0.05e6, 0.05e6, 0, 0, 0, 0};  // Pa, compression: xx, yy, zz, yz, zx, xy
};

struct RoofWedgeFaces {
  std::array<Vector3, 3> normal{};  // unit, into the wedge
  std::array<double, 3> area{};     // m²
  double base_area = 0;             // m²
  double volume = 0;                // m³
};

// Throws std::invalid_argument when the planes enclose no wedge below the apex.
RoofWedgeFaces roof_wedge_faces(const RoofWedge& wedge);

struct RoofWedgeState {
  double friction = 0;                   // rad: the common angle
  Vector3 displacement{};                // m, since the roof was cut
  std::array<double, 3> normal_force{};  // N
  std::array<double, 3> shear_force{};   // N
  int first_plane = 0;                   // the one that slips first
  double step_error = 0;                 // rad: change of `friction` when the steps are halved; 0 for a closed form
};

// First slip, in closed form. Elastic joints relax when the roof is cut: with n into the wedge and P the stress,
//   sum A [kn n n^T + ks (I - n n^T)] d = -W e_z - P e_z A_base,
//   N = A n.P n - kn A n.d,   T = A (I - n n^T) P n - ks A (I - n n^T) d,
// and the plane with the greatest |T|/(N strength) slips at tan(friction) = that. Only kn/ks matters for the angle.
// Throws std::domain_error when a plane opens, since the joints are then not linear.
RoofWedgeState first_slip(const RoofWedge& wedge);

struct RoofWedgeSettings {
  double friction_start = 1.3;   // rad: stable without slip
  double friction_step = 2e-4;   // rad
  double smallest_step = 1e-10;  // rad: the bracket on the collapse angle
};

// Collapse: friction falls from `friction_start`, planes slip one after the other at their Coulomb limits (elastic,
// perfectly plastic, no dilation), until no equilibrium is left. The state is the last in equilibrium. Throws
// std::domain_error when the wedge is not stable at the start.
RoofWedgeState collapse(const RoofWedge& wedge, const RoofWedgeSettings& settings = {});

}  // namespace voussoir::reference
