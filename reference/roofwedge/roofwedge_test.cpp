#include "reference/roofwedge/roofwedge.hpp"
#include "text/angle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

using namespace voussoir::reference;
using Eigen::Vector3d;
using voussoir::degree;

namespace {

RoofWedge wedge_of(std::array<double, 3> dips, std::array<double, 3> directions) {
  RoofWedge w;
  for (int i = 0; i < 3; ++i) {
    w.planes[i].dip = dips[i] * degree;
    w.planes[i].dip_direction = directions[i] * degree;
  }
  return w;
}

RoofWedge thesis_wedge(double gravity = 9.81) {
  RoofWedge w = wedge_of({60, 60, 60}, {30, 150, 270});
  w.gravity = gravity;
  return w;
}

RoofWedge unequal_wedge() {
  return wedge_of({55, 65, 70}, {20, 160, 280});
}

TEST(RoofWedge, HasItsPublishedNumbers) {
  const RoofWedgeState ten = first_slip(thesis_wedge(10));
  EXPECT_NEAR(ten.friction / degree, 34.401950, 5.1e-7);
  EXPECT_NEAR(ten.displacement[2], -0.333333e-3, 5.1e-10);
  EXPECT_NEAR(std::hypot(ten.displacement[0], ten.displacement[1]), 0, 1e-15);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(ten.normal_force[i], 41376.769, 5.1e-4);
    EXPECT_NEAR(ten.shear_force[i], 28333.333, 5.1e-4);
  }
  const RoofWedgeFaces faces = roof_wedge_faces(thesis_wedge());
  EXPECT_NEAR(faces.volume, 0.577350, 5.1e-7);
  for (const double area : faces.area)
    EXPECT_NEAR(area, 1.154701, 5.1e-7);
  EXPECT_NEAR(first_slip(thesis_wedge(9.81)).friction / degree, 34.318632, 5.1e-7);
}

// the closed surface of the wedge has no resultant area, and the joints' forces balance the cut traction and the weight
TEST(RoofWedge, FacesCloseAndForcesBalance) {
  RoofWedge w = unequal_wedge();
  w.stress = {60e3, 45e3, 10e3, 2e3, -3e3, 5e3};
  const RoofWedgeFaces faces = roof_wedge_faces(w);
  Vector3d area(0, 0, faces.base_area);
  for (int i = 0; i < 3; ++i)
    area += faces.area[i] * Vector3d(faces.normal[i].data());
  EXPECT_LT(area.norm(), 1e-12);

  const RoofWedgeState s = first_slip(w);
  Eigen::Matrix3d stress;
  stress << 60e3, 5e3, -3e3, 5e3, 45e3, 2e3, -3e3, 2e3, 10e3;
  const Vector3d d(s.displacement.data());
  Vector3d sum(0, 0, -w.density * w.gravity * faces.volume);
  for (int i = 0; i < 3; ++i) {
    const Vector3d n(faces.normal[i].data());
    const Vector3d traction = stress * n - w.normal_stiffness * n.dot(d) * n - w.shear_stiffness * (d - n.dot(d) * n);
    sum += faces.area[i] * traction;
    EXPECT_NEAR(faces.area[i] * n.dot(traction), s.normal_force[i], 1e-7);
  }
  EXPECT_LT(sum.norm(), 1e-8);
}

TEST(RoofWedge, OnlyTheRatioOfStiffnessesAndOfStressToWeightMatters) {
  RoofWedge w = unequal_wedge();
  const double slip = first_slip(w).friction, fall = collapse(w).friction;
  w.normal_stiffness *= 7;
  w.shear_stiffness *= 7;
  EXPECT_NEAR(first_slip(w).friction, slip, 1e-12);
  EXPECT_NEAR(collapse(w).friction, fall, 1e-8);
  for (double& s : w.stress)
    s *= 3;
  w.gravity *= 3;
  EXPECT_NEAR(first_slip(w).friction, slip, 1e-12);
  w.shear_stiffness *= 0.1;
  EXPECT_GT(std::abs(first_slip(w).friction - slip), 0.1 * degree);
}

// with rigid joints in shear nothing relaxes: N stays as given by the in-situ stress
TEST(RoofWedge, StiffShearKeepsTheNormalForces) {
  RoofWedge w = thesis_wedge();
  w.shear_stiffness = 1e6 * w.normal_stiffness;
  const RoofWedgeState s = first_slip(w);
  const RoofWedgeFaces faces = roof_wedge_faces(w);
  EXPECT_NEAR(s.normal_force[0] / (0.75 * 0.05e6 * faces.area[0]), 1, 1e-5);
}

// equal planes slip together, and no reserve is left
TEST(RoofWedge, EqualPlanesCollapseAtFirstSlip) {
  const RoofWedge w = thesis_wedge();
  const RoofWedgeState fall = collapse(w);
  EXPECT_NEAR(fall.friction, first_slip(w).friction, 1e-8);
  EXPECT_NEAR(fall.displacement[2], first_slip(w).displacement[2], 1e-9);
}

TEST(RoofWedge, UnequalPlanesRemainStableAfterFirstSlip) {
  for (RoofWedge w : {unequal_wedge(), wedge_of({60, 60, 60}, {30, 150, 270})}) {
    if (w.planes[0].dip == w.planes[1].dip) w.planes[1].strength = 1.3;
    const RoofWedgeState slip = first_slip(w), fall = collapse(w);
    EXPECT_LT(fall.friction, slip.friction - 0.05 * degree);
    EXPECT_LT(fall.step_error, 1e-4 * degree);
    for (int i = 0; i < 3; ++i)
      EXPECT_LE(fall.shear_force[i],
                fall.normal_force[i] * w.planes[i].strength * std::tan(fall.friction) * (1 + 1e-9));
  }
}

// Second derivation: the block as a damped mass under explicit steps, friction lowered over time to a target and kept
// there. Shares no solver and no return mapping with the code.
bool holds_by_dynamics(const RoofWedge& w, double target) {
  const RoofWedgeFaces faces = roof_wedge_faces(w);
  const double weight = w.density * w.gravity * faces.volume, mass = w.density * faces.volume;
  Eigen::Matrix3d stress = Vector3d(w.stress[0], w.stress[1], w.stress[2]).asDiagonal();
  Vector3d n[3], shear[3], d = Vector3d::Zero(), v = Vector3d::Zero();
  double start[3], total = 0;
  for (int i = 0; i < 3; ++i) {
    n[i] = Vector3d(faces.normal[i].data());
    const Vector3d traction = faces.area[i] * (stress * n[i]);
    start[i] = n[i].dot(traction);
    shear[i] = traction - start[i] * n[i];
    total += faces.area[i] * (w.normal_stiffness + w.shear_stiffness);
  }
  const double dt = 0.3 * std::sqrt(mass / total), damping = 0.3 * std::sqrt(mass * total);
  const double from = 60 * degree;
  constexpr int fall = 60000, wait = 40000;
  for (int k = 0; k < fall + wait; ++k) {
    // gravity and the cut are applied while friction is high, then friction falls
    const double on = std::min(1.0, k / 5000.0), down = std::clamp((k - 8000) / (fall - 8000.0), 0.0, 1.0);
    const double tangent = std::tan(from + (target - from) * down);
    Vector3d force = Vector3d(0, 0, -on * weight) + (1 - on) * faces.base_area * (stress * Vector3d::UnitZ());
    for (int i = 0; i < 3; ++i) {
      const double normal = std::max(0.0, start[i] - w.normal_stiffness * faces.area[i] * n[i].dot(d));
      const Vector3d slip = dt * (v - n[i].dot(v) * n[i]);
      shear[i] -= w.shear_stiffness * faces.area[i] * slip;
      const double limit = normal * w.planes[i].strength * tangent, size = shear[i].norm();
      if (size > limit) shear[i] *= limit / size;
      force += normal * n[i] + shear[i];
    }
    v += dt / mass * (force - damping * v);
    d += dt * v;
    if (d.norm() > 0.02) return false;
  }
  return v.norm() * dt < 1e-12;
}

TEST(RoofWedge, CollapseAgreesWithDynamics) {
  RoofWedge weaker = thesis_wedge();
  weaker.planes[1].strength = 1.3;
  for (const RoofWedge& w : {unequal_wedge(), weaker}) {
    const double angle = collapse(w).friction;
    EXPECT_TRUE(holds_by_dynamics(w, angle + 0.03 * degree)) << angle / degree;
    EXPECT_FALSE(holds_by_dynamics(w, angle - 0.03 * degree)) << angle / degree;
  }
}

TEST(RoofWedge, RefusesPlanesThatFormNoWedge) {
  EXPECT_THROW(roof_wedge_faces(wedge_of({60, 60, 60}, {30, 60, 90})), std::invalid_argument);
  EXPECT_THROW(roof_wedge_faces(wedge_of({60, 60, 95}, {30, 150, 270})), std::invalid_argument);
  EXPECT_THROW(roof_wedge_faces(wedge_of({60, 60, 60}, {30, 210, 120})), std::invalid_argument);
  RoofWedge open = thesis_wedge();
  open.stress = {};
  EXPECT_THROW(first_slip(open), std::domain_error);
}

}  // namespace
