#include "reference/key_blocks/slope_wedge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

using Eigen::Vector3d;

constexpr Require require{"slope wedge: "};
constexpr double rounding = 1e-9;  // of its size

Vector3d up(const PlaneAngles& plane) {
  return {std::sin(plane.dip) * std::sin(plane.direction), std::sin(plane.dip) * std::cos(plane.direction),
          std::cos(plane.dip)};
}
Vector3 to_array(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

// along the line of two planes, of unit rise
Vector3d rising_line(const Vector3d& m, const Vector3d& n) {
  const Vector3d line = m.cross(n);
  require(std::abs(line.z()) > rounding, "a line of two planes is level");
  return line / line.z();
}

struct Bound {
  Vector3d outward;
  double offset;
};

std::vector<Vector3d> corners_of(const std::vector<Bound>& bounds, double size) {
  std::vector<Vector3d> corners;
  const int count = static_cast<int>(bounds.size());
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        Eigen::Matrix3d planes;
        planes << bounds[i].outward.transpose(), bounds[j].outward.transpose(), bounds[k].outward.transpose();
        if (std::abs(planes.determinant()) < rounding) continue;
        const Vector3d corner =
            planes.partialPivLu().solve(Vector3d(bounds[i].offset, bounds[j].offset, bounds[k].offset));
        if (std::all_of(bounds.begin(), bounds.end(),
                        [&](const Bound& b) { return b.outward.dot(corner) <= b.offset + rounding * size; }) &&
            std::none_of(corners.begin(), corners.end(),
                         [&](const Vector3d& c) { return (c - corner).norm() <= rounding * size; }))
          corners.push_back(corner);
      }
  return corners;
}

// area of the corners on a plane, sorted by their angle about the mean
double face_area(const Bound& bound, const std::vector<Vector3d>& corners, double size) {
  std::vector<Vector3d> on;
  for (const Vector3d& corner : corners)
    if (std::abs(bound.outward.dot(corner) - bound.offset) <= 10 * rounding * size) on.push_back(corner);
  if (on.size() < 3) return 0;
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& corner : on)
    mean += corner / static_cast<double>(on.size());
  const Vector3d first = (on[0] - mean).normalized(), second = bound.outward.cross(first);
  std::sort(on.begin(), on.end(), [&](const Vector3d& p, const Vector3d& q) {
    return std::atan2((p - mean).dot(second), (p - mean).dot(first)) <
           std::atan2((q - mean).dot(second), (q - mean).dot(first));
  });
  double area = 0;
  for (std::size_t k = 0; k < on.size(); ++k)
    area += 0.5 * (on[k] - mean).cross(on[(k + 1) % on.size()] - mean).norm();
  return area;
}

}  // namespace

SlopeWedgeSolid solid_of(const SlopeWedge& wedge) {
  require(positive(wedge.crest_height), "the crest must be above the toe");
  const Vector3d a = up(wedge.a), b = up(wedge.b), face = up(wedge.face), upper = up(wedge.upper);
  const Vector3d crest = wedge.crest_height * rising_line(a, face);
  std::vector<Bound> bounds{{-a, 0}, {-b, 0}, {face, 0}, {upper, upper.dot(crest)}};
  SlopeWedgeSolid solid;
  solid.crest = to_array(crest);
  if (wedge.crack) {
    Vector3d trace = a.cross(upper).normalized();  // back from the face
    if (trace.dot(face) > 0) trace = -trace;
    const Vector3d point = crest + wedge.crack_distance * trace, crack = up(*wedge.crack);
    bounds.push_back({-crack, -crack.dot(point)});
    solid.crack_point = to_array(point);
  }
  const double size = wedge.crest_height;
  const std::vector<Vector3d> corners = corners_of(bounds, size);
  require(corners.size() >= 4, "its planes enclose no wedge");
  Vector3d inside = Vector3d::Zero();
  for (const Vector3d& corner : corners)
    inside += corner / static_cast<double>(corners.size());
  std::vector<double> areas;
  for (const Bound& bound : bounds) {
    areas.push_back(face_area(bound, corners, size));
    solid.volume += areas.back() * (bound.offset - bound.outward.dot(inside)) / 3;
  }
  solid.area_a = areas[0];
  solid.area_b = areas[1];
  const Vector3d line = rising_line(a, b);
  solid.line_height = upper.dot(crest) / upper.dot(line);
  if (wedge.crack) {
    solid.area_crack = areas[4];
    double lowest = wedge.crest_height;
    for (const Vector3d& corner : corners)
      if (std::abs(bounds[4].outward.dot(corner) - bounds[4].offset) <= 10 * rounding * size && corner.z() < lowest) {
        lowest = corner.z();
        solid.crack_depth = upper.dot(crest - corner) / upper.z();
      }
  }
  return solid;
}

double crest_height_of_line(const SlopeWedge& wedge, double line_height) {
  const Vector3d a = up(wedge.a), upper = up(wedge.upper);
  return line_height * upper.dot(rising_line(a, up(wedge.b))) / upper.dot(rising_line(a, up(wedge.face)));
}

double mean_water_pressure(const SlopeWedgeSolid& solid, bool cracked, double water_unit_weight) {
  return water_unit_weight * (cracked ? solid.crack_depth / 3 : solid.line_height / 6);
}

double factor_of_safety(const LowWedge& w, double water_unit_weight) {
  require(positive(w.crest_height) && positive(w.unit_weight), "height and unit weight must be positive");
  using std::cos;
  using std::sin;
  using std::tan;
  const double both = w.beta_1 + w.beta_2;
  const double cosine = sin(w.delta_1) * sin(w.delta_2) * cos(both) + cos(w.delta_1) * cos(w.delta_2);
  const double sin_psi = std::sqrt(1 - cosine * cosine);
  const double tan_line = sin(both) / (sin(w.beta_1) / tan(w.delta_2) + sin(w.beta_2) / tan(w.delta_1));
  const double sines = sin(both) * sin(w.delta_1) * sin(w.delta_2);
  const double a0 = sin_psi / (sines * sines * (1 / tan_line - 1 / tan(w.face)));
  const double b1 = a0 * sin(w.beta_2) * sin(w.delta_2), b2 = a0 * sin(w.beta_1) * sin(w.delta_1);
  const double a1 = (sin(w.delta_2) / tan(w.delta_1) - cos(w.delta_2) * cos(both)) / (sin_psi * sin(both));
  const double a2 = (sin(w.delta_1) / tan(w.delta_2) - cos(w.delta_1) * cos(both)) / (sin_psi * sin(both));
  const double lift = w.water * water_unit_weight / w.unit_weight, weight = w.unit_weight * w.crest_height;
  return (a1 - b1 * lift) * tan(w.friction_1) + (a2 - b2 * lift) * tan(w.friction_2) +
         3 * (b1 * w.cohesion_1 + b2 * w.cohesion_2) / weight;
}

SlopeWedge planes_of(const LowWedge& w) {
  constexpr double south = std::numbers::pi;
  return {
      {w.delta_1, south - w.beta_1}, {w.delta_2, south + w.beta_2}, {w.face, south}, {w.upper, south}, w.crest_height};
}

}  // namespace voussoir::reference
