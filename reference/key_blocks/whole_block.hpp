#pragma once

#include <array>
#include <vector>

// Block theory of one block in whole numbers, by enumeration of every candidate: slow, plain, without rounding.
// Goodman & Shi (1985), Block Theory and Its Application to Rock Engineering.
namespace voussoir::reference {

using Whole3 = std::array<long long, 3>;

// components of at most 1000, so that no product overflows
struct WholeBlock {
  std::vector<Whole3> normals;  // into the block, of the faces by which it lies on other rock; any length but 0
  Whole3 load{};                // resultant of its active forces
};

// Whether some direction closes no face. A cone that holds no line has extreme directions, each in two of its planes.
bool is_removable(const WholeBlock& block);

// a motion without friction: direction of any length, and its loaded faces
struct WholeMotion {
  Whole3 direction{};
  std::array<int, 2> faces{-1, -1};
  int loaded = 0;
};

// Every candidate that closes no face and whose loaded faces all press: the load itself, its projections on faces, the
// lines of pairs of faces. Throws std::invalid_argument for a zero normal or numbers out of range.
std::vector<WholeMotion> find_motions(const WholeBlock& block);

// the lines of pairs of faces that close no face and go with the load, whether or not both faces press
std::vector<Whole3> open_lines(const WholeBlock& block);

}  // namespace voussoir::reference
