#pragma once

#include <limits>

// A circular opening in elastic rock under a hydrostatic stress, with radial bolts smeared into the rock around it.
//
// Source: Carranza-Torres (2009), Analytical and numerical study of the mechanics of rockbolt reinforcement around
// tunnels in rock masses, Rock Mech. Rock Eng. 42, 175-228, as used by Boon (2013), section 5.4.4, Eqs 5.3
// and G.3. The equation below was derived again from equilibrium; plane strain, tension positive, u the outward
// displacement:
//
//   rho = r/a,  beta = K_a s_mean / (s_theta s_z 2G),  b = beta (1 - 2 nu)/(1 - nu)
//   rho (rho + b) u'' + rho u' - u = 0          within the bolts' length
//   u / a = C1 rho + C2 [(rho/b^2) ln(1 + b/rho) - 1/b]   there,     u / a = C3 / rho   beyond
//
// Rock that is held at a radius R, as in a model of finite size, has u / a = C3 (1/rho - rho a²/R²) beyond: plain rock
// has u = A r + B/r, and u(R) = 0. R to infinity gives the line above.
//
// Wished in place: bolts are loaded by the whole convergence, no pretension. At the wall the stress increment of rock
// and bolts together cancels p0 (free wall); at the bolts' end u and the total radial stress are continuous.
namespace voussoir::reference {

struct BoltedRing {
  double radius = 0;                // a, m
  double in_situ_pressure = 0;      // p0, Pa, compression positive
  double shear_modulus = 0;         // G of the rock mass, Pa
  double poisson_ratio = 0;         // 0 <= nu < 0.5
  double bolt_stiffness = 0;        // K_a, N/m, of one bolt across one joint; 0: no bolts
  double mean_joint_spacing = 0;    // s_mean, m: E_b A_b = K_a s_mean
  double bolt_length = 0;           // m
  double tangential_spacing = 0;    // s_theta, m along the wall: radius times the angle between bolts
  double longitudinal_spacing = 1;  // s_z, m: 1 for the unit thickness of a plane model
  double fixed_radius = std::numeric_limits<double>::infinity();  // R, m, at which the rock is held; beyond the bolts
};

struct BoltedRingState {
  double convergence = 0;    // towards the opening, m
  double bolt_force = 0;     // N, tension positive; 0 beyond the bolts
  double radial_stress = 0;  // Pa, compression positive, rock and bolts together; 0 at the wall, p0 far away
  double hoop_stress = 0;    // Pa, compression positive
};

// Shear modulus of an infinite rock with the stiffness at the wall of rock of modulus G that is held at R: G (1 +
// (a/R)²/(1 - 2 nu))/(1 - (a/R)²): at a, the radial stress of u = B (1/r - r/R²) over u.
double modulus_of_held_rock(double shear_modulus, double poisson_ratio, double radius, double fixed_radius);

// Force of a bolt of `ring`, mean over its length: its integral from wall to end over that length, N.
double mean_bolt_force(const BoltedRing& ring);

// beta above.
double bolt_relative_stiffness(const BoltedRing& ring);

// The state at a distance (m, from the wall to the held radius) from the centre; just inside at the bolts' end. Closed
// form. Throws std::invalid_argument on values out of range.
BoltedRingState bolted_ring_at(const BoltedRing& ring, double distance);

// The same by integrating the differential equation inwards from the bolts' end.
BoltedRingState bolted_ring_at_by_ode(const BoltedRing& ring, double distance);

}  // namespace voussoir::reference
