// unit.verification, second half: the table must not be greener than the files it is made from.
#include "verification/verdicts.hpp"
#include "text/csv_table.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <stdexcept>

namespace voussoir::verification::verdicts_test {
namespace {

namespace fs = std::filesystem;

Row row(const std::string& case_name, const std::string& quantity, Kind kind, double computed) {
  return {case_name, {quantity, "deg", kind, "Author 1999, eq. 1", 30.0, {0.1, 0.0}, "a | b"}, computed, {}, "abc"};
}

class Table : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder);
    merge_into_case_file(folder / "wedge.json", "wedge", {row("wedge", "angle", Kind::exact, 30.05)}, "T", "");
  }
  static Verdicts collected(const std::vector<std::string>& cases = {"wedge"},
                            const std::vector<std::string>& open = {}) {
    return collect(folder, cases, open, "abc");
  }
  static inline const fs::path folder = fs::path(testing::TempDir()) / "voussoir_table_test";
};

TEST_F(Table, PassesWhenEveryListedCasePassed) {
  EXPECT_TRUE(all_good(collected({"wedge"}, {"tunnel"})));
  EXPECT_EQ(one_line(collected()), "1 check passed, 0 failed, 0 cases not run");
}

TEST_F(Table, FailsWhenARowFails) {
  merge_into_case_file(folder / "wedge.json", "wedge", {row("wedge", "slip", Kind::exact, 30.2)}, "T", "");
  EXPECT_FALSE(all_good(collected()));
  EXPECT_EQ(count(collected()).failed, 1);
}

TEST_F(Table, FailsWhenACaseDidNotRun) {
  EXPECT_FALSE(all_good(collected({"wedge", "slump"})));
  EXPECT_NE(verdict_markdown(collected({"wedge", "slump"})).find("| slump | **not run** |"), std::string::npos);
  merge_into_case_file(folder / "slump.json", "slump", {}, "T", "");  // a file, but no rows
  EXPECT_FALSE(all_good(collected({"wedge", "slump"})));
}

TEST_F(Table, FailsWithoutAnyCheck) {
  EXPECT_FALSE(all_good(collected({}, {"wedge"})));
  merge_into_case_file(folder / "only.json", "only", {row("only", "steps", Kind::reported, 1.0)}, "T", "");
  EXPECT_FALSE(all_good(collected({"only"})));
}

TEST_F(Table, FailsForExtraRows) {
  EXPECT_FALSE(all_good(collected({"slump"})));  // nobody listed wedge
  merge_into_case_file(folder / "tunnel.json", "tunnel", {row("tunnel", "angle", Kind::exact, 30.0)}, "T", "");
  EXPECT_FALSE(all_good(collected({"wedge"}, {"tunnel"})));
}

TEST_F(Table, FailsForFailuresWithoutARow) {
  merge_into_case_file(folder / "wedge.json", "wedge", {}, "Wedge.Slides", "stopped by an exception");
  EXPECT_FALSE(all_good(collected()));
  merge_into_case_file(folder / "wedge.json", "wedge", {}, "Wedge.Slides", "");
  EXPECT_TRUE(all_good(collected()));
}

TEST_F(Table, FailsForFilesThatAreEmptyCutOrEdited) {
  const fs::path path = folder / "wedge.json";
  const std::string whole = read_text(path);
  write_atomically(path, "");
  EXPECT_FALSE(all_good(collected()));
  write_atomically(path, whole.substr(0, whole.size() / 2));
  EXPECT_FALSE(all_good(collected()));

  const auto edited = [&](auto change) {
    auto text = nlohmann::json::parse(whole);
    change(text);
    write_atomically(path, text.dump());
    EXPECT_FALSE(all_good(collected()));
    EXPECT_FALSE(collected().failures.empty());
  };
  edited([](auto& text) { text["rows"][0]["computed"] = 31.0; });  // still with the stored verdict passed
  edited([](auto& text) { text["rows"][0].erase("computed"); });
  edited([](auto& text) { text["rows"][0]["because"] = ""; });
  edited([](auto& text) { text["rows"][0]["case"] = "slump"; });
  edited([](auto& text) { text["rows"].push_back(text["rows"][0]); });  // the same row twice
  edited([](auto& text) { text["case"] = "slump"; });
}

TEST_F(Table, KeepsVerificationApartFromValidation) {
  merge_into_case_file(folder / "wedge.json", "wedge",
                       {row("wedge", "observed", Kind::published, 30.0), row("wedge", "steps", Kind::reported, 3.0)},
                       "T", "");
  const std::string text = verdict_markdown(collected());
  const auto verification = text.find("## Verification"), validation = text.find("## Validation");
  const auto reported = text.find("## Reported");
  ASSERT_NE(verification, std::string::npos);
  ASSERT_NE(validation, std::string::npos);
  ASSERT_NE(reported, std::string::npos);
  EXPECT_LT(verification, text.find("| wedge | angle"));
  EXPECT_LT(text.find("| wedge | angle"), validation);
  EXPECT_LT(validation, text.find("| wedge | observed"));
  EXPECT_LT(reported, text.find("| wedge | steps"));
}

TEST_F(Table, IsReadBackAsItWasWritten) {
  merge_into_case_file(folder / "wedge.json", "wedge",
                       {row("wedge", "broken", Kind::exact, std::numeric_limits<double>::quiet_NaN())}, "T", "x");
  const Verdicts verdicts = collected({"wedge", "slump"}, {"tunnel"});
  const Verdicts again = verdicts_from_json(nlohmann::json::parse(verdict_json(verdicts).dump()));
  EXPECT_EQ(verdict_markdown(again), verdict_markdown(verdicts));
  EXPECT_EQ(verdict_csv(again), verdict_csv(verdicts));
  EXPECT_EQ(parse_csv(verdict_csv(verdicts)).rows.size(), 2u);
}

}  // namespace
}  // namespace voussoir::verification::verdicts_test
