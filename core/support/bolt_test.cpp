// The forces of a bolt's spring, against closed forms and its own potential.
#include "core/support/bolt.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace voussoir::bolt_test {
namespace {

constexpr double K = 2e8, ks = 1e7, F0 = 3e4;

BoltProperties bar() {
  BoltProperties p;
  p.stiffness = K;
  return p;
}

// along x, its anchors `length` apart
template <int Dim>
BoltSpring<Dim> spring_of(double length) {
  BoltSpring<Dim> spring;
  spring.axis = Vector<Dim>::Unit(0);
  spring.length = length;
  spring.stiffness = K;
  return spring;
}

// Eqs 5.1 and 5.2
TEST(BoltSpring, FollowsAnOpeningAndSlippingJoint) {
  BoltProperties p = bar();
  p.pretension = F0;
  for (const double length : {0.0672, 1.3, 0.0})
    for (const double opening : {-2e-3, 0.0, 3e-3})
      for (const double slip : {0.0, 0.02}) {
        BoltSpring<2> spring = spring_of<2>(length);
        const Vector<2> apart(length + opening, slip);
        const BoltAnswer<2> answer = bolt_answer<2>(p, apart, spring);
        const double extension = length > 0 ? std::hypot(length + opening, slip) - length : opening;
        EXPECT_NEAR(spring.force, K * extension + F0, 1e-9 * K);
        const Vector<2> along = length > 0 ? Vector<2>(apart.normalized()) : Vector<2>(1, 0);
        EXPECT_LT((answer.on_second + spring.force * along).norm(), 1e-9 * K);
        EXPECT_EQ(answer.lost, 0);
      }
}

TEST(BoltSpring, PushesBackWhenItsAnchorsHavePassedEachOther) {
  BoltSpring<2> spring = spring_of<2>(0.0672);
  const BoltAnswer<2> answer = bolt_answer<2>(bar(), Vector<2>(-0.001, 0), spring);
  EXPECT_NEAR(spring.force, -K * 0.0682, 1e-6);
  EXPECT_GT(answer.on_second[0], 0) << "towards the toe";
}

template <int Dim>
void forces_and_stiffness_have_a_potential(double length, bool cable) {
  BoltProperties p = bar();
  p.pretension = F0;
  p.dowel_stiffness = ks;
  p.tension_only = cable;
  const double way = 1e-7;
  Vector<Dim> apart = Vector<Dim>::Constant(2e-3);
  apart[0] += length;
  BoltSpring<Dim> spring = spring_of<Dim>(length);
  const BoltAnswer<Dim> here = bolt_answer<Dim>(p, apart, spring);
  const Matrix<Dim> stiffness = bolt_stiffness<Dim>(p, apart, spring);
  for (int k = 0; k < Dim; ++k) {
    BoltSpring<Dim> plus = spring, minus = spring;
    const BoltAnswer<Dim> ahead = bolt_answer<Dim>(p, apart + way * Vector<Dim>::Unit(k), plus);
    const BoltAnswer<Dim> behind = bolt_answer<Dim>(p, apart - way * Vector<Dim>::Unit(k), minus);
    EXPECT_NEAR(-here.on_second[k], (ahead.elastic - behind.elastic) / (2 * way), 1e-6 * K * 2e-3);
    const Vector<Dim> lost = (behind.on_second - ahead.on_second) / (2 * way);
    EXPECT_LT((stiffness.col(k) - lost).norm(), 1e-6 * K);
  }
  EXPECT_LE(stiffness.norm(), std::sqrt(static_cast<double>(Dim)) * stiffest<Dim>(p, spring));
}

TEST(BoltSpring, HasAPotential) {
  for (const double length : {0.0, 0.0672, 2.0})
    for (const bool cable : {false, true}) {
      forces_and_stiffness_have_a_potential<2>(length, cable);
      forces_and_stiffness_have_a_potential<3>(length, cable);
    }
}

TEST(BoltSpring, YieldsBothWaysAndLosesTheWorkOfTheForce) {
  BoltProperties p = bar();
  p.yield = 1e5;
  BoltSpring<2> spring = spring_of<2>(1);
  double lost = 0;
  const auto go_to = [&](double x) {
    const BoltAnswer<2> answer = bolt_answer<2>(p, Vector<2>(1 + x, 0), spring);
    lost += answer.lost;
    return answer.elastic;
  };
  const double elastic_limit = 1e5 / K;
  EXPECT_NEAR(go_to(5 * elastic_limit), 0.5 * 1e5 * elastic_limit, 1e-9);
  EXPECT_DOUBLE_EQ(spring.force, 1e5);
  EXPECT_NEAR(spring.plastic, 4 * elastic_limit, 1e-12);
  go_to(3 * elastic_limit);
  EXPECT_NEAR(spring.force, -1e5, 1e-6) << "unloaded by twice its yield";
  go_to(0);
  EXPECT_NEAR(spring.plastic, elastic_limit, 1e-12);
  EXPECT_NEAR(lost, 1e5 * (4 + 3) * elastic_limit, 1e-6);
}

TEST(BoltSpring, GoesSlackAsACable) {
  BoltProperties p = bar();
  p.tension_only = true;
  BoltSpring<2> spring = spring_of<2>(1);
  EXPECT_TRUE(bolt_answer<2>(p, Vector<2>(0.99, 0), spring).on_second.isZero(0));
  bolt_answer<2>(p, Vector<2>(1.001, 0), spring);
  EXPECT_NEAR(spring.force, K * 1e-3, 1e-4) << "it keeps its plastic extension";
}

TEST(BoltSpring, BreaksBeyondItsExtension) {
  BoltProperties p = bar();
  p.yield = 1e5;
  p.rupture_extension = 0.01;
  BoltSpring<2> spring = spring_of<2>(1);
  const double limit = 0.01 + 1e5 / K;
  double lost = bolt_answer<2>(p, Vector<2>(1 + 0.999 * limit, 0), spring).lost;
  EXPECT_FALSE(spring.broken);
  const BoltAnswer<2> broken = bolt_answer<2>(p, Vector<2>(1 + 1.001 * limit, 0), spring);
  lost += broken.lost;
  EXPECT_TRUE(spring.broken && broken.on_second.isZero(0) && broken.elastic == 0);
  EXPECT_NEAR(lost, 1e5 * (1.001 * limit) - 0.5 * 1e5 * 1e5 / K, 1e-6) << "all work is lost";
  EXPECT_TRUE(bolt_answer<2>(p, Vector<2>(1, 0), spring).on_second.isZero(0));
}

TEST(BoltSpring, SlipsAcrossAtItsDowelStrength) {
  BoltProperties p = bar();
  p.dowel_stiffness = ks;
  p.dowel_strength = 5e4;
  BoltSpring<3> spring = spring_of<3>(0);
  const BoltAnswer<3> answer = bolt_answer<3>(p, Vector<3>(0, 0.006, 0.008), spring);
  EXPECT_NEAR(answer.on_second[1], -3e4, 1e-6);
  EXPECT_NEAR(answer.on_second[2], -4e4, 1e-6);
  EXPECT_NEAR(answer.lost, 5e4 * 0.005, 1e-6);
  EXPECT_NEAR(answer.elastic, 0.5 * 5e4 * 0.005, 1e-6);
}

}  // namespace
}  // namespace voussoir::bolt_test
