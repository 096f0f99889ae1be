#pragma once

#include <limits>

// Linings of a circular opening in elastic ground, plane strain, wished in place.
// Thrust is compression positive; moment is sagging positive (tension on the inside); the angle runs from the crown.
namespace voussoir::reference {

// Axisymmetric lining over a compliant interface: Boon (2013), Eqs H.1-H.6.
struct SoftLining {
  double radius = 0;                // a, m
  double in_situ_pressure = 0;      // p0, Pa
  double shear_modulus = 0;         // G of the ground, Pa
  double lining_modulus = 0;        // E, Pa
  double lining_thickness = 0;      // t, m
  double interface_stiffness = 0;   // K_L, Pa/m
  double lining_poisson_ratio = 0;  // 0 for separate beams, as in a discrete-element lining
  double fixed_radius = std::numeric_limits<double>::infinity();  // R, m, at which the ground is held
  double ground_poisson_ratio = 0;                                // of ground that is held
};

// N = p0 a / (1 + 2 G a (1 - nu_L^2) / (E t) + 2 G / (K_L a)), N per metre of tunnel (Boon 2013, Eq. 5.14, after Eq.
// H.6). Ground that is held at R has the stiffness at the wall of infinite ground with `modulus_of_held_rock`
// (bolted_ring.hpp), which replaces G. Throws std::invalid_argument unless radius, moduli, thickness and stiffness are
// positive.
double lining_hoop_force(const SoftLining& lining);

// Einstein & Schwartz (1979), Simplified analysis for tunnel supports, J. Geotech. Eng. Div. ASCE 105, 499-518: the
// relative stiffness solution for an elastic, homogeneous ground and a thin elastic ring, excavation unloading.
struct RingLining {
  double radius = 0;                // R, m
  double vertical_stress = 0;       // P, Pa
  double horizontal_ratio = 1;      // K = horizontal over vertical stress
  double ground_modulus = 0;        // E, Pa
  double ground_poisson_ratio = 0;  // 0 <= nu < 0.5
  double lining_modulus = 0;        // E_s, Pa
  double lining_area = 0;           // A_s, m^2 per metre of tunnel
  double lining_inertia = 0;        // I_s, m^4 per metre of tunnel
  double lining_poisson_ratio = 0;  // nu_s
};

enum class LiningContact { full_slip, no_slip };

// thrust(t) = thrust_mean - thrust_wave cos 2t, moment(t) = moment_wave cos 2t, t from the crown, so a larger vertical
// stress (K < 1) sags the crown and presses the springline.
struct RingLiningForces {
  double thrust_mean = 0;  // N per metre
  double thrust_wave = 0;  // N per metre
  double moment_wave = 0;  // N m per metre
};

// With C = E R (1 - nu_s^2)/(E_s A_s (1 - nu^2)) and F = E R^3 (1 - nu_s^2)/(E_s I_s (1 - nu^2)); the mean thrust tends
// to lining_hoop_force without interface as I/(A R^2) -> 0 (the ring's bending adds that fraction to its hoop
// stiffness). Throws std::invalid_argument on values out of range.
RingLiningForces ring_lining(const RingLining& lining, LiningContact contact);

double thrust_at(const RingLiningForces& forces, double angle_from_crown);  // N per metre
double moment_at(const RingLiningForces& forces, double angle_from_crown);  // N m per metre

}  // namespace voussoir::reference
