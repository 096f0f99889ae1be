// The force of an integrated face contact (contact/integrated_contact.hpp): normal force and moment from its potential;
// shear and twist by springs ks A and ks J over its area, from the slip at its centre and the rotation about its
// normal; Coulomb friction for both together if two faces are in contact (joint_laws/face_friction.hpp), else for
// translation only.
//
// The springs' stress is uniform plus a rotation about the centre. When the contact loses area, the remaining area
// keeps its stress; new area starts without stress, and force and moment are kept. In both cases the springs, uniform
// again, store less energy than before: the difference is lost to the change of area.
#pragma once

#include "core/contact/integrated_contact.hpp"
#include "core/joint_laws/joint_properties.hpp"
#include "core/step/pair_motion.hpp"

namespace voussoir {

template <int Dim>
struct FaceForce {
  Vector<Dim> force = Vector<Dim>::Zero();                        // N on the second body
  Spin<Dim> about = Spin<Dim>::Zero();                            // N m: its moment about the first body's centroid
  double elastic = 0, friction = 0, lost_area = 0, dashpots = 0;  // J, of this step; `elastic`: stored now
};

// J: energy of the springs of a history
template <int Dim>
double held(const JointState<Dim>& history, double shear_stiffness);

// transfers the springs to another area, m² and m⁴, whose centre is `apart` from the previous one
template <int Dim>
void change_area(const Vector<Dim>& normal, const Vector<Dim>& apart, double area, double polar,
                 JointState<Dim>& history);

// `dashpot`, N s/m, along the normal at the centre, which never makes the contact pull. The history is updated.
// `slip_normal`: FaceSlip::normal; zero: it is found and returned, else the slip is found near it.
template <int Dim>
FaceForce<Dim> face_force(const JointProperties& properties, double friction, double dashpot, double time_step,
                          const PairMotion<Dim>& motion, const ContactGeometry<Dim>& geometry,
                          const IntegratedContact<Dim>& face, JointState<Dim>& history,
                          Vector<3>* slip_normal = nullptr);

}  // namespace voussoir
