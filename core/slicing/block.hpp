// From a list of planes to a checked convex part: bounded, solid, without redundant planes.
#pragma once

#include <vector>

#include "core/geometry/polytope.hpp"
#include "core/solvers/feasibility.hpp"

namespace voussoir {

enum class BlockStatus {
  ok,
  open,      // the planes do not close a region
  empty,     // no point satisfies all of them with room to spare: at most 1e-10 of the coordinates remains
  flat,      // thinner than 1e-8 of its extent: its coordinates' rounding would be seen in its volume
  far,       // so far from the origin that coordinates round by more than 1e-6 of its size
  bad_plane  // a zero or non-finite normal, or a non-finite offset
};

template <int Dim>
struct BlockResult {
  BlockStatus status = BlockStatus::ok;
  int plane = -1;  // the first offending plane of the input (bad_plane)
  Polytope<Dim> part;
};

// Normals are normalised; of planes that coincide the last one, with its joint, is kept (Boon 2013, Eq. 3.8, keeps
// both), and a plane that would cut off less than 1e-10 of the inscribed radius is dropped. Faces
// come in an order of their own, so that a part has the same bits for any order of its planes (except which of
// coincident planes names the joint). Vertices lie within some 64 roundings of the coordinates of the planes, measured
// across them; volume, centroid and inertia follow from that. `joints` names the joint of each plane, or no_joint.
// Coordinates as given: the caller keeps the origin near the block.
template <int Dim>
BlockResult<Dim> make_block(const HalfSpaces<Dim>& planes, const std::vector<int>& joints);

// A part that is still being cut: the data that decide the next cut, without those that only the finished part needs.
template <int Dim>
struct Draft {
  HalfSpaces<Dim> faces;              // unit normals, none redundant
  std::vector<int> joints;            // as in Polytope
  std::vector<Vector<Dim>> vertices;  // m
  FeasibilityResult<Dim> ball;        // the largest inscribed one; its basis are faces of this draft, or negative
  double extent = 0;                  // largest distance of a vertex from the ball's centre, m

  double inscribed_radius() const { return -ball.value; }
};

template <int Dim>
Draft<Dim> make_draft(const Polytope<Dim>& part);

// The draft's part below a plane of unit normal. Refused as in make_block, and as flat from twice its thickness on, so
// that a draft never fails to be finished.
template <int Dim>
BlockStatus cut_draft(const Draft<Dim>& whole, const HalfSpace<Dim>& plane, int joint, Draft<Dim>& below);

// the same bits as make_block with the draft's faces
template <int Dim>
BlockResult<Dim> finish(Draft<Dim> draft);

// The half-spaces of the convex hull of points. 2-D and 3-D; coplanar points share one plane. Fewer than Dim+1 points
// or points without volume give an empty list. `hidden` counts the points that are no vertices of the hull.
template <int Dim>
HalfSpaces<Dim> hull_planes(const std::vector<Vector<Dim>>& points, int* hidden = nullptr);

}  // namespace voussoir
