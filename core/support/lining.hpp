// Linings of the plane (Boon 2013, section 5.3.5; cases/support/README.md): nodes on the outline of an opening, beams
// between neighbours (beam.hpp) and, between nodes and rock, an interface with the laws of a joint. Per metre out of
// the plane. Nodes follow each other counter-clockwise about the opening.
//
// A node is in its unloaded place when the lining is installed, at any earlier deformation of the rock: the lining is
// cast against the rock in its position at that time. So each side of the outline is a line fixed in every block that
// has a face there: x0 and the normal m, into the rock, in the block's frame, at that time. With y the node seen from
// that block,
//
//   closure u = m·(y - x0),   slip along t (m turned to the left),
//
// and stress = the joint's law, times the length of outline that the node represents. Blocks whose lines were flush
// when it was cast stay flush as long as they do not move against each other: a node that slides from one to the next
// meets no step. Without a bond the interface does not pull.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/joint_laws/joint_state.hpp"
#include "core/support/beam.hpp"

namespace voussoir {

struct LiningProperties {
  std::string name;
  double thickness = 0;                          // m
  double young_modulus = 0;                      // Pa, E/(1-ν²) for plane strain
  double density = 2500;                         // kg/m³
  std::optional<double> bending_stiffness{};     // N m² per m; without it E t³/12
  std::optional<double> compressive_strength{};  // Pa, and
  std::optional<double> tensile_strength{};      // Pa: of an elastic section

  double axial() const { return young_modulus * thickness; }
  double bending() const { return bending_stiffness.value_or(young_modulus * thickness * thickness * thickness / 12); }
};

// a straight side of the outline
struct LiningSide {
  Vector<2> corner = Vector<2>::Zero();  // m, model coordinates: its begin, counter-clockwise
  Vector<2> normal = Vector<2>::Zero();  // unit, into the rock
  double length = 0;                     // m

  Vector<2> along() const;
};

// a node, and the two halves of outline that it represents: before and after it
struct LiningNode {
  Vector<2> place = Vector<2>::Zero();  // m, model coordinates
  std::array<int, 2> side{};            // of each half
  std::array<double, 2> half_length{};  // m; 0 beyond an end
  double mass = 0, inertia = 0;         // kg, kg m²: ρ t l and m (l² + t²)/12
  double square_frequency = 0;          // 1/s²: bound for the stiffest mode of its beams
};

struct Lining {
  LiningProperties properties;
  int interface_properties = 0;  // Model::properties
  bool closed = true;            // a ring: its last node has a beam to the first
  std::vector<LiningSide> sides;
  std::vector<LiningNode> nodes;
  int first_body = -1;  // once it is installed its nodes are the bodies from this one on, without parts

  int beams() const { return static_cast<int>(nodes.size()) - (closed ? 0 : 1); }
  int next(int node) const { return (node + 1) % static_cast<int>(nodes.size()); }
  Beam beam(int k) const;
};

// A lining on the sides of a convex outline, all of them in order. `turns` are the directions of the nodes from a point
// inside, rad, ascending within one turn; an open one ends at its first and last node. `interface_properties` is left
// to the caller. Throws std::invalid_argument if two nodes fall in one place.
Lining make_lining(const LiningProperties& properties, std::vector<LiningSide> sides, const Vector<2>& centre,
                   const std::vector<double>& turns, bool closed);

// the node next to a direction from the middle of the outline's corners, rad
int nearest_node(const Lining& lining, double turn);

// A face of rock that a lining was cast against.
struct LiningRock {
  int side = 0;  // Lining::sides
  int body = 0;
  Vector<2> corner = Vector<2>::Zero();  // m, begin of the side, body frame
  Vector<2> normal = Vector<2>::Zero();  // body frame, into the rock
  double from = 0, to = 0;               // m, along the side: the block's face
};

// The history of the interface at half a node, and its forces.
struct LiningContact {
  int rock = -1;  // LiningState::rock; -1: no rock is opposite
  Bond bond = Bond::lost;
  double closure = 0;          // m: u
  double place = 0;            // m, of the node along the side
  double shear = 0;            // N on the node, along t
  double plastic_slip = 0;     // m, accumulated
  double bond_slip = 0;        // m, as JointState's
  double shear_stiffness = 0;  // Pa/m, as JointState's
  double normal = 0;           // N on the node, out of the rock: compression positive
  double dashpot = 0;          // N, of it
};

// the data of an installed lining from step to step; its beams have no history
struct LiningState {
  int lining = 0;  // Model::linings
  std::vector<LiningRock> rock;
  std::vector<LiningContact> contacts;  // two for each node: before it, after it
};

// the position of half a node relative to its rock
struct LiningMotion {
  double closure = 0, place = 0;  // m, now
  double seconds = 0;             // of the step that led here
};

struct LiningAnswer {
  double elastic = 0;   // J, stored now
  double friction = 0;  // J, lost to slip in this step, or with a bond or a closure that ends
  double dashpots = 0;  // J, lost to damping in this step
};

// The present strength and damping of an interface's joint.
struct LiningJoint {
  const JointProperties& properties;
  double friction;             // rad
  double strength_factor = 1;  // divides cohesion
  double dashpot = 0;          // N s/m
};

// The forces at a motion; updates the history. `length` of outline in m.
LiningAnswer interface_answer(const LiningJoint& joint, double length, const LiningMotion& motion,
                              LiningContact& contact);

// the sum of the interfaces' forces, for the measure of equilibrium
struct InterfaceSum {
  double forces = 0;  // N
  long long touching = 0;
};
InterfaceSum interface_sum(const std::vector<LiningState>& linings);

// section forces at an end of a beam
struct SectionForces {
  double thrust = 0;  // N, compression positive
  double shear = 0;   // N
  double moment = 0;  // N m, sagging positive: tension on the side of the opening
};

// at the first and the second end of a beam
std::array<SectionForces, 2> section_forces(const BeamForces& forces);

// the same at the nodes, means of those of their beams; `beams` in the order of Lining::beam
std::vector<SectionForces> forces_at_nodes(const Lining& lining, const std::vector<BeamForces>& beams);

// Moments without the ripple that an even pressure causes on a polygon of straight sides (Boon 2013, appendix I): a
// parabola through the moments of each side gives its pressure, q = -M''; the pressures act on a ring of the outline's
// mean radius, and their resultant is balanced by shear. With q = Σ q_n cos(nθ - f_n), n up to half the
// number of sides, M = a² Σ_{n >= 2} q_n cos(nθ - f_n)/(n² - 1). None for a lining that is no ring, has fewer than five
// sides or one of less than three nodes. The shear of the rock along the
// lining is left out except for the part that balances the pressures: under uneven pressure, which that shear helps to
// support, the smoothed moments may be larger than those of the beams.
std::vector<double> smoothed_moments(const Lining& lining, const std::vector<SectionForces>& at_nodes);

// Utilisation of a rectangular, uncracked section, the largest fibre stress over its strength: in moment and thrust the
// envelope is the polygon N/t + 6|M|/t² <= compressive, 6|M|/t² - N/t <= tensile strength. Nothing if no strength is
// stated.
std::optional<double> use_of(const LiningProperties& properties, const SectionForces& forces);

}  // namespace voussoir
