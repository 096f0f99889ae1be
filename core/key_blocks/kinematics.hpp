// Kinematic analysis of a rock face: which joints and which lines of intersection fall into the zones of a stereonet
// (Markland 1972; Goodman & Bray 1976; Goodman 1989), and what block theory says of every pair of joints.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/geometry/types.hpp"
#include "text/angle.hpp"

namespace voussoir {

struct FaceDirection {
  double dip = 0, direction = 0;  // rad; an overhanging face dips more than π/2
};

// rad: largest differences to the dip direction of the face, or to the opposite one
struct LateralLimits {
  double plane_sliding = 20 * degree, flexural_toppling = 30 * degree, direct_toppling = 20 * degree;
};

struct KinematicRequest {
  FaceDirection face;
  double friction = 0;  // rad, of every joint
  LateralLimits limits{};
};

struct KinematicJoint {
  Vector<3> normal;  // upward
  int set = -1;      // pairs of joints of the same set are counted apart; -1: a set of its own
};

// Vectors instead of angles: v, down the dip or down the line, leaves the face if n·v > 0, n the normal of the face out
// of the rock. With φ friction, ψ and β dip and dip direction of the face:
struct KinematicCounts {
  long joints = 0, pairs = 0, pairs_of_sets = 0;  // of_sets: of joints of different sets
  // leaves the face, dip > φ; and within the lateral limit
  long plane_sliding = 0, plane_sliding_within = 0;
  // the line leaves the face and plunges more than φ; less, but more steeply than the plane φ/β in its trend
  long wedge_primary = 0, wedge_primary_of_sets = 0, wedge_secondary = 0, wedge_secondary_of_sets = 0;
  // 90° - dip + φ <= ψ (Goodman); the pole above the plane (ψ - φ)/β (the net's great circle)
  long flexural_toppling = 0, flexural_toppling_net = 0;
  // Lines into the rock within the limit, from 90° - ψ to 90° - φ, and steeper; steeper outside the limit.
  std::array<long, 3> direct_lines{};
  // Base planes within the limit, φ < dip <= ψ (they slide as well), and flatter; flatter outside the limit.
  std::array<long, 3> direct_bases{};
};

// what block theory says of the block above both planes, under weight and friction alone
enum class WedgeMotion {
  buried,  // the line leaves the face, but the block's motion does not: it lies under one of the planes
  on_both,
  on_one
};

struct PairVerdict {
  int first = 0, second = 0;                 // joints
  Vector<3> line = Vector<3>::Zero();        // unit, downward; it leaves the face
  bool primary = false;                      // its zone: it plunges more than φ
  WedgeMotion motion = WedgeMotion::buried;  // of the block
  Vector<3> direction = Vector<3>::Zero();   // unit, of its motion
  std::optional<double> factor{};            // none: buried
};

KinematicCounts count_kinematic(const KinematicRequest& request, const std::vector<KinematicJoint>& joints);

// Of every pair whose line leaves the face, by (first, second).
std::vector<PairVerdict> judge_pairs(const KinematicRequest& request, const std::vector<KinematicJoint>& joints);

}  // namespace voussoir
