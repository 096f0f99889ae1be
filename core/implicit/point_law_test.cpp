// A point over one step: its force against its energy, its inverse, and what is lost.
#include "core/implicit/point_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/joint_sets/random_stream.hpp"

namespace voussoir::point_law_test {
namespace {

PointStep some_point(RandomStream& stream) {
  PointStep point;
  point.h = std::pow(10, -4 + 3 * stream.uniform());
  point.normal = std::pow(10, 5 + 6 * stream.uniform());
  point.shear = point.normal * (0.1 + 0.9 * stream.uniform());
  point.friction = stream.uniform();
  const double mass = std::pow(10, 2 + 3 * stream.uniform());
  point.dashpot = stream.uniform() < 0.5 ? 0 : 0.1 * std::sqrt(point.normal * mass);
  point.chi_normal = unresolved_share(point.normal, mass, point.h);
  point.chi_shear = unresolved_share(point.shear, mass, point.h);
  point.rho_normal = softer_of(point.normal, mass, point.h);
  point.rho_shear = softer_of(point.shear, mass, point.h);
  point.overlap = 1e-3 * (2 * stream.uniform() - 1);
  return point;
}

double energy(const PointStep& point, double overlap) {
  return 0.5 * point.normal * std::pow(std::max(overlap, 0.0), 2);
}

TEST(PointLaw, NormalWorkIsTheSpringsEnergyAndItsLoss) {
  RandomStream stream(1, "normal work");
  for (int k = 0; k < 2000; ++k) {
    const PointStep point = some_point(stream);
    const double u1 = 1e-3 * (2 * stream.uniform() - 1);
    const MeanNormal found = mean_normal(point, u1);
    const double stored = energy(point, u1) - energy(point, point.overlap), closed = u1 - point.overlap;
    const double grown = std::max(u1, 0.0) - std::max(point.overlap, 0.0);
    const double lost = found.force * closed - stored;
    const double scale = energy(point, 1e-3);
    EXPECT_GE(lost, -1e-12 * scale);
    if (found.force > 0) {
      EXPECT_NEAR(lost, point.loss() * grown * closed, 1e-12 * (scale + point.loss() * 1e-6));
    }
    const double step = 1e-9;
    const MeanNormal more = mean_normal(point, u1 + step), less = mean_normal(point, u1 - step);
    if (less.force > 0 && (u1 - step) * (u1 + step) > 0) {
      EXPECT_NEAR((more.force - less.force) / (2 * step), found.slope, 1e-5 * (found.slope + point.normal));
    }
  }
}

TEST(PointLaw, OverlapIsTheInverseOfTheForce) {
  RandomStream stream(2, "inverse");
  for (int k = 0; k < 2000; ++k) {
    const PointStep point = some_point(stream);
    const double u1 = 1e-3 * (2 * stream.uniform() - 1);
    const MeanNormal found = mean_normal(point, u1);
    if (!(found.force > 0)) continue;
    const OverlapAfter back = overlap_after(point, found.force);
    EXPECT_NEAR(back.overlap, u1, 1e-9 * 1e-3) << "from " << point.overlap;
    EXPECT_NEAR(back.slope, found.slope, 1e-6 * (found.slope + point.normal));
  }
}

// shear in space: the return, and that nothing is gained
TEST(PointLaw, ShearLosesAndNeverGains) {
  RandomStream stream(3, "shear");
  const Vector<3> n(0, 0, 1);
  int slipped = 0;
  for (int k = 0; k < 2000; ++k) {
    PointStep point = some_point(stream);
    point.overlap = std::abs(point.overlap);
    const double normal = point.normal * point.overlap, u1 = point.overlap * stream.uniform() * 2;
    const Vector<3> from = 0.8 * point.friction * normal * Vector<3>(stream.uniform() - 0.5, stream.uniform() - 0.5, 0);
    const Vector<3> slip = 3 * normal / point.shear * Vector<3>(stream.uniform() - 0.5, stream.uniform() - 0.5, 0);
    PointForce<3> force;
    force.normal = mean_normal(point, u1).force;
    force.shear = from;
    // the equations of shear alone: the motion is given
    for (int i = 0; i < 200; ++i) {
      const LinearPoint<3> line = linearise<3>(point, n, from, u1, slip, force);
      force.normal += n.dot(line.change);
      force.shear += line.change - n.dot(line.change) * n;
    }
    const Vector<3> trial = from - point.sticking() * slip;
    const double most = point.friction * force.normal;
    const Vector<3> expected = trial.norm() > most ? Vector<3>(trial * most / trial.norm()) : trial;
    EXPECT_LT((force.shear - expected).norm(), 1e-6 * (normal + trial.norm())) << k;
    const PointEnd<3> end = end_of_step<3>(point, from, u1, slip, force);
    const double scale = normal * point.overlap;
    EXPECT_GE(end.friction, -1e-9 * scale);
    EXPECT_GE(end.unresolved, -1e-9 * scale);
    EXPECT_GE(end.dashpot, 0);
    const double work = force.normal * (u1 - point.overlap) - force.shear.dot(slip);
    EXPECT_NEAR(work, end.elastic - end.elastic_before + end.friction + end.unresolved + end.dashpot,
                1e-9 * (scale + std::abs(work)));
    EXPECT_LE(end.shear.norm(), point.friction * point.normal * u1 * (1 + 1e-12));
    slipped += end.plastic_slip > 0 && !end.stuck;
  }
  EXPECT_GT(slipped, 200);
  EXPECT_LT(slipped, 1900);
}

}  // namespace
}  // namespace voussoir::point_law_test
