// Blocks of a network from lines, and the faces between them: corner lists in, springs, loads, bolts and ties out.
#pragma once

#include <vector>

#include "reference/tunnel/network.hpp"

namespace voussoir::reference::network {

// normal·x = offset; the normal need not be unit
struct Line {
  Point normal;
  double offset = 0;
};

// The pieces of a convex polygon between lines that all run through it. A piece that would be thinner than `thinnest`
// (m) is not cut off.
std::vector<Polygon> cut(const Polygon& whole, const std::vector<Line>& lines, double thinnest);

// Persistent sets of equal spacing over a circle of radius `reach` about the origin: lines with normals at `angles`
// (rad), the k-th line of set i at offset (k + shifts[i]) spacing.
std::vector<Line> persistent_sets(const std::vector<double>& angles, const std::vector<double>& shifts, double spacing,
                                  double reach);

// Every piece a block.
inline std::vector<Block> one_each(const std::vector<Polygon>& pieces) {
  std::vector<Block> blocks;
  for (const Polygon& piece : pieces)
    blocks.push_back({{piece}});
  return blocks;
}

// Every piece a block; the part inside the convex outline is removed. A piece across the outline becomes a block of
// convex parts, or several if it is divided.
std::vector<Block> take_out(const std::vector<Polygon>& pieces, const Polygon& outline, double thinnest);

// A segment along which two blocks touch. `normal` is unit, from the first to the second; `start` and `end` run
// counter-clockwise about the first.
struct Face {
  int first = 0, second = 0;
  Point start, end, normal;
};

// All faces between different blocks that are not both wholly held, by (first, second), first < second. Edges touch if
// they run against each other, not further than `tolerance` (m) apart, over more than that length.
std::vector<Face> faces(const std::vector<Block>& blocks, double tolerance);

// `cells` equal cells a face, a spring at the middle of each. Spread l²/12 as the program's cells have it, or 0.
std::vector<Spring> springs(const std::vector<Face>& faces, int cells, double normal_stiffness, double shear_stiffness,
                            bool with_spread = true);

// The faces of blocks on an outline, counter-clockwise about it from its first corner. `first` is the block, `normal`
// points into the opening, `start` to `end` runs clockwise about the opening as it runs counter-clockwise about the
// block; second is -1.
std::vector<Face> wall(const std::vector<Block>& blocks, const Polygon& outline, double tolerance);

// Stress in rock, compression positive: vertical unit_weight (surface - y), horizontal k0 times that.
struct InSitu {
  double surface = 0;      // m
  double unit_weight = 0;  // N/m³
  double k0 = 1;
  double uniform = 0;  // Pa, added to both
};

// Loads the blocks by the reversed forces of the removed rock on them, times `share`: towards the opening under
// compression. Exact in force and moment.
void relieve(std::vector<Block>& blocks, const std::vector<Face>& wall, const InSitu& stress, double share = 1);

// A spring at each face that the line from collar to toe crosses, its anchors `offset` (m) to both sides, but not
// further than the middle of the bolt's segment in that block; infinite: midway. The first block is nearer to the
// collar.
std::vector<Bolt> bolts_across(const std::vector<Face>& faces, const Point& collar, const Point& toe, double stiffness,
                               double offset, double across = 0, double pretension = 0);

// Ties nodes on the wall. Each half of a node's two beams is on the wall's face on that side of the node: one tie if
// both halves are on one block in one direction, else two. Throws std::invalid_argument naming the node that is not on
// the wall.
void tie_to_wall(Lining& lining, const std::vector<Face>& wall, double normal_stiffness, double shear_stiffness,
                 double tolerance);

// Displacement of the wall towards `centre`: at its intersection with the ray at `angle` (rad, from x
// counter-clockwise), and as mean over the wall's length. m.
double convergence_at(const Network& network, const Solution& solution, const std::vector<Face>& wall,
                      const Point& centre, double angle);
double mean_convergence(const Network& network, const Solution& solution, const std::vector<Face>& wall,
                        const Point& centre);

}  // namespace voussoir::reference::network
