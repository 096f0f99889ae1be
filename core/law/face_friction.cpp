#include "core/law/face_friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

// Around a pole so far off, over the polygon's radius, the closed forms' triangles cancel to some 32⁴ roundings, 1e-10;
// beyond it a rule of degree 5 leaves less than (1/32)⁶, 1e-9.
constexpr double far_pole = 32;

// a pole this near to an edge's line, over the distance to its corners, lies on it: all terms of the edge vanish with
// it
constexpr double on_the_line = 1e-30;

// The direction of slip is found when the trial lies off its plane's normal by no more than this, over the limit force;
// Newton's method gets there from 1e-5, where its differences still tell.
constexpr double along_the_normal = 1e-11;
constexpr int newton_limit = 60;

// of directions, for differences of the friction: half of the digits
constexpr double difference_step = 1e-7;

Vector<2> quarter_turn(const Vector<2>& v) {
  return {-v[1], v[0]};
}

// ∫ u r̂ dA and ∫ u r dA around a pole
struct AroundPole {
  Vector<2> direction = Vector<2>::Zero();
  double distance = 0;
};

// Over the triangle from the pole to an edge from `first` to `second`, seen from the pole, where the overlap is
// at_pole + gradient·y. In polar coordinates the radius integrates to powers of ρ = √(h² + s²), the distance to the
// edge's point s; along the edge dθ = h ds/ρ².
void add_edge(const Vector<2>& first, const Vector<2>& second, double at_pole, const Vector<2>& gradient,
              AroundPole& sum) {
  const double length = (second - first).norm();
  if (!(length > 0)) return;
  const Vector<2> along = (second - first) / length, out(along[1], -along[0]);
  const double h = first.dot(out), s0 = first.dot(along), s1 = second.dot(along);
  if (std::abs(h) <= on_the_line * std::max(std::abs(s0), std::abs(s1))) return;
  const double r0 = std::hypot(h, s0), r1 = std::hypot(h, s1);
  const double i0 = std::asinh(s1 / std::abs(h)) - std::asinh(s0 / std::abs(h));  // ∫ ds/ρ
  const double i1 = r1 - r0;                                                      // ∫ s ds/ρ
  const double i2 = 0.5 * (s1 * r1 - s0 * r0 - h * h * i0);                       // ∫ s² ds/ρ
  const double rho = 0.5 * (s1 * r1 - s0 * r0 + h * h * i0);                      // ∫ ρ ds
  const double s_rho = (r1 * r1 * r1 - r0 * r0 * r0) / 3;                         // ∫ s ρ ds
  const double across = gradient.dot(out), slope = gradient.dot(along);
  sum.direction += h * ((at_pole / 2 * h * i0 + (h * h * across * i0 + h * slope * i1) / 3) * out +
                        (at_pole / 2 * i1 + (h * across * i1 + slope * i2) / 3) * along);
  sum.distance += h * (at_pole / 3 * rho + (h * across * rho + slope * s_rho) / 4);
}

// seven points of a triangle, exact to degree 5 (Radon 1948): weights, and the corners' shares, of which the first is
// one corner's and the second the two others'
struct TrianglePoint {
  double weight, share;
};
constexpr std::array<TrianglePoint, 2> radon{
    {{0.13239415278850618, 0.05971587178976982}, {0.12593918054482715, 0.7974269853530873}}};

// a pole far from the polygon: slip hardly changes its direction over it
FaceFriction friction_by_points(const PressedPolygon& polygon, const Vector<2>& v, double w) {
  FaceFriction friction;
  const auto& c = polygon.corners;
  const auto add = [&](const Vector<2>& y, double area) {
    const double pressed = (polygon.overlap + polygon.gradient.dot(y)) * area;
    const Vector<2> along = (v + w * quarter_turn(y)).normalized();
    friction.force += pressed * along;
    friction.moment += pressed * (y[0] * along[1] - y[1] * along[0]);
  };
  for (std::size_t k = 1; k + 1 < c.size(); ++k) {
    const Vector<2> p = c[k] - c[0], q = c[k + 1] - c[0];
    const double area = 0.5 * (p[0] * q[1] - p[1] * q[0]);
    add(c[0] + (p + q) / 3, 0.225 * area);
    for (const TrianglePoint& at : radon) {
      const double other = 0.5 * (1 - at.share);
      add(c[0] + other * (p + q), at.weight * area);
      add(c[0] + at.share * p + other * q, at.weight * area);
      add(c[0] + other * p + at.share * q, at.weight * area);
    }
  }
  return friction;
}

double radius_of(const PressedPolygon& polygon) {
  double square = 0;
  for (const Vector<2>& v : polygon.corners)
    square = std::max(square, v.squaredNorm());
  return std::sqrt(square);
}

double area_of(const PressedPolygon& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k) {
    const Vector<2>&p = polygon.corners[k], &q = polygon.corners[(k + 1) % polygon.corners.size()];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return 0.5 * twice;
}

// The limit surface where force is measured in limits of translation, moment in those at the radius of gyration: its
// springs are alike in all directions, and the return is to its nearest point.
struct LimitSurface {
  const PressedPolygon& polygon;
  double volume, gyration;

  // the point whose outward normal is `direction`: the friction against a slip along it
  Vector<3> point(const Vector<3>& direction) const {
    const FaceFriction f = friction_against(polygon, direction.head<2>(), direction[2] / gyration);
    return {f.force[0] / volume, f.force[1] / volume, f.moment / (volume * gyration)};
  }

  // Whether what it is certain to hold holds the trial: the cone of the circle of translations and the two extremes of
  // twist, which its convexity includes.
  bool surely_holds(const Vector<3>& trial, const Vector<3>& twist) const {
    const Vector<2> centre = pressure_centre() / gyration;
    // on the disc of translations the moment is that of a force at the centre of pressure
    const auto beyond = [&](const Vector<3>& s) { return s[2] - (centre[0] * s[1] - centre[1] * s[0]); };
    const double part = beyond(trial) / beyond(twist);
    const Vector<2> rest = trial.head<2>() - part * twist.head<2>();
    return rest.norm() + std::abs(part) <= 1;
  }

  Vector<2> pressure_centre() const {
    // ∫ u y dA from the second moments about the centre, by triangles around it
    Vector<2> sum = Vector<2>::Zero();
    const auto& c = polygon.corners;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Vector<2>&p = c[k], &q = c[(k + 1) % c.size()];
      const double area = 0.5 * (p[0] * q[1] - p[1] * q[0]);
      sum += area / 12 *
             (p * p.dot(polygon.gradient) + q * q.dot(polygon.gradient) + (p + q) * (p + q).dot(polygon.gradient));
    }
    return sum / volume;
  }
};

// The outward normal of the surface where it is nearest to a trial: the direction in which the trial lies farthest
// beyond the surface's plane. Newton's method on the sphere; the curvature of the support function by differences.
// False where the trial lies within.
bool nearest(const LimitSurface& surface, const Vector<3>& trial, Vector<3>& normal, Vector<3>& point) {
  point = surface.point(normal);
  double beyond = normal.dot(trial - point);
  const double enough = along_the_normal * std::max(1.0, trial.norm());
  for (int i = 0; i < newton_limit; ++i) {
    Eigen::Matrix<double, 3, 2> tangent;
    tangent.col(0) = perpendicular(normal);
    tangent.col(1) = normal.cross(tangent.col(0));
    const Vector<2> gradient = tangent.transpose() * (trial - point);
    if (gradient.norm() <= enough) break;
    Matrix<2> curvature;
    for (int k = 0; k < 2; ++k)
      curvature.col(k) = tangent.transpose() *
                         (surface.point((normal + difference_step * tangent.col(k)).normalized()) - point) /
                         difference_step;
    curvature = 0.5 * (curvature + curvature.transpose()).eval();
    curvature.diagonal().array() += std::max(beyond, gradient.norm() * gradient.norm());
    Vector<2> way = curvature.inverse() * gradient;
    if (!(way.dot(gradient) > 0) || !way.allFinite()) way = gradient;
    if (way.norm() > 1) way.normalize();
    bool better = false;
    for (double length = 1; length > along_the_normal && !better; length *= 0.5) {
      const Vector<3> other = (normal + length * (tangent * way)).normalized(), there = surface.point(other);
      const double then = other.dot(trial - there);
      if (!(then > beyond)) continue;
      better = true;
      normal = other;
      point = there;
      beyond = then;
    }
    if (!better) break;
  }
  return beyond > 0;
}

}  // namespace

FaceFriction friction_against(const PressedPolygon& polygon, const Vector<2>& v, double w) {
  const double radius = radius_of(polygon);
  if (v.norm() > far_pole * radius * std::abs(w)) return friction_by_points(polygon, v, w);
  const Vector<2> pole = quarter_turn(v) / w;
  const double at_pole = polygon.overlap + polygon.gradient.dot(pole);
  AroundPole sum;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k)
    add_edge(polygon.corners[k] - pole, polygon.corners[(k + 1) % polygon.corners.size()] - pole, at_pole,
             polygon.gradient, sum);
  const double sign = w > 0 ? 1 : -1;
  return {sign * quarter_turn(sum.direction), sign * (sum.distance + pole.dot(sum.direction))};
}

FaceSlip return_to_limit(const PressedPolygon& polygon, double pressure, double stiffness, double twist_stiffness,
                         const Vector<2>& force, double moment) {
  FaceSlip result{force, moment};
  const auto give_way = [&] {
    if (stiffness > 0) result.slip = (force - result.force) / stiffness;
    if (twist_stiffness > 0) result.turn = (moment - result.moment) / twist_stiffness;
    return result;
  };
  if (!(pressure > 0)) {
    result.force.setZero();
    result.moment = 0;
    return give_way();
  }
  if (!(stiffness > 0) || (force.isZero(0) && moment == 0)) return result;
  const double gyration = std::sqrt(twist_stiffness / stiffness);
  const LimitSurface surface{polygon, area_of(polygon) * polygon.overlap, gyration};
  const Vector<3> trial(force[0] / pressure, force[1] / pressure, moment / (pressure * gyration));
  const Vector<3> twist = surface.point(Vector<3>::UnitZ());
  if (surface.surely_holds(trial, twist)) return result;

  // from the normal of the ellipsoid through the extremes
  Vector<3> normal(trial[0], trial[1], trial[2] / (twist[2] * twist[2])), point;
  normal.normalize();
  if (!nearest(surface, trial, normal, point)) return result;
  result.force = pressure * point.head<2>();
  result.moment = pressure * gyration * point[2];
  return give_way();
}

}  // namespace voussoir
