// Free rotation by the midpoint rule: energy and moment of momentum at any step, order two in attitude.
#include "core/implicit/mean_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace voussoir::mean_motion_test {
namespace {

Body<3> tumbling() {
  Body<3> body;
  body.mass = 1;
  body.inertia = Spin<3>(1, 2, 3);
  body.radius = 1;
  body.free_translation.fill(true);
  body.free_rotation.fill(true);
  return body;
}

Spin<3> momentum_in_space(const Body<3>& body, const Motion<3>& m) {
  return matrix(m.rotation) * body.principal_axes * m.angular_momentum;
}

// the equation of free rotation, by Newton's method
MeanMotion<3> free_motion(const Body<3>& body, const Motion<3>& before, double h) {
  MeanMotion<3> mean;
  mean.spin = angular_velocity(body, before);
  for (int k = 0; k < 50; ++k) {
    const SpinChange<3> found = spin_change<3>(body, before, mean.spin, h);
    const Spin<3> more = found.by_spin.inverse() * found.change;
    mean.spin -= more;
    if (more.norm() < 1e-15 * mean.spin.norm()) break;
  }
  return mean;
}

Motion<3> after(const Body<3>& body, double h, double time) {
  Motion<3> m;
  m.angular_momentum = body.inertia.cwiseProduct(Spin<3>(0.05, 1, 0.05));
  for (int k = 0; k < std::lround(time / h); ++k)
    m = motion_after(body, m, free_motion(body, m, h), h);
  return m;
}

double turn_between(const Motion<3>& a, const Motion<3>& b) {
  return rotation_vector(Rotation<3>{a.rotation.quaternion * b.rotation.quaternion.conjugate()}).norm();
}

TEST(MeanMotion, FreeRotationKeepsEnergyAndMomentumAtAnyStep) {
  const Body<3> body = tumbling();
  Motion<3> start;
  start.angular_momentum = body.inertia.cwiseProduct(Spin<3>(0.05, 1, 0.05));
  for (const double h : {0.02, 0.2, 0.9}) {
    const Motion<3> m = after(body, h, 18);
    EXPECT_NEAR(kinetic_energy(body, m), kinetic_energy(body, start), 1e-13 * kinetic_energy(body, start)) << h;
    EXPECT_LT((momentum_in_space(body, m) - momentum_in_space(body, start)).norm(), 1e-13 * 2) << h;
  }
}

TEST(MeanMotion, FreeRotationIsOfSecondOrder) {
  const Body<3> body = tumbling();
  const Motion<3> exact = after(body, 0.0005, 20);
  std::vector<double> errors;
  for (const double h : {0.2, 0.1, 0.05, 0.025})
    errors.push_back(turn_between(after(body, h, 20), exact));
  for (std::size_t k = 1; k < errors.size(); ++k)
    EXPECT_NEAR(std::log2(errors[k - 1] / errors[k]), 2, 0.06);
  EXPECT_LT(errors[2], 6e-3);
}

// a point fixed to the body moves by h w × r exactly, r the mean of its arms before and after the step
TEST(MeanMotion, MeanArmGivesTheDisplacement) {
  const double h = 0.3;
  const Spin<3> spin(0.7, -1.1, 2.3);
  const Vector<3> start(0.4, 0.2, -0.9);
  const Vector<3> end = matrix(turned(Rotation<3>{}, turn_of_step<3>(spin, h))) * start;
  EXPECT_LT((h * cross(spin, Vector<3>(0.5 * (start + end))) - (end - start)).norm(), 1e-15);
  const Spin<2> in_plane(1.9);
  const Vector<2> arm(0.4, -0.3);
  const Vector<2> turned_arm = matrix(Rotation<2>{turn_of_step<2>(in_plane, h)[0]}) * arm;
  EXPECT_LT((h * cross(in_plane, Vector<2>(0.5 * (arm + turned_arm))) - (turned_arm - arm)).norm(), 1e-15);
}

}  // namespace
}  // namespace voussoir::mean_motion_test
