// The history of a joint at one point: the variables that its laws keep from step to step.
#pragma once

#include "core/geometry/types.hpp"

namespace voussoir {

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
  bool bonded = false;         // tension and cohesion are intact, both or neither
};

}  // namespace voussoir
