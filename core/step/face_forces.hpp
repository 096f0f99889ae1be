// What a contact that is carried as a whole answers (contact/integrated_contact.hpp): the normal force and moment of
// its potential; shear and twist by springs ks A and ks J over its area, from the slip at its centre and the turn about
// its normal; Coulomb's friction in both together where two faces lie on each other (joint_laws/face_friction.hpp),
// else in translation.
//
// The springs' stress is even, and turns about the centre. When the contact loses area, what is left keeps its own
// share of it; what it gains begins without stress, and force and moment stay. Either way the springs, which are even
// again, hold less than before: energy that is lost to the change of area.
#pragma once

#include "core/contact/integrated_contact.hpp"
#include "core/joint_laws/joint_properties.hpp"
#include "core/step/pair_motion.hpp"

namespace voussoir {

template <int Dim>
struct FaceForce {
  Vector<Dim> force = Vector<Dim>::Zero();                        // N on the second body
  Spin<Dim> about = Spin<Dim>::Zero();                            // N m: its moment about the first body's centroid
  double elastic = 0, friction = 0, lost_area = 0, dashpots = 0;  // J, of this step; `elastic`: held now
};

// `dashpot`, N s/m, along the normal at the centre, which never makes the contact pull. The history goes on.
template <int Dim>
FaceForce<Dim> face_force(const JointProperties& properties, double friction, double dashpot, double time_step,
                          const PairMotion<Dim>& motion, const ContactGeometry<Dim>& geometry,
                          const IntegratedContact<Dim>& face, JointState<Dim>& history);

}  // namespace voussoir
