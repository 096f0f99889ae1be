#include "core/key_blocks/kinematics.hpp"

#include <cmath>
#include <numbers>

#include "core/geometry/half_space.hpp"
#include "core/key_blocks/direction_cone.hpp"

namespace voussoir {
namespace {

constexpr double right_angle = std::numbers::pi / 2;
constexpr double parallel_sine = 1e-12;  // below, two joints have no line
constexpr double level_sine = 1e-12;     // below, a line is horizontal

// rad, from 0 to π: between two directions of the compass
double apart(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * std::numbers::pi));
}

// rad: clockwise from north
double trend_of(const Vector<3>& v) {
  return std::atan2(v.x(), v.y());
}

double dip_of(const Vector<3>& normal) {
  return std::atan2(std::hypot(normal.x(), normal.y()), normal.z());
}

Vector<3> down_the_dip(const Vector<3>& normal) {
  const double dip = dip_of(normal), direction = trend_of(normal);
  return {std::cos(dip) * std::sin(direction), std::cos(dip) * std::cos(direction), -std::sin(dip)};
}

// Of two planes, downward; none if they are parallel. A horizontal line has no lower end: the one out of the face.
std::optional<Vector<3>> line_of(const Vector<3>& a, const Vector<3>& b, const Vector<3>& face) {
  Vector<3> line = a.cross(b);
  const double length = line.norm();
  if (length < parallel_sine) return {};
  line /= length;
  const bool turn = std::abs(line.z()) < level_sine ? face.dot(line) < 0 : line.z() > 0;
  return turn ? Vector<3>(-line) : line;
}

bool of_different_sets(const KinematicJoint& a, const KinematicJoint& b) {
  return a.set < 0 || a.set != b.set;
}

void count_joint(const KinematicRequest& request, const Vector<3>& normal, KinematicCounts& counts) {
  const auto& [face, friction, limits] = request;
  const double dip = dip_of(normal), direction = trend_of(normal), lateral = apart(direction, face.direction);
  const bool slides = dip > friction && upward_normal_3d(face.dip, face.direction).dot(down_the_dip(normal)) > 0;
  ++counts.joints;
  counts.plane_sliding += slides;
  counts.plane_sliding_within += slides && lateral <= limits.plane_sliding;
  if (apart(direction, face.direction + std::numbers::pi) <= limits.flexural_toppling) {
    counts.flexural_toppling += right_angle - dip + friction <= face.dip;
    counts.flexural_toppling_net +=
        face.dip > friction && upward_normal_3d(face.dip - friction, face.direction).dot(-normal) > 0;
  }
  const bool within = lateral <= limits.direct_toppling;
  counts.direct_bases[0] += within && friction < dip && dip <= face.dip;
  counts.direct_bases[1] += within && dip <= friction;
  counts.direct_bases[2] += !within && dip <= friction;
}

void count_pair(const KinematicRequest& request, const Vector<3>& line, bool of_sets, KinematicCounts& counts) {
  const auto& [face, friction, limits] = request;
  const double plunge = std::asin(std::min(1.0, -line.z()));
  const bool leaves = upward_normal_3d(face.dip, face.direction).dot(line) > 0, primary = leaves && plunge > friction,
             secondary = leaves && !primary && upward_normal_3d(friction, face.direction).dot(line) < 0;
  counts.wedge_primary += primary;
  counts.wedge_primary_of_sets += primary && of_sets;
  counts.wedge_secondary += secondary;
  counts.wedge_secondary_of_sets += secondary && of_sets;
  const bool within = apart(trend_of(line), face.direction + std::numbers::pi) <= limits.direct_toppling,
             steep = plunge >= right_angle - friction;
  counts.direct_lines[0] += within && !steep && plunge >= right_angle - face.dip;
  counts.direct_lines[1] += within && steep;
  counts.direct_lines[2] += !within && steep;
}

}  // namespace

KinematicCounts count_kinematic(const KinematicRequest& request, const std::vector<KinematicJoint>& joints) {
  const Vector<3> face = upward_normal_3d(request.face.dip, request.face.direction);
  KinematicCounts counts;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    count_joint(request, joints[i].normal, counts);
    for (std::size_t k = 0; k < i; ++k) {
      const bool of_sets = of_different_sets(joints[i], joints[k]);
      ++counts.pairs;
      counts.pairs_of_sets += of_sets;
      if (const std::optional<Vector<3>> line = line_of(joints[i].normal, joints[k].normal, face))
        count_pair(request, *line, of_sets, counts);
    }
  }
  return counts;
}

std::vector<PairVerdict> judge_pairs(const KinematicRequest& request, const std::vector<KinematicJoint>& joints) {
  const Vector<3> face = upward_normal_3d(request.face.dip, request.face.direction), down(0, 0, -1);
  std::vector<PairVerdict> verdicts;
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t k = i + 1; k < joints.size(); ++k) {
      const std::optional<Vector<3>> line = line_of(joints[i].normal, joints[k].normal, face);
      if (!line || face.dot(*line) <= 0) continue;
      const Projection<3> moved = project<3>({joints[i].normal, joints[k].normal}, down);
      PairVerdict pair{.first = static_cast<int>(i),
                       .second = static_cast<int>(k),
                       .line = *line,
                       .primary = -line->z() > std::sin(request.friction)};
      if (moved.loaded > 0 && face.dot(moved.motion) > 0) {
        double normal_force = 0;
        for (int f = 0; f < moved.loaded; ++f)
          normal_force += moved.forces[f];
        pair.motion = moved.loaded == 2 ? WedgeMotion::on_both : WedgeMotion::on_one;
        pair.direction = moved.motion.normalized();
        pair.factor = normal_force * std::tan(request.friction) / moved.motion.norm();
      }
      verdicts.push_back(pair);
    }
  return verdicts;
}

}  // namespace voussoir
