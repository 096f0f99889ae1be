// `voussoir study` as users see it: settings in, study.csv out, even if single runs fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/testing/program.hpp"

namespace voussoir::study_test {
namespace {

using namespace program;

const char* const plan = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "stiffness"
key = "joint_properties.rock.normal_stiffness"
values = [1e8, 2e8]
unit = "Pa/m"
extrapolate = { power = 1 }
)";

class Study : public Program {
 protected:
  Study() { write("scene.toml", read(scenes / "two_cubes.toml")); }
  std::vector<std::string> rows(const std::string& out = "out") const {
    return lines_of(read(folder_ / out / "study.csv"));
  }
  // of the settings that ended well
  std::vector<double> results() const {
    std::vector<double> found;
    for (const std::string& row : rows()) {
      std::istringstream cells(row);
      std::string cell;
      for (int k = 0; k < 6; ++k)
        std::getline(cells, cell, ',');
      if (row.find(",ok,") != std::string::npos) found.push_back(std::stod(cell));
    }
    return found;
  }
  // all but the seconds, which come last
  std::string without_seconds(const std::string& out) const {
    std::string text;
    for (const std::string& row : rows(out))
      text += row.substr(0, row.rfind(',')) + "\n";
    return text;
  }
};

TEST_F(Study, HasARowForEverySetting) {
  write("study.toml", plan);
  const Ended ended = run("study study.toml --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "") << "no progress without a terminal";
  EXPECT_NE(ended.out.find("4 settings, 0 failed: out/study.csv\n2 different runs, 0 of them kept from before\n"),
            std::string::npos)
      << ended.out;
  const std::vector<std::string> rows = this->rows();
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0],
            "sweep,key,value,unit,quantity,result,error_bar,result_unit,status,contact_evaluations,steps,seconds");
  EXPECT_EQ(rows[1].find("default,,,,top_displacement_z,-0.0001999"), 0u) << rows[1];
  EXPECT_EQ(
      rows[2].find("stiffness,joint_properties.rock.normal_stiffness,100000000,Pa/m,top_displacement_z,-0.0001999"), 0u)
      << rows[2];
  EXPECT_NE(rows[3].find(",m,ok,"), std::string::npos);

  // through (1, -2) and (2, -1): -3 at zero
  EXPECT_NE(rows[4].find("extrapolated 100000000->200000000,Pa/m,top_displacement_z,-0.000"), std::string::npos)
      << rows[4];
  std::istringstream cells(rows[4]);
  std::string cell;
  for (int k = 0; k < 6; ++k)
    std::getline(cells, cell, ',');
  EXPECT_NEAR(std::stod(cell), -3e-4, 1e-8);
}

TEST_F(Study, AnyNumberOfJobsGivesTheSameBytes) {
  write("study.toml", R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "stiffness"
key = "joint_properties.rock.normal_stiffness"
values = [1e8, 2e8, 4e8, 3e8]
[[sweep]]
name = "damping"
key = "statics"
values = ["local", "adaptive"]
)");
  ASSERT_EQ(run("study study.toml --out one --jobs 1").code, 0);
  ASSERT_EQ(run("study study.toml --out four --jobs 4 --threads 2").code, 0);
  EXPECT_EQ(without_seconds("one"), without_seconds("four"));
  EXPECT_EQ(rows("one").size(), 8u);
}

// Runs of one scene are the same runs, whichever names of keys the plan states.
TEST_F(Study, TakesKeysByTheirEarlierNames) {
  const std::string earlier = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
set = ["damping.increments=2"]
[[sweep]]
name = "statics"
key = "damping.statics"
values = ["local", "newton"]
[[grid]]
name = "both"
keys = [{ key = "stage.settle.damping.statics", values = ["adaptive", "newton"] },
        { key = "density", values = [1000, 2000] }]
[[sample]]
name = "drawn"
rows = 2
set = ["damping.statics=newton"]
keys = [{ key = "density", law = "uniform", least = 1000, most = 2000 }]
)";
  std::string present = earlier;
  for (const auto& [before, after] : {std::pair<std::string, std::string>{"damping.increments", "static_increments"},
                                      std::pair<std::string, std::string>{"damping.statics", "statics"}})
    for (auto at = present.find(before); at != std::string::npos; at = present.find(before))
      present.replace(at, before.size(), after);
  write("study.toml", earlier);
  EXPECT_EQ(run("study study.toml --out out").code, 0);
  const std::vector<std::string> rows = this->rows();
  ASSERT_EQ(rows.size(), 10u);
  write("study.toml", present);
  const Ended ended = run("study study.toml --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("9 different runs, 9 of them kept from before"), std::string::npos) << ended.out;
}

TEST_F(Study, KeepsCompletedRuns) {
  const auto kept = [&](int different, int before) {
    const Ended ended = run("study study.toml --out out --jobs 2");
    EXPECT_EQ(ended.code, 0) << ended.err;
    const std::string wanted = fmt::format("{} different runs, {} of them kept from before", different, before);
    EXPECT_NE(ended.out.find(wanted), std::string::npos) << wanted << "\n" << ended.out;
  };
  std::string text = plan;
  write("study.toml", text);
  kept(2, 0);
  const std::string first = read(folder_ / "out/study.csv");
  kept(2, 2);
  EXPECT_EQ(read(folder_ / "out/study.csv"), first) << "the seconds included";

  // another value is another run; the one that is no longer requested is removed
  text.replace(text.find("2e8"), 3, "3e8");
  write("study.toml", text);
  kept(2, 1);
  const auto folders = std::distance(fs::directory_iterator(folder_ / "out/runs"), fs::directory_iterator());
  EXPECT_EQ(folders, 2);

  // a comment changes no run, a number of the scene changes all
  const std::string scene = read(folder_ / "scene.toml");
  write("scene.toml", scene + "# no more\n");
  kept(2, 2);
  ASSERT_NE(scene.find("density = 2000"), std::string::npos);
  std::string denser = scene;
  denser.replace(denser.find("density = 2000"), 14, "density = 2001");
  write("scene.toml", denser);
  kept(2, 0);

  // a run without its results is repeated
  fs::remove(fs::directory_iterator(folder_ / "out/runs")->path() / "results.json");
  kept(2, 1);
}

TEST_F(Study, AFailedSettingIsARowToo) {
  write("study.toml", R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "patience"
key = "stage.settle.step_limit"
values = [5, 100000]
set = ["damping.local=0.6"]
)");
  const Ended ended = run("study study.toml --out out");
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.out.find("(patience: stage.settle.step_limit = 5): incomplete: stage settle"), std::string::npos)
      << ended.out;
  ASSERT_EQ(rows().size(), 4u);
  EXPECT_NE(rows()[2].find("top_displacement_z,,,,"), std::string::npos) << rows()[2];
  EXPECT_NE(rows()[2].find("incomplete: stage settle"), std::string::npos) << rows()[2];
  EXPECT_NE(rows()[3].find(",ok,"), std::string::npos) << rows()[3];
}

TEST_F(Study, TakesAQuantityFromTheHistory) {
  std::string text = plan;
  text.replace(text.find("[[sweep]]"), 0,
               "history = { column = \"top_displacement_z_m\", take = \"smallest\", unit = \"m\" }\n");
  write("study.toml", text);
  ASSERT_EQ(run("study study.toml --out out").code, 0);
  EXPECT_NE(rows()[1].find(",top_displacement_z,-0.000"), std::string::npos) << rows()[1];
  EXPECT_NE(rows()[1].find(",m,ok,"), std::string::npos) << rows()[1];
}

TEST_F(Study, LeavesOutRejectedTrialsOfASearch) {
  write("scene.toml", read(VOUSSOIR_SOURCE_DIR "/cases/wedge/scene.toml"));
  write("study.toml",
        "scene = \"scene.toml\"\nquantity = \"lowest\"\n"
        "history = { column = \"friction_rock_deg\", take = \"smallest\", unit = \"deg\" }\n"
        "[[sweep]]\nname = \"newton\"\nkey = \"contact.newton_tolerance\"\nvalues = [1e-5]\nunit = \"1\"\n");
  ASSERT_EQ(run("study study.toml --jobs 1 --out out").code, 0);
  const auto entry = *fs::directory_iterator(folder_ / "out/runs");
  double on_the_path = 90, anywhere = 90;
  std::istringstream history(read(entry.path() / "history.csv"));
  std::string line;
  std::getline(history, line);
  ASSERT_TRUE(line.starts_with("time_s,stage,trial,friction_rock_deg")) << line;
  while (std::getline(history, line)) {
    std::istringstream cells(line);
    std::string time, stage, trial, friction;
    for (std::string* cell : {&time, &stage, &trial, &friction})
      std::getline(cells, *cell, ',');
    anywhere = std::min(anywhere, std::stod(friction));
    if (trial == "0") on_the_path = std::min(on_the_path, std::stod(friction));
  }
  EXPECT_LT(anywhere, on_the_path) << "no trial was rejected: the test shows nothing";
  std::istringstream cells(rows()[1]);
  std::string cell;
  for (int i = 0; i < 6; ++i)
    std::getline(cells, cell, ',');
  EXPECT_EQ(std::stod(cell), on_the_path) << rows()[1];
}

TEST_F(Study, AColumnIsFoundByItsFullName) {
  std::string scene = read(folder_ / "scene.toml");
  scene += "[[monitors]]\nname = \"left,upper\"\nquantities = [\"displacement\"]\nabove = [\"bed\"]\n";
  write("scene.toml", scene);
  const std::string column = "history = { column = \"left,upper_displacement_z_m\", take = \"last\", unit = \"m\" }\n";
  std::string text = plan;
  write("study.toml", text);
  ASSERT_EQ(run("study study.toml --out plain").code, 0);
  text.replace(text.find("[[sweep]]"), 0, column);
  write("study.toml", text);
  ASSERT_EQ(run("study study.toml --out out").code, 0);
  // the same block under two names
  EXPECT_EQ(without_seconds("out"), without_seconds("plain"));
}

TEST_F(Study, OfAQuantityThatNoRunHasEndsWithItsFirstRun) {
  std::string text = plan;
  text.replace(text.find("top_displacement_z"), 18, "top_displacement_w");
  text.replace(text.find("[1e8, 2e8]"), 10, "[1.1e8, 1.2e8, 1.3e8, 1.4e8, 1.5e8, 1.6e8]");
  write("study.toml", text);
  const auto runs_done = [&] {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/runs"))
      count += fs::exists(entry.path() / "results.json");
    return count;
  };
  for (int k = 0; k < 2; ++k) {  // the second time the run is kept from before
    expect_one_line(run("study study.toml --jobs 1 --out out"), 2,
                    "study.toml: no run has a value of results.json 'top_displacement_w'; did you mean "
                    "'top_displacement_x'? there are: top_displacement_x, top_displacement_y, top_displacement_z");
    EXPECT_EQ(runs_done(), 1);
    EXPECT_FALSE(fs::exists(folder_ / "out/study.csv"));
  }
  text.replace(text.find("[[sweep]]"), 0, "history = { column = \"w\", take = \"last\", unit = \"m\" }\n");
  write("study.toml", text);
  expect_one_line(run("study study.toml --jobs 1 --out out"), 2,
                  "no run has a column of history.csv 'w'; there are: time_s, ");
}

TEST_F(Study, RemovesOnlyRunsOfAStudy) {
  std::string text = plan;
  write("study.toml", text);
  fs::create_directories(folder_ / "out/runs/thesis");
  write("out/runs/thesis/data.csv", "mine");
  write("out/runs/notes.txt", "mine");
  ASSERT_EQ(run("study study.toml --out out").code, 0);
  std::vector<fs::path> made;
  for (const auto& entry : fs::directory_iterator(folder_ / "out/runs"))
    if (entry.path().filename().string().size() == 32) made.push_back(entry.path());
  ASSERT_EQ(made.size(), 2u);
  std::ofstream(made[0] / "remarks.txt") << "mine";
  std::ofstream(made[1] / "remarks.txt") << "mine";

  // another scene: both runs are removed, but no other files in the folder
  write("scene.toml", read(folder_ / "scene.toml") + "[output]\nhistory_interval_s = 1\n");
  ASSERT_EQ(run("study study.toml --out out").code, 0);
  for (const fs::path& folder : made) {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1) << folder;
    EXPECT_EQ(read(folder / "remarks.txt"), "mine");
  }
  EXPECT_EQ(read(folder_ / "out/runs/thesis/data.csv"), "mine");
  EXPECT_EQ(read(folder_ / "out/runs/notes.txt"), "mine");
}

// the first never reaches equilibrium; ending it must not end the others
const char* const endless = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "rest"
key = "stage.settle.gravity_ramp_s"
values = [1e8, 0]
set = ["stage.settle.step_limit=1000000000000", "statics=local"]
)";

TEST_F(Study, ARunThatHangsLosesOneSetting) {
  write("study.toml", endless);
  const Ended ended = run("study study.toml --out out --jobs 2 --time-limit 2");
  EXPECT_EQ(ended.code, 1) << ended.err;
  ASSERT_EQ(rows().size(), 4u);
  EXPECT_NE(rows()[2].find("not done after 2 s"), std::string::npos) << rows()[2];
  const auto has_checkpoint = [](const fs::directory_entry& entry) { return fs::exists(entry.path() / "checkpoint"); };
  const fs::directory_iterator runs(folder_ / "out/runs");
  EXPECT_EQ(std::count_if(runs, {}, has_checkpoint), 1) << "with more time it would continue from there";
  EXPECT_NE(rows()[3].find(",ok,"), std::string::npos) << rows()[3];
}

TEST_F(Study, ARunThatIsKilledLosesOneSetting) {
  write("study.toml", endless);
  // the processor time that each process may take
  const Ended ended = run("study study.toml --out out --jobs 2", "ulimit -t 1 && ");
  EXPECT_EQ(ended.code, 1) << ended.err;
  ASSERT_EQ(rows().size(), 4u);
  EXPECT_NE(rows()[2].find("ended by signal"), std::string::npos) << rows()[2];
  EXPECT_NE(rows()[3].find(",ok,"), std::string::npos) << rows()[3];
}

// twice the stiffness under twice the weight: nothing changes
TEST_F(Study, KeysThatAreTiedChangeTogether) {
  write("study.toml", R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "stiffness and density"
key = "joint_properties.rock.normal_stiffness"
values = [1e8, 2e8]
with = [{ key = "density", values = [2000, 4000] }, { key = "joint_properties.rock.shear_stiffness", values = [1e7, 2e7] }]
)");
  const Ended ended = run("study study.toml --out out");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::vector<std::string> rows = this->rows();
  ASSERT_EQ(rows.size(), 4u);
  std::vector<double> results;
  for (const std::string& row : {rows[2], rows[3]}) {
    std::istringstream cells(row);
    std::string cell;
    for (int k = 0; k < 6; ++k)
      std::getline(cells, cell, ',');
    results.push_back(std::stod(cell));
  }
  EXPECT_LT(results[0], 0);
  EXPECT_NEAR(results[1] / results[0], 1, 1e-5);

  for (const char* wrong :
       {"[{ key = \"density\", values = [1] }]", "[{ values = [1, 2] }]", "3", "[]", "[3]",
        "[{ key = \"density\", values = [1, 2], unit = \"kg\" }]", "[{ key = \"densty\", values = [1, 2] }]"}) {
    write("study.toml", std::string("scene = \"scene.toml\"\nquantity = \"x\"\n[[sweep]]\nname = \"a\"\nkey = "
                                    "\"time.fraction\"\nvalues = [0.1, 0.2]\nwith = ") +
                            wrong + "\n");
    expect_one_line(run("study study.toml --out bad"), 2, "");
    EXPECT_FALSE(fs::exists(folder_ / "bad")) << wrong;
  }
}

// `voussoir limit` as the run: on a plane the critical friction is its dip
TEST_F(Study, MayRunLimitAnalysis) {
  write("plane.toml", R"(
preset = "thesis"
dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [-2, -3], max = [2, 3] } }
joints = [{ name = "A", dip = 30, dip_direction = 90, point = [0, -1] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 40, cohesion = 1e3 }]
fix = [{ below = ["A"] }]
stage = [{ name = "settle", kind = "settle" }]
)");
  const double dips[] = {30, 10, 20};  // the scene's own, then the sweep's
  const std::string sweep = "[[sweep]]\nname = \"dip\"\nkey = \"joints.A.dip\"\nvalues = [10, 20]\n";
  write("study.toml", "scene = \"plane.toml\"\nquantity = \"critical_friction\"\nlimit = {}\n" + sweep);
  const Ended first = run("study study.toml --out out");
  ASSERT_EQ(first.code, 0) << first.err << first.out;
  ASSERT_EQ(results().size(), 3u);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(results()[k], dips[k], 1e-3);
  EXPECT_NE(run("study study.toml --out out").out.find("3 of them kept"), std::string::npos);

  // another analysis is another run, also for a single sweep
  write("study.toml",
        "scene = \"plane.toml\"\nquantity = \"factor_of_safety\"\nlimit = { factor = true }\n" + sweep +
            "[[sweep]]\nname = \"bonded\"\nkey = \"joints.A.dip\"\nvalues = [20]\nlimit = { factor = true, cohesion = "
            "true, joint = [\"rock\"] }\n");
  const Ended second = run("study study.toml --out out");
  ASSERT_EQ(second.code, 0) << second.err << second.out;
  ASSERT_EQ(results().size(), 4u);
  const double deg = std::numbers::pi / 180, friction = std::tan(40 * deg);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(results()[k], friction / std::tan(dips[k] * deg), 1e-4);
  // 4 m wide and, in the mean, 4 m high
  const double weight = 2000 * 10 * 4 * 4, length = 4 / std::cos(20 * deg);
  EXPECT_NEAR(results()[3], results()[2] + 1e3 * length / (weight * std::sin(20 * deg)), 1e-4);

  const std::string begin = "scene = \"plane.toml\"\nquantity = \"critical_friction\"\n";
  for (const char* wrong :
       {"limit = 3", "limit = { load = \"sideways\" }", "limit = { load = \"left\", factor = true }",
        "limit = { joint = [\"rock\"] }", "limit = { cohesion = 1 }", "limit = { friction = \"rock\" }",
        "limit = { lod = \"left\" }", "limit = {}\nhistory = { column = \"x\", take = \"last\", unit = \"m\" }"}) {
    write("study.toml", begin + wrong + "\n" + sweep);
    expect_one_line(run("study study.toml --out bad"), 2, "");
    EXPECT_FALSE(fs::exists(folder_ / "bad")) << wrong;
  }
}

// `voussoir blocks` as the run: a block on a plane has F = tan φ / tan δ, and it moves below 1
TEST_F(Study, MayRunBlockTheory) {
  write("plane.toml", R"(
dimension = 3
gravity = [0, 0, -10]
density = 2000
domain = { box = { min = [-2, -2, -3], max = [2, 2, 3] } }
joints = [{ name = "A", dip = 30, dip_direction = 90, point = [0, 0, -1] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 35 }]
fix = [{ below = ["A"] }]
)");
  const std::string begin = "scene = \"plane.toml\"\nblocks = {}\n",
                    sweep = "[[sweep]]\nname = \"dip\"\nkey = \"joints.A.dip\"\nvalues = [20, 40]\n";
  write("study.toml", begin + "quantity = \"least_factor\"\n" + sweep);
  const Ended first = run("study study.toml --out out");
  ASSERT_EQ(first.code, 0) << first.err << first.out;
  ASSERT_EQ(results().size(), 3u);
  const double deg = std::numbers::pi / 180, dips[] = {30, 20, 40};
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(results()[k], std::tan(35 * deg) / std::tan(dips[k] * deg), 1e-9);

  write("study.toml", begin + "quantity = \"volume_below_1\"\n" + sweep);
  const Ended second = run("study study.toml --out out");
  ASSERT_EQ(second.code, 0) << second.err << second.out;
  ASSERT_EQ(results().size(), 3u);
  EXPECT_EQ(results()[0], 0);
  EXPECT_EQ(results()[1], 0);
  EXPECT_NEAR(results()[2], 4 * 4 * 4, 1e-9) << "4 m wide, and 4 m high in the mean";

  for (const char* wrong :
       {"blocks = 3", "blocks = { aftr = \"x\" }", "blocks = { after = 3 }", "blocks = {}\nlimit = {}"}) {
    write("study.toml", std::string("scene = \"plane.toml\"\nquantity = \"least_factor\"\n") + wrong + "\n" + sweep);
    expect_one_line(run("study study.toml --out bad"), 2, "");
    EXPECT_FALSE(fs::exists(folder_ / "bad")) << wrong;
  }
}

TEST_F(Study, IsReadStrictly) {
  const std::pair<std::string, std::string> edits[] = {
      {"unit", "units"},
      {"values = [1e8, 2e8]", "values = 3"},
      {"power = 1", "power = 0"},
      {"[[sweep]]", "[sweep]"},
      {"\"joint_properties.rock.normal_stiffness\"", "\"joint_properties.rock.stiffness\""},
      {"values = [1e8, 2e8]", "values = [1e8, -2e8]"},
      {"[[sweep]]", "history = { column = \"x\", take = \"mean\", unit = \"m\" }\n[[sweep]]"},
      {"\"scene.toml\"", "\"no.toml\""}};
  for (const auto& [from, to] : edits) {
    std::string text = plan;
    text.replace(text.find(from), from.size(), to);
    write("study.toml", text);
    const Ended ended = run("study study.toml --out out");
    expect_one_line(ended, 2, "");
    EXPECT_FALSE(fs::exists(folder_ / "out")) << to;
  }
  write("study.toml", "scene = \"scene.toml\"\nquantity = \"x\"\nswep = []\n");
  expect_one_line(run("study study.toml --out out"), 2, "study.toml:3: swep = []: no such key; did you mean 'sweep'?");
}

}  // namespace
}  // namespace voussoir::study_test
