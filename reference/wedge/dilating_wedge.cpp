#include "reference/wedge/dilating_wedge.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

using Vec = Eigen::Vector3d;

Vec of_array(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

// unit, leaving planes with these normals at these angles, near the line of intersection
Vec moving_direction(const Vec& a, const Vec& b, double dilation_a, double dilation_b) {
  Vec line = a.cross(b).normalized();
  if (line.z() > 0) line = -line;
  // v = line + x a + y b with v·a = sin ψa |v|, v·b = sin ψb |v|
  const double cosine = a.dot(b), square = 1 - cosine * cosine;
  Vec v = line;
  for (int i = 0; i < 200; ++i) {
    const double along_a = std::sin(dilation_a) * v.norm(), along_b = std::sin(dilation_b) * v.norm();
    v = line + (along_a - cosine * along_b) / square * a + (along_b - cosine * along_a) / square * b;
  }
  return v.normalized();
}

}  // namespace

DilatingSolution solve_dilating_wedge(const DilatingWedge& w) {
  const Vec a = of_array(upward_normal(w.wedge.a.dip, w.wedge.a.dip_direction)),
            b = of_array(upward_normal(w.wedge.b.dip, w.wedge.b.dip_direction));
  const Vec load = of_array(w.wedge.extra_force) - w.wedge.weight * Vec::UnitZ();
  DilatingSolution found;
  found.stress_a = found.stress_b = w.wedge.weight / (w.area_a + w.area_b);
  for (int i = 0; i < 1000; ++i) {
    const Vec v = moving_direction(a, b, w.joint.dilation(found.stress_a), w.joint.dilation(found.stress_b));
    const Vec in_a = (v - v.dot(a) * a).normalized(), in_b = (v - v.dot(b) * b).normalized();
    // N_a a + N_b b - (1/F) shear + load = 0, the shear of the stresses before
    Eigen::Matrix3d matrix;
    matrix << a, b,
        -(w.area_a * found.stress_a * w.joint.tan_friction(found.stress_a) * in_a +
          w.area_b * found.stress_b * w.joint.tan_friction(found.stress_b) * in_b);
    const Vec forces = matrix.fullPivLu().solve(-load);
    if (!(forces[0] > 0 && forces[1] > 0 && forces[2] > 0))
      throw std::invalid_argument("the wedge does not slide on both planes");
    found = {1 / forces[2], forces[0] / w.area_a, forces[1] / w.area_b, {v.x(), v.y(), v.z()}};
  }
  return found;
}

}  // namespace voussoir::reference
