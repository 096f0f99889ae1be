// The seeded pairs of the contact benchmark, for every method.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/shapes.hpp"
#include "core/contact/narrow_phase.hpp"
#include "core/contact/pair_geometry.hpp"

namespace voussoir::benchmarks {

enum class Shape { tetrahedron, cube, octahedron, dodecahedron, icosahedron, block, slab_20, slab_100 };
inline constexpr int shape_count = 8;

// lengths in units of the pair: 1 for the compact shapes, the thickness for slabs
enum class PairState {
  separated,  // 0.02 to 0.30 beyond touching along the line of centres, boxes still meet
  near,       // LP optimum +0.5e-4: a gap of about 1e-4
  touch,      // LP optimum -0.5e-4: mostly a vertex in a face, or edge on edge
  face,       // face on face, tilted by 1e-5, overlap 1e-4
  deep,       // LP optimum -0.5e-2
  solid,      // no pair: a single polyhedron is the region whose centre is computed (Boon 2013, Fig. 4.10)
  plane       // as touch, but prisms of thickness 1 side by side that move in the plane only: squares for the cube,
              // joint-cut polygons for the block
};
inline constexpr int pair_state_count = 7;

// shapes of a state: a single slab is a cube, and the plane has two
bool occurs(Shape shape, PairState state);

// m: unit of lengths
double unit_of(Shape shape);

const char* name_of(Shape shape);
const char* name_of(PairState state);

struct Workload {
  Shape shape;
  PairState state;
  std::shared_ptr<const std::vector<Polytope<3>>> parts;  // the pairs point to them; each with its centroid at 0
  std::vector<Pair<3>> pairs;                             // the poses that are timed
  // poses of the step before: the second body is displaced by up to 1e-6 (1e-5) units and rotated so that its rim moves
  // by as much: 1 % (10
  // %) of an overlap of 1e-4
  std::array<std::vector<Pair<3>>, 2> previous;

  bool touching() const { return state != PairState::separated && state != PairState::near; }
};

inline constexpr std::size_t pairs_per_workload = 1000;
inline constexpr std::uint64_t workload_seed = 20130;

// Made at the first call and kept. The same numbers on every platform.
const Workload& workload(Shape shape, PairState state);

// so many pairs of another seed; with workload_seed the first of workload()
Workload seeded_workload(Shape shape, PairState state, std::uint64_t seed, std::size_t pairs);

// The same pairs of a workload of state `plane`, their parts as polygons.
struct PlaneWorkload {
  std::vector<Polytope<2>> parts;
  std::vector<Pair<2>> pairs;
  std::array<std::vector<Pair<2>>, 2> previous;
};
std::shared_ptr<const PlaneWorkload> in_the_plane(const Workload& work);

// planes of both parts and vertices of one, means over the pairs
double mean_planes(const Workload& work);
double mean_vertices(const Workload& work);

// the box of half edge `half` around the origin, as a part
Polytope<3> box(const Vector<3>& half);

}  // namespace voussoir::benchmarks
