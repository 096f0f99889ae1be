// Where bodies are and how they move. Positions are reference + displacement, so that small steps far from the origin
// are not lost.
#pragma once

#include <vector>

#include "core/geometry/types.hpp"
#include "core/load/water.hpp"
#include "core/model/model.hpp"

namespace voussoir {

template <int Dim>
struct Motion {
  Vector<Dim> displacement = Vector<Dim>::Zero();  // m
  Rotation<Dim> rotation;                          // of the body's frame
  Vector<Dim> velocity = Vector<Dim>::Zero();      // m/s, half a step behind the displacement
  Spin<Dim> angular_momentum = Spin<Dim>::Zero();  // principal axes, kg m²/s, half a step behind
};

// the placement of a body
template <int Dim>
struct Placement {
  Vector<Dim> displacement;  // m
  Rotation<Dim> rotation;
};

// position and motion of a body, as its contacts need them; rebuilt every step
template <int Dim>
struct CachedPose {
  Vector<Dim> reference, displacement;  // m
  Matrix<Dim> axes;                     // its frame in world axes
  Vector<Dim> velocity;                 // m/s
  Spin<Dim> spin;                       // rad/s, world axes
  double inverse_mass;                  // 1/kg; 0: fixed, and no image of a free body
};

template <int Dim>
struct BodiesState {
  std::vector<Motion<Dim>> motions;        // by body
  std::vector<CachedPose<Dim>> poses;      // by body; rebuilt every step
  std::vector<Placement<Dim>> listed_at;   // by body: when the candidates were last listed
  std::vector<Placement<Dim>> counted_at;  // by body: up to which its path is counted
  std::vector<double> path_bounds;         // m, by body: bound of the path of any of its points
  std::vector<char> left_behind;           // by body: failed in a search that its failure does not end, and excluded
                                           // from the check of equilibrium; empty: none
};

// The second body's centroid seen from the first's, m: reference positions first, so that small displacements are not
// lost.
template <int Dim>
Vector<Dim> between(const CachedPose<Dim>& a, const CachedPose<Dim>& b);

// the pose of the body, as loads need it
template <int Dim>
Standing<Dim> standing(const CachedPose<Dim>& pose);

// Where the bodies stand now, m and orientations; the list keeps its memory.
template <int Dim>
void note_placements(const BodiesState<Dim>& bodies, std::vector<Placement<Dim>>& placements);

// m, by body
template <int Dim>
std::vector<Vector<Dim>> displacements(const BodiesState<Dim>& bodies);

// BodiesState::poses from the motions
template <int Dim>
void cache_poses(const Model<Dim>& model, int threads, BodiesState<Dim>& bodies);

// sets all velocities to zero
template <int Dim>
void stop(std::vector<Motion<Dim>>& motions);

// angular velocity in world axes, rad/s
template <int Dim>
Spin<Dim> angular_velocity(const Body<Dim>& body, const Motion<Dim>& motion);

// angular momentum in principal axes of a body that spins at `velocity` (world axes)
template <int Dim>
Spin<Dim> angular_momentum(const Body<Dim>& body, const Rotation<Dim>& rotation, const Spin<Dim>& velocity);

}  // namespace voussoir
