// Design points of closed forms, smooth and at a kink; what is said where there is none.
#include "core/probability/design_point.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/probability/normal.hpp"
#include "core/testing/limit_states.hpp"

namespace voussoir::design_point_test {
namespace {

using limit_states::Problem;
using limit_states::Values;

DesignPointRequest exact_request() {
  DesignPointRequest request;
  request.step = 1e-5;
  request.tolerance = 1e-8;
  return request;
}

LimitFunction of(const std::function<std::optional<double>(const StandardPoint&)>& g) {
  return [g](const std::vector<StandardPoint>& points) {
    std::vector<StateAnswer> answers;
    for (const StandardPoint& u : points)
      answers.push_back({g(u), ""});
    return answers;
  };
}

// to 1e-3 by differences of 0.1 within `evaluations`, and to 1e-6
void expect_design_point(const Problem& problem, double beta, int evaluations, const Values& x, double within) {
  const LimitFunction g = problem.function();
  const DesignPointSearch rough = find_design_point(g, problem.keys(), {});
  ASSERT_TRUE(rough.found) << rough.reason;
  EXPECT_NEAR(rough.found->beta, beta, 1e-3 * beta);
  EXPECT_LE(rough.evaluations, evaluations);
  EXPECT_EQ(rough.found->pieces.size(), 1);

  const DesignPointSearch search = find_design_point(g, problem.keys(), exact_request());
  ASSERT_TRUE(search.found) << search.reason;
  EXPECT_NEAR(search.found->beta, beta, 1e-6);
  EXPECT_NEAR(probability_of_pieces(*search.found).value(), normal_probability(-beta),
              1e-5 * normal_probability(-beta));
  EXPECT_EQ(rough.evaluations + search.evaluations, *problem.evaluations);
  const Values found = problem.values_at(search.found->u);
  for (std::size_t k = 0; k < x.size(); ++k)
    EXPECT_NEAR(found[k], x[k], within) << "key " << k;
}

// found by OpenTURNS 1.20 and by an own search, agreeing to 4e-9
TEST(DesignPoint, Wedges) {
  expect_design_point(limit_states::wedge_1(), 4.305378374, 42,
                      {43.72573, 134.50374, 62.07616, 215.49626, 37.71811, 42.50402}, 1e-3);
  expect_design_point(limit_states::wedge_2(), 3.895687394, 28,
                      {43.25141, 133.49863, 61.43973, 216.50137, 37.51763, 38.72526}, 1e-3);
  expect_design_point(limit_states::wedge_3(), 2.650165659, 35,
                      {47.80472, 112.20701, 71.20514, 227.79299, 31.38162, 28.15572}, 1e-3);
}

// found by OpenTURNS 1.20 and by an own search, agreeing to 3e-10
TEST(DesignPoint, SlopeWithTensionCrack) {
  expect_design_point(limit_states::sau_mau_ping(false), 1.5556597048, 42,
                      {8.62717550, 31.27103354, 14.82313112, 0.59862058, 0.08846557}, 1e-3);
  expect_design_point(limit_states::sau_mau_ping(true), 1.8929402388, 42,
                      {9.02576872, 31.87114715, 13.52000512, 0.63855074, 0.11073362}, 1e-3);
}

// found by an own search; the slab by OpenTURNS too
TEST(DesignPoint, OtherClosedForms) {
  expect_design_point(limit_states::dry_slab(22000, 4400, 38, 2.9), 4.709672883, 15, {}, 0);
  expect_design_point(limit_states::dry_slab(22000, 4400, 38, 2.9, 8), 4.709672883, 55, {}, 0);
  expect_design_point(limit_states::dry_slab(20000, 8000, 38, 3), 3.782394459, 30, {}, 0);
  expect_design_point(limit_states::gravity_block(6.5, 1, 34, 4), 3.04256061, 15, {9.54256061, 34}, 1e-6);
  expect_design_point(limit_states::fisher_wedge({40, 130, 60, 220}, {400, 400}, 42, 2), 2.6912749, 24,
                      {-1.1089, -1.46589, 0.82246, -0.63992, -1.66689}, 1e-3);
  expect_design_point(limit_states::fisher_wedge({40, 130, 60, 220}, {200, 100}, 45, 2), 2.6118119, 30,
                      {-1.0266, -1.56176, 1.07793, -0.91899, -1.14982}, 1e-3);
  expect_design_point(limit_states::fisher_wedge({45, 105, 70, 235}, {400, 200}, 32, 2), 2.6966165, 30,
                      {-1.40545, -0.87567, 1.49677, -0.58956, -1.39347}, 1e-3);
}

// Both pieces must fail. Other methods do not converge here, or return points that stand: the least distance and the
// half-spaces are of an own search, with no failed point within 0.999 of it among 400,000.
TEST(DesignPoint, Kink) {
  for (const double step : {0.3, 0.1, 0.01, 1e-4}) {
    const Problem problem = limit_states::wedge_4();
    DesignPointRequest request;
    request.step = step;
    const DesignPointSearch search = find_design_point(problem.function(), 6, request);
    ASSERT_TRUE(search.found) << search.reason;
    const DesignPoint& point = *search.found;
    EXPECT_NEAR(point.beta, 3.8628370, 1e-3);
    EXPECT_LE(search.evaluations, 50);
    EXPECT_LE(std::abs(point.g), 1e-3 * 0.48936940);
    ASSERT_EQ(point.pieces.size(), 2);
    const bool is_first_farther = point.pieces[0].distance > point.pieces[1].distance;
    EXPECT_NEAR(point.pieces[is_first_farther ? 0 : 1].distance, 3.608481, 1e-3);
    EXPECT_NEAR(point.pieces[is_first_farther ? 1 : 0].distance, 3.535536, 1e-3);
    // scipy's bivariate normal of the half-spaces; importance sampling of 3e6 rows: 1.97577e-05
    EXPECT_NEAR(probability_of_pieces(point).value(), 2.088092e-05, 1e-3 * 2.088092e-05);
  }
}

TEST(DesignPoint, ThreePieces) {
  // g is the largest of three planes: their corner
  const LimitFunction g = of([](const StandardPoint& u) { return std::max({2 - u[0], 2.2 - u[1], 1.8 - u[2]}); });
  const DesignPointSearch search = find_design_point(g, 3, {});
  ASSERT_TRUE(search.found) << search.reason;
  EXPECT_NEAR(search.found->beta, std::hypot(2, 2.2, 1.8), 1e-3);
  EXPECT_EQ(search.found->pieces.size(), 3);
  EXPECT_FALSE(probability_of_pieces(*search.found));
}

// a parabola and its mirror image, with and against the medians: β from the cubic of the nearest point
TEST(DesignPoint, CurvedLimitStates) {
  for (const double curvature : {-3.0, -1.0, -0.5, 0.2, 0.5, 1.0, 3.0}) {
    const auto height = [&](double t) { return 3 - 0.3 * t + curvature / 2 * t * t; };
    double beta = std::numeric_limits<double>::infinity();
    for (double t = -1; t <= 4; t += 1e-5)
      beta = std::min(beta, std::hypot(height(t), t));
    const LimitFunction g = of([&](const StandardPoint& u) { return height(u[1]) - u[0]; });
    const DesignPointSearch search = find_design_point(g, 2, {});
    ASSERT_TRUE(search.found) << search.reason;
    EXPECT_NEAR(search.found->beta, beta, 1e-3 * beta) << curvature;
    EXPECT_LE(search.evaluations, 60) << curvature;
  }
}

// limit states on which plain iteration is known to cycle or to be slow; β by a scan of all directions
TEST(DesignPoint, TextbookProblems) {
  const auto expect = [](const std::function<double(double, double)>& g, double beta, int evaluations) {
    const DesignPointSearch search =
        find_design_point(of([&](const StandardPoint& u) { return g(u[0], u[1]); }), 2, {});
    ASSERT_TRUE(search.found) << search.reason;
    EXPECT_NEAR(search.found->beta, beta, 1e-3 * beta);
    EXPECT_LE(search.evaluations, evaluations);
  };
  const auto cube = [](double x) { return x * x * x; };
  expect([&](double u, double v) { return cube(10 + 5 * u) + cube(9.9 + 5 * v) - 18; }, 2.22599, 42);
  expect([&](double u, double v) { return (10 + 5 * u) * cube(10 + 5 * u) + 2 * (10 + 5 * v) * cube(10 + 5 * v) - 20; },
         2.36545, 60);
  expect([](double u, double v) { return std::exp(0.4 * (u + 2) + 6.2) - std::exp(0.3 * v + 5) - 200; }, 2.70990, 18);
  expect([](double u, double v) { return std::exp(0.2 * u + 1.4) - v; }, 3.34969, 18);
  expect([](double u, double v) { return 3 - u + 0.3 * std::sin(3 * v) + 0.2 * std::cos(2 * u); }, 2.91450, 60);
  // flat around the medians
  expect([](double u, double v) { return std::min(1.0, 3 - u - v) + 1e-3 * (5 - u - v); }, 2.12273, 15);
}

// the factor known to brackets only, in twenty places of the bracket
TEST(DesignPoint, Brackets) {
  const auto worst = [](const Problem& problem, double bracket, double beta) {
    double error = 0;
    for (int place = 0; place < 20; ++place) {
      const LimitFunction exact = problem.function();
      const LimitFunction g = [&](const std::vector<StandardPoint>& points) {
        std::vector<StateAnswer> answers = exact(points);
        for (StateAnswer& answer : answers)
          answer.g = (std::floor(*answer.g / bracket + place / 20.0) - place / 20.0 + 0.5) * bracket;
        return answers;
      };
      DesignPointRequest request;
      request.step = 0.3;
      request.bracket = bracket;
      const DesignPointSearch search = find_design_point(g, 6, request);
      EXPECT_TRUE(search.found) << search.reason;
      if (search.found) error = std::max(error, std::abs(search.found->beta - beta));
    }
    EXPECT_LE(*problem.evaluations, 20 * 60);
    return error;
  };
  EXPECT_LT(worst(limit_states::wedge_1(), 0.002, 4.305378374), 0.02);
  EXPECT_LT(worst(limit_states::wedge_3(), 0.002, 2.650165659), 0.02);
}

TEST(DesignPoint, MediansFail) {
  // the nearest point that stands, the sign turned by the caller
  const LimitFunction fails = of([](const StandardPoint& u) { return u[0] - 1.5; });
  EXPECT_EQ(find_design_point(fails, 1, {}).reason, "the medians fail");
  const LimitFunction turned = of([](const StandardPoint& u) { return 1.5 - u[0]; });
  DesignPointRequest request;
  request.reversed = true;
  const DesignPointSearch search = find_design_point(turned, 1, request);
  ASSERT_TRUE(search.found) << search.reason;
  EXPECT_NEAR(search.found->beta, -1.5, 1e-9);
  EXPECT_NEAR(probability_of_pieces(*search.found).value(), normal_probability(1.5), 1e-9);
}

TEST(DesignPoint, KnownAnswerAtTheMediansIsNotAskedFor) {
  const Problem problem = limit_states::wedge_1();
  DesignPointRequest request;
  request.g_at_medians = 0.51904628;
  const DesignPointSearch search = find_design_point(problem.function(), 6, request);
  ASSERT_TRUE(search.found);
  EXPECT_EQ(search.evaluations, 41);
}

TEST(DesignPoint, NoneIsFound) {
  const auto reason = [](const LimitFunction& g) {
    const DesignPointSearch search = find_design_point(g, 2, {});
    EXPECT_FALSE(search.found);
    return search.reason;
  };
  EXPECT_EQ(reason(of([](const StandardPoint&) { return 1; })), "the answer depends on no key");
  EXPECT_EQ(reason(of([](const StandardPoint&) { return std::nullopt; })), "no answer at the medians");
  EXPECT_EQ(reason(of([](const StandardPoint& u) { return 2 + std::sqrt(1 + u[0] * u[0]) - 0.1 * u[0]; })),
            "no design point within 40 iterations");
  EXPECT_EQ(reason(of([](const StandardPoint& u) { return 100 - u[0]; })),
            "nothing fails within 37 standard deviations of the medians");
  const LimitFunction ends =
      of([](const StandardPoint& u) { return u[0] < 2 ? std::optional(3 - u[0]) : std::nullopt; });
  EXPECT_NE(reason(ends).find("no answer, or none that depends on a key, beyond 1.9"), std::string::npos)
      << reason(ends);
}

// no answer beyond a boundary that the way there crosses, and none of some differences
TEST(DesignPoint, PointsWithoutAnswer) {
  const LimitFunction g = of([](const StandardPoint& u) -> std::optional<double> {
    if (u[0] > 2.2 || u[1] > 0.05) return std::nullopt;
    return 2 - u[0] - 0.4 * u[0] * u[0] / 4;
  });
  const DesignPointSearch search = find_design_point(g, 2, {});
  ASSERT_TRUE(search.found) << search.reason;
  EXPECT_NEAR(search.found->beta, (-1 + std::sqrt(1.8)) / 0.2, 2e-3);
}

}  // namespace
}  // namespace voussoir::design_point_test
