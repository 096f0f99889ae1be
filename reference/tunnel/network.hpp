// Rigid blocks in the plane on joint springs, with bolts and a lining, for small displacements: a linear network. The
// same blocks as the program's, given as plain numbers, but none of its method: one sparse system, no steps, no contact
// detection. x right, y up, turns counter-clockwise; forces per metre of thickness.
//
// Against a joint of the program that stays closed, elastic and bonded, divided into n cells a face (sub_contacts = n):
//   the same      normal stiffness: a cell of length l has the force kn l times the overlap at its middle, acting at
//                 its centre of pressure: a couple kn l³/12 per radian about the middle. A spring that has
//                 `spread` l²/12 has that couple, and the integrated face kn L³/12 whatever n is. With spread 0 two
//                 points a face are softer in bending, kn L³/16.
//                 shear: ks l times the slip, and no couple, since a turn moves points of a face along its normal only.
//   not the same  finite turns and slips, the share of a face that slips away or closes at corners with overlap,
//                 the turning of the forces of a stressed joint or a pretensioned bolt with the blocks: all of the
//                 order of displacement over block size. Friction, tension cut off: none here. And the path: shear that
//                 built up while faces came into contact stays in the program's joints, so that only increments from a
//                 settled state are comparable.
// Three bricks, partly on each other, settled and then pushed at the top: displacements and turns of the program and of
// this network with spread agree to 6e-5; without spread turns are a third too large.
#pragma once

#include <array>
#include <vector>

#include "reference/tunnel/polygons.hpp"

namespace voussoir::reference::network {

using Freedoms = std::array<double, 3>;  // x, y, turn: m and rad, or N and N m about the centroid (at a node: there)

// One rigid body of one or more convex parts. Held freedoms take `imposed`; the ground is a block with all three held.
struct Block {
  std::vector<Polygon> parts;
  std::array<bool, 3> held{};
  Freedoms imposed{};
  Freedoms load{};  // N and N m about the centroid
};

Point centroid(const Block& block);
double area(const Block& block);                                    // m²
void add_force(Block& block, const Point& at, const Point& force);  // N

// A cell of a joint. `normal` is unit, from the first block to the second.
struct Spring {
  int first = 0, second = 0;
  Point at, normal;
  double length = 0;            // m, of the face
  double normal_stiffness = 0;  // kn, Pa/m
  double shear_stiffness = 0;   // ks, Pa/m
  double spread = 0;            // m²: l²/12 for a cell with its integrated moment, 0 for a point
};

// Between anchors fixed in two blocks, along `axis`, unit, from the first to the second. Across it (a dowel) both
// blocks are pulled at the second anchor.
struct Bolt {
  int first = 0, second = 0;
  Point first_anchor, second_anchor, axis;
  double stiffness = 0;   // K, N/m
  double across = 0;      // N/m
  double pretension = 0;  // F0, N: f = K (extension - installed) + F0
  Point installed{};      // m, initial extension along the axis and slip across it
};

// A joint of the beams. Held and loaded as a block, about its position.
struct Node {
  Point at;
  std::array<bool, 3> held{};
  Freedoms imposed{};
  Freedoms load{};
};

// A node on a block's wall, in compression when the two approach. `normal` is unit, from the block to the node. A node
// may have several: at a corner of the outline one to each side, of half its length each.
struct Tie {
  int node = 0, block = 0;
  Point normal;
  double length = 0;            // m, tributary
  double normal_stiffness = 0;  // Pa/m
  double shear_stiffness = 0;   // Pa/m
  Point installed{};            // m, initial displacement of node against wall, along the normal and the normal turned
};

// Euler-Bernoulli beams from node to node, counter-clockwise as seen from inside: the inside is on the left.
struct Lining {
  std::vector<Node> nodes;
  bool closed = true;  // the last node joins the first
  double axial = 0;    // EA, N
  double bending = 0;  // EI, N m²
  std::vector<Tie> ties;
};

struct Network {
  std::vector<Block> blocks;
  std::vector<Spring> springs;
  std::vector<Bolt> bolts;
  Lining lining;  // no nodes: no lining
};

struct SpringForce {
  double normal = 0;  // N, compression positive
  double shear = 0;   // N, on the second block along the normal turned by 90° counter-clockwise
  double couple = 0;  // N m, on the second block, about the spring's place; of a spring with spread
};

struct BoltForce {
  double axial = 0;   // N, tension positive, pretension included
  double across = 0;  // N, on the second block along the axis turned by 90° counter-clockwise
};

// Thrust compression positive, moments sagging positive (tension on the inside), shear the slope of the moment along
// the beam.
struct BeamForce {
  double thrust = 0, shear = 0, start_moment = 0, end_moment = 0;  // N, N, N m, N m
};

struct Solution {
  std::vector<Freedoms> blocks;  // of the centroids
  std::vector<Freedoms> nodes;
  std::vector<SpringForce> springs;
  std::vector<BoltForce> bolts;
  std::vector<SpringForce> ties;  // normal positive in compression; "second" is the node
  std::vector<BeamForce> beams;   // from node i to i + 1
  double unbalanced = 0;          // largest residual force of a freedom, over the largest load or spring force on any
};

// Installs the supports when the blocks have moved by `before`, a solution of a network with these blocks: bolts have
// only their pretension, dowels and ties no force there. Displacements of nodes then count from the position of the
// wall at installation.
void install(Network& network, const Solution& before);

// Displacement of a block's point, m.
Point displacement(const Network& network, const Solution& solution, int block, const Point& at);

// Throws std::invalid_argument, naming the block, node, spring, bolt or beam, if numbers are out of range, if a block
// or node is loose (no springs hold it, alone or with its neighbours), or if springs leave it a mechanism.
Solution solve(const Network& network);

}  // namespace voussoir::reference::network
