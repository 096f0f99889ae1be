// Records in scenes: files, directions, units, overrides, hash, and mistakes.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/exchange/record_file.hpp"
#include "core/load/ground_motion.hpp"
#include "core/scene/effective_scene.hpp"
#include "core/scene/judge_values.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/scene.hpp"

namespace voussoir::records_test {
namespace {

namespace fs = std::filesystem;

const std::string rock = R"(dimension = 3
gravity = [0, 0, -9.81]
density = 2600
domain = { box = { min = [-1, -1, -1], max = [1, 1, 1] } }
joints = [{ name = "A", dip = 0, point = [0, 0, 0] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 25 }]
fix = [{ below = ["A"] }]
[[stage]]
name = "shake"
kind = "run"
duration_s = 1
[[stage.move]]
below = ["A"]
)";

const std::string at2 =
    "PEER\nNowhere, 270\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 5, DT= .1 SEC\n 0 .1 -.2 .1 0\n";

class Records : public testing::Test {
 protected:
  Records() {
    fs::create_directories(folder_ / "deep");
    write("a.at2", at2);
    write("b.txt", "0\n1\n0\n");
  }
  ~Records() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  Scene parse(const std::string& factor, const std::vector<std::string>& overrides = {}) const {
    return parse_scene(rock + factor, (folder_ / "scene.toml").string(), overrides);
  }
  void expect_refused(const std::string& factor, const std::string& part,
                      const std::vector<std::string>& overrides = {}) const {
    SCOPED_TRACE(part);
    try {
      prepare<3>(parse(factor, overrides));
      ADD_FAILURE() << "accepted";
    } catch (const SceneError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(part), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos);
    }
  }
  std::vector<std::string> warnings(const std::string& factor) const {
    const Scene scene = parse(factor);
    return judge_values(scene, prepare<3>(scene));
  }
  void expect_warned(const std::string& factor, const std::string& part) const {
    std::string all;
    for (const std::string& warning : warnings(factor))
      all += warning + "\n";
    EXPECT_NE(all.find(part), std::string::npos) << all;
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("voussoir_records_{}", ::getpid());
};

const RecordedMotion& first_record(const Scene& scene) {
  return scene.stages.front().plan.change.move.front().records.front();
}

TEST_F(Records, AreReadBesideTheSceneInTheirUnit) {
  const Scene scene = parse("factor = { record = \"a.at2\", azimuth_deg = 270, scale = 2 }\n");
  const RecordedMotion& record = first_record(scene);
  EXPECT_EQ(record.motion->name, "a.at2");
  EXPECT_EQ(record.motion->quantity, MotionQuantity::acceleration);
  EXPECT_DOUBLE_EQ(record.motion->acceleration[2], -0.2 * 2 * 9.80665);
  EXPECT_EQ(record.direction, (std::vector<double>{-1, 0, 0}));
  ASSERT_EQ(scene.files.size(), 1u);
  EXPECT_EQ(scene.files.front().filename(), "a.at2");
  // its blocks move so
  const Model<3> model = apply(prepare<3>(scene).model, scene.stages.front().plan.change);
  ASSERT_EQ(model.prescribed.size(), 1u);
  EXPECT_EQ(model.prescribed.front().records.front().motion, record.motion);
  EXPECT_TRUE(model.prescribed.front().translation[2]);
  EXPECT_TRUE(warnings("factor = { record = \"a.at2\", azimuth_deg = 270 }\n").empty());
}

TEST_F(Records, OfSeveralComponentsAreAList) {
  const Scene scene = parse(R"(factor = [
  { record = "a.at2", direction = [3, 0, 4], polarity = "reversed" },
  { record = "b.txt", interval_s = 0.1, unit = "cm/s", direction = [0, 0, 1] }]
)");
  const auto& records = scene.stages.front().plan.change.move.front().records;
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].direction, (std::vector<double>{0.6, 0, 0.8}));
  EXPECT_DOUBLE_EQ(records[0].motion->acceleration[1], -0.1 * 9.80665);
  EXPECT_EQ(records[1].motion->quantity, MotionQuantity::velocity);
  EXPECT_DOUBLE_EQ(records[1].motion->velocity[1], 0.01);
  EXPECT_EQ(scene.files.size(), 2u);
}

// the hash follows the values; the scene of a run needs no file; an override of the file reads another
TEST_F(Records, AreInTheHashAndInTheScenesText) {
  const std::string factor = "factor = { record = \"a.at2\", direction = [1, 0, 0] }\n";
  const Scene scene = parse(factor);
  const std::string hash = input_hash(scene), text = toml_text(*scene.tree);
  const Scene again = parse_scene(text, "elsewhere/scene.toml");
  EXPECT_EQ(input_hash(again), hash);
  EXPECT_EQ(first_record(again).motion->displacement, first_record(scene).motion->displacement);
  EXPECT_TRUE(again.files.empty());

  write("a.at2", at2 + "");
  EXPECT_EQ(input_hash(parse(factor)), hash);
  std::string other = at2;
  other.replace(other.find("-.2"), 3, "-.3");
  write("a.at2", other);
  EXPECT_NE(input_hash(parse(factor)), hash);
  write("c.at2", at2);
  const Scene changed =
      parse(factor, {"stage.shake.move.1.factor.1.record=c.at2", "stage.shake.move.1.factor.1.scale=3"});
  EXPECT_EQ(first_record(changed).motion->name, "c.at2");
  EXPECT_DOUBLE_EQ(first_record(changed).motion->acceleration[2], -0.2 * 3 * 9.80665);
  const Scene twice =
      read_tree(*scene.tree, (folder_ / "scene.toml").string(), {"stage.shake.move.1.factor.1.record=c.at2"});
  EXPECT_EQ(first_record(twice).motion->name, "c.at2");
}

// a file of a base is in the base's folder
TEST_F(Records, OfABaseAreBesideIt) {
  write("deep/base.toml", rock + "factor = { record = \"r.at2\", direction = [1, 0, 0] }\n");
  write("deep/r.at2", at2);
  const Scene scene = parse_scene("base = \"deep/base.toml\"\n", (folder_ / "top.toml").string());
  EXPECT_EQ(first_record(scene).motion->name, "r.at2");
}

TEST_F(Records, AreRefusedInOneLine) {
  const std::string key = "stage.shake.move.1.factor.1.";
  expect_refused("factor = { record = \"no.at2\", direction = [1, 0, 0] }", "no such file in the scene's folder");
  expect_refused("factor = { record = \"../a.at2\", direction = [1, 0, 0] }", "in the scene's own folder");
  expect_refused("factor = { record = 3, direction = [1, 0, 0] }", key + "record = 3");
  expect_refused("factor = { recrod = \"a.at2\" }", "did you mean 'record'?");
  expect_refused("factor = 3", "factor = 3: must be a list of tables");
  expect_refused("factor = { record = \"a.at2\" }", key + "direction is missing");
  expect_refused("factor = { record = \"a.at2\", direction = [0, 0, 0] }", "must not be zero");
  expect_refused("factor = { record = \"a.at2\", direction = [1, 0, 0], azimuth_deg = 3 }", "remove one of the two");
  expect_refused("factor = { record = \"a.at2\", direction = [1, 0, 0], unit = \"gal\" }", "but the file states g");
  expect_refused("factor = { record = \"a.at2\", direction = [1, 0, 0], quantity = \"velocity\" }",
                 "but the file states acceleration");
  expect_refused("factor = { record = \"b.txt\", direction = [1, 0, 0], unit = \"g\" }", "b.txt:1: has one column");
  expect_refused("factor = { record = \"b.txt\", direction = [1, 0, 0], interval_s = 0.1 }", key + "unit is missing");
  expect_refused(
      "factor = { record = \"b.txt\", direction = [1, 0, 0], interval_s = 0.1, unit = \"cm\", quantity = "
      "\"velocity\" }",
      "cm is a unit of displacement, and quantity = \"velocity\"");
  expect_refused("factor = { record = \"b.txt\", direction = [1, 0, 0], interval_s = -1, unit = \"cm\" }",
                 key + "interval_s = -1");
  expect_refused(
      "factor = { record = \"b.txt\", direction = [1, 0, 0], interval_s = 1, unit = \"cm/s\", baseline = "
      "\"end\" }",
      "corrects accelerations");
  expect_refused("factor = { record = \"a.at2\", direction = [1, 0, 0], from_s = 0.35 }", key + "from_s = 0.35");
  expect_refused("factor = { record = \"a.at2\", direction = [1, 0, 0] }\nvelocity = [1, 0, 0]",
                 "stage.shake.move.1.velocity = [1, 0, 0]: is stated together with factor");
  expect_refused("factor = { record = \"a.at2\", direction = [1, 0, 0] }\ntranslation = [\"y\"]",
                 "has a component along x");
}

TEST_F(Records, AreJudged) {
  const std::string with = ", direction = [1, 0, 0], interval_s = 0.1, unit = \"m/s2\" }\n";
  write("drift.txt", "0\n1\n1\n0.5\n0\n");
  expect_warned("factor = { record = \"drift.txt\"" + with, "ends with a velocity of 0.25 m/s, 100 % of its peak");
  write("large.txt", "0\n40\n-40\n0\n");
  expect_warned("factor = { record = \"large.txt\"" + with, "peak acceleration of 4.08 g");
  write("cut.txt", "0\n0\n1\n-2\n");
  expect_warned("factor = { record = \"cut.txt\"" + with, "its peak at its last value");
  write("late.txt", "0.5\n-1\n1\n0\n");
  expect_warned("factor = { record = \"late.txt\"" + with, "begins with 50 % of its peak");
  expect_warned("factor = { record = \"a.at2\", azimuth_deg = 90 }\n", "differs from the 270 in the file's header");
  expect_warned("factor = { record = \"a.at2\", azimuth_deg = 270, pad_s = 0.7 }\n", "continues until 1.1 s");
}

// the units that keys list are those that files are read in
TEST(RecordKeys, HaveTheUnitsOfRecords) {
  const KeyRow* row = find_row({"record"}, "unit");
  ASSERT_TRUE(row);
  ASSERT_EQ(row->choices.size(), record_units().size());
  for (std::size_t k = 0; k < row->choices.size(); ++k)
    EXPECT_EQ(row->choices[k], record_units()[k].word);
}

}  // namespace
}  // namespace voussoir::records_test
