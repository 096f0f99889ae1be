// Differences of functions whose derivatives, kinks and jumps are known.
#include "app/derivatives/ridders.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace voussoir::ridders_test {
namespace {

using Function = double (*)(double);

// of one piece
AnswerAt smooth(Function function) {
  return [function](double x) { return PieceAnswer{function(x), "one", "one", ""}; };
}

Derivative of(const AnswerAt& answer, DifferenceRequest request) {
  request.base = answer(0);
  if (request.bar == 0) request.bar = 1e-15 * std::abs(*request.base.value);
  return differentiate(answer, request);
}

TEST(Ridders, SmoothFunctionsToTenDigits) {
  const Derivative wave = of(smooth([](double x) { return std::exp(std::sin(1 + x)); }), {.step = 0.2});
  const double exact = std::exp(std::sin(1)) * std::cos(1);
  EXPECT_NEAR(wave.value.value(), exact, 1e-11);
  EXPECT_LE(std::abs(*wave.value - exact), wave.bar);
  EXPECT_FALSE(wave.one_side || wave.kink || wave.still);
  // within the room of a key
  const Derivative at_end = of(smooth([](double x) { return std::exp(x); }), {.step = 0.2, .below = 0});
  EXPECT_TRUE(at_end.one_side);
  EXPECT_NEAR(at_end.value.value(), 1, 1e-10);
  EXPECT_LE(std::abs(*at_end.value - 1), at_end.bar);
  EXPECT_FALSE(at_end.below.value || at_end.below.end);
}

TEST(Ridders, AConstantIsStillAfterTwoAnswers) {
  const Derivative still = of(smooth([](double) { return 3.0; }), {.step = 0.1});
  EXPECT_TRUE(still.still);
  EXPECT_EQ(still.answers, 2);
}

TEST(Ridders, TheBarHoldsWhatAnswersDoNotKnow) {
  // an answer good to 1e-6, whose error changes its sign from place to place
  const AnswerAt rough = [](double x) {
    return PieceAnswer{std::exp(x) + 1e-6 * std::sin(1e7 * x + 1), "one", "one", ""};
  };
  const Derivative found = of(rough, {.step = 0.3, .bar = 1e-6, .levels = 3});
  EXPECT_LE(std::abs(found.value.value() - 1), found.bar);
  EXPECT_LT(found.bar, 1e-4);
}

TEST(Ridders, AKinkOfOnePieceIsFoundByItsSides) {
  const Derivative kink = of(smooth([](double x) { return 2 + std::sin(x) + (x > 0 ? x : 0); }), {.step = 0.1});
  EXPECT_TRUE(kink.kink);
  EXPECT_FALSE(kink.value);
  EXPECT_NEAR(kink.below.value.value(), 1, 1e-9);
  EXPECT_NEAR(kink.above.value.value(), 2, 1e-9);
}

TEST(Ridders, AJumpOfTheSecondDerivativeIsNoKink) {
  const auto bend = [](double x) { return 2 + std::sin(x) + (x > 0 ? x * x : 0); };
  const Derivative found = of(smooth(bend), {.step = 0.1});
  EXPECT_FALSE(found.kink);
  EXPECT_NEAR(found.value.value(), 1, 1e-9);
  EXPECT_LE(std::abs(*found.value - 1), found.bar);
}

// min of two mechanisms that are equal at `place`
AnswerAt two_mechanisms(double place) {
  return [place](double x) {
    const double a = std::exp(x), b = std::exp(place) + 3 * (place - x);
    return a < b ? PieceAnswer{a, "a", "mechanism a", ""} : PieceAnswer{b, "b", "mechanism b", ""};
  };
}

TEST(Ridders, TwoMechanismsAtTheBaseGiveBothSides) {
  const Derivative kink = of(two_mechanisms(0), {.step = 0.1});
  EXPECT_TRUE(kink.kink);
  EXPECT_NEAR(kink.below.value.value(), 1, 1e-9);
  EXPECT_NEAR(kink.above.value.value(), -3, 1e-9);
  EXPECT_EQ(kink.below.words, "mechanism a");
}

TEST(Ridders, AMechanismNearbyLeavesTheOtherSide) {
  const Derivative found = of(two_mechanisms(4e-4), {.step = 0.1});
  EXPECT_TRUE(found.one_side);
  EXPECT_NEAR(found.value.value(), 1, 1e-9);
  ASSERT_TRUE(found.above.end);
  EXPECT_NEAR(found.above.end->distance, 4e-4, 1e-6);
  EXPECT_EQ(found.above.end->words, "mechanism b");
  // farther than an eighth of the step: halved until both sides are the base's
  EXPECT_FALSE(of(two_mechanisms(0.03), {.step = 0.1}).one_side);
}

TEST(Ridders, JumpsOnBothSidesAreRefused) {
  const AnswerAt island = [](double x) {
    return std::abs(x) < 1e-5 ? PieceAnswer{1 + x, "a", "", ""} : PieceAnswer{{}, "", "", "the block is gone"};
  };
  const Derivative none = of(island, {.step = 0.1});
  EXPECT_FALSE(none.value || none.kink || none.below.value || none.above.value);
  EXPECT_EQ(none.above.end.value().words, "the block is gone");
  EXPECT_NEAR(none.below.end.value().distance, 1e-5, 1e-6);
}

}  // namespace
}  // namespace voussoir::ridders_test
