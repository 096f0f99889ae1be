#include "reference/wedge/wedge_path.hpp"
#include "text/angle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <stdexcept>

using namespace voussoir::reference;
using voussoir::degree;
using Eigen::Vector3d;

namespace {

Wedge wedge(double dip_a, double direction_a, double dip_b, double direction_b) {
  Wedge w;
  w.a.dip = dip_a * degree;
  w.a.dip_direction = direction_a * degree;
  w.b.dip = dip_b * degree;
  w.b.dip_direction = direction_b * degree;
  return w;
}

Wedge boon_wedge() {
  return wedge(40, 130, 60, 220);
}

double critical_deg(double stiffness_ratio, double area_ratio = 1, double start_deg = 70) {
  WedgePathSettings settings;
  settings.friction_start = start_deg * degree;
  return elastic_plastic_path({boon_wedge(), area_ratio, 1, 1, stiffness_ratio}, settings).critical_friction / degree;
}

// Second derivation: the same block as a damped mass under explicit time steps, friction falling at a steady rate.
// Failure is a move away; shares no step, solver or return mapping with the code.
double critical_deg_by_dynamics(double stiffness_ratio) {
  const Wedge w = boon_wedge();
  const Vector3 normals[2] = {upward_normal(w.a.dip, w.a.dip_direction), upward_normal(w.b.dip, w.b.dip_direction)};
  double u[3] = {}, v[3] = {}, shear[2][3] = {};
  const double dt = 0.2, damping = 0.2;  // unit mass, weight and kn: highest frequency about 2, settlement about 1
  double friction_deg = 70, load = 0, moved = 0;
  while (moved < 4) {
    // gravity in 2000 time units, then friction: slower and slower
    if (load < 1)
      load = std::min(1.0, load + dt / 2000);
    else
      friction_deg -= dt * (friction_deg > 36 ? 2e-3 : friction_deg > 33.4 ? 6e-5 : 2e-6);
    const double tan_friction = std::tan(friction_deg * degree);
    double force[3] = {0, 0, -load};
    for (int i = 0; i < 2; ++i) {
      const Vector3& n = normals[i];
      const double push = std::max(0.0, -(n[0] * u[0] + n[1] * u[1] + n[2] * u[2]));
      const double closing = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
      double size = 0;
      for (int k = 0; k < 3; ++k) {
        shear[i][k] -= stiffness_ratio * dt * (v[k] - n[k] * closing);
        size += shear[i][k] * shear[i][k];
      }
      const double part = std::min(1.0, push * tan_friction / std::max(std::sqrt(size), 1e-300));
      for (int k = 0; k < 3; ++k)
        force[k] += push * n[k] + (shear[i][k] *= part);
    }
    moved = 0;
    for (int k = 0; k < 3; ++k) {
      v[k] += dt * (force[k] - damping * v[k]);
      u[k] += dt * v[k];
      moved += u[k] * u[k];
    }
    moved = std::sqrt(moved);
  }
  return friction_deg;
}

TEST(WedgePath, boon_wedge_with_equal_areas) {
  // Values of an independent calculation that does not state its areas; equal ones come within 0.03, which is what
  // 8 % on the area ratio does. Its 33.135 at ks/kn = 2 would need a ratio of 0.8 and is not gated here.
  EXPECT_NEAR(critical_deg(0.1), 33.355, 0.03);
  EXPECT_NEAR(critical_deg(0.5), 33.330, 0.03);
  EXPECT_NEAR(critical_deg(1), 33.300, 0.03);
  EXPECT_NEAR(critical_deg(1, 1, 36), 33.27, 0.005);
  // the table of the header, its rounding and the step error
  EXPECT_NEAR(critical_deg(0.1), 33.353, 8e-4);
  EXPECT_NEAR(critical_deg(0.5), 33.318, 8e-4);
  EXPECT_NEAR(critical_deg(1), 33.274, 8e-4);
  EXPECT_NEAR(critical_deg(2), 33.229, 8e-4);
  EXPECT_NEAR(critical_deg(2, 0.8), 33.142, 8e-4);
  EXPECT_NEAR(critical_deg(2, 1.1305), 33.293, 8e-4);
}

TEST(WedgePath, damped_dynamics_agrees) {
  // Failure is seen late: the block, weight 1, damper c = 0.2, rate r = 2e-6 degrees, moves 2.5 units (four less the
  // settlement) within sqrt(2 c 2.5 r / 0.016) = 0.011 degrees.
  EXPECT_NEAR(critical_deg_by_dynamics(1), critical_deg(1), 0.015);
  EXPECT_NEAR(critical_deg_by_dynamics(2), critical_deg(2), 0.015);
}

TEST(WedgePath, never_above_the_closed_form) {
  const double closed = *critical_friction(boon_wedge()) / degree;
  double last = closed;
  for (const double ratio : {0.1, 0.5, 1.0, 2.0}) {
    const double now = critical_deg(ratio);
    EXPECT_LT(now, last);
    last = now;
  }
  EXPECT_NEAR(critical_deg(1, 3), closed, 1e-6);   // a wide face A: the closed form itself
  EXPECT_NEAR(critical_deg(0.001), closed, 2e-4);  // no shear stiffness, nothing to lock
}

TEST(WedgePath, single_plane_and_symmetric_wedge) {
  // Single plane: nothing to lock against. Symmetric: both normal forces rise alike.
  const Wedge symmetric = wedge(50, 30, 50, 330), single = wedge(35, 180, 70, 190);
  for (const double ratio : {0.1, 2.0}) {
    const WedgePathResult one = elastic_plastic_path({single, 1, 1, 1, ratio});
    EXPECT_NEAR(one.critical_friction / degree, 35, 1e-5);
    EXPECT_NEAR(one.normal_force_b, 0, 1e-6);
  }
  const WedgePathResult two = elastic_plastic_path({symmetric, 1, 1, 1, 1});
  EXPECT_LE(two.critical_friction, *critical_friction(symmetric) + 1e-8);
  EXPECT_NEAR(two.normal_force_a, two.normal_force_b, 1e-9);
}

TEST(WedgePath, steps_converge) {
  WedgePathSettings coarse;
  coarse.friction_step = 0.02 * degree;
  const ElasticPlasticWedge block{boon_wedge(), 1, 1, 1, 1};
  const WedgePathResult far = elastic_plastic_path(block, coarse), near = elastic_plastic_path(block);
  EXPECT_LT(near.step_error, 0.1 * far.step_error);
  EXPECT_LT(near.step_error / degree, 5e-4);
  EXPECT_NEAR(far.critical_friction, near.critical_friction, 4 * far.step_error);
}

TEST(WedgePath, weight_stiffness_and_size_cancel) {
  Wedge heavy = boon_wedge();
  heavy.weight = 3e7;
  const double reference = critical_deg(0.5, 1.1);
  EXPECT_NEAR(elastic_plastic_path({heavy, 1.1, 1, 1, 0.5}).critical_friction / degree, reference, 1e-6);
  EXPECT_NEAR(elastic_plastic_path({heavy, 1.1e4, 1e4, 1e7, 0.5e7}).critical_friction / degree, reference, 1e-6);
}

TEST(WedgePath, faces_of_the_block) {
  // Vertical face across a symmetric wedge, dips 45, dip directions 45 either side: corners by hand.
  const WedgeFaces faces = wedge_faces(wedge(45, 45, 45, 315), 90 * degree, 0, 1);
  const double back = std::numbers::sqrt2, wide = std::numbers::sqrt2;  // top triangle: depth and half width
  EXPECT_NEAR(faces.volume, back * wide / 3, 1e-12);
  const Vector3d line(0, -back, 1), crest(wide, 0, 1);
  EXPECT_NEAR(faces.area_a, 0.5 * line.cross(crest).norm(), 1e-12);
  EXPECT_NEAR(faces.area_b, faces.area_a, 1e-12);
  const WedgeFaces large = wedge_faces(wedge(45, 45, 45, 315), 90 * degree, 0, 10);
  EXPECT_NEAR(large.volume, 1000 * faces.volume, 1e-9);
  EXPECT_NEAR(large.area_a, 100 * faces.area_a, 1e-10);
  EXPECT_NEAR(wedge_faces(boon_wedge(), 90 * degree, 180 * degree, 1).area_a, 1.226961, 1e-6);
}

TEST(WedgePath, refuses_bad_input) {
  EXPECT_THROW(elastic_plastic_path({boon_wedge(), 0, 1, 1, 1}), std::invalid_argument);
  WedgePathSettings weak;
  weak.friction_start = 20 * degree;
  EXPECT_THROW(elastic_plastic_path({boon_wedge(), 1, 1, 1, 1}, weak), std::invalid_argument);
  Wedge glued = boon_wedge();
  glued.a.cohesion_force = 1;
  EXPECT_THROW(elastic_plastic_path({glued, 1, 1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(wedge_faces(boon_wedge(), 20 * degree, 156 * degree, 1), std::invalid_argument);
}

}  // namespace
