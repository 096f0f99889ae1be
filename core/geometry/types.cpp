#include "core/geometry/types.hpp"

#include <cmath>

namespace voussoir {

Vector<2> cross(const Spin<2>& w, const Vector<2>& r) {
  return {-w[0] * r[1], w[0] * r[0]};
}

Vector<3> cross(const Spin<3>& w, const Vector<3>& r) {
  return w.cross(r);
}

Spin<2> moment(const Vector<2>& r, const Vector<2>& f) {
  return Spin<2>(r[0] * f[1] - r[1] * f[0]);
}

Spin<3> moment(const Vector<3>& r, const Vector<3>& f) {
  return r.cross(f);
}

Matrix<2> matrix(const Rotation<2>& rotation) {
  const double c = std::cos(rotation.angle), s = std::sin(rotation.angle);
  Matrix<2> q;
  q << c, -s, s, c;
  return q;
}

Matrix<3> matrix(const Rotation<3>& rotation) {
  return rotation.quaternion.toRotationMatrix();
}

Rotation<2> turned(const Rotation<2>& rotation, const Spin<2>& turn) {
  return {rotation.angle + turn[0]};
}

Rotation<3> turned(const Rotation<3>& rotation, const Spin<3>& turn) {
  const double angle = turn.norm();
  // sin(x/2)/x by its series near zero, where the quotient is 0/0
  const double half_sinc = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48;
  const Quaternion q(std::cos(0.5 * angle), half_sinc * turn[0], half_sinc * turn[1], half_sinc * turn[2]);
  // renormalised, or rounding alone would let the norm drift over 1e7 steps
  return {(q * rotation.quaternion).normalized()};
}

Spin<2> rotation_vector(const Rotation<2>& rotation) {
  return Spin<2>(rotation.angle);
}

Spin<3> rotation_vector(const Rotation<3>& rotation) {
  const Quaternion& q = rotation.quaternion;
  const double sine = q.vec().norm();
  if (sine == 0) return Spin<3>::Zero();
  const double sign = q.w() < 0 ? -1 : 1;
  return sign * 2 * std::atan2(sine, std::abs(q.w())) / sine * q.vec();
}

Rotation<3> rotation_onto(const Vector<3>& from, const Vector<3>& to) {
  const Vector<3> a = from.normalized(), b = to.normalized();
  const double cosine = a.dot(b);
  if (cosine < -1 + 1e-15) {
    const Vector<3> axis = perpendicular(a);
    return {Quaternion(0, axis[0], axis[1], axis[2])};
  }
  const double twice = std::sqrt((1 + cosine) * 2);  // 2 cos of half the angle
  const Vector<3> axis = a.cross(b) * (1 / twice);
  // of nearly opposite directions the error of the length is far more than rounding
  return {Quaternion(0.5 * twice, axis[0], axis[1], axis[2]).normalized()};
}

Vector<2> perpendicular(const Vector<2>& n) {
  return {-n[1], n[0]};
}

Vector<3> perpendicular(const Vector<3>& n) {
  int axis = 0;
  n.cwiseAbs().minCoeff(&axis);
  return n.cross(Vector<3>::Unit(axis)).normalized();
}

}  // namespace voussoir
