// The blocks of a model with the areas by which they touch, their loads and the bolts that cross their joints: input of
// every verdict. Positions are those before any motion.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/key_blocks/rock_contacts.hpp"

namespace voussoir {

// a bolt at a joint that it crosses; its tension pulls the two blocks together
template <int Dim>
struct BoltCrossing {
  int bolt = 0;                             // Model::bolts
  int contact = 0;                          // RockContacts::list
  Vector<Dim> on_b = Vector<Dim>::Zero();   // unit: direction of its force on the contact's body_b; on body_a opposite
  Vector<Dim> place = Vector<Dim>::Zero();  // m, model coordinates
};

template <int Dim>
struct Assembly {
  Model<Dim> model;
  RockContacts<Dim> contacts;
  std::vector<Load<Dim>> stated;  // by body, about its centroid, N: weight and applied forces at the end of their stage
  std::vector<Load<Dim>> water;   // likewise, of the scene's waters
  WaterValues water_values;       // the numbers of these
  std::vector<BoltCrossing<Dim>> crossings;  // by contact
  // By body, since the bodies themselves are far from each other in memory.
  std::vector<char> free;       // it is judged: present, not fixed, and has parts
  std::vector<double> volumes;  // m³
};

// `bolts`: by Model::bolts, whether it is installed. No stress acts on the faces of blocks.
template <int Dim>
Assembly<Dim> make_assembly(Model<Dim> model, const WaterValues& water, const std::vector<bool>& bolts);

// a plane of a block's faces that lie on other rock: areas of one joint and direction
template <int Dim>
struct RockFace {
  Vector<Dim> normal;  // unit, into the block
  int joint = no_joint;
  int properties = 0;                          // Model::properties
  double area = 0;                             // m²
  double tan_friction = 0;                     // of a friction that does not depend on stress
  const JointProperties* rough = nullptr;      // otherwise Barton and Bandis' peak envelope, of the assembly's model
  double cohesion = 0;                         // N: of the areas of one stated joint
  Vector<Dim> centroid = Vector<Dim>::Zero();  // m, model coordinates

  void set_friction(const JointProperties& joint);
  double tan_friction_at(double normal_force) const;
  double friction_force(double normal_force) const { return normal_force * tan_friction_at(normal_force); }  // N
  double friction_slope(double normal_force) const;              // its derivative
  double friction_gain(double normal_force, double more) const;  // N, by a larger normal force
};

// the force of a bolt on a block
template <int Dim>
struct BlockBolt {
  int bolt = 0;                                 // Model::bolts
  Vector<Dim> direction = Vector<Dim>::Zero();  // unit
  Vector<Dim> place = Vector<Dim>::Zero();      // m, model coordinates
  double pretension = 0;                        // N
  double capacity = 0;                          // N: its yield; its pretension if it states none
};

// A block, or several that move as one.
template <int Dim>
struct Block {
  std::vector<int> bodies;  // ascending
  std::vector<RockFace<Dim>> faces;
  std::vector<Vector<Dim>> normals;  // of the faces
  std::vector<int> contacts;         // RockContacts::list
  std::vector<int> face_of_contact;  // of each of them, in `faces`
  std::vector<BlockBolt<Dim>> bolts;
  double contact_area = 0, surface = 0;        // m²: of the faces on other rock, and of all outer ones
  double volume = 0, weight = 0;               // m³, N
  Vector<Dim> centroid = Vector<Dim>::Zero();  // m, model coordinates
  Load<Dim> stated, water;                     // about the centroid

  bool enclosed() const;  // all of its surface lies on other rock
  bool fixed = false;
};

// Fills a block with these bodies; contacts with bodies that are gone count as free surface (`gone` by body; empty:
// none are). Memory of the block is used again.
template <int Dim>
void gather(const Assembly<Dim>& assembly, std::span<const int> bodies, const std::vector<char>& gone,
            Block<Dim>& block);

}  // namespace voussoir
