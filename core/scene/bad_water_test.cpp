// Mistakes in the keys of water.
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_water_test {
namespace {

using namespace bad_scenes;

class BadWater : public testing::TestWithParam<BadInput> {};

TEST_P(BadWater, IsReportedInOneLine) {
  expect_reported(GetParam());
}

const std::string lake = "[[water]]\nname = \"lake\"\n";
const std::string level = lake + "level = 1\n";
const std::string seep = "[[water]]\nname = \"seep\"\n";

// the water is written after the monitors, its change in the settle stage
const std::string running = level + "[[stage]]\nname = \"drain\"\nkind = \"run\"\nduration_s = 2\n[[stage.water]]\n";
const std::string settling = level + "[[stage]]\nname = \"drain\"\nkind = \"settle\"\n[[stage.water]]\n";

INSTANTIATE_TEST_SUITE_P(
    Surfaces, BadWater,
    testing::Values(
        BadInput{"nothing_stated", "", lake, "water.lake.level is missing", "or a table of points, or pressure"},
        BadInput{"no_name", "", "[[water]]\nlevel = 1", "water.1.name is missing", "unique among the waters"},
        BadInput{"level_and_pressure", "", level + "pressure = 5 #!", "water.lake.pressure = 5",
                 "only one of level, table and pressure"},
        BadInput{"points_in_space", "", lake + "table = [[0, 1], [1, 2]] #!", "water.lake.table", "must be a table"},
        BadInput{"negative_pressure", "", lake + "pressure = -5 #!", "water.lake.pressure = -5", "must lie between"},
        BadInput{"no_weight", "", level + "unit_weight = 0 #!", "water.lake.unit_weight = 0", "must be greater than 0"},
        BadInput{"weight_of_a_pressure", "", lake + "pressure = 5\nunit_weight = 9810 #!",
                 "water.lake.unit_weight = 9810", "together with a pressure"},
        BadInput{"twice", "", level + "[[water]]\nlevel = 2\nname = \"lake\" #!", "water.lake.name = \"lake\"",
                 "must be unique in water"},
        BadInput{"steep", "", lake + "table = { point = [0, 0, 1], dip = 85, dip_direction = 90 } #!",
                 "water.lake.table.dip = 85", "must lie between 0 and 80"},
        BadInput{"dips_nowhere", "", lake + "table = { point = [0, 0, 1], dip = 5 } ",
                 "water.lake.table.dip_direction is missing", "a plane that dips needs it"},
        BadInput{"level_of_words", "", lake + "level = \"high\" #!", "water.lake.level = \"high\"",
                 "must be a number"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Faces, BadWater,
    testing::Values(
        BadInput{"no_such_joint", "", level + "faces = [\"C\"] #!", "water.lake.faces = [\"C\"]",
                 "no joint or joint set is named 'C'"},
        BadInput{"no_such_word", "", level + "faces = \"outside\" #!", "water.lake.faces = \"outside\"",
                 "no joint or joint set is named"},
        BadInput{"two_waters", "", level + "faces = [\"A\"]\n" + seep + "level = 2\nfaces = [\"B\", \"A\"] #!",
                 "water.seep.faces = [\"B\", \"A\"]", "joint 'A' already have the water 'lake'"},
        BadInput{"two_waters_outside", "", level + seep + "level = 2\nfaces = \"outer\" #!",
                 "water.seep.faces = \"outer\"", "the outer faces already have the water 'lake'"},
        BadInput{"a_number", "", level + "faces = 5 #!", "water.lake.faces = 5", "must be a name or a list of names"},
        BadInput{"a_name_twice", "", level + "faces = [\"A\", \"A\"] #!", "water.lake.faces", "appears twice"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Changes, BadWater,
    testing::Values(
        BadInput{"without_time", "", running + "name = \"lake\"\nlevel = 0 ",
                 "stage.drain.water.lake.duration_s is missing", "a change of water needs a duration"},
        BadInput{"without_time_at_rest", "", settling + "name = \"lake\"\nlevel = 0 ",
                 "stage.drain.water.lake.duration_s is missing", "like gravity_ramp_s"},
        BadInput{"two_times", "", running + "name = \"lake\"\nlevel = 0\nduration_s = 1\nrate = 1 #!",
                 "stage.drain.water.lake.rate = 1", "together with duration_s"},
        BadInput{"unknown", "", running + "name = \"lkae\" #!\nlevel = 0\nduration_s = 1",
                 "stage.drain.water.lkae.name = \"lkae\"", "did you mean 'lake'?"},
        BadInput{"to_a_pressure", "", running + "name = \"lake\"\nduration_s = 1\npressure = 5 #!",
                 "stage.drain.water.lake.pressure = 5", "has a level or a table"},
        BadInput{"to_nothing", "", running + "name = \"lake\"\nduration_s = 1 ",
                 "stage.drain.water.lake.level is missing", "elevation of the water"},
        BadInput{"longer_than_the_stage", "", running + "name = \"lake\"\nlevel = 0\nduration_s = 3 #!",
                 "stage.drain.water.lake.duration_s = 3", "the stage ends after 2 s"},
        BadInput{"too_slow_for_the_stage", "", running + "name = \"lake\"\nlevel = 0\nrate = 0.25 #!",
                 "stage.drain.water.lake.rate = 0.25", "last 4 s, but the stage ends after 2 s"},
        BadInput{"longer_than_the_limit", "",
                 level + "[[stage]]\nname = \"drain\"\nkind = \"settle\"\ntime_limit_s = 5\n[[stage.water]]\nname = "
                         "\"lake\"\nlevel = 0\nduration_s = 5 #!",
                 "stage.drain.water.lake.duration_s = 5", "must be less than time_limit_s"},
        BadInput{"tilting_at_a_rate", "",
                 running + "name = \"lake\"\ntable = { point = [0, 0, 1], dip = 5, dip_direction = 90 }\nrate = 1 #!",
                 "stage.drain.water.lake.rate = 1", "the rise then differs from place to place"},
        BadInput{"while_friction_falls", "kind = \"reduce\"",
                 "kind = \"reduce\"\nwater = [{ name = \"lake\", level = 0, duration_s = 1 }] #!", "stage.reduce.water",
                 "applies only if kind"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Monitors, BadWater,
    testing::Values(BadInput{"level_of_nothing", "", level + "[[monitors]]\nname = \"l\"\nquantities = [\"level\"]",
                             "monitors.l.water is missing", "level is a quantity of a water"},
                    BadInput{"level_of_no_water", "",
                             level + "[[monitors]]\nname = \"l\"\nquantities = [\"level\"]\nwater = \"sea\" #!",
                             "monitors.l.water = \"sea\"", "no water of this name"},
                    BadInput{"force_of_a_water", "",
                             level + "[[monitors]]\nname = \"l\"\nwater = \"lake\"\nquantities = [\"water_load\"] #!",
                             "monitors.l.quantities", "has its level only"},
                    BadInput{"bonds_of_a_block", "",
                             "[[monitors]]\nname = \"l\"\nbodies = [\"far\"]\nquantities = [\"whole_bonds\"]",
                             "monitors.l.joint is missing", "whole_bonds is a quantity of a joint"}),
    by_name);

const std::string in_the_plane = R"(dimension = 2
density = 2000
gravity = [0, -9.81]
[[blocks]]
name = "stone"
box = { min = [0, 0], max = [1, 1] }
[[water]]
name = "lake"
)";
const std::string then = "\n[[stage]]\nname = \"drain\"\nkind = \"run\"\nduration_s = 2\n";

TEST(BadTable, IsReportedInOneLine) {
  struct Row {
    const char *text, *key, *phrase;
  };
  const std::string to_one =
      then + "[[stage.water]]\nname = \"lake\"\nduration_s = 1\ntable = [[0, 1], [1, 1], [2, 1]]";
  for (const Row& row : {Row{"table = [[0, 1]]", "scene.toml:9: water.lake.table", "at least two points"},
                         Row{"table = [[1, 1], [0, 2]]", "scene.toml:9: water.lake.table", "ascending x"},
                         Row{"table = [[0, 1], [0, 2]]", "scene.toml:9: water.lake.table", "each x once"},
                         Row{"table = [[0, 1, 2], [1, 1, 2]]", "water.lake.table.1", "a list of 2 numbers"},
                         Row{"table = { dip = 5 }", "scene.toml:9: water.lake.table", "must be a list of points"}}) {
    const std::string message = complaint_about(in_the_plane + row.text + then);
    EXPECT_NE(message.find(row.key), std::string::npos) << message;
    EXPECT_NE(message.find(row.phrase), std::string::npos) << message;
  }
  const std::string message = complaint_about(in_the_plane + "table = [[0, 1], [1, 2]]" + to_one);
  EXPECT_NE(message.find("scene.toml:17: stage.drain.water.lake.table"), std::string::npos) << message;
  EXPECT_NE(message.find("has 3 points, but the water has 2"), std::string::npos) << message;
  EXPECT_EQ(complaint_about(in_the_plane + "table = [[0, 1], [1, 2], [2, 2]]" + to_one), "");
}

}  // namespace
}  // namespace voussoir::bad_water_test
