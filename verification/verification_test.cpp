// unit.verification, first half: the rule and the report must refuse wrong results and incomplete checks.
#include "verification/verification.hpp"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "verification/verdict_file.hpp"

namespace voussoir::verification::verification_test {
namespace {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

Check good_check() {
  return {"slip", "m", Kind::exact, "an identity", -21.7, {1e-3, 1e-2}, "made for this test"};
}

TEST(Within, IsTrueInsideAndOnTheEdgeOnly) {
  EXPECT_TRUE(within(10.0, 10.0, {}));
  EXPECT_TRUE(within(10.5, 10.0, {0.5, 0.0}));
  EXPECT_TRUE(within(11.0, 10.0, {0.5, 0.05}));
  EXPECT_FALSE(within(std::nextafter(10.5, inf), 10.0, {0.5, 0.0}));
  EXPECT_FALSE(within(std::nextafter(10.0, inf), 10.0, {}));
}

TEST(Within, RefusesTheWrongSign) {
  // the classical trap: a relative error without the absolute value accepts any negative force
  EXPECT_FALSE(within(21.7, -21.7, {0.0, 0.01}));
  EXPECT_FALSE(within(-1000.0, -21.7, {0.0, 0.01}));
  EXPECT_FALSE(within(-1e-3, 1e-3, {0.0, 0.999}));
}

TEST(Within, RefusesNumbersThatAreNotFinite) {
  for (const double bad : {nan, inf, -inf}) {
    for (const Bound bound : {Bound::both, Bound::at_most, Bound::at_least}) {
      EXPECT_FALSE(within(bad, 1.0, {0.1, 0.1, bound}));
      EXPECT_FALSE(within(1.0, bad, {0.1, 0.1, bound}));
      EXPECT_FALSE(within(bad, bad, {0.1, 0.1, bound}));
    }
  }
}

TEST(Within, NeedsAnAbsoluteToleranceAtZero) {
  EXPECT_TRUE(within(0.0, 0.0, {0.0, 0.01}));
  EXPECT_FALSE(within(1e-300, 0.0, {0.0, 0.01}));
  EXPECT_TRUE(within(1e-9, 0.0, {1e-8, 0.0}));
  EXPECT_FALSE(within(1e-7, 0.0, {1e-8, 0.0}));
}

TEST(Within, FreesOnlyTheAllowedSideOfABound) {
  EXPECT_TRUE(within(-5.0, 1.0, {0.1, 0.0, Bound::at_most}));
  EXPECT_TRUE(within(1.1, 1.0, {0.11, 0.0, Bound::at_most}));
  EXPECT_FALSE(within(1.2, 1.0, {0.1, 0.0, Bound::at_most}));
  EXPECT_TRUE(within(5.0, 1.0, {0.1, 0.0, Bound::at_least}));
  EXPECT_FALSE(within(0.8, 1.0, {0.1, 0.0, Bound::at_least}));
}

TEST(Within, RefusesResultsScaledByOnePlusThreeTolerances) {
  for (const double expected : {1e-9, 0.3, -21.7, 6.1e7}) {
    for (const double relative : {1e-12, 1e-6, 1e-2, 0.2}) {
      const Tolerance tolerance{0.0, relative};
      // the computed value may itself be anywhere in the accepted interval
      for (const double place : {-0.99, 0.0, 0.99}) {
        const double computed = expected * (1.0 + place * relative);
        ASSERT_TRUE(within(computed, expected, tolerance));
        EXPECT_FALSE(within(computed * (1.0 + 3.0 * relative), expected, tolerance));
        EXPECT_FALSE(within(computed * (1.0 - 3.0 * relative), expected, tolerance));
        EXPECT_FALSE(within(computed + 3.0 * width(expected, tolerance), expected, tolerance));
        EXPECT_FALSE(within(computed - 3.0 * width(expected, tolerance), expected, tolerance));
      }
    }
  }
}

TEST(Check, MustBeComplete) {
  EXPECT_NO_THROW(require_complete(good_check()));
  const auto refused = [](auto change) {
    Check check = good_check();
    change(check);
    EXPECT_THROW(require_complete(check), std::invalid_argument);
  };
  refused([](Check& c) { c.because.clear(); });
  refused([](Check& c) { c.unit.clear(); });
  refused([](Check& c) { c.source.clear(); });
  refused([](Check& c) { c.quantity.clear(); });
  refused([](Check& c) { c.expected = nan; });
  refused([](Check& c) { c.tolerance.absolute = -1.0; });
  refused([](Check& c) { c.tolerance.absolute = inf; });
  refused([](Check& c) { c.tolerance.relative = nan; });
  refused([](Check& c) { c.tolerance.relative = 1.0; });
  refused([](Check& c) { c.tolerance.bound = Bound::at_most; });
  refused([](Check& c) { c.kind = Kind::reported; });
}

TEST(Check, MustBeAbleToFail) {
  Check check = good_check();
  check.expected = 1e6;
  check.tolerance = {1e-12, 0.0};
  EXPECT_FALSE(bites(check));
  EXPECT_THROW(require_complete(check), std::invalid_argument);
  check.tolerance = {};
  EXPECT_TRUE(bites(check));
  check.expected = 0.0;
  EXPECT_TRUE(bites(check));
  for (const Bound bound : {Bound::at_most, Bound::at_least}) {
    check.tolerance = {0.1, 0.0, bound};
    EXPECT_TRUE(bites(check));
  }
}

TEST(Margin, IsTheUsedPartOfTheTolerance) {
  Check check{"q", "m", Kind::limit, "s", 10.0, {0.5, 0.0}, "b"};
  EXPECT_DOUBLE_EQ(margin(10.25, check), 0.5);
  EXPECT_DOUBLE_EQ(margin(9.0, check), 2.0);
  EXPECT_EQ(margin(nan, check), inf);
  check.tolerance.bound = Bound::at_most;
  EXPECT_DOUBLE_EQ(margin(8.0, check), -4.0);
  check.tolerance = {};
  EXPECT_EQ(margin(10.0, check), 0.0);
  EXPECT_EQ(margin(10.1, check), inf);
}

TEST(Names, AreReadBackAndUnknownOnesRefused) {
  for (const Kind kind : {Kind::exact, Kind::limit, Kind::published, Kind::drift, Kind::reported})
    EXPECT_EQ(kind_of(name_of(kind)), kind);
  for (const Bound bound : {Bound::both, Bound::at_most, Bound::at_least})
    EXPECT_EQ(bound_of(name_of(bound)), bound);
  EXPECT_THROW(kind_of("exactly"), std::invalid_argument);
  EXPECT_THROW(bound_of(""), std::invalid_argument);
}

// Each test reports into a folder of its own.
class Report : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder);
    ::setenv("VOUSSOIR_VERDICTS", folder.c_str(), 1);
    ::setenv("VOUSSOIR_CASE_OUTPUT", (folder / "data").c_str(), 1);
    ::unsetenv("VOUSSOIR_FRESH");
  }
  static fs::path file(const std::string& name) { return folder / (name + ".json"); }
  static inline const fs::path folder = fs::path(testing::TempDir()) / "voussoir_report_test";
};

TEST_F(Report, PassesAndRecordsARow) {
  {
    CaseReport report("kept");
    EXPECT_TRUE(report.record(good_check(), -21.75, {42, 0.5}));
    report.report("steps", "1", 17.0, "how long it took");
  }
  const CaseFile stored = read_case_file(file("kept"));
  ASSERT_EQ(stored.rows.size(), 2u);
  EXPECT_EQ(stored.rows[0].check.quantity, "slip");
  EXPECT_EQ(stored.rows[0].cost.contact_evaluations, 42);
  EXPECT_EQ(verdict_of(stored.rows[0]), "passed");
  EXPECT_NEAR(error_of(stored.rows[0]), -0.05, 1e-12);
  EXPECT_EQ(verdict_of(stored.rows[1]), "reported");
  EXPECT_FALSE(stored.rows[0].commit.empty());
  EXPECT_TRUE(stored.failures.empty());
}

TEST_F(Report, FailsInGoogleTestAndInTheRow) {
  for (const double bad : {21.7, 0.0, nan, inf, -21.7 * 1.04}) {
    fs::remove_all(folder);
    const std::string name = "bad" + std::to_string(bad);
    EXPECT_NONFATAL_FAILURE(
        {
          CaseReport report(name);
          EXPECT_FALSE(report.record(good_check(), bad));
        },
        "because made for this test");
    const CaseFile stored = read_case_file(file(name));
    ASSERT_EQ(stored.rows.size(), 1u);
    EXPECT_EQ(verdict_of(stored.rows[0]), "FAILED");
  }
}

TEST_F(Report, MergesByQuantityAndDiscardsOldRowsWhenFresh) {
  const Row earlier{"merged", good_check(), -21.7, {}, "earlier"};
  Row renamed = earlier;
  renamed.check.quantity = "gone from the source";
  merge_into_case_file(file("merged"), "merged", {earlier, renamed}, "Old.Test", "");
  { CaseReport("merged").record(good_check(), -21.71); }
  CaseFile stored = read_case_file(file("merged"));
  ASSERT_EQ(stored.rows.size(), 2u);
  EXPECT_EQ(stored.rows[0].computed, -21.71);

  merge_into_case_file(file("fresh"), "fresh", {}, "Old.Test", "it broke");
  ::setenv("VOUSSOIR_FRESH", "1", 1);
  { CaseReport("fresh").record(good_check(), -21.71); }
  stored = read_case_file(file("fresh"));
  EXPECT_EQ(stored.rows.size(), 1u);
  EXPECT_TRUE(stored.failures.empty());
}

TEST_F(Report, RefusesTheSameQuantityTwice) {
  CaseReport report("twice");
  report.record(good_check(), -21.7);
  EXPECT_THROW(report.record(good_check(), -21.7), std::invalid_argument);
  EXPECT_THROW(report.report("slip", "m", 1.0, "note"), std::invalid_argument);
  EXPECT_THROW(report.report("other", "m", 1.0, ""), std::invalid_argument);
}

TEST_F(Report, ReportsAnExceptionAndAMissingPromisedCheck) {
  try {
    CaseReport report("thrown");
    report.record(good_check(), -21.7);
    throw std::runtime_error("the run broke");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(read_case_file(file("thrown")).failures.size(), 1u);

  EXPECT_NONFATAL_FAILURE({ CaseReport report("promised", {"slip"}); }, "'slip' was not recorded");
  EXPECT_EQ(read_case_file(file("promised")).failures.size(), 1u);
}

TEST_F(Report, CountsAsUnfinishedUntilItsEnd) {
  {
    CaseReport report("crash");
    EXPECT_EQ(read_case_file(file("crash")).failures.size(), 1u);
    report.record(good_check(), -21.7);
    report.write();
    EXPECT_EQ(read_case_file(file("crash")).failures.size(), 1u);
    EXPECT_EQ(read_case_file(file("crash")).rows.size(), 1u);
  }
  EXPECT_TRUE(read_case_file(file("crash")).failures.empty());
}

TEST_F(Report, WritesReferenceNumbersForTheStudy) {
  CaseReport report("referenced");
  report.reference("critical_friction", 33.357, "deg");
  report.reference("slip", 0.1, "m");
  const auto stored = nlohmann::json::parse(read_text(case_output("referenced") / "reference.json"));
  EXPECT_EQ(stored.at("critical_friction").at("value"), 33.357);
  EXPECT_EQ(stored.at("slip").at("unit"), "m");
  EXPECT_THROW(report.reference("bad", nan, "m"), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::verification::verification_test
