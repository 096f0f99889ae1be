// Estimates of the critical strength from the trials of a search.
#include "core/run/search_estimates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "text/angle.hpp"

namespace voussoir::search_estimates_test {
namespace {

Levels friction_levels() {
  ReducePlan plan;
  plan.from = 60 * degree;
  plan.to = 5 * degree;
  plan.tolerance = 0.02 * degree;
  return levels_of(plan);
}

Levels factor_levels() {
  ReducePlan plan;
  plan.searched = Searched::factor;
  plan.factor = {.from = 0.5, .to = 3, .tolerance = 0.002};
  return levels_of(plan);
}

TrialEstimate estimate(const Levels& levels, double level, double critical) {
  return {levels.strength(level), levels.strength(critical), 1e-4};
}

// s = s0 + b u^(-1/2) - a u
std::vector<StableTrial> turning(double s0, double b, double a, const std::vector<double>& displacements) {
  std::vector<StableTrial> trials;
  for (const double u : displacements)
    trials.push_back({s0 + b / std::sqrt(u) - a * u, u, u / 0.1});
  return trials;
}

TEST(SearchEstimates, TheFitFindsTheStrengthAtNoDisplacement) {
  for (const std::vector<double>& u :
       {std::vector<double>{0.001, 0.004, 0.03}, std::vector<double>{0.001, 0.002, 0.008, 0.02, 0.06}}) {
    const std::optional<StableFit> fit = fit_stable(turning(0.13, 0.002, 0.05, u));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->critical, 0.13, 1e-9);
    EXPECT_EQ(fit->of_three, u.size() == 3);
    EXPECT_NEAR(fit->change, 0, 1e-9);
  }
}

TEST(SearchEstimates, TheFitRefusesTrialsThatTellNothing) {
  EXPECT_FALSE(fit_stable(turning(0.13, 0.002, 0.05, {0.001, 0.02}))) << "two trials";
  EXPECT_FALSE(fit_stable(turning(0.13, 0.002, 0.05, {1e-5, 2e-5, 1e-4, 0.02}))) << "bodies have not turned yet";
  EXPECT_FALSE(fit_stable(turning(0.13, 0.002, 0.05, {0.01, 0.01, 0.01, 0.02}))) << "the same displacement";
  EXPECT_FALSE(fit_stable(turning(0.13, -0.002, 0.05, {0.001, 0.004, 0.02, 0.05}))) << "of another law";
  EXPECT_FALSE(fit_stable(turning(0.13, 0.002, -0.05, {0.001, 0.004, 0.02, 0.05}))) << "the arm of the loads grows";
}

TEST(SearchEstimates, TheFitLeavesOutTrialsOfAnotherGeometry) {
  std::vector<StableTrial> trials = turning(0.13, 0.002, 0.05, {0.001, 0.002, 0.005, 0.01, 0.03});
  for (StableTrial far : turning(0.13, 0.002, 0.05, {0.06, 0.08})) {
    far.level -= 0.01;
    trials.push_back(far);
  }
  const std::optional<StableFit> fit = fit_stable(trials);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->critical, 0.13, 1e-9);
  EXPECT_NEAR(fit->change, 0, 1e-9);
}

// s = s0 + b u^(-1/2) + c u is least at u = (b/(2 c))^(2/3), where it is 3 c u above s0.
TEST(SearchEstimates, BodiesThatToppleFailAboveTheStrengthOfRigidOnes) {
  const double s0 = 0.5, b = 0.001, c = 0.4, least = std::pow(b / (2 * c), 2.0 / 3);
  const std::vector<StableTrial> trials = turning(s0, b, -c, {0.1 * least, 0.4 * least, least});
  ASSERT_GT(trials.front().of_failure, 0.003);
  EXPECT_NEAR(error_of_turning(trials), 4.0 / 3 * 3 * c * least, 1e-9);
  EXPECT_EQ(error_of_turning({trials.front()}), 0) << "one trial";

  // the last has moved far enough for the fit, those before not
  std::vector<StableTrial> sudden = turning(s0, b, -c, {0.002 * least, 0.04 * least, least});
  for (StableTrial& t : sudden)
    t.of_failure = 0.01 * t.displacement / least;
  ASSERT_LT(sudden[1].of_failure, 0.003);
  EXPECT_NEAR(error_of_turning(sudden), 4.0 / 3 * 3 * c * least, 1e-9);

  const Levels levels = friction_levels();
  SearchEstimates known;
  known.stable = trials;
  known.no_line = NoLine::turned;
  const double stable = levels.level_of(trials.back().level);
  const CriticalLevel critical = critical_level(levels, {stable, stable - 0.01 * degree}, known);
  EXPECT_EQ(critical.by, CriticalBy::bracket_of_turning);
  EXPECT_LT(std::abs(critical.level - levels.level_of(s0)), critical.error_bar);
}

TEST(SearchEstimates, TheNextTrialIsBesideTheEstimate) {
  const Levels levels = friction_levels();
  const Bracket bracket{60 * degree, 29 * degree};
  SearchEstimates known;
  EXPECT_FALSE(level_by_estimate(levels, bracket, known));
  known.failed.push_back(estimate(levels, 29 * degree, 30 * degree));
  EXPECT_FALSE(level_by_estimate(levels, bracket, known)) << "a trial 4 % below says too little";

  known.failed.back() = estimate(levels, 29.5 * degree, 30 * degree);
  const Bracket near{60 * degree, 29.5 * degree};
  EXPECT_NEAR(*level_by_estimate(levels, near, known) / degree, 29.7, 1e-9) << "a hundredth beyond it";

  known.failed.push_back(estimate(levels, 29.7 * degree, 30.001 * degree));
  const Bracket nearer{60 * degree, 29.7 * degree};
  EXPECT_NEAR(*level_by_estimate(levels, nearer, known) / degree, 30.011, 1e-9) << "half a tolerance before it";
  EXPECT_FALSE(is_certified(levels, nearer, known));
  EXPECT_TRUE(is_certified(levels, {30.011 * degree, 29.7 * degree}, known));
}

TEST(SearchEstimates, AnEstimateThatTheBracketContradictsDoesNotCount) {
  const Levels levels = factor_levels();
  SearchEstimates known;
  known.failed = {estimate(levels, 1.41, 1.40), estimate(levels, 1.405, 1.4001)};
  const CriticalLevel inside = critical_level(levels, {1.399, 1.405}, known);
  EXPECT_EQ(inside.by, CriticalBy::required_strength);
  EXPECT_NEAR(inside.level, 1.4001, 1e-12);
  EXPECT_NEAR(inside.error_bar, 1e-4 + 0.1 * 1e-4 * 1.4 * 1.4, 1e-6);
  EXPECT_NEAR(inside.taken_out, 1e-4 * 1.4 * 1.4, 1e-6);
  EXPECT_EQ(inside.bracket_because, "");

  // outside by less than the tolerance: the bar reaches into the bracket
  const CriticalLevel beside = critical_level(levels, {1.401, 1.405}, known);
  EXPECT_NEAR(beside.level, 1.4001, 1e-12);
  EXPECT_NEAR(beside.error_bar, inside.error_bar + 0.0009, 1e-12);

  const CriticalLevel outside = critical_level(levels, {1.42, 1.43}, known);
  EXPECT_EQ(outside.by, CriticalBy::bracket);
  EXPECT_NEAR(outside.level, 1.425, 1e-12);
  EXPECT_NEAR(outside.error_bar, 0.005, 1e-12);
}

// The law predicts the level at four times the displacement: b u^(-1/2) falls by half.
TEST(SearchEstimates, BodiesThatTurnAreLoweredGently) {
  const Levels levels = friction_levels();
  const Bracket wide{30 * degree, 5 * degree};
  SearchEstimates known;
  known.stable = {{std::tan(30 * degree), 1e-5, 1e-4}};
  EXPECT_FALSE(level_for_fit(levels, wide, known)) << "nothing turned";
  known.no_line = NoLine::turned;
  EXPECT_NEAR(std::tan(*level_for_fit(levels, wide, known)), 0.8 * std::tan(30 * degree), 1e-12) << "no law yet";
  EXPECT_FALSE(level_for_fit(levels, {30 * degree, 26 * degree}, known)) << "half the bracket is a shorter step";

  known.stable = turning(0.4, 0.003, 0, {0.001, 0.002});
  const double here = levels.level_of(known.stable.back().level);
  EXPECT_NEAR(std::tan(*level_for_fit(levels, {here, 5 * degree}, known)), 0.4 + 0.003 / std::sqrt(0.008), 1e-12);
  known.stable = turning(0.4, 0.003, 0, {0.001, 0.05});
  EXPECT_FALSE(level_for_fit(levels, {levels.level_of(known.stable.back().level), 5 * degree}, known))
      << "they have moved far enough";
}

TEST(SearchEstimates, BodiesThatTurnAreJudgedByTheFit) {
  const Levels levels = friction_levels();
  SearchEstimates known;
  known.stable = turning(std::tan(9.47 * degree), 0.001, 0.02, {0.001, 0.004, 0.02, 0.05});
  const Bracket bracket{10.2 * degree, 10.1 * degree};
  EXPECT_EQ(critical_level(levels, bracket, known).by, CriticalBy::bracket) << "they did not turn";
  known.no_line = NoLine::turned;
  const CriticalLevel critical = critical_level(levels, bracket, known);
  EXPECT_EQ(critical.by, CriticalBy::stable_fit);
  EXPECT_NEAR(critical.level / degree, 9.47, 1e-6);
}

TEST(SearchEstimates, AResultThatIsTheBracketSaysWhy) {
  const Levels levels = factor_levels();
  const Bracket bracket{1.4, 1.5};
  const auto why = [&](const SearchEstimates& known) {
    const CriticalLevel critical = critical_level(levels, bracket, known);
    EXPECT_EQ(critical.by, CriticalBy::bracket);
    EXPECT_EQ(critical.taken_out, 0);
    return critical.bracket_because;
  };
  const std::pair<NoLine, const char*> reasons[] = {
      {NoLine::turned, "bodies turn"},   {NoLine::no_slip, "slips"},
      {NoLine::broke, "bonds broke"},    {NoLine::loads, "bolts still took up load"},
      {NoLine::too_short, "had a line"}, {NoLine::not_straight, "never fell in a straight line"}};
  for (const auto& [reason, words] : reasons)
    EXPECT_NE(why({.no_line = reason}).find(words), std::string::npos) << words;
  EXPECT_NE(why({.failed = {estimate(levels, 1.5, 1.42)}}).find("1.42, is more than 3 % from that of its trial, 1.5"),
            std::string::npos);
  EXPECT_NE(why({.failed = {estimate(levels, 1.6, 1.59)}}).find("1.59, is outside the bracket"), std::string::npos);
}

}  // namespace
}  // namespace voussoir::search_estimates_test
