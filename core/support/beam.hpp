// A straight elastic beam between two nodes of the plane with motions and turns of any size: co-rotational, without
// shear deformation (Boon 2013, section 5.3.5). Per metre out of the plane: stiffnesses in N and N m²,
// forces in N, moments in N m, energies in J, all per m. Counter-clockwise rotations and moments are positive.
//
// With the present chord of length l, which has turned by α, and the end rotations θ = φ - α of the nodes against it
//   N = -EA ΔL/L,  M1 = (EI/L)(4θ1 + 2θ2),  M2 = (EI/L)(2θ1 + 4θ2),  V = (M1 + M2)/l,
// L being the unloaded length. With l, and not L, in V the forces are minus the gradient of the potential
//   U = EA ΔL²/(2L) + (EI/L)(2θ1² + 2θ1θ2 + 2θ2²).
// Strains and end rotations must be small, or the element is too long; displacements and turns may be of any size.
#pragma once

#include <array>

#include "core/geometry/types.hpp"

namespace voussoir {

struct Beam {
  Vector<2> chord;               // m, from the first node to the second, unloaded, with rotations of zero
  double axial_stiffness = 0;    // N: EA, E/(1-ν²) for E in plane strain
  double bending_stiffness = 0;  // N m²: EI
};

// the motion of a node from its unloaded place
struct BeamNode {
  Vector<2> displacement = Vector<2>::Zero();  // m
  double rotation = 0;                         // rad, accumulated: a full turn is 2π
};

// The strains of a beam.
struct BeamStrain {
  Vector<2> along = Vector<2>::Zero();      // unit, along the present chord
  double length = 0;                        // m: l; if it is 0 the nodes coincide and nothing else is set
  double elongation = 0;                    // m: ΔL = l - L
  std::array<double, 2> end_rotation = {};  // rad: θ1, θ2
};

// Accurate to rounding of the displacements' difference, at any distance of the nodes from the origin and for any small
// difference. The turn of the chord is the one, among those that differ by 2π, closest to the mean of the nodes'
// rotations: unique as long as θ1 + θ2 stays within ±2π.
BeamStrain beam_strain(const Beam& beam, const BeamNode& first, const BeamNode& second);

struct BeamForces {
  std::array<Vector<2>, 2> force = {Vector<2>::Zero(), Vector<2>::Zero()};  // N, on the nodes
  std::array<double, 2> moment = {};                                        // N m, on the nodes: -M1, -M2

  // inside the beam
  double normal_force = 0;                // N: N, compression positive
  double shear_force = 0;                 // N: V, with which the first node pushes the beam to the left of its chord
  std::array<double, 2> end_moment = {};  // N m: M1, M2, of the nodes on the beam; the bending moment, positive if
                                          // it turns the chord's direction to the left along the beam, is -M1 and M2
  double energy = 0;                      // J: U
};
BeamForces beam_forces(const Beam& beam, const BeamStrain& strain);

// rows and columns: displacement x, y and rotation of the first node, then of the second
using BeamMatrix = FixedMatrix<6, 6>;

// The Hessian of the potential: minus the derivative of the nodes' forces. Symmetric; N/m, N, N m.
BeamMatrix beam_tangent(const Beam& beam, const BeamStrain& strain);

struct BeamInertia {
  double mass = 0;     // kg
  double inertia = 0;  // kg m²
};

// For the time step: a bound of the largest eigenvalue of M⁻¹K, 1/s², for a stiffness K of the two nodes, at least the
// largest and, with the three modes of a beam, at most 3.5 % more. If each node's inertia is divided among its beams,
// such that the parts add up to no more than it has, no eigenvalue of the chain exceeds the largest of its beams'
// (Irons & Treharne 1971), and 2/√λ is a stable step. Half each is the fraction for a chain of equal beams. The
// stiffness of other supports of a node is added to K in like parts. A held node has the inertia 0, its rows are
// ignored.
double largest_eigenvalue_bound(const BeamMatrix& stiffness, const std::array<BeamInertia, 2>& nodes);

}  // namespace voussoir
