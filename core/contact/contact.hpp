// A contact between two convex parts, split by lifetime: geometry (this step), joint state (history), proof (what
// decided it, and the next start).
#pragma once

#include <array>

#include "core/joint_laws/joint_state.hpp"

namespace voussoir {

enum class ContactStatus {
  apart,                 // not near each other (core/step/neighbours): not looked at
  separated,             // proven
  undecided,             // nearer to touching than rounding can tell, at most 64 ulp of the pair's size: no contact
  touching,              // proven
  lp_not_converged,      // the LP hit its iteration limit
  centre_not_converged,  // Newton hit its limit or met a singular system
  no_normal,             // neither potential nor multipliers gave a direction
  no_face  // a search along the normal met no face: an unbounded part; or so many planes bound the overlap that it
           // cannot be integrated (region_integral)
};

// where and how two parts overlap, relative to the centroid of the first part's body, world axes
template <int Dim>
struct ContactGeometry {
  Vector<Dim> point = Vector<Dim>::Zero();   // m
  Vector<Dim> normal = Vector<Dim>::Zero();  // unit, from the first to the second
  double overlap = 0;                        // m, positive
  double area = 0;                           // m² (2-D: m, unit thickness); 0 when no law asked for it
  double stiffness_factor = 1;               // fraction of a constant normal stiffness that acts (ContactNormal)
  // the faces that end the searches along the normal, or lean on each other most, or are nearest to the point
  int face_a = -1, face_b = -1;
};

enum class ProofKind {
  none,
  interior_point,   // `point` lies inside both parts by at least `margin`
  separating_axis,  // nothing of A lies beyond `support` along `axis`, nothing of B before support + margin
  multipliers,      // the LP's optimum is at least `margin`, by its multipliers (weak duality)
  // of potential particles: `point` is where max(f_A, f_B) is least, `support` the ratio λ / (1 - λ); where they touch
  // `margin` is how far the point walks as one part turns, m/rad
  least_point
};

// What proves the answer, its own rounding included, and where the kernel starts next time. In the frame of the first
// body. A new contact has none and starts cold.
template <int Dim>
struct Proof {
  ProofKind kind = ProofKind::none;
  double margin = 0;                          // m, positive
  Vector<Dim> point = Vector<Dim>::Zero();    // m
  Vector<Dim> axis = Vector<Dim>::Zero();     // unit: the axis that separates the parts, or the contact's normal
  Vector<Dim> tangent = Vector<Dim>::Zero();  // interior point, 3-D: with `axis` it spans what is thin
  double support = 0;                         // m
  std::array<int, Dim + 1> basis{};           // multipliers: the planes that have them, A's first
  std::array<unsigned short, 12> section{};   // interior point: the planes that bound the section, in cyclic order
  int section_size = 0;                       // 0: unknown, or too many
};

// one of several points that carry a joint: a cell of the divided face (sub_contacts.hpp)
template <int Dim>
struct SubContact {
  Vector<Dim> point = Vector<Dim>::Zero();  // m, where its force acts; relative as the contact's
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
  int cells = 0;               // sub-contacts that carry it, in State::contacts.subs; 0: it carries itself
  int divided_face = -1;       // theirs: of the first part, or, counted on behind its faces, of the second
  ContactStatus status = ContactStatus::apart;
  bool bond_due = false;  // its joint is closed, and is bonded where it first presses (make_bonds)
  // m: what was found of the pair holds until its bodies' travels add up to this
  double near_until = 0;  // whether it is near
  double free_until = 0;  // that it is separated
  // m²: the area the time step was last chosen for, times what stress stiffened it; negative: not yet
  double area_rated = -1;
  // most steps ask the above and no more of most pairs, a cache line; a body's loads ask the force and the point
  Vector<Dim> force = Vector<Dim>::Zero();  // N on the second body
  ContactGeometry<Dim> geometry;
  JointState<Dim> history;  // of all sub-contacts together where there are any
  Proof<Dim> proof;

  bool touching() const { return status == ContactStatus::touching; }
  bool unanswered() const { return status > ContactStatus::touching; }
};

}  // namespace voussoir
