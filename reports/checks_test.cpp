// unit.study_report: all checks at a glance, of made-up verdicts; names for gnuplot; files of subfolders.
#include "reports/checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "reports/drawing.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports::checks_test {
namespace {

namespace fs = std::filesystem;
using namespace verification;

Row row(const std::string& of_case, Kind kind, double expected, double computed, Tolerance tolerance) {
  static int number = 0;
  return {of_case, {"q" + std::to_string(++number), "m", kind, "s", expected, tolerance, "b"}, computed, {}, ""};
}

Verdicts some() {
  Verdicts verdicts;
  verdicts.rows = {row("wedge", Kind::exact, 10, 10.5, {1, 0}),
                   row("wedge", Kind::exact, -10, -9.5, {1, 0}),
                   row("slump", Kind::limit, 0, 0.25, {1, 0}),
                   row("slump", Kind::limit, 3, 2, {0, 0, Bound::at_most}),
                   row("slump", Kind::exact, 7, 7, {0, 0}),
                   row("tunnel", Kind::published, 100, 130, {10, 0}),
                   row("tunnel", Kind::published, 1, std::numeric_limits<double>::quiet_NaN(), {1, 0}),
                   row("tunnel", Kind::reported, 1, 2, {1, 0})};
  return verdicts;
}

TEST(Checks, SpreadIsMeanAndSampleDeviation) {
  EXPECT_EQ(spread_of({}).count, 0);
  EXPECT_EQ(spread_of({4}).deviation, 0);
  const Spread two = spread_of({1, 3});
  EXPECT_EQ(two.mean, 2);
  EXPECT_DOUBLE_EQ(two.deviation, std::sqrt(2.0));
  EXPECT_EQ(in_words(two), "bias 2, scatter 1.4");
}

TEST(Checks, VerificationAndValidationAreApart) {
  const CheckSpreads spreads = spreads_of(some());
  const GroupSpread &verification = spreads.groups[0], &validation = spreads.groups[1];
  EXPECT_EQ(verification.title, "Verification");
  EXPECT_EQ(verification.judged, 5);
  EXPECT_EQ(verification.passed, 5);
  EXPECT_EQ(verification.one_sided, 1);
  EXPECT_EQ(verification.without_room, 1);
  EXPECT_EQ(verification.expected_zero, 1);
  EXPECT_EQ(verification.over_tolerance.count, 3);
  EXPECT_DOUBLE_EQ(verification.over_tolerance.mean, (0.5 + 0.5 + 0.25) / 3);
  EXPECT_EQ(verification.log_ratio.count, 2);
  EXPECT_DOUBLE_EQ(verification.log_ratio.mean, (std::log(1.05) + std::log(0.95)) / 2);
  EXPECT_EQ(spreads.cases(0), (std::vector<std::string>{"wedge", "slump"}));
  EXPECT_EQ(validation.judged, 2);
  EXPECT_EQ(validation.passed, 0);
  EXPECT_EQ(validation.failed_to_compute, 1);
  EXPECT_EQ(validation.over_tolerance.count, 1);
  EXPECT_EQ(validation.over_tolerance.mean, 3);
  EXPECT_TRUE(spreads.can_be_drawn());
  EXPECT_FALSE(spreads_of({}).can_be_drawn());
}

TEST(Checks, PointsAreForLogarithmicAxesAndClampedAtTheEdge) {
  EXPECT_EQ(checks_csv(some()),
            "group,case,side,place,expected,computed,over_tolerance\n"
            "Verification,wedge,both,0.76,10,10.5,0.5\n"
            "Verification,wedge,both,1,10,9.5,0.5\n"
            "Verification,slump,both,1.76,,,0.25\n"
            "Verification,slump,one,,3,2,\n"
            "Verification,slump,both,,7,7,\n"
            "Validation,tunnel,both,0.76,100,130,1.4\n"
            "Validation,tunnel,both,,,,\n");
  EXPECT_EQ(checks_cases_csv(spreads_of(some())),
            "group,place,mean,deviation\nVerification,1,0.5,0\nVerification,2,0.25,0\nValidation,1,3,0\n");
}

TEST(Checks, PageHasBothFiguresAndTheTable) {
  const std::string page = checks_markdown(spreads_of(some()));
  for (const char* part :
       {"(checks_values.svg)", "(checks_errors.svg)", "| Verification | 5 | 5 | 3 | 1 | 1 | 0.42 | 0.14 | 0.9987 |",
        "| Validation | 2 | 0 | 1 | 0 | 0 | 3 | 0 | 1.3000 | 0 % |"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
  EXPECT_NE(checks_markdown({}).find("| 0 | 0 |"), std::string::npos);
}

TEST(Drawing, NamesAreWords) {
  EXPECT_EQ(as_words({}), "");
  EXPECT_EQ(as_words({"time step", "don't", "a|b"}), "\"time step\" \"don't\" \"a|b\"");
  EXPECT_THROW(as_words({"a \"b\""}), std::runtime_error);
}

TEST(Drawing, FilesOfSubfoldersComeInTheOrderOfNames) {
  const fs::path root = fs::path(testing::TempDir()) / "voussoir_subfolders";
  fs::remove_all(root);
  for (const char* name : {"b", "a", "c"})
    write_atomically(root / name / (name == std::string("c") ? "other.json" : "x.json"), "1");
  const auto found = in_subfolders(root, "x.json");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "a");
  EXPECT_EQ(found[1].file, root / "b" / "x.json");
  EXPECT_TRUE(in_subfolders(root / "nowhere", "x.json").empty());
}

}  // namespace
}  // namespace voussoir::reports::checks_test
