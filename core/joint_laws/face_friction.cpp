#include "core/joint_laws/face_friction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace voussoir {
namespace {

// Around a pole so far off, over the polygon's radius, the closed forms' triangles cancel to some 32⁴ roundings, 1e-10;
// beyond it a rule of degree 5 leaves less than (1/32)⁶, 1e-9.
constexpr double far_pole = 32;

// a pole this near to an edge's line, over the distance to its corners, lies on it: all terms of the edge vanish with
// it
constexpr double on_the_line = 1e-30;

// The direction of slip is found when the trial's distance from its plane's normal is no more than this, over the limit
// force: the remaining force is on the surface, with an error along it of as much. Below the accuracy of far poles,
// Newton's method would not end.
constexpr double along_the_normal = 1e-8;
constexpr int newton_limit = 60;
constexpr double shortest_step = 1e-3;  // of Newton's

// The resistance of friction to a slip, and its derivative by the slip (v, w): the second derivative of the
// dissipation, ∫ p/|s| j jᵀ with s the slip at a point, t its direction, j = (ẑ × t, t·y).
struct Resistance {
  FaceFriction friction;
  Matrix<3> curvature = Matrix<3>::Zero();
};

Vector<2> quarter_turn(const Vector<2>& v) {
  return {-v[1], v[0]};
}

// ∫ u r̂ dA, ∫ u r dA and ∫ u/r r̂ r̂ᵀ dA around a pole
struct AroundPole {
  Vector<2> direction = Vector<2>::Zero();
  double distance = 0;
  Matrix<2> bending = Matrix<2>::Zero();
};

// ∫ ds/ρ, the difference of asinh(s/|h|) at both ends, by one logarithm and without cancellation
double integral_of_inverse(double h, double s0, double r0, double s1, double r1) {
  if (s0 >= 0) return std::log((s1 + r1) / (s0 + r0));
  if (s1 <= 0) return std::log((r0 - s0) / (r1 - s1));
  return std::log((s1 + r1) / h * ((r0 - s0) / h));
}

// Over the triangle from the pole to an edge from `first` to `second`, seen from the pole, with the overlap at_pole +
// gradient·y. In polar coordinates the radius integrates to powers of ρ = √(h² + s²), the distance to the edge's point
// s; along the edge dθ = h ds/ρ².
void add_edge(const Vector<2>& first, const Vector<2>& second, double at_pole, const Vector<2>& gradient,
              AroundPole& sum) {
  const double length = (second - first).norm();
  if (!(length > 0)) return;
  const Vector<2> along = (second - first) / length, out(along[1], -along[0]);
  const double h = first.dot(out), s0 = first.dot(along), s1 = second.dot(along);
  if (std::abs(h) <= on_the_line * std::max(std::abs(s0), std::abs(s1))) return;
  const double r0 = std::sqrt(h * h + s0 * s0), r1 = std::sqrt(h * h + s1 * s1);
  const double i0 = integral_of_inverse(h, s0, r0, s1, r1);   // ∫ ds/ρ
  const double i1 = r1 - r0;                                  // ∫ s ds/ρ
  const double i2 = 0.5 * (s1 * r1 - s0 * r0 - h * h * i0);   // ∫ s² ds/ρ
  const double rho = 0.5 * (s1 * r1 - s0 * r0 + h * h * i0);  // ∫ ρ ds
  const double s_rho = (r1 * r1 * r1 - r0 * r0 * r0) / 3;     // ∫ s ρ ds
  const double across = gradient.dot(out), slope = gradient.dot(along);
  sum.direction += h * ((at_pole / 2 * h * i0 + (h * h * across * i0 + h * slope * i1) / 3) * out +
                        (at_pole / 2 * i1 + (h * across * i1 + slope * i2) / 3) * along);
  sum.distance += h * (at_pole / 3 * rho + (h * across * rho + slope * s_rho) / 4);
  // h² ∫ ds/ρ³, ∫ s ds/ρ³, ∫ s² ds/ρ³, ∫ s³ ds/ρ³
  const double j0 = s1 / r1 - s0 / r0, j1 = 1 / r0 - 1 / r1, j2 = i0 - j0, j3 = i1 + h * h * (1 / r1 - 1 / r0);
  const double even = at_pole + 0.5 * h * across, odd = 0.5 * slope;
  const double oo = h * (even * j0 + odd * h * h * j1), oa = h * h * (even * j1 + odd * j2),
               aa = h * (even * j2 + odd * j3);
  sum.bending += oo * out * out.transpose() + oa * (out * along.transpose() + along * out.transpose()) +
                 aa * along * along.transpose();
}

// seven points of a triangle, exact to degree 5 (Radon 1948): weights, and the corners' shares: the first is that of
// one corner, the second that of the two others
struct TrianglePoint {
  double weight, share;
};
constexpr std::array<TrianglePoint, 2> radon{
    {{0.13239415278850618, 0.05971587178976982}, {0.12593918054482715, 0.7974269853530873}}};

// a pole far from the polygon: slip hardly changes its direction over it
Resistance resistance_by_points(const PressedPolygon& polygon, const Vector<2>& v, double w) {
  Resistance result;
  FaceFriction& friction = result.friction;
  const auto& c = polygon.corners;
  const auto add = [&](const Vector<2>& y, double area) {
    const double pressed = (polygon.overlap + polygon.gradient.dot(y)) * area;
    const Vector<2> slip = v + w * quarter_turn(y);
    const double speed = slip.norm();
    const Vector<2> along = slip / speed;
    friction.force += pressed * along;
    friction.moment += pressed * (y[0] * along[1] - y[1] * along[0]);
    const Vector<3> across(-along[1], along[0], along.dot(y));
    result.curvature += pressed / speed * across * across.transpose();
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
  return result;
}

double radius_of(const PressedPolygon& polygon) {
  double square = 0;
  for (const Vector<2>& v : polygon.corners)
    square = std::max(square, v.squaredNorm());
  return std::sqrt(square);
}

Resistance resistance(const PressedPolygon& polygon, const Vector<2>& v, double w) {
  const double radius = radius_of(polygon);
  if (v.norm() > far_pole * radius * std::abs(w)) return resistance_by_points(polygon, v, w);
  const Vector<2> pole = quarter_turn(v) / w;
  const double at_pole = polygon.overlap + polygon.gradient.dot(pole);
  AroundPole sum;
  for (std::size_t k = 0; k < polygon.corners.size(); ++k)
    add_edge(polygon.corners[k] - pole, polygon.corners[(k + 1) % polygon.corners.size()] - pole, at_pole,
             polygon.gradient, sum);
  const double sign = w > 0 ? 1 : -1;
  Resistance result{{sign * quarter_turn(sum.direction), sign * (sum.distance + pole.dot(sum.direction))}};
  // j is r̂ and its part in the turning of the pole
  FixedMatrix<3, 2> motion;
  motion << Matrix<2>::Identity(), quarter_turn(pole).transpose();
  result.curvature = motion * sum.bending * motion.transpose() / std::abs(w);
  return result;
}

// The overlap over the polygon: its integral, the centre of pressure, and about that the second moment and the largest
// distance. By triangles around the centre of the area.
struct Pressure {
  double volume = 0, second = 0, reach = 0;
  Vector<2> centre = Vector<2>::Zero();

  explicit Pressure(const PressedPolygon& polygon) {
    const auto& c = polygon.corners;
    Vector<2> sum = Vector<2>::Zero();
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Vector<2>&p = c[k], &q = c[(k + 1) % c.size()];
      const double area = 0.5 * (p[0] * q[1] - p[1] * q[0]), u = polygon.overlap, up = u + polygon.gradient.dot(p),
                   uq = u + polygon.gradient.dot(q);
      volume += area / 3 * (u + up + uq);
      sum += area / 12 * ((u + 2 * up + uq) * p + (u + up + 2 * uq) * q);
      second += area / 30 *
                ((u + 3 * up + uq) * p.squaredNorm() + (u + 2 * up + 2 * uq) * p.dot(q) +
                 (u + up + 3 * uq) * q.squaredNorm());
    }
    centre = sum / volume;
    second = std::max(second - volume * centre.squaredNorm(), 0.0);
    double square = 0;
    for (const Vector<2>& v : c)
      square = std::max(square, (v - centre).squaredNorm());
    reach = std::sqrt(square);
  }

  // Whether the face certainly resists a force and a moment about its centre of area, both over µ k: slips at no more
  // than the speed of its farthest point, w reach, about the centre of pressure, which resist with the second moment
  // over the reach at least; with translations, which the full face resists, they span a double cone inside the limit
  // surface.
  bool surely_holds(const Vector<2>& force, double moment) const {
    const double about = moment - (centre[0] * force[1] - centre[1] * force[0]);
    return force.norm() / volume + std::abs(about) * reach / second <= 1;
  }
};

// The limit surface with the force in units of the limit of translation and the moment in those at the radius of
// gyration: the springs are equal in all directions, and the return is to the nearest point.
struct LimitSurface {
  const PressedPolygon& polygon;
  double volume, gyration;

  struct Point {
    Vector<3> at;
    Matrix<3> curvature;  // its derivative by the direction
  };

  // the point whose outward normal is `direction`: the friction against a slip along it
  Point point(const Vector<3>& direction) const {
    const Resistance r = resistance(polygon, direction.head<2>(), direction[2] / gyration);
    const FaceFriction& f = r.friction;
    const Vector<3> units(1, 1, 1 / gyration);
    return {Vector<3>(f.force[0], f.force[1], f.moment / gyration) / volume,
            units.asDiagonal() * r.curvature * units.asDiagonal() / volume};
  }
};

FixedMatrix<3, 2> tangent_of(const Vector<3>& normal) {
  FixedMatrix<3, 2> tangent;
  tangent.col(0) = perpendicular(normal);
  tangent.col(1) = normal.cross(tangent.col(0));
  return tangent;
}

// The outward normal of the surface at the point nearest to a trial: the direction in which the trial is farthest
// beyond the surface's plane. Newton's method on the sphere. False if the trial is inside.
bool nearest(const LimitSurface& surface, const Vector<3>& trial, Vector<3>& normal, Vector<3>& point) {
  LimitSurface::Point at = surface.point(normal);
  double beyond = normal.dot(trial - at.at);
  const double enough = along_the_normal * std::max(1.0, trial.norm());
  for (int i = 0; i < newton_limit; ++i) {
    const FixedMatrix<3, 2> tangent = tangent_of(normal);
    const Vector<2> gradient = tangent.transpose() * (trial - at.at);
    if (gradient.norm() <= enough) break;
    Matrix<2> curvature = tangent.transpose() * at.curvature * tangent;
    curvature.diagonal().array() += std::max(beyond, gradient.norm() * gradient.norm());
    Vector<2> way = curvature.inverse() * gradient;
    if (!(way.dot(gradient) > 0) || !way.allFinite()) way = gradient;
    if (way.norm() > 1) way.normalize();
    bool better = false;
    for (double length = 1; length > shortest_step && !better; length *= 0.5) {
      const Vector<3> other = (normal + length * (tangent * way)).normalized();
      const LimitSurface::Point there = surface.point(other);
      const double then = other.dot(trial - there.at);
      if (!(then > beyond)) continue;
      better = true;
      normal = other;
      at = there;
      beyond = then;
    }
    if (!better) break;
  }
  point = at.at;
  return beyond > 0;
}

// One step of it from a normal that is known but for little.
bool near(const LimitSurface& surface, const Vector<3>& trial, const Vector<3>& normal, Vector<3>& point) {
  const LimitSurface::Point at = surface.point(normal);
  const double beyond = normal.dot(trial - at.at);
  if (!(beyond > 0)) return false;
  const FixedMatrix<3, 2> tangent = tangent_of(normal);
  Matrix<2> curvature = tangent.transpose() * at.curvature * tangent;
  curvature.diagonal().array() += beyond;
  const Vector<2> way = curvature.inverse() * (tangent.transpose() * (trial - at.at));
  point = at.at + at.curvature * (tangent * way);
  return true;
}

// finds the nearest point by `find`, which may begin with the normal it is given
template <class Find>
FaceSlip returned(const PressedPolygon& polygon, double pressure, double stiffness, double twist_stiffness,
                  const Vector<2>& force, double moment, Find find) {
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
  const Pressure press(polygon);
  const double part = press.volume / pressure;
  if (press.surely_holds(part * force, part * moment)) return result;
  const LimitSurface surface{polygon, press.volume, gyration};
  const Vector<3> trial(force[0] / pressure, force[1] / pressure, moment / (pressure * gyration));

  // from the normal of an ellipsoid; no twist is resisted by more than the root of the second moment
  Vector<3> point;
  result.normal = {trial[0], trial[1], trial[2] * gyration * gyration * press.volume / press.second};
  result.normal.normalize();
  if (!find(surface, trial, result.normal, point)) return result;
  result.force = pressure * point.head<2>();
  result.moment = pressure * gyration * point[2];
  return give_way();
}

}  // namespace

FaceFriction friction_against(const PressedPolygon& polygon, const Vector<2>& v, double w) {
  return resistance(polygon, v, w).friction;
}

FaceSlip return_to_limit(const PressedPolygon& polygon, double pressure, double stiffness, double twist_stiffness,
                         const Vector<2>& force, double moment) {
  return returned(polygon, pressure, stiffness, twist_stiffness, force, moment, nearest);
}

FaceSlip return_near(const PressedPolygon& polygon, double pressure, double stiffness, double twist_stiffness,
                     const Vector<2>& force, double moment, const Vector<3>& known) {
  return returned(polygon, pressure, stiffness, twist_stiffness, force, moment,
                  [&](const LimitSurface& surface, const Vector<3>& trial, Vector<3>& normal, Vector<3>& point) {
                    normal = known;
                    return near(surface, trial, known, point);
                  });
}

}  // namespace voussoir
