// Numbers of 106 bits, and the convex program of feasibility against enumeration of all bases.
#include "core/solvers/feasibility.hpp"

#include <gtest/gtest.h>

#include "core/solvers/double_double.hpp"
#include "core/solvers/extended_precision_feasibility.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/random_pair.hpp"

namespace voussoir::feasibility_test {
namespace {

using shapes::Random;
using shapes::random_pair;

// the LP's value has an error of a few ulp of the coordinates (of order one here), more when the basis is badly
// conditioned
constexpr double lp_tolerance = 1e-12;

// multipliers satisfy their equations within the same rounding
constexpr double certificate_tolerance = 1e-12;

template <int Dim>
void expect_certificate(const HalfSpaces<Dim>& planes, const FeasibilityResult<Dim>& r) {
  Vector<Dim> direction = Vector<Dim>::Zero();
  double sum = 0, value = 0;
  for (int k = 0; k <= Dim; ++k) {
    ASSERT_GE(r.basis[k], 0);
    EXPECT_GE(r.multipliers[k], -certificate_tolerance);
    direction += r.multipliers[k] * planes[r.basis[k]].normal;
    sum += r.multipliers[k];
    value -= r.multipliers[k] * planes[r.basis[k]].offset;
  }
  EXPECT_LT(direction.norm(), certificate_tolerance);
  EXPECT_NEAR(sum, 1, certificate_tolerance);
  EXPECT_NEAR(value, r.value, lp_tolerance);
  for (const HalfSpace<Dim>& p : planes)
    EXPECT_LE(signed_distance<Dim>(p, r.point), r.value + lp_tolerance);
}

// ---- numbers of 106 bits --------------------------------------------------------------------------------------------

TEST(DoubleDouble, KeepsTwiceTheDigits) {
  using Quad = __float128;  // 113 bits
  const auto quad = [](const DoubleDouble& x) { return Quad(x.high) + Quad(x.low); };
  const auto expect_near = [&](const DoubleDouble& x, Quad exact, Quad terms) {
    EXPECT_LE(std::abs(static_cast<double>((quad(x) - exact) / terms)), 0x1p-102);
    EXPECT_EQ(x.high + x.low, x.high);  // the halves do not overlap
  };
  Random random(14);
  const auto number = [&] {
    const double high = shapes::uniform(random, -1, 1) * shapes::power_of_ten(random, -12, 12);
    return exact_sum(high, 0x1p-54 * high * shapes::uniform(random, -1, 1));
  };
  for (int i = 0; i < 10'000; ++i) {
    const DoubleDouble a = number();
    DoubleDouble b = number();
    if (i % 3 == 0)
      b = -a + shapes::uniform(random, -1, 1) * shapes::power_of_ten(random, -31, -1) * a.high;  // cancels
    const Quad x = quad(a), y = quad(b);
    const Quad size = (x < 0 ? -x : x) + (y < 0 ? -y : y);
    expect_near(a + b, x + y, size);
    expect_near(a - b, x - y, size);
    expect_near(a * b, x * y, x * y);
    expect_near(a / b, x / y, x / y);
    EXPECT_EQ(a < b, x < y);
    EXPECT_EQ(a > b, x > y);
  }
}

// ---- feasibility ----------------------------------------------------------------------------------------------------

template <int Dim>
void expect_best_of_all_bases(std::uint64_t seed, int trials) {
  Random random(seed);
  int separate = 0;
  for (int i = 0; i < trials; ++i) {
    const HalfSpaces<Dim> planes = random_pair<Dim>(random, shapes::integer(random, 0, 3));
    const FeasibilityResult<Dim> r = solve_feasibility<Dim>(planes, {});
    ASSERT_EQ(r.status, FeasibilityStatus::optimal);
    EXPECT_NEAR(r.value, static_cast<double>(oracle::feasibility<Dim>(planes)), lp_tolerance);
    expect_certificate<Dim>(planes, r);
    const FeasibilityResult<Dim> extended = solve_feasibility_in_extended_precision<Dim>(planes, {});
    ASSERT_EQ(extended.status, FeasibilityStatus::optimal);
    EXPECT_NEAR(extended.value, r.value, lp_tolerance);
    expect_certificate<Dim>(planes, extended);
    separate += r.value > 0;
  }
  // both outcomes must have occurred
  EXPECT_GT(separate, trials / 10);
  EXPECT_LT(separate, trials - trials / 10);
}

// Eqs 3.7 and 3.27
TEST(Feasibility, IsTheBestOfAllBases3D) {
  expect_best_of_all_bases<3>(11, 100);
}
TEST(Feasibility, IsTheBestOfAllBases2D) {
  expect_best_of_all_bases<2>(12, 300);
}

TEST(Feasibility, OnALineIsAnInterval) {
  const HalfSpaces<1> planes{{Vector<1>(1), 5}, {Vector<1>(-1), -2}, {Vector<1>(1), 7}, {Vector<1>(-1), 3}};
  const FeasibilityResult<1> r = solve_feasibility<1>(planes, {});
  ASSERT_EQ(r.status, FeasibilityStatus::optimal);
  EXPECT_NEAR(r.value, -1.5, lp_tolerance);
  EXPECT_NEAR(r.point[0], 3.5, lp_tolerance);
}

TEST(Feasibility, TouchingIsZeroAndGapsAreHalved) {
  for (const double gap : {0.0, 1e-12, 1e-6, 0.5, 100.0, -1e-12, -0.25}) {
    HalfSpaces<3> planes = shapes::cube<3>(1);
    for (const HalfSpace<3>& p : shapes::box<3>({1 + gap, -1, -1}, {3 + gap, 1, 1}))
      planes.push_back(p);
    const FeasibilityResult<3> r = solve_feasibility<3>(planes, {});
    ASSERT_EQ(r.status, FeasibilityStatus::optimal);
    EXPECT_NEAR(r.value, gap / 2, 4e-16 * (1 + std::abs(gap)));
  }
}

TEST(Feasibility, DegenerateInputEnds) {
  // 400 planes tangent to one ball: every basis that encloses the centre is optimal
  Random random(13);
  HalfSpaces<3> ball;
  HalfSpaces<2> disc;
  for (int i = 0; i < 400; ++i) {
    ball.push_back({shapes::direction<3>(random), 1});
    disc.push_back({shapes::direction<2>(random), 1});
  }
  EXPECT_NEAR(solve_feasibility<3>(ball, {}).value, -1, lp_tolerance);
  EXPECT_NEAR(solve_feasibility<2>(disc, {}).value, -1, lp_tolerance);

  // every plane four times, and all planes of four cubes that meet at a point
  HalfSpaces<3> repeated, corner;
  for (int i = 0; i < 4; ++i) {
    for (const HalfSpace<3>& p : shapes::cube<3>(1))
      repeated.push_back(p);
    const Vector<3> low(i & 1 ? 0 : -1, i & 2 ? 0 : -1, 0);
    for (const HalfSpace<3>& p : shapes::box<3>(low, low + Vector<3>::Ones()))
      corner.push_back(p);
  }
  for (const auto& [planes, value] : {std::pair{repeated, -1.0}, {corner, 0.0}}) {
    const FeasibilityResult<3> r = solve_feasibility<3>(planes, {});
    ASSERT_EQ(r.status, FeasibilityStatus::optimal);
    EXPECT_NEAR(r.value, value, lp_tolerance);
    expect_certificate<3>(planes, r);
  }
}

TEST(Feasibility, OpenRegionsAreUnbounded) {
  EXPECT_EQ(solve_feasibility<3>({{Vector<3>(0, 0, 1), 1}}, {}).status, FeasibilityStatus::unbounded);
  EXPECT_EQ(solve_feasibility<2>({{Vector<2>(1, 0), 1}, {Vector<2>(0, 1), 1}}, {}).status,
            FeasibilityStatus::unbounded);
  HalfSpaces<3> wedge = shapes::cube<3>(1);
  wedge.erase(wedge.begin());
  wedge[0] = {Vector<3>(0.6, 0.8, 0), 1};  // two faces gone, one tilted
  EXPECT_EQ(solve_feasibility<3>({wedge[0], wedge[1], wedge[3]}, {}).status, FeasibilityStatus::unbounded);
}

TEST(Feasibility, AZeroNormalOnlyBoundsTheValue) {
  HalfSpaces<3> planes = shapes::cube<3>(1);
  planes.push_back({Vector<3>::Zero(), 0.25});  // requires -0.25 <= s
  const FeasibilityResult<3> r = solve_feasibility<3>(planes, {});
  ASSERT_EQ(r.status, FeasibilityStatus::optimal);
  EXPECT_NEAR(r.value, -0.25, lp_tolerance);
}

TEST(Feasibility, StartsAnywhereAndEndsTheSame) {
  Random random(14);
  for (int i = 0; i < 100; ++i) {
    HalfSpaces<3> planes = random_pair<3>(random, 6);
    const FeasibilityResult<3> cold = solve_feasibility<3>(planes, {});
    // the final basis of a shifted problem, a useless basis, and another order of the planes
    HalfSpaces<3> shifted = planes;
    for (HalfSpace<3>& p : shifted)
      p.offset += shapes::uniform(random, -0.05, 0.05);
    const std::array<int, 4> warm = solve_feasibility<3>(shifted, {}).basis, useless{0, 0, 0, 0};
    EXPECT_NEAR(solve_feasibility<3>(planes, {&warm}).value, cold.value, lp_tolerance);
    EXPECT_NEAR(solve_feasibility<3>(planes, {&useless}).value, cold.value, lp_tolerance);
    const FeasibilityResult<3> again = solve_feasibility<3>(planes, {&cold.basis});
    EXPECT_LE(again.pivots, 1);  // one pass to polish the result
    shapes::shuffle(planes, random);
    EXPECT_NEAR(solve_feasibility<3>(planes, {}).value, cold.value, lp_tolerance);
  }
}

TEST(Feasibility, StopsEarlyOnlyOnProof) {
  Random random(15);
  int stopped = 0;
  for (int i = 0; i < 100; ++i) {
    const HalfSpaces<3> planes = random_pair<3>(random, 6);
    const double value = solve_feasibility<3>(planes, {}).value;
    const FeasibilityResult<3> r = solve_feasibility<3>(planes, {nullptr, 0.0, 0});
    if (r.status == FeasibilityStatus::separated_early) {
      ++stopped;
      EXPECT_GT(r.value, 0);
      EXPECT_LE(r.value, value + lp_tolerance);
    } else {
      EXPECT_LE(value, 0);
    }
  }
  EXPECT_GT(stopped, 10);
}

TEST(Feasibility, PowersOfTwoScaleItExactly) {
  Random random(16);
  for (int i = 0; i < 50; ++i) {
    const HalfSpaces<3> planes = random_pair<3>(random, 5);
    const FeasibilityResult<3> one = solve_feasibility<3>(planes, {});
    for (const double factor : {0x1p-10, 0x1p13}) {
      const FeasibilityResult<3> other = solve_feasibility<3>(shapes::scaled<3>(planes, factor), {});
      EXPECT_EQ(other.value, factor * one.value);
      EXPECT_EQ(other.basis, one.basis);
    }
  }
}

// Two blocks between parallel joints, corner in corner by 1e-13 m, turned by 1e-10: pivoting from one block's own basis
// comes to two pairs of opposite faces, which are dependent. The values from their stale inverse were no result.
TEST(Feasibility, ADependentBasisIsLeftForAFreshStart) {
  const HalfSpaces<3> planes{
      {{-0x1.fe0d3b41815a2p-1, -0x1.194f4cfc107e4p-54, -0x1.64fd6b8c281p-4}, 0x1.fe0d3b41815a3p-2},
      {{-0x1.1d06c968d9e19p-3, -0x1.3a6704e715ff1p-57, -0x1.fb046a930947ap-1}, 0x1.fb046a9309478p-2},
      {{-0x0p+0, -0x1.f838b8c811c17p-1, -0x1.63a1a7e0b738cp-3}, 0x1.f838b8c811c15p-2},
      {{0x0p+0, 0x1.f838b8c811c17p-1, 0x1.63a1a7e0b738cp-3}, 0x1.f838b8c811c18p-2},
      {{0x1.1d06c968d9e19p-3, 0x1.3a6704e715ff1p-57, 0x1.fb046a930947ap-1}, 0x1.fb046a930947cp-2},
      {{0x1.fe0d3b41815a2p-1, 0x1.194f4cfc107e4p-54, 0x1.64fd6b8c281p-4}, 0x1.fe0d3b41815a2p-2},
      {{-0x1.fe0d3b4143818p-1, 0x1.baf8301fcf7ap-35, -0x1.64fd6ba23f4e3p-4}, 0x1.fe0d3b45063d8p-2},
      {{-0x1.1d06c95ddf14fp-3, 0x1.c107147efa63fp-33, -0x1.fb046a936c09bp-1}, 0x1.7c434febeae3cp+0},
      {{0x1.9f7e81cd101cp-36, -0x1.f838b8c7c4c87p-1, -0x1.63a1a7e7895aep-3}, -0x1.f838b8c66c9c8p-2},
      {{0x1.2189defdd8061p-35, 0x1p+0, 0x1.bb447cd1cabeap-33}, 0x1.ce103451b5c5p+0},
      {{0x1.1d06c95ddf14fp-3, -0x1.c107147efa63fp-33, 0x1.fb046a936c09bp-1}, -0x1.fb046a8999002p-2},
      {{0x1.fe0d3b4143818p-1, -0x1.baf8301fcf7ap-35, 0x1.64fd6ba23f4e3p-4}, 0x1.fe0d3b3dfc76ep-2},
  };
  const std::array<int, 4> own{0, 2, 1, 3};
  const FeasibilityResult<3> answer = solve_feasibility<3>(planes, {&own, -4.9e-14, 4.9e-16});
  const FeasibilityResult<3> cold = solve_feasibility<3>(planes, {});
  EXPECT_EQ(answer.status, FeasibilityStatus::optimal);
  constexpr double rounding = 2e-15;  // m, of coordinates of 1 m
  EXPECT_NEAR(answer.value, cold.value, rounding);
  for (const HalfSpace<3>& plane : planes)
    EXPECT_LT(signed_distance<3>(plane, answer.point), answer.value + rounding);
}

// Two squares corner in corner by 1e-13 m, turned by 1e-13: the multiplier of the side face, 5e-14, passed for rounding
// and went below zero, and squares that overlap were found separate, by a value 1e-13 too high.
TEST(Feasibility, ASmallMultiplierIsNotRounding) {
  const HalfSpaces<2> planes{
      {{-0x1p+0, -0x0p+0}, 0x1.7ffffffffffa4p+1},  {{-0x0p+0, -0x1p+0}, 0x1.0921a29a6fc8bp+0},
      {{0x0p+0, 0x1p+0}, 0x1.edbcbacb206eap-1},    {{0x1p+0, 0x0p+0}, -0x1.ffffffffffe8ep-1},
      {{-0x1p+0, -0x1.c37688e7c8adep-44}, 0x1p+0}, {{0x1.c37688e7c8adep-44, -0x1p+0}, 0x1p+0},
      {{-0x1.c37688e7c8adep-44, 0x1p+0}, 0x1p+0},  {{0x1p+0, 0x1.c37688e7c8adep-44}, 0x1p+0},
  };
  const FeasibilityResult<2> answer = solve_feasibility<2>(planes, {});
  ASSERT_EQ(answer.status, FeasibilityStatus::optimal);
  EXPECT_NEAR(answer.value, static_cast<double>(oracle::feasibility<2>(planes)), 2e-15);  // rounding of 1 m
  for (const double multiplier : answer.multipliers)
    EXPECT_GE(multiplier, -2e-15);
}

// Two blocks of a sliced rock mass that touch along an edge and have turned by 1e-10: opposite faces of two joints,
// whose bases have an inverse of 1e10. Updates of it, and ratios distinguished by its rounding, cycled.
TEST(Feasibility, BlocksAlongAnEdgeBetweenJointsAreSolved) {
  const HalfSpaces<3> planes{
      {{-0x1.d3818faa3d4e2p-1, 0x1.79c4fa9bd7368p-2, -0x1.63a1a7e0b738dp-3}, 0x1.034c8b4bc15a2p-3},
      {{-0x1.3f289d4ccf0d8p-3, -0x1.f7c5a88755d0ep-1, -0x1.64fd6b8c280ffp-4}, 0x1.034c8b4bc15a4p-3},
      {{-0x1.e36eb06e422d1p-4, 0x1.2e15030c0bd6ep-4, -0x1.fb046a930947ap-1}, 0x1.034c8b4bc15ap-3},
      {{0x1.e36eb06e422d1p-4, -0x1.2e15030c0bd6ep-4, 0x1.fb046a930947ap-1}, 0x1.034c8b4bc15ap-3},
      {{0x1.3f289d4ccf0d8p-3, 0x1.f7c5a88755d0ep-1, 0x1.64fd6b8c280ffp-4}, 0x1.486b489f1112bp-1},
      {{0x1.d3818faa3d4e2p-1, -0x1.79c4fa9bd7368p-2, 0x1.63a1a7e0b738dp-3}, 0x1.be869cceb826bp-2},
      {{-0x1.d3818fa9881bep-1, 0x1.79c4fa9bb181ap-2, -0x1.63a1a7f03a96bp-3}, -0x1.be869ccb20c28p-2},
      {{-0x1.3f289d4b70048p-3, -0x1.f7c5a887601a5p-1, -0x1.64fd6b8d6e5c8p-4}, 0x1.034c8b4cc5706p-3},
      {{0x1.036b743d112a9p-31, -0x1.eb9840de5a263p-35, -0x1p+0}, 0x1.c09e5c1b1cd36p-2},
      {{0x1.e36eb04e23ecfp-4, -0x1.2e15030840ca8p-4, 0x1.fb046a938cd0fp-1}, -0x1.034c8b5616f19p-3},
      {{0x1.3f289d4b70048p-3, 0x1.f7c5a887601a5p-1, 0x1.64fd6b8d6e5c8p-4}, 0x1.bc399cf39c5p-1},
  };
  const std::array<int, 4> own{0, 3, 1, 2};
  const FeasibilityResult<3> answer = solve_feasibility<3>(planes, {&own, 4e-15, 6e-17});
  ASSERT_EQ(answer.status, FeasibilityStatus::optimal);
  EXPECT_NEAR(answer.value, static_cast<double>(oracle::feasibility<3>(planes)), 2e-15);  // rounding of 1 m
  for (const double multiplier : answer.multipliers)
    EXPECT_GE(multiplier, -2e-15);
}

}  // namespace
}  // namespace voussoir::feasibility_test
