#include "reference/arch/loaded_arch.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace voussoir::reference::loaded_arch_test {
namespace {

constexpr double pi = std::numbers::pi;

// The linear program of the static theorem: force and moment (about the centre) of the left abutment, and the load, as
// large as possible while every joint's force passes between its ends. Its optimum is at a corner, where four of the
// conditions hold as equations; all of them are tried. Weights and centroids come from the corners of the voussoirs.
double greatest_load_of_thrust_lines(const LoadedArch& loaded) {
  const int n = loaded.arch.voussoirs;
  const double inside = loaded.arch.radius - 0.5 * loaded.thickness, outside = inside + loaded.thickness;
  Eigen::Matrix<double, Eigen::Dynamic, 4> of(2 * n + 2, 4);  // of (thrust, upward force, moment, load) >= of_weights
  Eigen::VectorXd of_weights(2 * n + 2);
  double weight = 0, moment = 0;
  bool passed = false;
  for (int joint = 0; joint <= n; ++joint) {
    const double angle = joint * pi / n - 0.5 * pi;
    for (const bool outer : {false, true}) {
      const double radius = outer ? outside : inside, x = radius * std::sin(angle), y = radius * std::cos(angle);
      // moment of the forces on the left about that end: of one sense about the inner end, of the other about the outer
      const double sense = outer ? 1 : -1;
      const int row = 2 * joint + outer;
      of.row(row) << sense * y, -sense * x, sense, passed ? sense * (x - loaded.x) : 0;
      of_weights[row] = sense * (moment - weight * x);
    }
    if (joint == n) break;
    const std::vector<Corner> c = voussoir_corners(loaded.arch, loaded.thickness, joint);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Corner &p = c[i], &q = c[(i + 1) % c.size()];
      const double twice = p.x * q.y - q.x * p.y;
      weight += loaded.arch.weight * 0.5 * twice;
      moment += loaded.arch.weight * (p.x + q.x) * twice / 6;
    }
    passed = passed || loaded.x < c[2].x;
  }
  const double rounding = 1e-9 * loaded.arch.weight * std::pow(loaded.arch.radius, 3);
  double most = -1;
  const int rows = 2 * n + 2;
  for (int a = 0; a < rows; ++a)
    for (int b = a + 1; b < rows; ++b)
      for (int c = b + 1; c < rows; ++c)
        for (int d = c + 1; d < rows; ++d) {
          Eigen::Matrix4d equations;
          equations << of.row(a), of.row(b), of.row(c), of.row(d);
          const Eigen::Vector4d right(of_weights[a], of_weights[b], of_weights[c], of_weights[d]);
          const Eigen::FullPivLU<Eigen::Matrix4d> solver(equations);
          if (!solver.isInvertible()) continue;
          const Eigen::Vector4d corner = solver.solve(right);
          if (corner[3] > most && (of * corner - of_weights).minCoeff() > -rounding) most = corner[3];
        }
  return most;
}

const LoadedArch quarter{{15, 5, 25e3}, 0.75, -2.5};

TEST(RigidLoad, IsTheLoadOfTheBestThrustLine) {
  for (const LoadedArch& loaded :
       {LoadedArch{{9, 5, 25e3}, 0.9, -2.5}, {{9, 5, 25e3}, 0.9, 0.3}, {{12, 2, 1}, 0.3, 1.7}})
    EXPECT_NEAR(greatest_load_of_thrust_lines(loaded) / greatest_rigid_load(loaded).load, 1, 1e-9);
  EXPECT_NEAR(greatest_load_of_thrust_lines(quarter) / greatest_rigid_load(quarter).load, 1, 1e-9);
}

// both theorems: the thrust line through the hinges of the mechanism stays inside, and touches at the hinges
TEST(RigidLoad, IsProvedByItsThrustLine) {
  for (const double x : {-4.5, -3.2, -2.5, -1.0, 0.0, 0.7, 3.9}) {
    const LoadedArch loaded{{15, 5, 25e3}, 0.75, x};
    const RigidLoad found = greatest_rigid_load(loaded);
    EXPECT_NEAR(found.margin, 0, 1e-12 * loaded.arch.radius) << x;
    ASSERT_EQ(found.hinges.size(), 4u);
    for (const Hinge& hinge : found.hinges)
      EXPECT_NEAR(found.radius[hinge.joint] - 5, hinge.outside ? 0.375 : -0.375, 1e-11) << x;
  }
}

TEST(RigidLoad, HasHingesUnderTheLoadAndAtTheFarSpringing) {
  const RigidLoad found = greatest_rigid_load(quarter);
  const std::vector<std::pair<int, bool>> expected{{2, false}, {6, true}, {11, false}, {15, true}};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(std::pair(found.hinges[i].joint, found.hinges[i].outside), expected[i]);
  EXPECT_EQ(loaded_point(quarter).voussoir, 5);  // left of the hinge outside
}

TEST(RigidLoad, IsTheMirrorImageForALoadOnTheOtherSide) {
  LoadedArch other = quarter;
  other.x = -quarter.x;
  EXPECT_NEAR(greatest_rigid_load(other).load / greatest_rigid_load(quarter).load, 1, 1e-12);
  EXPECT_NEAR(greatest_rigid_load({{15, 50, 3}, 7.5, -25}).load,
              greatest_rigid_load({{15, 5, 3}, 0.75, -2.5}).load * 100, 1e-9);
}

TEST(RigidLoad, VanishesAtTheLeastThickness) {
  const double least = minimum_thickness(quarter.arch);
  // to the first order the added thickness supports the load
  const auto carried = [&](double added) {
    return greatest_rigid_load({quarter.arch, (1 + added) * least, quarter.x}).load;
  };
  EXPECT_NEAR(carried(1e-5) / carried(1e-6), 10, 1e-3);
  EXPECT_THROW(carried(-1e-6), std::invalid_argument);
  EXPECT_THROW(greatest_rigid_load({quarter.arch, 0.75, 6}), std::invalid_argument);
}

// the whole arch, unloaded, against its half
TEST(ElasticLoad, IsTheUnloadedArchWithoutALoad) {
  const ArchJoints joints{3e10, 2e10};
  const ElasticLoad whole = elastic_load(quarter, joints, 0);
  const ElasticArch half = elastic_arch(quarter.arch, joints, quarter.thickness);
  EXPECT_NEAR(whole.thrust / half.thrust, 1, 1e-9);
  for (std::size_t k = 0; k < half.joints.size(); ++k) {
    const ElasticJoint &right = whole.joints[whole.joints.size() - 1 - k], &left = whole.joints[k];
    EXPECT_NEAR(right.angle, half.joints[k].angle, 1e-12);
    EXPECT_NEAR(right.crossing, half.joints[k].crossing, 1e-8);
    EXPECT_NEAR(left.crossing, half.joints[k].crossing, 1e-8);
  }
}

TEST(ElasticLoad, ApproachesTheRigidLoadByTheCubeRootOfTheCompliance) {
  const double rigid = greatest_rigid_load(quarter).load;
  double last = 0;
  for (const double stiffness : {1e12, 1e13, 1e14}) {
    const ElasticLoad found = greatest_elastic_load(quarter, {stiffness, stiffness});
    const double lost = 1 - found.load / rigid;
    EXPECT_GT(lost, 0);
    // the next power is relatively as large as the loss
    if (last > 0) {
      EXPECT_NEAR(last / lost, std::cbrt(10.0), last * std::cbrt(10.0));
      // a line over k^-1/3 meets the rigid load where k is infinite, but for that part
      EXPECT_NEAR(lost - (last - lost) / (std::cbrt(10.0) - 1), 0, last * lost);
    }
    last = lost;
  }
}

TEST(ElasticLoad, HasTheHingesOfTheRigidArch) {
  const RigidLoad rigid = greatest_rigid_load(quarter);
  const ElasticLoad found = greatest_elastic_load(quarter, {1e14, 1e14});
  const double lost = 1 - found.load / rigid.load;
  EXPECT_NEAR(found.thrust / rigid.thrust, 1, lost);
  for (const Hinge& hinge : rigid.hinges) {
    const ElasticJoint& joint = found.joints[hinge.joint];
    EXPECT_NEAR(joint.crossing, hinge.outside ? 0.375 : -0.375, lost * 0.375);
    EXPECT_EQ(joint.turn > 0, hinge.outside);
  }
}

// The integration begins on the right: a load on the other side comes late instead of early.
TEST(ElasticLoad, IsTheSameFromEitherSide) {
  const ArchJoints joints{1e11, 1e11};
  LoadedArch other = quarter;
  other.x = -quarter.x;
  const ElasticLoad left = greatest_elastic_load(quarter, joints), right = greatest_elastic_load(other, joints);
  EXPECT_NEAR(left.load / right.load, 1, 1e-9);
  EXPECT_NEAR(left.drop / right.drop, 1, 1e-4);  // a flat maximum
  for (std::size_t k = 0; k < left.joints.size(); ++k)
    EXPECT_NEAR(left.joints[k].crossing, right.joints[left.joints.size() - 1 - k].crossing, 1e-5);
}

TEST(ElasticLoad, DependsOnWeightOverStiffnessOnly) {
  const ElasticLoad one = greatest_elastic_load({{15, 5, 25e3}, 0.75, -2.5}, {1e11, 1e11}),
                    other = greatest_elastic_load({{15, 0.5, 50e3}, 0.075, -0.25}, {2e11, 2e11});
  EXPECT_NEAR(one.load / 100, other.load / 2, 1e-7 * one.load);
}

TEST(ElasticLoad, HasItsStableEquilibriumBelowTheGreatestLoadOnly) {
  const ArchJoints joints{1e11, 1e11};
  const ElasticLoad limit = greatest_elastic_load(quarter, joints);
  const ElasticLoad less = elastic_load(quarter, joints, 0.99 * limit.load);
  EXPECT_NEAR(less.load, 0.99 * limit.load, 1e-6 * limit.load);
  EXPECT_LT(less.drop, limit.drop);
  EXPECT_THROW(elastic_load(quarter, joints, 1.001 * limit.load), std::runtime_error);
  const std::vector<ElasticLoad> path = elastic_load_path(quarter, joints);
  for (const ElasticLoad& state : path)
    EXPECT_LE(state.load, (1 + 1e-9) * limit.load);
  EXPECT_LT(path.back().load, 0.98 * limit.load);
}

}  // namespace
}  // namespace voussoir::reference::loaded_arch_test
