// The outside solvers against closed forms and against ours. Built with what is available: each half stands by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/optimise/analytic_centre.hpp"
#include "core/optimise/feasibility.hpp"
#ifdef VOUSSOIR_HAS_GLPK
#include "core/optimise/glpk.hpp"
#endif
#ifdef VOUSSOIR_HAS_IPOPT
#include "core/optimise/ipopt.hpp"
#endif

namespace voussoir {
namespace {

template <int Dim>
HalfSpaces<Dim> box(const Vector<Dim>& middle, const Vector<Dim>& half) {
  HalfSpaces<Dim> planes;
  for (int k = 0; k < Dim; ++k)
    for (const double sign : {1.0, -1.0}) {
      const Vector<Dim> normal = sign * Vector<Dim>::Unit(k);
      planes.push_back({normal, normal.dot(middle) + half[k]});
    }
  return planes;
}

// a bounded region around the origin: a box and planes of any direction
HalfSpaces<3> random_region(std::mt19937& random) {
  std::normal_distribution<double> direction;
  std::uniform_real_distribution<double> distance(0.2, 1.0);
  HalfSpaces<3> planes = box<3>({0, 0, 0}, {1, 1, 1});
  for (int k = 0; k < 8; ++k)
    planes.push_back(
        {Vector<3>(direction(random), direction(random), direction(random)).normalized(), distance(random)});
  return planes;
}

#ifdef VOUSSOIR_HAS_GLPK

// sum λ_i a_i = 0, sum λ_i = 1, λ >= 0 and s = -sum λ_i d_i prove the optimum
template <int Dim>
void expect_certificate(const HalfSpaces<Dim>& planes, const FeasibilityResult<Dim>& result) {
  Vector<Dim> direction = Vector<Dim>::Zero();
  double sum = 0, value = 0;
  for (int k = 0; k <= Dim; ++k) {
    ASSERT_GE(result.basis[k], 0);
    direction += result.multipliers[k] * planes[result.basis[k]].normal;
    sum += result.multipliers[k];
    value -= result.multipliers[k] * planes[result.basis[k]].offset;
    EXPECT_GE(result.multipliers[k], 0);
  }
  EXPECT_LT(direction.norm(), 1e-12);
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(value, result.value, 1e-12);
}

TEST(Glpk, FindsTheInscribedCircleOfABox) {
  const HalfSpaces<2> planes = box<2>({3, -2}, {0.5, 0.25});
  const FeasibilityResult<2> result = solve_feasibility_glpk<2>(planes, {});
  ASSERT_EQ(result.status, FeasibilityStatus::optimal);
  EXPECT_NEAR(result.value, -0.25, 1e-14);
  EXPECT_NEAR(result.point[1], -2, 1e-14);
  expect_certificate<2>(planes, result);
}

TEST(Glpk, SymmetricProblemsHaveACompleteBasis) {
  const HalfSpaces<3> planes = box<3>({0, 0, 0}, {1, 1, 1});
  const FeasibilityResult<3> result = solve_feasibility_glpk<3>(planes, {});
  ASSERT_EQ(result.status, FeasibilityStatus::optimal);
  EXPECT_NEAR(result.value, -1, 1e-14);
  expect_certificate<3>(planes, result);
}

TEST(Glpk, AgreesWithOurSolver) {
  std::mt19937 random(20131);
  for (int trial = 0; trial < 200; ++trial) {
    const HalfSpaces<3> planes = random_region(random);
    const FeasibilityResult<3> theirs = solve_feasibility_glpk<3>(planes, {}), ours = solve_feasibility<3>(planes, {});
    ASSERT_EQ(theirs.status, FeasibilityStatus::optimal);
    ASSERT_EQ(ours.status, FeasibilityStatus::optimal);
    EXPECT_NEAR(theirs.value, ours.value, 1e-10);
    expect_certificate<3>(planes, theirs);
  }
}

TEST(Glpk, MeasuresTheGapOfSeparatedParts) {
  HalfSpaces<3> planes = box<3>({0, 0, 0}, {1, 1, 1});
  for (const HalfSpace<3>& plane : box<3>({2.5, 0, 0}, {1, 1, 1}))
    planes.push_back(plane);
  const FeasibilityResult<3> result = solve_feasibility_glpk<3>(planes, {});
  ASSERT_EQ(result.status, FeasibilityStatus::optimal);
  EXPECT_NEAR(result.value, 0.25, 1e-14);
}

TEST(Glpk, RefusesWhatItWouldCallOptimal) {
  HalfSpaces<3> planes = box<3>({0, 0, 0}, {1, 1, 1});
  planes[2].offset = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solve_feasibility_glpk<3>(planes, {}).status, FeasibilityStatus::iteration_limit);
  const HalfSpaces<3> open = {{Vector<3>(0, 0, 1), 1}};
  EXPECT_EQ(solve_feasibility_glpk<3>(open, {}).status, FeasibilityStatus::unbounded);
}

#endif

#ifdef VOUSSOIR_HAS_IPOPT

template <int Dim>
CentreRequest<Dim> request_from(const Vector<Dim>& start) {
  CentreRequest<Dim> request;
  request.start = start;
  return request;
}

TEST(Ipopt, TheCentreOfABoxIsItsMiddle) {
  const HalfSpaces<2> planes = box<2>({3, -2}, {0.5, 0.25});
  const CentreResult<2> result = solve_analytic_centre_ipopt<2>(planes, request_from<2>({3.4, -1.8}));
  ASSERT_EQ(result.status, CentreStatus::converged);
  EXPECT_LT((result.point - Vector<2>(3, -2)).norm(), 1e-9);
  EXPECT_GT(result.iterations, 0);
}

TEST(Ipopt, AFlatOverlapIsNoHarder) {
  const double thickness = 1e-9;
  const HalfSpaces<3> planes = box<3>({0, 0, 0}, {1, 1, thickness});
  const CentreResult<3> result = solve_analytic_centre_ipopt<3>(planes, request_from<3>({0.5, -0.7, 0.9 * thickness}));
  ASSERT_EQ(result.status, CentreStatus::converged);
  EXPECT_LT(result.point.head<2>().norm(), 1e-8);
  EXPECT_LT(std::abs(result.point[2]), 1e-8 * thickness);
}

TEST(Ipopt, AgreesWithOurSolver) {
  std::mt19937 random(20132);
  for (int trial = 0; trial < 50; ++trial) {
    const HalfSpaces<3> planes = random_region(random);
    CentreRequest<3> request = request_from<3>({0, 0, 0});
    request.tolerance = 1e-8;
    const CentreResult<3> theirs = solve_analytic_centre_ipopt<3>(planes, request);
    const CentreResult<3> ours = solve_analytic_centre<3>(planes, request);
    ASSERT_EQ(theirs.status, CentreStatus::converged);
    ASSERT_EQ(ours.status, CentreStatus::converged);
    EXPECT_LT((theirs.point - ours.point).norm(), 1e-8);
  }
}

TEST(Ipopt, AStartOnAPlaneIsRefused) {
  const HalfSpaces<2> planes = box<2>({0, 0}, {1, 1});
  EXPECT_EQ(solve_analytic_centre_ipopt<2>(planes, request_from<2>({1, 0})).status, CentreStatus::start_not_interior);
  EXPECT_EQ(solve_analytic_centre_ipopt<2>(planes, request_from<2>({std::nan(""), 0})).status,
            CentreStatus::start_not_interior);
}

#endif

}  // namespace
}  // namespace voussoir
