// Rock bolts as springs between blocks (Boon 2013, Eqs 5.1 and 5.2; cases/support/README.md): one at every joint that
// a bolt crossed when it was installed, or, end-anchored, one from plate to anchor. Its anchors are fixed in the two
// blocks. With d from the first to the second, s the sign of d on the bolt's axis and l0 the length at installation
//
//   f = K (s|d| - l0 - plastic extension) + F0   along s d/|d|,       anchors apart
//   f = K (a·d - plastic extension) + F0         along the axis a,    anchors both at the joint
//   q = ks (d - (a·d) a - plastic slip)          across the axis,     a dowel
//
// a turns with the first block; both forces act on both blocks at the second anchor, so that they have the potential
// f²/2K + q²/2ks, which depends only on the position of the second anchor in the first block. At a joint
// that a grouted bar crosses f is the bar's (grouted_bolt.hpp).
#pragma once

#include <optional>
#include <string>

#include "core/geometry/types.hpp"
#include "core/support/grout.hpp"

namespace voussoir {

enum class BoltKind { springs, end_anchored, grouted };
enum class BoltAnchors { offset, at_joint, midway };

// Of all bolts of one name. In the plane, stiffness and forces of a Model are per metre of thickness: a bolt's own over
// the spacing.
struct BoltProperties {
  std::string name;
  BoltKind kind = BoltKind::springs;
  BoltAnchors anchors = BoltAnchors::offset;  // not of end-anchored bolts
  double diameter = 0.028;                    // m: offset anchors are 1.2 of it from the joint
  double stiffness = 0;                       // K, N/m, at each crossed joint
  double axial_stiffness = 0;                 // EA, N, of an end-anchored or grouted bolt
  double pretension = 0;                      // F0, N
  std::optional<double> yield{};              // N, tension and compression
  std::optional<double> rupture_extension{};  // m, plastic: beyond it the spring breaks
  bool tension_only = false;                  // a cable
  double dowel_stiffness = 0;                 // ks, N/m
  std::optional<double> dowel_strength{};     // N
  double spacing = 1;                         // m, out of the plane
  // of grouted bolts
  double bond_stiffness = 0;              // k, N/m²
  std::optional<double> bond_strength{};  // S, N/m
  Plate plate = Plate::none;
  double plate_stiffness = 0;            // N/m
  double free_length = 0;                // m, from the plate, without grout
  std::optional<double> node_spacing{};  // m, at most
};

// λ = √(EA/k), m, over which the bar of a grouted bolt builds up its force
double transfer_length(const BoltProperties& properties);

// m, of the nodes of a grouted bolt of this length: as stated, or λ/5, by which its stiffness over a joint is 0.5 % low
// (h²/8λ²), but no less than a 200th of the bolt.
double node_spacing(const BoltProperties& properties, double length);

// from collar to toe
template <int Dim>
struct Bolt {
  int properties = 0;                                                   // Model::bolt_properties
  int number = 1;                                                       // among those of its name
  Vector<Dim> collar = Vector<Dim>::Zero(), toe = Vector<Dim>::Zero();  // m, model coordinates
};

template <int Dim>
struct BoltSpring {
  int bolt = 0;                                                              // Model::bolts
  int number = 1;                                                            // along the bolt, from its collar
  int body_a = 0, body_b = 0;                                                // a is nearer to the collar
  Vector<Dim> place_a = Vector<Dim>::Zero(), place_b = Vector<Dim>::Zero();  // of the anchors, body frames, m
  Vector<Dim> axis = Vector<Dim>::Zero();                                    // unit, towards the toe, frame of body a
  Vector<Dim> begin = Vector<Dim>::Zero(), end = Vector<Dim>::Zero();  // of the length of bolt that it represents,
                                                                       // frames of a and b, m: drawn, no force
  double length = 0;                                                   // l0, m; 0: both anchors at the joint
  double stiffness = 0;                                                // K, N/m
  double plastic = 0;                                                  // m, plastic extension
  Vector<Dim> slip = Vector<Dim>::Zero();                              // m, plastic slip of the dowel, frame of a
  bool broken = false;
  double extension = 0;                     // m, since installation
  double force = 0;                         // f, N, tension positive
  Vector<Dim> shear = Vector<Dim>::Zero();  // q, N, frame of body a
};

template <int Dim>
struct BoltAnswer {
  Vector<Dim> on_second = Vector<Dim>::Zero();  // N at the second anchor, frame of body a; on body a the opposite
  double elastic = 0;                           // J, stored now
  double lost = 0;                              // J, to yield and rupture, in this step
};

// The forces of a spring at a position of its second anchor relative to the first, frame of body a, m; updates its
// history.
template <int Dim>
BoltAnswer<Dim> bolt_answer(const BoltProperties& properties, const Vector<Dim>& apart, BoltSpring<Dim>& spring);

// Minus the derivative of `on_second` with `apart`, N/m, in the spring's state after that.
template <int Dim>
Matrix<Dim> bolt_stiffness(const BoltProperties& properties, const Vector<Dim>& apart, const BoltSpring<Dim>& spring);

// upper bound of the stiffness, for the time step, N/m
template <int Dim>
double stiffest(const BoltProperties& properties, const BoltSpring<Dim>& spring);

}  // namespace voussoir
