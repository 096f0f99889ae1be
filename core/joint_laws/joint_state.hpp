// The history of a joint at one point: the variables that its laws keep from step to step.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

// The state of a bond. A slipped one has lost its tensile strength and keeps the cohesion that its slip has left, while
// the joint stays closed; of a brittle law there is none.
enum class Bond : unsigned char { lost, whole, slipped };

template <int Dim>
struct JointState {
  Vector<Dim> shear_force = Vector<Dim>::Zero();  // N on the second body
  Vector<Dim> normal = Vector<Dim>::Zero();       // of the step before
  Vector<Dim> point = Vector<Dim>::Zero();        // m, of the step before, relative as the contact's
  double plastic_slip = 0;                        // m, accumulated: β
  double dashpot = 0;                             // N: its fraction of the normal force, of the step before
  double area = 0;                                // m², of the step before; 1 for a constant stiffness
  double twist = 0;            // N m on the second body about the normal: of an integrated face contact
  double polar = 0;            // m⁴: its last twisting stiffness, over the shear stiffness
  double shear_stiffness = 0;  // Pa/m, of the step before, if a law lets it vary; else 0
  double bond_slip = 0;        // m, plastic slip since the bond was made
  Bond bond = Bond::lost;
};

}  // namespace voussoir
