// The external solvers against closed forms and against ours. Built with those available: each half is independent.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "core/contact/narrow_phase.hpp"
#include "core/solvers/analytic_centre.hpp"
#include "core/solvers/feasibility.hpp"
#include "core/testing/shapes.hpp"
#ifdef VOUSSOIR_HAS_GLPK
#include "core/solvers/glpk.hpp"
#endif
#ifdef VOUSSOIR_HAS_IPOPT
#include "core/solvers/ipopt.hpp"
#endif

namespace voussoir {
namespace {

template <int Dim>
HalfSpaces<Dim> box(const Vector<Dim>& middle, const Vector<Dim>& half) {
  return shapes::box<Dim>(middle - half, middle + half);
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

// Eq. 3.18
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

// Eqs 3.27 and 3.29
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

TEST(Glpk, RefusesInputThatItWouldCallOptimal) {
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

// Eq. 3.28 by Eq. 3.38
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

// ---- the thesis' scaling --------------------------------------------------------------------------------------------

template <int Dim>
void expect_aligned(const Vector<Dim>& n) {
  const Matrix<Dim> turn = aligning_rotation(n);
  EXPECT_LT((turn.col(Dim - 1) - n).norm(), 1e-15) << n.transpose();
  EXPECT_LT((turn * turn.transpose() - Matrix<Dim>::Identity()).norm(), 4e-15) << n.transpose();
  EXPECT_NEAR(turn.determinant(), 1, 4e-15);
  if constexpr (Dim == 3) {  // about the axis that is normal to both, and no other
    const Vector<3> axis = Vector<3>::UnitZ().cross(n);
    EXPECT_LT((turn * axis - axis).norm(), 4e-15) << n.transpose();
  }
}

// Eqs 3.39-3.44
TEST(AligningRotation, TakesTheLastAxisToTheNormalAlsoIfTheyAreOpposite) {
  // 10^-k from z and from -z, down to angles whose squares vanish
  for (int k = 0; k <= 300; k += k < 20 ? 1 : 20)
    for (const double up : {1.0, -1.0})
      for (const double along : {0.0, 1.0, 2.5, 4.0}) {
        const double angle = std::pow(10.0, -k), s = std::sin(angle);
        expect_aligned<3>({s * std::cos(along), s * std::sin(along), up * std::cos(angle)});
      }
  expect_aligned<3>({0, 0, -1});
  expect_aligned<3>({0, 0, 1});
  expect_aligned<3>({1, 0, 0});
  for (int k = 0; k < 64; ++k)
    expect_aligned<2>({std::cos(0.1 * k), std::sin(0.1 * k)});
  expect_aligned<2>({0, -1});
}

// a block on another, face on face: the upper one is turned about the vertical and reaches `overlap` into the lower one
HalfSpaces<3> face_on_face(std::mt19937& random, double overlap) {
  std::uniform_real_distribution<double> angle(0, 6), side(-0.3, 0.3);
  HalfSpaces<3> planes = box<3>({0, 0, -0.5}, {0.5, 0.5, 0.5});
  const Matrix<3> about_z = Eigen::AngleAxisd(angle(random), Vector<3>::UnitZ()).toRotationMatrix();
  const Vector<3> middle(side(random), side(random), 0.5 - overlap);
  for (const HalfSpace<3>& p : box<3>({0, 0, 0}, {0.4, 0.4, 0.5})) {
    const Vector<3> normal = about_z * p.normal;
    planes.push_back({normal, p.offset + normal.dot(middle)});
  }
  return planes;
}

// how much any slack changes from one point to the other, as a fraction of it
double apart(const HalfSpaces<3>& planes, const Vector<3>& from, const Vector<3>& to) {
  double fraction = 0;
  for (const HalfSpace<3>& p : planes)
    fraction = std::max(fraction, std::abs(p.normal.dot(to - from)) / -signed_distance(p, from));
  return fraction;
}

// Iterations per solve for 20 face-on-face pairs, mean of overlaps 1e-2 to 1e-10 (in brackets: of the thinnest):
//   start                       thesis' scaling   unscaled, Eq. 3.38
//   1 % of the block away           4.5 (4.5)         7.4 (12)
//   the LP's point, a corner         24 (38)         10.7 (10)
// The scaling is made for starts near the centre; there it needs no more iterations at any thickness of the overlap.
TEST(IpoptScaling, FindsOurCentreFaceOnFaceAndSavesIterationsFromAWarmStart) {
  const int pairs = 5;
  for (const double overlap : {1e-2, 1e-6, 1e-10}) {
    std::mt19937 random(20133);
    int scaled = 0, unscaled = 0;
    const double rounding = 4 * std::numeric_limits<double>::epsilon() / overlap;
    for (int trial = 0; trial < pairs; ++trial) {
      const HalfSpaces<3> planes = face_on_face(random, overlap);
      CentreRequest<3> cold = request_from<3>(solve_feasibility<3>(planes, {}).point);
      cold.tolerance = 1e-9;
      const CentreResult<3> ours = solve_analytic_centre<3>(planes, cold);
      ASSERT_EQ(ours.status, CentreStatus::converged);
      CentreRequest<3> warm = request_from<3>(ours.point + Vector<3>(0.01, 0.02, 0.01 * overlap));

      for (const Vector<3>& normal : {Vector<3>(Vector<3>::UnitZ()), Vector<3>(Vector<3>::Zero())}) {
        warm.normal = cold.normal = normal;
        const CentreResult<3> near = solve_analytic_centre_ipopt_scaled<3>(planes, warm),
                              far = solve_analytic_centre_ipopt_scaled<3>(planes, cold);
        ASSERT_EQ(near.status, CentreStatus::converged);
        ASSERT_EQ(far.status, CentreStatus::converged);
        EXPECT_LT(apart(planes, ours.point, near.point), 1e-8);
        EXPECT_LT(apart(planes, ours.point, far.point), 1e-8 + rounding);
        scaled = std::max(scaled, near.iterations);
      }
      unscaled = std::max(unscaled, solve_analytic_centre_ipopt_unscaled<3>(planes, warm).iterations);
      EXPECT_LT(apart(planes, ours.point, solve_analytic_centre_ipopt<3>(planes, warm).point), 1e-8);
    }
    EXPECT_LE(scaled, 5) << "overlap " << overlap;
    EXPECT_GE(unscaled, scaled) << "overlap " << overlap;
  }
}

// Eqs 3.45-3.52
TEST(IpoptScaling, FindsOurCentreInAnyDirectionAndInThePlane) {
  std::mt19937 random(20134);
  for (int trial = 0; trial < 20; ++trial) {
    const HalfSpaces<3> planes = random_region(random);
    CentreRequest<3> request = request_from<3>({0, 0, 0});
    request.tolerance = 1e-9;
    request.normal = planes[6].normal;
    const CentreResult<3> ours = solve_analytic_centre<3>(planes, request),
                          theirs = solve_analytic_centre_ipopt_scaled<3>(planes, request);
    ASSERT_EQ(theirs.status, CentreStatus::converged);
    EXPECT_LT(apart(planes, ours.point, theirs.point), 1e-8);
  }
  const HalfSpaces<2> flat = box<2>({3, -2}, {0.5, 1e-6});
  const CentreResult<2> result = solve_analytic_centre_ipopt_scaled<2>(flat, request_from<2>({3.2, -2 + 5e-7}));
  ASSERT_EQ(result.status, CentreStatus::converged);
  EXPECT_LT(std::abs(result.point[0] - 3), 1e-8);
  EXPECT_LT(std::abs(result.point[1] + 2), 1e-8 * 1e-6 + 1e-15);
}

// newton_limit applies to Ipopt as well: a solve that takes longer gives no result
TEST(Ipopt, StopsAtTheLimit) {
  CentreRequest<2> request = request_from<2>({3.4, -1.8});
  request.limit = 1;
  EXPECT_EQ(solve_analytic_centre_ipopt<2>(box<2>({3, -2}, {0.5, 0.25}), request).status,
            CentreStatus::iteration_limit);
}

TEST(Ipopt, FindsTheKernelsContact) {
  const Polytope<3> cube = shapes::block<3>(box<3>({0, 0, 0}, {0.5, 0.5, 0.5}));
  for (const double overlap : {1e-2, 1e-8}) {
    const Pair<3> pair{&cube, &cube, Matrix<3>::Identity(), Matrix<3>::Identity(), {0.2, 0.3, 1 - overlap}};
    const Solvers<3> own, oracle{.centre = &solve_analytic_centre_ipopt<3>};
    Contact<3> expected, found;
    Contact<3>*to_expected = &expected, *to_found = &found;
    KernelCounters counters;
    narrow_phase<3>(std::span(&pair, 1), {}, own, std::span(&to_expected, 1), counters);
    narrow_phase<3>(std::span(&pair, 1), {}, oracle, std::span(&to_found, 1), counters);
    ASSERT_TRUE(found.touching());
    EXPECT_LT((found.geometry.point - expected.geometry.point).norm(), 1e-7);
    EXPECT_NEAR(found.geometry.overlap, expected.geometry.overlap, 1e-15);
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
