// Linear elastic, perfectly plastic Coulomb law (Boon 2013, Eqs 4.1-4.9; decisions in core/joint_laws/README.md).
#pragma once

#include "core/geometry/types.hpp"
#include "core/joint_laws/joint_properties.hpp"

namespace voussoir {

// motion of the second body relative to the first at the contact, over the last step
template <int Dim>
struct JointKinematics {
  Vector<Dim> normal;           // unit, from the first to the second
  double overlap = 0;           // m, mean over the area
  double overlap_variance = 0;  // m², its variance; it stores energy only
  double area = 0;              // m²; 1 for a constant stiffness
  double stiffness_factor = 1;  // fraction of a constant normal stiffness that acts
  double closing_speed = 0;     // m/s
  Vector<Dim> slip;             // tangential displacement increment, m
  double turn = 0;              // rad: spin of the two bodies about the normal, 3-D only
};

template <int Dim>
struct JointForce {
  Vector<Dim> force;        // N on the second body
  double plastic_slip = 0;  // m, of this step
  double elastic = 0;       // J stored in the normal and the shear spring
  double friction = 0;  // J lost to slip in this step: mean of the old and the new shear force times the plastic slip,
                        // never negative
  double dashpot = 0;   // N: the dashpot's fraction of the normal force
  double stiffening = 0;   // J lost by the shear spring as it stiffened under its force; negative: gained
  bool snap_back = false;  // strength fell faster than the spring could unload
};

// of a force or slip of any size: the square of 1e-200 N is zero
template <int Dim>
double length_of(const Vector<Dim>& v);

// Rotates a shear force to a new contact plane: turned with the normal, then with the bodies' spin about it, its length
// kept. (Decision: Eq. 4.4 lengthens it on every turn and misses the spin.)
Vector<2> carried(const Vector<2>& shear, const Vector<2>& old_normal, const Vector<2>& normal, double turn);
Vector<3> carried(const Vector<3>& shear, const Vector<3>& old_normal, const Vector<3>& normal, double turn);

// Force on the second body. `shear` is its old shear force already rotated to the new plane and is updated to the new
// one. `coefficient` of friction; `dashpot` in N s/m adds to the normal force, which never pulls.
template <int Dim>
JointForce<Dim> elastic_coulomb(const JointProperties& properties, double coefficient, double dashpot,
                                const JointKinematics<Dim>& kinematics, Vector<Dim>& shear);

}  // namespace voussoir
