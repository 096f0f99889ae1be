// Random pairs: two solvers that share only the function, and a proof in 113 bits of both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#ifdef VOUSSOIR_HAS_IPOPT
#include "core/potential/ipopt.hpp"
#endif
#include "core/testing/potential_pairs.hpp"
#include "core/testing/potential_referee.hpp"

namespace voussoir::certainty_test {
namespace {

using referee::Quad;

constexpr double point_tolerance = 1e-9;   // of the size, which is 1
constexpr double value_tolerance = 1e-10;  // of f + 1, of which f loses the rounding

// The proof's gap bounds the point's own uncertainty: sqrt(2 gap / curvature), 1e-11 at k = 0.01.
constexpr double proof_gap = 1e-26;

struct Tally {
  int pairs = 0, without_answer = 0, undecided = 0, asked_outside = 0, outside_unsure = 0, disagreed = 0;
  double point_off = 0, value_off = 0;  // at worst, m and of f + 1
  long long iterations = 0;
  int most_iterations = 0;
};

template <int Dim>
void expect_proven(const referee::Verdict<Dim>& truth, const PotentialContact<Dim>& found, int index, Tally& tally) {
  ASSERT_TRUE(truth.proven) << index;
  ASSERT_LE(truth.point_error, point_tolerance / 10) << index;
  ASSERT_LE(truth.distance_to(found.point), point_tolerance) << index;
  const double terms = 1 + std::max(0.0, found.value + 1);
  const double value_off = std::abs(static_cast<double>(truth.value - Quad(found.value))) / terms;
  ASSERT_LE(value_off, value_tolerance) << index;
  tally.point_off = std::max(tally.point_off, truth.distance_to(found.point));
  tally.value_off = std::max(tally.value_off, value_off);
  // the two bounds hold, but for the rounding that is stated
  ASSERT_GE(static_cast<double>(Quad(found.value) - truth.bound), -found.rounding) << index;
  ASSERT_LE(static_cast<double>(Quad(found.bound) - truth.value), found.rounding) << index;
  if (found.status == PotentialStatus::touching) {
    ASSERT_LT(truth.value, 0) << index;
  }
  if (found.status == PotentialStatus::separated) {
    ASSERT_GT(truth.bound, 0) << index;
  }
  // nothing is left undecided beyond the rounding
  if (found.status == PotentialStatus::undecided) {
    ASSERT_LE(std::abs(static_cast<double>(truth.value)), 4 * found.rounding) << index;
  }
}

#ifdef VOUSSOIR_HAS_IPOPT
// A result whose error Ipopt reports above this, which it would not call acceptable either, is no reference.
constexpr double outside_error = 1e-12;

// If the two disagree both are compared with the proven point, to show which of them is wrong.
template <int Dim>
void ask_outside(const shapes::PotentialCase<Dim>& c, const referee::Verdict<Dim>& truth,
                 const PotentialContact<Dim>& found, int index, Tally& tally) {
  const ConeAnswer<Dim> other = solve_cone_program<Dim>(c.pair(), ConeReading::linked);
  ++tally.asked_outside;
  if (!other.solved || other.error > outside_error) {
    ++tally.outside_unsure;
    return;
  }
  const double value = std::max(other.value_a, other.value_b), terms = 1 + std::max(0.0, found.value + 1);
  const double apart = (other.point - found.point).norm();
  if (apart <= point_tolerance && std::abs(value - found.value) <= value_tolerance * terms) return;
  ++tally.disagreed;
  const auto above = [&](const Vector<Dim>& point) {
    return static_cast<double>(referee::larger_value<Dim>(c.pair(), point) - truth.bound);
  };
  std::cout << "pair " << index << " of dimension " << Dim << ": " << apart << " m apart; from the proven point "
            << truth.distance_to(found.point) << " (ours), " << truth.distance_to(other.point)
            << " (Ipopt's); above the proven value " << above(found.point) << " (ours), " << above(other.point)
            << " (Ipopt's); Ipopt reports an error of " << other.error << '\n';
}
#endif

// those of the seed's pairs from `first` on
template <int Dim>
void judge_pairs(unsigned seed, int first, int pairs) {
  shapes::Random random(seed);
  PotentialWorkspace<Dim> workspace;
  Tally tally;
  for (int i = 0; i < first + pairs && !testing::Test::HasFatalFailure(); ++i) {
    const shapes::PotentialCase<Dim> c = shapes::random_potential_case<Dim>(random, 0.01);
    if (i < first) continue;
    const PotentialContact<Dim> found = resolve<Dim>(c.pair(), PotentialQuery::least, workspace);
    ++tally.pairs;
    tally.without_answer += found.status == PotentialStatus::no_answer;
    tally.undecided += found.status == PotentialStatus::undecided;
    const referee::Verdict<Dim> truth = referee::judge<Dim>(c.pair(), found.point, found.ratio, proof_gap);
    expect_proven<Dim>(truth, found, i, tally);
    tally.iterations += found.iterations;
    tally.most_iterations = std::max(tally.most_iterations, found.iterations);
#ifdef VOUSSOIR_HAS_IPOPT
    ask_outside<Dim>(c, truth, found, i, tally);
#endif
  }
  testing::Test::RecordProperty("dimension", Dim);
  testing::Test::RecordProperty("undecided", tally.undecided);
  testing::Test::RecordProperty("asked_outside", tally.asked_outside);
  testing::Test::RecordProperty("outside_unsure", tally.outside_unsure);
  testing::Test::RecordProperty("disagreed", tally.disagreed);
  testing::Test::RecordProperty("point_off", std::to_string(1e16 * tally.point_off) + "e-16");
  testing::Test::RecordProperty("value_off", std::to_string(1e16 * tally.value_off) + "e-16");
  testing::Test::RecordProperty("mean_iterations", std::to_string(static_cast<double>(tally.iterations) / tally.pairs));
  testing::Test::RecordProperty("most_iterations", tally.most_iterations);
  EXPECT_EQ(tally.without_answer, 0);
  EXPECT_EQ(tally.disagreed, 0);
  EXPECT_LE(1000 * tally.outside_unsure, tally.asked_outside);
}

// Eq. A.3, in exact digits and, by Ipopt, through Eqs A.6-A.9; Ipopt takes most of the time
TEST(PotentialCertainty, RandomPairs) {
  judge_pairs<2>(1, 0, 25);
  judge_pairs<3>(2, 0, 25);
}

TEST(PotentialPairsLong, MoreRandomPairs) {
  judge_pairs<2>(1, 25, 475);
  judge_pairs<3>(2, 25, 475);
}

// 100,000 of each dimension, in parts of which each takes Ipopt some minutes: --gtest_filter=*CertaintyLong*Space/3
class PotentialCertaintyLong : public testing::TestWithParam<int> {};
constexpr int part = 10000;

TEST_P(PotentialCertaintyLong, RandomPairsInThePlane) {
  judge_pairs<2>(11, GetParam() * part, part);
}
TEST_P(PotentialCertaintyLong, RandomPairsInSpace) {
  judge_pairs<3>(12, GetParam() * part, part);
}
INSTANTIATE_TEST_SUITE_P(Parts, PotentialCertaintyLong, testing::Range(0, 10));

// k down to 0, at which the least point need not be unique: the value alone, and both decisions. The referee needs some
// curvature: k = 1e-16 changes the value by less than 1e-14. If the inner bodies overlap and k is below 1e-6, only the
// spheres' last digits determine the least point; the solver may then report that it has no result.
template <int Dim>
void expect_values_without_spheres(int pairs) {
  shapes::Random random(291);
  PotentialWorkspace<Dim> workspace;
  int without_answer = 0;
  for (int i = 0; i < pairs; ++i) {
    shapes::PotentialCase<Dim> c = shapes::random_potential_case<Dim>(random, 0);
    if (i % 2 == 0) c.a.sphericity = c.b.sphericity = shapes::power_of_ten(random, -16, -2);
    const PotentialContact<Dim> found = resolve<Dim>(c.pair(), PotentialQuery::least, workspace);
    if (found.status == PotentialStatus::no_answer && c.a.sphericity > 0 && c.a.sphericity < 1e-6) {
      ++without_answer;
      continue;
    }
    ASSERT_NE(found.status, PotentialStatus::no_answer) << i;
    for (PotentialShape<Dim>* shape : {&c.a, &c.b})
      shape->sphericity = std::max(shape->sphericity, 1e-16);
    const referee::Verdict<Dim> truth = referee::judge<Dim>(c.pair(), found.point, found.ratio, value_tolerance / 10);
    ASSERT_TRUE(truth.proven) << i;
    const double terms = 2 + std::max(0.0, found.value);
    ASSERT_LE(std::abs(static_cast<double>(truth.value - Quad(found.value))), value_tolerance * terms) << i;
    ASSERT_LE(static_cast<double>(Quad(found.bound) - truth.value), found.rounding + value_tolerance / 10) << i;
    // half of the pairs were given another k after they were placed
    if (i % 2 == 1) {
      ASSERT_EQ(found.status, c.depth > 0 ? PotentialStatus::touching : PotentialStatus::separated) << i;
    }
  }
  EXPECT_LE(100 * without_answer, pairs);
}
TEST(PotentialCertainty, ValuesWithoutSpheres) {
  expect_values_without_spheres<2>(500);
  expect_values_without_spheres<3>(500);
}

#ifdef VOUSSOIR_HAS_IPOPT
// Two spheres: Eq. A.10 without s_A = s_B minimises D_A / R_A + D_B / R_B, which is least at the centre of the smaller
// one.
TEST(PotentialOutside, WithoutTheLinkTheProgramLeavesTheContact) {
  PotentialShape<3> a, b;
  a.corner_radius = b.corner_radius = a.sphericity = b.sphericity = 1;
  a.sphere_radius = 2;
  b.sphere_radius = 1;
  const PotentialPair<3> pair{&a, &b, Matrix<3>::Identity(), {2.9, 0, 0}};
  const ConeAnswer<3> linked = solve_cone_program<3>(pair, ConeReading::linked);
  const ConeAnswer<3> unlinked = solve_cone_program<3>(pair, ConeReading::unlinked);
  EXPECT_TRUE(linked.solved);
  EXPECT_LE((linked.point - Vector<3>(2 * 2.9 / 3, 0, 0)).norm(), 1e-9);
  EXPECT_LE((unlinked.point - Vector<3>(2.9, 0, 0)).norm(), 1e-4);
  EXPECT_NEAR(unlinked.value_b, -1, 1e-6);
  EXPECT_GT(unlinked.value_a, 0);
}
#endif

}  // namespace
}  // namespace voussoir::certainty_test
