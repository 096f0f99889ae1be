// The centroid of the overlap by clipping one polyhedron by the other's planes, which the analytic centre replaces
// (Boon 2013, section 4.7). Written for this benchmark and for speed; shares no code with the core.
#pragma once

#include <vector>

#include "core/geometry/polytope.hpp"

namespace voussoir::benchmarks {

struct Overlap {
  double volume = 0;                       // m³; 0 if nothing is left
  Vector<3> centroid = Vector<3>::Zero();  // m
};

// Keeps its buffers, so that a query allocates nothing.
class Clipper {
 public:
  // the part clipped by the planes, in the part's frame
  Overlap clip(const Polytope<3>& part, const HalfSpaces<3>& planes);

 private:
  using Loop = std::vector<int>;  // vertices of a face, counter-clockwise from outside
  struct Cut {
    int kept, lost, vertex;  // the edge cut, and the vertex there
  };

  bool cut_by(const HalfSpace<3>& plane);
  bool hit(const Loop& loop) const;
  void cut_loop(const Loop& loop, Loop& left);
  int vertex_on(int kept, int lost);
  void close_section();
  Overlap measure() const;

  std::vector<Vector<3>> vertices_;
  std::vector<int> alive_;         // vertices of the present faces
  std::vector<double> distances_;  // of these to the present plane, negative on the kept side
  std::vector<Loop> loops_, next_loops_;
  std::size_t loop_count_ = 0, next_count_ = 0;
  std::vector<Cut> cuts_;
  std::vector<std::pair<int, int>> section_edges_;  // from, to
};

}  // namespace voussoir::benchmarks
