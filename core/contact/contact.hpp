// A contact between two convex parts, split by lifetime: geometry (this step), joint state (history), warm start.
#pragma once

#include <array>

#include "core/geometry/types.hpp"

namespace voussoir {

enum class ContactStatus {
  apart,  // their boxes do not meet: not looked at
  separated,
  touching,
  lp_not_converged,      // the LP hit its iteration limit
  centre_not_converged,  // Newton hit its limit or met a singular system
  no_normal,             // neither potential nor multipliers gave a direction
  no_face                // a search along the normal met no face: an unbounded part
};

// where and how two parts overlap, relative to the centroid of the first part's body, world axes
template <int Dim>
struct ContactGeometry {
  Vector<Dim> point = Vector<Dim>::Zero();   // m
  Vector<Dim> normal = Vector<Dim>::Zero();  // unit, from the first to the second
  double overlap = 0;                        // m, positive
  double area = 0;                           // m² (2-D: m, unit thickness); 0 when no law asked for it
  int face_a = -1, face_b = -1;              // the faces that end the searches along the normal
};

// what a joint remembers
template <int Dim>
struct JointState {
  Vector<Dim> shear_force = Vector<Dim>::Zero();  // N on the second body
  Vector<Dim> normal = Vector<Dim>::Zero();       // of the step before
  double plastic_slip = 0;                        // m, accumulated
  double dashpot = 0;                             // N: its share of the normal force, of the step before
};

// where the kernel starts next time; a new contact starts cold
template <int Dim>
struct WarmStart {
  bool point_known = false;
  Vector<Dim> point = Vector<Dim>::Zero();  // frame of the first body, m
  bool basis_known = false;
  std::array<int, Dim + 1> basis{};  // of the last LP that separated the parts
};

template <int Dim>
struct Contact {
  int part_a = 0, part_b = 0, sub = 0;  // the key: Model::parts, a < b, number of the sub-contact
  int joint = -1;                       // Model::joints, or -1 between faces that no joint made
  int properties = 0;                   // Model::properties in force while touching
  ContactStatus status = ContactStatus::apart;
  ContactGeometry<Dim> geometry;
  JointState<Dim> history;
  WarmStart<Dim> warm;
  Vector<Dim> force = Vector<Dim>::Zero();  // N on the second body
  double area_rated = -1;                   // m²: the area the time step was last chosen for; negative: not yet

  bool touching() const { return status == ContactStatus::touching; }
  bool unanswered() const { return status > ContactStatus::touching; }
};

}  // namespace voussoir
