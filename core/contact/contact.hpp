// A contact between two convex parts, split by lifetime: geometry (this step), joint state (history), proof (of the
// decision, and the next start).
#pragma once

#include <array>

#include "core/joint_laws/joint_state.hpp"

namespace voussoir {

enum class ContactStatus {
  apart,                 // not near each other (core/step/neighbours): not evaluated
  separated,             // proven
  undecided,             // nearer to touching than rounding resolves, at most 64 ulp of the pair's size: no contact
  touching,              // proven
  lp_not_converged,      // the LP hit its iteration limit
  centre_not_converged,  // Newton hit its limit or met a singular system
  no_normal,             // neither potential nor multipliers gave a direction
  no_face  // a search along the normal met no face: an unbounded part; or so many planes bound the overlap that it
           // cannot be integrated (region_integral)
};

// place and measures of the overlap of two parts, relative to the centroid of the first part's body, world axes
template <int Dim>
struct ContactGeometry {
  Vector<Dim> point = Vector<Dim>::Zero();   // m
  Vector<Dim> normal = Vector<Dim>::Zero();  // unit, from the first to the second
  double overlap = 0;                        // m, positive
  double area = 0;                           // m² (2-D: m, unit thickness); 0 when no law needs it
  double stiffness_factor = 1;               // fraction of a constant normal stiffness that acts (ContactNormal)
  // the faces that end the searches along the normal, or press on each other most, or are nearest to the point
  int face_a = -1, face_b = -1;
};

enum class ProofKind {
  none,
  interior_point,   // `point` is inside both parts by at least `margin`
  separating_axis,  // no point of A is beyond `support` along `axis`, no point of B before support + margin
  multipliers,      // the LP's optimum is at least `margin`, by its multipliers (weak duality)
  // of potential particles: `point` is that of the least max(f_A, f_B), `support` the ratio λ / (1 - λ); if they touch
  // `margin` is the path of the point as one part turns, m/rad
  least_point
};

// The proof of the result, its own rounding included, and the kernel's next start. In the frame of the first body. A
// new contact has none and starts cold.
template <int Dim>
struct Proof {
  ProofKind kind = ProofKind::none;
  double margin = 0;                          // m, positive
  Vector<Dim> point = Vector<Dim>::Zero();    // m
  Vector<Dim> axis = Vector<Dim>::Zero();     // unit: the axis that separates the parts, or the contact's normal
  Vector<Dim> tangent = Vector<Dim>::Zero();  // interior point, 3-D: with `axis` it spans the thin directions
  double support = 0;                         // m
  std::array<int, Dim + 1> basis{};           // multipliers: the planes that have them, A's first
  std::array<unsigned short, 12> section{};   // interior point: the planes that bound the section, in cyclic order
  int section_size = 0;                       // 0: unknown, or too many
};

// one of several contact points of a joint: a cell of the divided face (sub_contacts.hpp)
template <int Dim>
struct SubContact {
  Vector<Dim> point = Vector<Dim>::Zero();  // m, point of its force; relative as the contact's
  double overlap = 0;                       // m, mean over the cell
  double overlap_variance = 0;              // m², variance of the overlap over the cell
  double gyration2 = 0;                     // m²: square of the radius of gyration of the cell's section
  double area = 0;                          // m² (2-D: m); 0: the cell does not touch
  JointState<Dim> history;
  Vector<Dim> force = Vector<Dim>::Zero();  // N on the second body
};

template <int Dim>
struct Contact {
  int part_a = 0, part_b = 0;  // the key: Model::parts, a < b
  int joint = -1;              // Model::joints, or -1 between faces that no joint made
  int properties = 0;          // Model::properties in force while touching
  int cells = 0;               // its sub-contacts in State::contacts.subs; 0: its force acts at its own point
  int divided_face = -1;       // theirs: of the first part, or, counted on behind its faces, of the second
  ContactStatus status = ContactStatus::apart;
  bool bond_due = false;  // its joint is closed, and is bonded when first compressed (make_bonds)
  // m: a finding on the pair is valid until its bodies' paths add up to this
  double near_until = 0;  // whether it is near
  double free_until = 0;  // that it is separated
  // m²: the area for which the time step was last chosen, times the stiffening by stress; negative: not yet
  double area_rated = -1;
  // most steps read only the above of most pairs, a cache line; a body's loads need the force and the point
  Vector<Dim> force = Vector<Dim>::Zero();  // N on the second body
  ContactGeometry<Dim> geometry;
  JointState<Dim> history;  // of all sub-contacts together if there are any
  Proof<Dim> proof;

  bool touching() const { return status == ContactStatus::touching; }
  bool unanswered() const { return status > ContactStatus::touching; }
};

}  // namespace voussoir
