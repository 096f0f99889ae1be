// The central path and the analytic centre, against Newton in long double.
#include "core/solvers/analytic_centre.hpp"

#include <gtest/gtest.h>

#include "core/solvers/central_path.hpp"
#include "core/solvers/feasibility.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/random_pair.hpp"

namespace voussoir::centre_test {
namespace {

using shapes::Random;
using shapes::random_pair;

// the LP's value has an error of a few ulp of the coordinates (of order one here), more when the basis is badly
// conditioned
constexpr double lp_tolerance = 1e-12;

// a decrement of 1e-5 before the last Newton step leaves its square, with room for the constant
constexpr double centre_tolerance = 1e-8;

// ---- central path ---------------------------------------------------------------------------------------------------

template <int Dim>
void expect_on_the_central_path(const HalfSpaces<Dim>& planes, double weight, const CentralPathResult<Dim>& r) {
  ASSERT_EQ(r.status, CentralPathStatus::converged);
  Vector<Dim> direction = Vector<Dim>::Zero();
  double sum = 0;
  for (const HalfSpace<Dim>& p : planes) {
    const double t = r.bound - signed_distance<Dim>(p, r.point);
    ASSERT_GT(t, 0);
    sum += weight / t;
    direction += weight / t * p.normal;
  }
  // a t of the weight's size has the rounding of the coordinates
  const double rounding = 1e-15 / weight;
  EXPECT_NEAR(sum, 1, centre_tolerance + rounding);
  EXPECT_LT(direction.norm(), centre_tolerance + rounding);
  // its multipliers prove the program's value as closely as there are planes
  const double value = solve_feasibility<Dim>(planes, {}).value;
  EXPECT_GE(r.bound, value);
  EXPECT_LE(r.bound - static_cast<double>(planes.size()) * weight, value + lp_tolerance);
}

template <int Dim>
void expect_central_paths(std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 200; ++i) {
    const HalfSpaces<Dim> planes = random_pair<Dim>(random, shapes::integer(random, 0, 10));
    const double weight = shapes::power_of_ten(random, -7, -1);
    const CentralPathResult<Dim> r = follow_central_path<Dim>(planes, {Vector<Dim>::Zero(), weight});
    expect_on_the_central_path<Dim>(planes, weight, r);
    // the same from any start
    const Vector<Dim> start = 3 * shapes::direction<Dim>(random);
    const CentralPathResult<Dim> other = follow_central_path<Dim>(planes, {start, weight});
    expect_on_the_central_path<Dim>(planes, weight, other);
    EXPECT_NEAR(other.bound, r.bound, centre_tolerance * weight + 1e-14);
  }
}

// Eq. 3.30 against the program, Eq. 3.29
TEST(CentralPath, ItsMultipliersAreThoseOfTheProgramButForTheWeight) {
  expect_central_paths<3>(21);
  expect_central_paths<2>(22);
}

TEST(CentralPath, OfABoxIsItsMiddle) {
  for (const double weight : {1e-1, 1e-4, 1e-8}) {
    const CentralPathResult<3> r = follow_central_path<3>(shapes::cube<3>(1), {Vector<3>(0.9, -0.3, 0.5), weight});
    ASSERT_EQ(r.status, CentralPathStatus::converged);
    EXPECT_LT(r.point.norm(), centre_tolerance);
    EXPECT_NEAR(r.bound, 6 * weight - 1, centre_tolerance * weight + 1e-15);
  }
}

TEST(CentralPath, PowersOfTwoScaleItExactly) {
  Random random(23);
  for (int i = 0; i < 50; ++i) {
    const HalfSpaces<3> planes = random_pair<3>(random, 5);
    const CentralPathResult<3> one = follow_central_path<3>(planes, {Vector<3>::Zero(), 1e-4});
    for (const double factor : {0x1p-10, 0x1p13}) {
      const CentralPathResult<3> other =
          follow_central_path<3>(shapes::scaled<3>(planes, factor), {Vector<3>::Zero(), factor * 1e-4});
      EXPECT_EQ(other.bound, factor * one.bound);
      EXPECT_EQ(other.point, Vector<3>(factor * one.point));
    }
  }
}

TEST(CentralPath, NamesEveryFailure) {
  EXPECT_EQ(follow_central_path<3>(shapes::cube<3>(1), {Vector<3>(5, 0, 0), 1e-4, 1e-5, 1}).status,
            CentralPathStatus::iteration_limit);
  // a region that is open along z has none
  HalfSpaces<3> tube = shapes::cube<3>(1);
  std::erase_if(tube, [](const HalfSpace<3>& p) { return p.normal[2] != 0; });
  EXPECT_NE(follow_central_path<3>(tube, {Vector<3>::Zero(), 1e-4}).status, CentralPathStatus::converged);
}

// ---- analytic centre ------------------------------------------------------------------------------------------------

template <int Dim>
void expect_simplex_centroid(Random& random) {
  std::array<Vector<Dim>, Dim + 1> corners;
  Vector<Dim> centroid = Vector<Dim>::Zero();
  for (Vector<Dim>& c : corners) {
    c = shapes::normal_vector<Dim>(random);
    centroid += c / (Dim + 1);
  }
  HalfSpaces<Dim> planes;
  for (int k = 0; k <= Dim; ++k) {
    Matrix<Dim> edges = Matrix<Dim>::Zero();
    for (int j = 1; j < Dim; ++j)
      edges.row(j) = corners[(k + 1 + j) % (Dim + 1)] - corners[(k + 1) % (Dim + 1)];
    edges.row(0) = centroid - corners[(k + 1) % (Dim + 1)];
    const Vector<Dim> n = -(edges.inverse() * Vector<Dim>::Unit(0)).normalized();
    planes.push_back({n, n.dot(corners[(k + 1) % (Dim + 1)])});
  }
  // starts near a corner, with nearly all slacks small
  const Vector<Dim> start = corners[0] + 0.01 * (centroid - corners[0]);
  const CentreResult<Dim> r = solve_analytic_centre<Dim>(planes, {start});
  ASSERT_EQ(r.status, CentreStatus::converged);
  EXPECT_LT((r.point - centroid).norm(), centre_tolerance);
}

TEST(AnalyticCentre, OfASimplexIsItsCentroid) {
  Random random(17);
  for (int i = 0; i < 200; ++i) {
    expect_simplex_centroid<3>(random);
    expect_simplex_centroid<2>(random);
  }
}

TEST(AnalyticCentre, OfABoxIsItsMiddleHoweverThin) {
  for (const double thin : {1.0, 1e-3, 1e-6, 1e-9, 1e-12}) {
    const CentreResult<3> slab =
        solve_analytic_centre<3>(shapes::box<3>({-1, -2, -thin}, {1, 2, thin}), {Vector<3>(0.9, 1.2, 0.99 * thin)});
    ASSERT_EQ(slab.status, CentreStatus::converged);
    EXPECT_LT(slab.point.head<2>().norm(), centre_tolerance);
    EXPECT_LT(std::abs(slab.point[2]), centre_tolerance * thin);
    const CentreResult<3> needle = solve_analytic_centre<3>(shapes::box<3>({-1, -thin, -thin}, {1, thin, thin}),
                                                            {Vector<3>(0.9, -0.9 * thin, 0.99 * thin)});
    ASSERT_EQ(needle.status, CentreStatus::converged);
    EXPECT_LT(std::abs(needle.point[0]), centre_tolerance);
    EXPECT_LT(needle.point.tail<2>().norm(), centre_tolerance * thin);
    const CentreResult<2> strip =
        solve_analytic_centre<2>(shapes::box<2>({-1, -thin}, {1, thin}), {Vector<2>(0.9, 0.99 * thin)});
    ASSERT_EQ(strip.status, CentreStatus::converged);
    EXPECT_LT(std::abs(strip.point[0]), centre_tolerance);
    EXPECT_LT(std::abs(strip.point[1]), centre_tolerance * thin);
  }
}

template <int Dim>
void expect_newton_in_long_double(std::uint64_t seed, int trials) {
  Random random(seed);
  for (int i = 0; i < trials; ++i) {
    const HalfSpaces<Dim> planes = shapes::random_planes<Dim>(random, shapes::integer(random, 0, 20), 1);
    const oracle::RealVector<Dim> expected = oracle::analytic_centre<Dim>(planes, oracle::RealVector<Dim>::Zero());
    ASSERT_LT(oracle::barrier<Dim>(planes, expected).decrement, 1e-14L);
    // the centre does not depend on the start of the search
    for (const double fraction : {0.0, 0.5, 0.999999}) {
      Vector<Dim> start = shapes::direction<Dim>(random);
      double reach = 1e300;
      for (const HalfSpace<Dim>& p : planes)
        if (p.normal.dot(start) > 0) reach = std::min(reach, p.offset / p.normal.dot(start));
      start *= fraction * reach;
      const CentreResult<Dim> r = solve_analytic_centre<Dim>(planes, {start});
      ASSERT_EQ(r.status, CentreStatus::converged);
      EXPECT_LT((r.point.template cast<oracle::Real>() - expected).norm(), centre_tolerance);
    }
  }
}

// Eq. 3.28
TEST(AnalyticCentre, AgreesWithNewtonInLongDouble3D) {
  expect_newton_in_long_double<3>(18, 40);
}
TEST(AnalyticCentre, AgreesWithNewtonInLongDouble2D) {
  expect_newton_in_long_double<2>(19, 100);
}

TEST(AnalyticCentre, RepeatedPlanesCountRepeatedly) {
  // max log(1 - x) + 2 log(1 + x): x = 1/3
  HalfSpaces<2> planes = shapes::cube<2>(1);
  planes.push_back({Vector<2>(-1, 0), 1});
  const CentreResult<2> r = solve_analytic_centre<2>(planes, {Vector<2>::Zero()});
  ASSERT_EQ(r.status, CentreStatus::converged);
  EXPECT_NEAR(r.point[0], 1.0 / 3, centre_tolerance);
  EXPECT_NEAR(r.point[1], 0, centre_tolerance);
}

TEST(AnalyticCentre, NamesEveryFailure) {
  const HalfSpaces<3> planes = shapes::cube<3>(1);
  EXPECT_EQ(solve_analytic_centre<3>(planes, {Vector<3>(1, 0, 0)}).status, CentreStatus::start_not_interior);
  EXPECT_EQ(solve_analytic_centre<3>(planes, {Vector<3>(2, 0, 0)}).status, CentreStatus::start_not_interior);
  EXPECT_EQ(solve_analytic_centre<3>(planes, {Vector<3>(0.9, 0.9, -0.9), 1e-5, 1}).status,
            CentreStatus::iteration_limit);
  // a region open along z has no centre
  HalfSpaces<3> tube(planes.begin(), planes.begin() + 4);
  EXPECT_EQ(solve_analytic_centre<3>(tube, {Vector<3>(0.5, 0, 0)}).status, CentreStatus::singular);
  EXPECT_NE(solve_analytic_centre<3>({planes[0], planes[2], planes[4]}, {Vector<3>::Zero()}).status,
            CentreStatus::converged);
}

TEST(AnalyticCentre, PowersOfTwoScaleItExactly) {
  Random random(20);
  for (int i = 0; i < 50; ++i) {
    const HalfSpaces<3> planes = shapes::random_planes<3>(random, 8, 1);
    const Vector<3> start = 0.5 * shapes::direction<3>(random);
    const CentreResult<3> one = solve_analytic_centre<3>(planes, {start});
    for (const double factor : {0x1p-10, 0x1p13}) {
      const CentreResult<3> other = solve_analytic_centre<3>(shapes::scaled<3>(planes, factor), {factor * start});
      EXPECT_EQ(other.point, factor * one.point);
      EXPECT_EQ(other.iterations, one.iterations);
    }
  }
}

}  // namespace
}  // namespace voussoir::centre_test
