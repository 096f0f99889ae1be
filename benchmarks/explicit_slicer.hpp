// Slicing with an explicit face-edge-vertex structure (Warburton 1985; Heliot 1988), the method that the linear program
// replaces: a reference for speed, for persistent joints only. Shares no code with the core's slicing; its blocks
// accumulate the rounding of every cut, and near-degenerate joints are not supported.
#pragma once

#include <vector>

#include "core/geometry/half_space.hpp"

namespace voussoir::benchmarks {

struct ExplicitBlock {
  std::vector<Vector<3>> vertices;
  std::vector<std::vector<int>> faces;  // loops of vertices, counter-clockwise from outside
};

ExplicitBlock explicit_box(double half);

// all blocks between the planes
std::vector<ExplicitBlock> explicit_slice(const ExplicitBlock& domain, const HalfSpaces<3>& planes);

double explicit_volume(const ExplicitBlock& block);

}  // namespace voussoir::benchmarks
