// unit.verification: a value that has moved since an earlier version is reported with its old and new value, and is a
// failure unless the changelog announces it.
#include "verification/history.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "text/csv_table.hpp"

namespace voussoir::verification::history_test {
namespace {

namespace fs = std::filesystem;

Verdicts verdicts(double angle, long long evaluations = 100) {
  Verdicts made{"abc", {{"wedge", CaseState::run}}, {}, {}, {}, {}};
  made.rows.push_back({"wedge",
                       {"critical friction", "deg", Kind::exact, "source", 30.0, {0.1, 0.0}, "b"},
                       angle,
                       {evaluations, 1.0},
                       ""});
  made.rows.push_back({"wedge", {"steps", "1", Kind::reported, "this run", 0.0, {}, "note"}, 3.0, {}, ""});
  Row timed{"wedge", {"time", "s", Kind::reported, "this run", 0.0, {}, "note"}, 0.5 * angle, {}, ""};
  timed.check.by_the_clock = true;
  made.rows.push_back(timed);
  return made;
}

class History : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder);
    write_atomically(folder / "0.9.0.jsonl", history_lines(verdicts(30.01), "abc"));
    write_atomically(folder / "0.10.0.jsonl", history_lines(verdicts(30.02), "abc"));
  }
  static PastVersion newest() { return read_history(folder).back(); }
  static inline const fs::path folder = fs::path(testing::TempDir()) / "voussoir_history_test";
};

TEST_F(History, IsReadInTheOrderOfVersions) {
  const auto history = read_history(folder);
  ASSERT_EQ(history.size(), 2u);
  EXPECT_EQ(history[0].version, "0.9.0");
  EXPECT_EQ(history[1].version, "0.10.0");
  EXPECT_EQ(history[1].math_functions, "abc");
  EXPECT_EQ(math_functions_in("voussoir 1\nfast_arithmetic no\nmath functions  0abc, a hash of\n"), "0abc");
  EXPECT_EQ(math_functions_in("voussoir 1\n"), "");
  EXPECT_EQ(history[1].rows.size(), 3u);
  EXPECT_DOUBLE_EQ(*history[1].rows[0].error, 30.02 - 30.0);
  EXPECT_TRUE(read_history(folder / "none").empty());
}

TEST_F(History, ReportsNoValueThatStayed) {
  EXPECT_TRUE(moved_since(newest(), verdicts(30.02)).empty());
  EXPECT_TRUE(moved_since(newest(), verdicts(30.02 * (1 + 1e-10))).empty());  // rounding
}

TEST_F(History, ReportsOldAndNewValuesThatMoved) {
  const auto moved = moved_since(newest(), verdicts(30.020001));  // and the time, which is measured by the clock
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_EQ(describe(moved[0], "0.10.0"), "wedge: critical friction: 30.020001 deg, was 30.02 in 0.10.0");

  const auto cost = moved_since(newest(), verdicts(30.02, 101));
  ASSERT_EQ(cost.size(), 1u);
  EXPECT_EQ(describe(cost[0], "0.10.0"), "wedge: critical friction: 101 contact evaluations, were 100 in 0.10.0");

  Verdicts fewer = verdicts(30.02);
  fewer.rows.erase(fewer.rows.begin() + 1);
  const auto gone = moved_since(newest(), fewer);
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(describe(gone[0], "0.10.0"), "wedge: steps: is gone, was 3 in 0.10.0");
}

TEST_F(History, AMoveMustBeAnnouncedInTheFirstSection) {
  const auto announced = [](const std::string& changelog, std::size_t idle = 0) {
    Verdicts now = verdicts(30.03);
    now.moved = moved_since(newest(), now);
    EXPECT_EQ(mark_announced(now.moved, changelog).size(), idle) << changelog;
    return all_announced(now);
  };
  EXPECT_FALSE(announced(""));
  EXPECT_FALSE(announced("# Changelog\n\n## 0.11.0 (unreleased)\n\n- Faster.\n"));
  EXPECT_TRUE(announced(
      "# Changelog\n\n## 0.11.0 (unreleased)\n\n- Moved: `wedge`: `critical friction`, since the step halved\n"));
  EXPECT_TRUE(announced("## 0.11.0 (unreleased)\n- Moved: `wedge`, all of it\n## 0.10.0\n"));
  EXPECT_FALSE(announced("## 0.11.0 (unreleased)\n- Moved: `wedge`: `steps`\n", 1));
  EXPECT_FALSE(announced("## 0.11.0 (unreleased)\n- Moved: `slump`\n", 1));
  EXPECT_FALSE(announced("## 0.11.0\n## 0.10.0\n- Moved: `wedge`\n"));  // in the section of an earlier version
}

TEST_F(History, IsShownInTheTable) {
  Verdicts now = verdicts(30.03);
  now.compared_with = "0.10.0";
  now.moved = moved_since(newest(), now);
  EXPECT_EQ(one_line(now), "1 check passed, 0 failed, 0 cases not run, 1 row moved since 0.10.0");
  const Verdicts again = verdicts_from_json(verdict_json(now));
  EXPECT_EQ(verdict_markdown(again), verdict_markdown(now));
  EXPECT_NE(verdict_markdown(again).find("| moved since 0.10.0 |"), std::string::npos);
  EXPECT_NE(verdict_markdown(again).find("| was 30.02 |"), std::string::npos);
}

TEST_F(History, IsDrawnWithItsMoves) {
  const CsvTable table = parse_csv(history_csv(read_history(folder), verdicts(30.02)));
  ASSERT_EQ(table.rows.size(), 9u);  // two quantities and the cost at three places, without the time
  EXPECT_EQ(table.rows[0].cells[3].text, "0.9.0");
  EXPECT_NEAR(std::stod(table.rows[0].cells[4].text), -0.01 / 30.02, 1e-12);
  EXPECT_EQ(table.rows[0].cells[5].text, "1");
  EXPECT_EQ(table.rows[1].cells[5].text, "0");
  EXPECT_EQ(table.rows[2].cells[3].text, "now");
  EXPECT_EQ(table.rows[6].cells[1].text, history_cost);
  EXPECT_EQ(table.rows[6].cells[4].text, "0");
}

TEST_F(History, RefusesInvalidHistories) {
  Verdicts failing = verdicts(31.0);
  EXPECT_THROW(history_lines(failing, ""), std::runtime_error);
  const auto message = [](const std::string& name, const std::string& text) {
    write_atomically(folder / name, text);
    std::string refusal;
    try {
      read_history(folder);
    } catch (const std::runtime_error& problem) {
      refusal = problem.what();
    }
    fs::remove(folder / name);
    return refusal;
  };
  EXPECT_NE(message("1.0.0.jsonl", history_lines(verdicts(30.0), "") + "{\"case\": 1}\n").find("1.0.0.jsonl:5:"),
            std::string::npos);
  EXPECT_NE(message("one.jsonl", "").find("'one' is not a version"), std::string::npos);
}

}  // namespace
}  // namespace voussoir::verification::history_test
