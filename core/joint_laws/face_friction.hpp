// Shear and twist of a face that is pressed unevenly: Coulomb's friction at each of its points, summed. If the face
// slips with the velocity v + w ẑ × y, a pressure p(y) resists with the force and the moment
//
//   F = µ ∫ p t dA,   M = µ ∫ p (y × t) dA,   t = (v + w ẑ × y) / |v + w ẑ × y|,
//
// the gradient of the dissipation D(v, w) = µ ∫ p |v + w ẑ × y| dA. The face does not slip under forces and moments
// below all planes F·v + M w = D(v, w) (Goyal, Ruina & Papadopoulos 1991): a convex body whose support function is D,
// the limit surface. On a polygon with a linear p the integrals have closed forms, so nothing is fitted: an ellipsoid
// through the same extremes is up to 13 % too strong under even pressure and 16 % under linear (the worst of a
// rectangle 4:1).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/types.hpp"

namespace voussoir {

// A contact polygon with the overlap on it; in its own coordinates, m, from the centre of its area.
struct PressedPolygon {
  std::vector<Vector<2>> corners;          // counter-clockwise
  FixedMatrix<3, 2> axes;                  // of its coordinates, ẑ their cross product
  double overlap = 0;                      // at the centre, m
  Vector<2> gradient = Vector<2>::Zero();  // of the overlap, which is not negative in any corner
};

// The resistance of friction to a slip of velocity v at the centre and spin w, over µ k: force in m³, moment about the
// centre in m⁴. Only the direction of (v, w) matters; not both are zero. To 1e-12 of ∫ u, and of ∫ u times the
// polygon's extent, if the pole of the slip is within some 32 times its radius; beyond, and near that, to 1e-9.
struct FaceFriction {
  Vector<2> force = Vector<2>::Zero();
  double moment = 0;
};
FaceFriction friction_against(const PressedPolygon& polygon, const Vector<2>& v, double w);

// The force and moment within the limit of friction that are nearest to the trial in the energy of the springs, and the
// slip at the centre and the turn that lead there. `pressure`: µ k ∫ u, N; stiffness ks A, N/m, twisting stiffness ks
// J, N m. They are on the limit surface, or equal the trial if it is inside.
struct FaceSlip {
  Vector<2> force;                     // N
  double moment;                       // N m, about the centre
  Vector<2> slip = Vector<2>::Zero();  // m; trial minus remaining force, over the stiffness
  double turn = 0;                     // rad
  // of the limit surface at its nearest point, in the units of the search; zero where none had to be found
  Vector<3> normal = Vector<3>::Zero();
};
FaceSlip return_to_limit(const PressedPolygon& polygon, double pressure, double stiffness, double twist_stiffness,
                         const Vector<2>& force, double moment);

// The same of a face and a trial that differ little from those whose nearest point has this normal: to first order in
// that difference.
FaceSlip return_near(const PressedPolygon& polygon, double pressure, double stiffness, double twist_stiffness,
                     const Vector<2>& force, double moment, const Vector<3>& normal);

}  // namespace voussoir
