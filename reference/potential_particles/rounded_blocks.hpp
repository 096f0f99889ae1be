// The effect of rounding on blocks whose sharp behaviour is known: faces that bulge, hinges that roll, columns that
// lean. Potential particles (Boon 2013, appendix A) in the plane; contacts are springs in N/m at one point. SI units,
// radians.
#pragma once

#include "reference/hingedbeam/hingedbeam.hpp"

namespace voussoir::reference {

// The middle of a face whose plane is at the distance `plane` from the sphere's centre: with u = x - plane the surface
// is (1 - k) u²/r² + k (x² + y²)/R² = 1.
struct FaceBulge {
  double height = 0;            // m, of the surface above its plane: r at k = 0
  double curvature_radius = 0;  // m, of the surface there; infinite at k = 0
};
FaceBulge face_bulge(double plane, double corner_radius, double sphericity, double sphere_radius);

// The three-hinged beam (reference/hingedbeam) of blocks with k = 0, whose faces are those of the sharp ones and whose
// corners are arcs of radius r, between walls with the same r. Turned by θ a block is 2 δ wider than its place,
//   δ = ((L1 - 2 r) cos θ + (L2 - 2 r) sin θ + 2 r - L1)/2,
// of which δ_w is in the wall. The forces are horizontal, H = K δ_w at a wall and H = K_m 2 (2 δ - δ_w) at mid-
// span, and pass through the arcs' centres, whose heights differ by l = (L2 - 2 r) cos θ - (L1 - 2 r) sin θ; the wall
// supports the weight in the middle of the overlap, L1/2 + δ - δ_w/2 from the centroid:  W = H l / (L1/2 + δ - δ_w/2).
// At r = 0 it is a hinge at the corner itself; a distributed joint has its resultant at a third of the overlap.
struct RoundedHingedBeam {
  HingedBeam beam;
  double midspan_stiffness = 50e6;  // K_m, N/m; δ_w = δ if it is half of K
  double corner_radius = 0;         // m, 0 <= 2 r < depth
};
HingedBeamLoad rounded_hinged_beam(const RoundedHingedBeam& beam, double rotation);

// the greatest weight and its rotation
HingedBeamLoad rounded_hinged_beam_peak(const RoundedHingedBeam& beam);

// A column of equal blocks on a fixed one of their kind, each on one point of faces that bulge and roll on each other.
// The condition on the block height h and the faces' radius: with tilts φ_j (φ_0 = 0) the potential energy is,
// to second order, 1/2 m g Σ (N - j) [ρ (φ_{j+1} - φ_j)² - h/2 (φ_j² + φ_{j+1}²)], j = 0 .. N - 1,
// where 1/ρ = 1/ρ_a + 1/ρ_b of the two faces. The column is stable while this is positive for all tilts: the least ρ/h.
double least_joint_radius(int blocks);

}  // namespace voussoir::reference
