// The overlap whose force has a potential: closed forms, finite differences, work around closed paths.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <limits>
#include <numbers>

#include "core/potential/contact.hpp"
#include "core/testing/potential_pairs.hpp"

namespace voussoir::conservative_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int Dim>
constexpr int turns = Dim == 2 ? 1 : 3;
template <int Dim>
using Turn = Eigen::Matrix<double, turns<Dim>, 1>;  // rad

template <int Dim>
Matrix<Dim> rotation_by(const Turn<Dim>& turn) {
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(turn[0]).toRotationMatrix();
  else
    return turn.norm() > 0 ? Matrix<3>(Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix())
                           : Matrix<3>(Matrix<3>::Identity());
}

template <int Dim>
Turn<Dim> moment(const Vector<Dim>& arm, const Vector<Dim>& force) {
  if constexpr (Dim == 2)
    return Turn<2>(arm[0] * force[1] - arm[1] * force[0]);
  else
    return arm.cross(force);
}

template <int Dim>
void expect_spheres() {
  shapes::Random random(301);
  PotentialWorkspace<Dim> workspace;
  for (int i = 0; i < 1000; ++i) {
    PotentialShape<Dim> a, b;
    a.corner_radius = a.sphericity = b.corner_radius = b.sphericity = 1;
    a.sphere_radius = shapes::power_of_ten(random, -2, 0);
    b.sphere_radius = shapes::power_of_ten(random, -2, 0);
    const double size = a.sphere_radius + b.sphere_radius, depth = shapes::power_of_ten(random, -9, -1) * size;
    const Vector<Dim> normal = shapes::direction<Dim>(random);
    const PotentialPair<Dim> pair{&a, &b, Matrix<Dim>::Identity(), (size - depth) * normal};
    const PotentialContact<Dim> found = resolve<Dim>(pair, PotentialQuery::overlap, workspace);
    ASSERT_EQ(found.status, PotentialStatus::touching);
    // the error of a value is the point's displacement over the smaller radius, that of the overlap the size times this
    const double spread = size / std::min(a.sphere_radius, b.sphere_radius);
    ASSERT_NEAR(found.energy_overlap, depth, 8 * epsilon * size * spread);
    ASSERT_NEAR(found.energy_rate, 1, 16 * epsilon * spread);
  }
}
TEST(PotentialConservative, BetweenSpheresItIsTheOverlap) {
  expect_spheres<2>();
  expect_spheres<3>();
}

// k = 0, faces, right-angled edges and corners: Q = t²/r² on both sides
TEST(PotentialConservative, BetweenRightAngledFeaturesItIsTheOverlap) {
  PotentialWorkspace<3> workspace;
  for (const Vector<3>& down : {Vector<3>(0, 0, 1), Vector<3>(0, 1, 1), Vector<3>(1, 1, 1)})
    for (const double r : {1e-3, 0.1}) {
      const PotentialShape<3> block{shapes::box<3>({-2, -2, -1}, {2, 2, 0}), 0.05, 0, 10, {0, 0, -0.5}};
      const PotentialShape<3> cube{shapes::cube<3>(0.5), r, 0, 10};
      const double both = r + 0.05, depth = 0.1 * r;
      const Matrix<3> turn = matrix(rotation_onto(down, Vector<3>(0, 0, -1)));
      const PotentialPair<3> pair{&block, &cube, turn, {0.3, -0.2, both - depth + 0.5 * down.norm()}};
      const PotentialContact<3> found = resolve<3>(pair, PotentialQuery::overlap, workspace);
      ASSERT_EQ(found.status, PotentialStatus::touching);
      EXPECT_NEAR(found.energy_overlap, depth, 32 * epsilon);
      EXPECT_NEAR(found.energy_overlap, found.overlap, 32 * epsilon);
      EXPECT_NEAR(found.energy_rate, 1, 32 * epsilon / r);
    }
}

// Faces at any k: the scale is exact halfway out, |x - c|² = R²/2. Elsewhere the face is at s = r sqrt((1 - k ρ²/R²)
// / (1 - k)), and the decrease of sqrt(f + 1) along the normal is the inverse of the rate.
TEST(PotentialConservative, BetweenFacesTheRateIsThatOfTheSlopes) {
  PotentialWorkspace<3> workspace;
  for (const double r : {1e-3, 0.2})
    for (const double k : {0.01, 0.3, 0.9}) {
      PotentialShape<3> cube{shapes::cube<3>(0.5), r, k};
      cube.sphere_radius = enclosing_radius<3>(cube.planes, r, Vector<3>::Zero());
      const double p = (1 - k) / (r * r), q = k / (cube.sphere_radius * cube.sphere_radius);
      const double s = (1 - q / 4) / (q / 2 + std::sqrt(q * q / 4 + (p + q) * (1 - q / 4)));
      const double depth = 1e-6 * r, slope = p * s + q * (0.5 + s);  // of sqrt(f + 1), where it is 1
      PotentialPair<3> pair{&cube, &cube};
      pair.offset[0] = 1 + 2 * s - depth;
      const PotentialContact<3> found = resolve<3>(pair, PotentialQuery::overlap, workspace);
      ASSERT_EQ(found.status, PotentialStatus::touching);
      const double rate = energy_scale<3>(cube) * slope;
      // to first order in the depth: sqrt(f + 1) bends by no more than its slope over r
      EXPECT_NEAR(found.energy_rate, rate, 2 * depth / r * rate + 16 * epsilon / r);
      EXPECT_NEAR(found.energy_overlap, rate * depth, 2 * depth / r * rate * depth + 16 * epsilon);
    }
}

// the planes outside which the point lies
template <int Dim>
std::vector<bool> counting(const PotentialWorkspace<Dim>& workspace, const Vector<Dim>& point) {
  std::vector<bool> planes;
  for (const PlacedPotential<Dim>* potential : {&workspace.a, &workspace.b})
    for (const HalfSpace<Dim>& plane : potential->planes)
      planes.push_back(signed_distance<Dim>(plane, point) > 0);
  return planes;
}

// Central differences of δ over all motions of the second body. If the same planes count at both ends δ is smooth
// over lengths of r: the difference is off by some (h / r)², and rounding of coordinates adds ε / h.
template <int Dim>
void expect_differences() {
  shapes::Random random(302);
  PotentialWorkspace<Dim> workspace;
  int compared = 0;
  for (int i = 0; i < 1000; ++i) {
    const shapes::PotentialCase<Dim> c = shapes::random_potential_case<Dim>(random, 0.01);
    const double r = std::min(c.a.corner_radius, c.b.corner_radius), h = 1e-4 * r;
    const PotentialContact<Dim> found = resolve<Dim>(c.pair(), PotentialQuery::overlap, workspace);
    if (r < 1e-3 || found.status != PotentialStatus::touching || found.energy_overlap < 10 * h || found.value < -0.5)
      continue;
    const std::vector<bool> planes = counting<Dim>(workspace, found.point);
    const Vector<Dim> force = found.energy_rate * found.normal;  // of δ as its own potential
    const Turn<Dim> turning = moment<Dim>(found.point - c.offset, force);
    for (int k = 0; k < Dim + turns<Dim>; ++k) {
      std::array<double, 2> overlaps{};
      bool smooth = true;
      for (const int side : {0, 1}) {
        PotentialPair<Dim> moved = c.pair();
        const double way = side == 0 ? -h : h;
        if (k < Dim)
          moved.offset[k] += way;
        else
          moved.rotation = rotation_by<Dim>(Turn<Dim>(way * Turn<Dim>::Unit(k - Dim))) * moved.rotation;
        const PotentialContact<Dim> there = resolve<Dim>(moved, PotentialQuery::overlap, workspace);
        overlaps[side] = there.energy_overlap;
        smooth = smooth && counting<Dim>(workspace, there.point) == planes;
      }
      if (!smooth) continue;
      ++compared;
      const double slope = -(overlaps[1] - overlaps[0]) / (2 * h);
      const double expected = k < Dim ? force[k] : turning[k - Dim];
      ASSERT_NEAR(slope, expected, 1e-5 * found.energy_rate) << i << " " << k;
    }
  }
  EXPECT_GT(compared, 300);
}
TEST(PotentialConservative, TheForceIsTheSlopeOfTheOverlap) {
  expect_differences<2>();
  expect_differences<3>();
}

struct Work {
  double bracketed = 0, conservative = 0, gross = 0;  // work around the path; the conservative one's |work|
};

// Once around an ellipse in the space of motions, stiffness 1: Gauss's rule of three points on each of many pieces. The
// same planes count along the entire path, so that the integrand is smooth.
template <int Dim>
Work around(const PotentialPair<Dim>& pair, const Vector<Dim>& to, const Vector<Dim>& across, const Turn<Dim>& turn,
            int pieces) {
  constexpr std::array<double, 3> nodes{-0.7745966692414834, 0, 0.7745966692414834},
      weights{5.0 / 18, 4.0 / 9, 5.0 / 18};
  PotentialWorkspace<Dim> workspace;
  Work work;
  std::vector<bool> planes;
  for (int piece = 0; piece < pieces; ++piece)
    for (int node = 0; node < 3; ++node) {
      const double part = 2 * std::numbers::pi / pieces, angle = part * (piece + (1 + nodes[node]) / 2);
      PotentialPair<Dim> moved = pair;
      // turns about one axis alone: their rate is that of the angle
      moved.rotation = rotation_by<Dim>(Turn<Dim>(std::sin(angle) * turn)) * pair.rotation;
      moved.offset += std::cos(angle) * to + std::sin(angle) * across;
      const PotentialContact<Dim> found = resolve<Dim>(moved, PotentialQuery::overlap, workspace);
      EXPECT_EQ(found.status, PotentialStatus::touching);
      if (planes.empty()) planes = counting<Dim>(workspace, found.point);
      EXPECT_EQ(counting<Dim>(workspace, found.point), planes);
      const Vector<Dim> velocity = -std::sin(angle) * to + std::cos(angle) * across;
      const Turn<Dim> spin = std::cos(angle) * turn;
      const double rate = found.normal.dot(velocity) + moment<Dim>(found.point - moved.offset, found.normal).dot(spin);
      const double weight = part * weights[node];
      work.bracketed += weight * found.overlap * rate;
      work.conservative += weight * conservative_force<Dim>(found, 1) * rate;
      work.gross += weight * std::abs(conservative_force<Dim>(found, 1) * rate);
    }
  return work;
}

// A corner that stands tilted on a slanting face with k > 0, moved and turned around a loop.
TEST(PotentialConservative, AroundClosedPathsItDoesNoWorkAndTheBracketedOverlapDoes) {
  for (const double k : {0.0, 0.1}) {
    const double r = 0.1;
    PotentialShape<3> block{shapes::box<3>({-2, -2, -1}, {2, 2, 0}), r, k, 4, {0, 0, -0.5}};
    PotentialShape<3> wedge{shapes::cube<3>(0.5), r, k, 2};
    wedge.planes[0].normal = Vector<3>(0.8, 0.6, 0);  // an edge that is not right-angled
    const Matrix<3> turned = matrix(rotation_onto(Vector<3>(1, 1.2, 0.9), Vector<3>(0, 0, -1)));
    PotentialPair<3> pair{&block, &wedge, turned, {0.3, -0.2, 0}};
    PotentialWorkspace<3> workspace;
    double low = 0, high = 3;
    for (int i = 0; i < 60; ++i) {
      pair.offset[2] = (low + high) / 2;
      (resolve<3>(pair, PotentialQuery::decision, workspace).status == PotentialStatus::touching ? low : high) =
          pair.offset[2];
    }
    pair.offset[2] = low - 0.1 * r;
    const Work work = around<3>(pair, {0.02 * r, 0, 0.03 * r}, {0.03 * r, 0.01 * r, 0}, {0.02, 0.05, 0.01}, 400);
    // the integrand is periodic and smooth, so that only rounding remains: of coordinates of 1 m, over an overlap of
    // 0.01 m, some 1e-14 of each term
    EXPECT_LE(std::abs(work.conservative), 1e-12 * work.gross) << k;
    EXPECT_GE(std::abs(work.bracketed), 0.01 * work.gross) << k;
  }
}

}  // namespace
}  // namespace voussoir::conservative_test
