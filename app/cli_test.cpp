// The program as its users meet it: arguments in, files, messages and exit codes out.
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/base/progress_line.hpp"
#include "app/testing/program.hpp"

namespace voussoir {
namespace {

using namespace program;

TEST(ProgressLine, WithoutATerminalItAddsALineAtTimes) {
  ProgressReport report;
  report.stage = "settle";
  report.stage_number = report.stage_count = 1;
  const auto shown = [&](bool wanted, std::chrono::milliseconds between) {
    testing::internal::CaptureStderr();
    ProgressLine line(wanted, false, between);
    for (report.steps = 1000; report.steps <= 3000; report.steps += 1000)
      line.show(report);
    line.clear();
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(shown(true, std::chrono::hours(1)), "");
  EXPECT_EQ(shown(false, std::chrono::milliseconds(0)), "");
  const std::vector<std::string> lines = lines_of(shown(true, std::chrono::milliseconds(0)));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines.front(), "voussoir: stage 1/1 settle: 1000 steps, t = 0 s");
}

// ---- run ----------------------------------------------------------------------------------------------------------

TEST_F(Program, RunWritesResultsThatOpen) {
  const Ended ended = run("run " + cubes_);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "") << "no progress where nobody watches";
  EXPECT_NE(ended.out.find("done"), std::string::npos);
  EXPECT_NE(ended.out.find("results: results/two_cubes"), std::string::npos) << ended.out;

  const std::string where = "results/two_cubes";
  for (const char* name :
       {"results.json", "history.csv", "scene.toml", "blocks.pvd", "contacts.pvd", "frames/blocks_0000.vtp",
        "frames/contacts_0000.vtp", "force_lines.pvd", "frames/force_lines_0000.vtp"})
    EXPECT_TRUE(fs::exists(folder_ / where / name)) << name;
  EXPECT_EQ(results(where)["status"], "done");
  // weight over stiffness: 20 kN / 100 MN/m
  EXPECT_NEAR(settlement(where), -2e-4, 1e-8);
  EXPECT_EQ(lines_of(read(folder_ / where / "history.csv")).front(),
            "time_s,stage,top_displacement_x_m,top_displacement_y_m,top_displacement_z_m");
}

TEST_F(Program, TheEffectiveSceneRunsAgain) {
  ASSERT_EQ(run("run " + cubes_ + "--out first --set joint_properties.rock.normal_stiffness=2e8").code, 0);
  EXPECT_NEAR(settlement("first"), -1e-4, 1e-8);
  ASSERT_EQ(run("run first/scene.toml --out second").code, 0);
  EXPECT_EQ(results("first")["input_hash"], results("second")["input_hash"]);
  EXPECT_EQ(settlement("first"), settlement("second"));
}

TEST_F(Program, ScenesInThePlaneRunToo) {
  EXPECT_EQ(run("run " + squares_ + "--out out").code, 0);
  EXPECT_EQ(results("out")["dimension"], 2);
}

TEST_F(Program, ThreadsDoNotChangeTheResults) {
  ASSERT_EQ(run("run " + cubes_ + "--out one --threads 1").code, 0);
  ASSERT_EQ(run("run " + cubes_ + "--out two --threads 2").code, 0);
  nlohmann::json one = results("one"), two = results("two");
  one.erase("timing");
  two.erase("timing");
  EXPECT_EQ(one, two);
  EXPECT_EQ(read(folder_ / "one/history.csv"), read(folder_ / "two/history.csv"));
}

TEST_F(Program, ResultsAreNotOverwrittenUnasked) {
  ASSERT_EQ(run("run " + cubes_ + "--out out").code, 0);
  const std::string before = read(folder_ / "out/results.json");
  expect_one_line(run("run " + cubes_ + "--out out --set stage.settle.step_limit=50000"), 2, "--overwrite");
  EXPECT_EQ(read(folder_ / "out/results.json"), before);

  // frames of a longer run must not survive in a shorter one's folder
  write("out/frames/blocks_0007.vtp", "old");
  write("out/notes.txt", "mine");
  EXPECT_EQ(run("run " + cubes_ + "--out out --overwrite").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/frames/blocks_0007.vtp"));
  EXPECT_TRUE(fs::exists(folder_ / "out/notes.txt"));
}

TEST_F(Program, BadInputWritesNothing) {
  expect_one_line(run("run nowhere.toml --out out"), 2, "nowhere.toml");
  expect_one_line(run("run " + cubes_ + "--out out --set densty=1"), 2, "density");
  expect_one_line(run("run " + cubes_ + "--out out --set density=-1"), 2, "density");
  expect_one_line(run("run " + cubes_ + "--out out --set joints.bad.dip=1"), 2, "bed");
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(Program, ARunWhoseEnergyDoesNotCloseSaysSo) {
  const std::string bounce = std::string("run ") +
                             VOUSSOIR_SOURCE_DIR "/cases/bounce/scene.toml --set output.history_interval_s=0 " +
                             "--set damping.viscous_ratio=0 ";
  const auto doubts = [&](const std::string& where) {
    const nlohmann::json warnings = results(where)["warnings"];
    return std::count_if(warnings.begin(), warnings.end(), [](const nlohmann::json& w) {
      return w.get<std::string>().find("energy ledger does not close") != std::string::npos;
    });
  };
  ASSERT_EQ(run(bounce + "--set time.fraction=0.05 --out fine").code, 0);
  EXPECT_EQ(doubts("fine"), 0);
  EXPECT_LT(results("fine")["energy"]["closure"], 0.01);

  // a one-sided contact gains energy when the step is long
  const Ended coarse = run(bounce + "--set time.fraction=0.9 --out coarse");
  ASSERT_EQ(coarse.code, 0);
  EXPECT_EQ(doubts("coarse"), 1);
  EXPECT_NE(coarse.err.find("energy ledger does not close"), std::string::npos) << coarse.err;
  EXPECT_GT(results("coarse")["energy"]["closure"], 0.05);
}

TEST_F(Program, AGoalNotReachedIsOne) {
  const Ended ended = run("run " + cubes_ + "--out out --set stage.settle.step_limit=5");
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_EQ(results("out")["status"], "incomplete");
  EXPECT_NE(results("out")["message"], "");
  EXPECT_NE(ended.out.find("incomplete"), std::string::npos);
}

TEST_F(Program, AStageThatRemovesTheLastFreeBlockLeavesTheOnesBefore) {
  write("dig.toml", read(scenes / "two_cubes.toml") +
                        "[[stage]]\nname = \"dig\"\nkind = \"settle\"\n[[stage.remove]]\nabove = [\"bed\"]\n");
  const Ended ended = run("run dig.toml --out out");
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_EQ(ended.err.find("unexpected"), std::string::npos) << ended.err;
  EXPECT_NE(ended.out.find("no block is free to move"), std::string::npos) << ended.out;
  EXPECT_EQ(results("out")["status"], "incomplete");
  EXPECT_EQ(results("out")["stages"].size(), 2u);
  EXPECT_EQ(results("out")["stages"][0]["ended"], "equilibrium");
}

TEST_F(Program, StrengthCountsWhereJointsAreBondedAndTheResultsCountTheBonds) {
  const std::string strong = cubes_ + "--set joint_properties.rock.cohesion=1e5 ",
                    bonded = strong + "--set stage.settle.bond=true ";
  EXPECT_NE(run("check " + strong).out.find("no stage bonds any"), std::string::npos);
  const Ended doubted = run("run " + strong + "--out doubted");
  EXPECT_NE(doubted.err.find("no stage bonds any"), std::string::npos) << doubted.err;
  EXPECT_FALSE(results("doubted").contains("bonds"));

  const Ended checked = run("check " + bonded);
  EXPECT_EQ(checked.out.find("no stage bonds any"), std::string::npos) << checked.out;
  EXPECT_NE(checked.out.find("0 closed joints press and can be bonded, 1 when they first press"), std::string::npos)
      << checked.out;
  const Ended done = run("run " + bonded + "--out done");
  EXPECT_NE(done.out.find("bonds: 1 made, 1 whole, 0 broken"), std::string::npos) << done.out;
  EXPECT_EQ(results("done")["bonds"]["made"], 1);
  EXPECT_EQ(results("done")["bonds"]["whole"], 1);

  EXPECT_NE(run("check " + cubes_ + "--set stage.settle.bond=true").out.find("bonds nothing"), std::string::npos);
  if (!is_built_in("glpk")) return;
  const Ended limit = run("limit " + squares_ + "--out limit --set joint_properties.rock.cohesion=1e5");
  EXPECT_NE(limit.err.find("leaves both out"), std::string::npos) << limit.err;
}

TEST_F(Program, ANumericalFailureIsFour) {
  const Ended ended = run("run " + cubes_ + "--out out --set contact.newton_limit=1");
  EXPECT_EQ(ended.code, 4) << ended.err;
  EXPECT_EQ(results("out")["status"], "failed");
  EXPECT_GT(results("out")["counters"]["unconverged"], 0);
}

TEST_F(Program, AnUnwritableFolderIsFive) {
  write("file", "");
  expect_one_line(run("run " + cubes_ + "--out file/out"), 5, "cannot write 'file/out'");
  expect_one_line(run("slice " + cubes_ + "--out file"), 5, "cannot write 'file'");
}

TEST_F(Program, QuietSaysNothing) {
  const Ended ended = run("run " + cubes_ + "--out out --quiet");
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out + ended.err, "");
  expect_one_line(run("run " + cubes_ + "--out short --quiet --set stage.settle.step_limit=5"), 1, "incomplete");
}

TEST_F(Program, ExchangeablePartsAgreeOrSayThatTheyAreMissing) {
  ASSERT_EQ(run("run " + cubes_ + "--out own").code, 0);
  // what must be built in, and the choice
  const std::pair<std::string, std::string> choices[] = {{"glpk", "contact.lp=glpk"},
                                                         {"ipopt", "contact.centre=ipopt"},
                                                         {"ipopt", "contact.centre=ipopt_scaled"},
                                                         {"", "contact.point=centroid"},
                                                         {"", "contact.overlap=bracketing"}};
  for (const auto& [needs, choice] : choices) {
    const bool built_in = is_built_in(needs);
    const std::string folder = choice.substr(choice.find('=') + 1);
    const Ended ended = run("run " + cubes_ + "--out " + folder + " --set " + choice);
    if (built_in) {
      EXPECT_EQ(ended.code, 0) << ended.err;
      EXPECT_NEAR(settlement(folder), settlement("own"), 1e-9);
    } else {
      expect_one_line(ended, 2, "is not built in");
    }
  }
}

// ---- check, slice, docs, the command line -------------------------------------------------------------------------

TEST_F(Program, CheckTellsWhatIsActive) {
  const Ended ended = run("check " + cubes_);
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* part : {"2: 1 free, 1 fixed", "bed: dip/dip direction 0/0, 2 faces", "local 0.7", "not active",
                           "about 0.0002 m", "no warnings"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  EXPECT_TRUE(folder_is_empty());

  const Ended soft = run("check " + cubes_ + "--set joint_properties.rock.normal_stiffness=1e6");
  EXPECT_EQ(soft.code, 0);
  EXPECT_NE(soft.out.find("warning: blocks sink by"), std::string::npos) << soft.out;
  expect_one_line(run("check " + cubes_ + "--set gravity=down"), 2, "gravity");
}

TEST_F(Program, ALevelOfAccuracyShowsWhatItSets) {
  const Ended ended = run("check " + cubes_ + "--set accuracy.level=fast");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("by level    equilibrium.unbalanced = 1e-05"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("no warnings"), std::string::npos) << ended.out;
  expect_one_line(run("check " + cubes_ + "--set accuracy.level=exact"), 2, "accuracy.level");

  // the effective scene states it, and runs again to the same
  ASSERT_EQ(run("run " + cubes_ + "--out first --set accuracy.level=fast").code, 0);
  EXPECT_NE(read(folder_ / "first/scene.toml").find("unbalanced = 1e-05"), std::string::npos);
  ASSERT_EQ(run("run first/scene.toml --out second").code, 0);
  EXPECT_EQ(results("first")["input_hash"], results("second")["input_hash"]);
}

TEST_F(Program, SliceListsTheBlocks) {
  EXPECT_EQ(run("slice " + cubes_ + "--out out").code, 0);
  const std::vector<std::string> rows = lines_of(read(folder_ / "out/blocks.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], "body,name,volume_m3,faces,inscribed_radius_m,fixed,x_m,y_m,z_m");
  ASSERT_EQ(rows[1].substr(0, 3), "0,,");
  EXPECT_NEAR(std::stod(rows[1].substr(3)), 1, 1e-14);
  EXPECT_TRUE(fs::exists(folder_ / "out/blocks.vtp"));
}

TEST_F(Program, LimitAnswersProvesAndDraws) {
  const std::string slump = "'" + (fs::path(VOUSSOIR_SOURCE_DIR) / "cases/slump/scene.toml").string() + "' ";
  if (!is_built_in("glpk")) return expect_one_line(run("limit " + slump), 2, "-DVOUSSOIR_WITH_GLPK=ON");
  const Ended ended = run("limit " + slump + "--out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* part : {"critical_friction 15.335", "7 of 21 free blocks move", "associated flow", "gap between"})
    EXPECT_NE(ended.out.find(part), std::string::npos) << part << "\n" << ended.out;
  for (const char* name : {"limit.svg", "blocks.vtp", "mechanism.vtp", "forces.vtp"})
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  const nlohmann::json json = results("out");
  EXPECT_NEAR(json["values"]["critical_friction"]["value"].get<double>(), 15.335, 0.001);
  EXPECT_EQ(json["mechanism"]["moving"].size(), 7u);
  EXPECT_EQ(json["interfaces"].size(), 42u);
  expect_one_line(run("limit " + slump + "--out out"), 2, "--overwrite");

  // a load's factor, and questions that have no answer
  const std::string weaker = slump + "--set joint_properties.rock.friction_deg=20 --overwrite --out out ";
  EXPECT_EQ(run("limit " + weaker + "--load left").code, 0);
  EXPECT_GT(results("out")["values"]["collapse_factor"]["value"], 0);
  const Ended any = run("limit " + squares_ + "--out any");
  EXPECT_EQ(any.code, 0);
  EXPECT_NE(any.out.find("stand without friction"), std::string::npos) << any.out;
  EXPECT_EQ(results("any")["status"], "done");
  EXPECT_EQ(results("any")["values"]["critical_friction"]["value"], 0);
  const std::string changed = "--overwrite --out any --set stage.settle.friction_deg=10";
  expect_one_line(run("limit " + squares_ + changed), 0, "before its first stage");

  // a block that leans out over its base topples however rough it is: other words, another value, another code
  write("leaning.toml",
        "dimension = 2\ngravity = [0, -10]\ndensity = 2000\n"
        "blocks = [{ name = \"base\", box = { min = [0, -1], max = [1, 0] }, fixed = true },\n"
        "          { name = \"leaning\", vertices = [[0, 0], [1, 0], [4, 3], [3, 3]] }]\n"
        "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
        "stage = [{ name = \"s\", kind = \"settle\" }]\n");
  const Ended none = run("limit leaning.toml --out none");
  EXPECT_EQ(none.code, 1);
  EXPECT_NE(none.out.find("no friction up to 89 degrees is enough"), std::string::npos) << none.out;
  EXPECT_EQ(results("none")["status"], "incomplete");
  EXPECT_FALSE(results("none")["values"].contains("critical_friction"));
  EXPECT_NEAR(results("none")["values"]["friction_not_enough"]["value"].get<double>(), 89, 1e-9);
  expect_one_line(run("limit " + cubes_ + "--out bad"), 2, "dimension = 3");
  expect_one_line(run("limit " + slump + "--friction roc --out bad"), 2, "there are: rock");
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

// with friction alone the factor of safety is the ratio of the tangents; cohesion adds to it where it is asked for
TEST_F(Program, LimitFindsTheFactorOfSafety) {
  if (!is_built_in("glpk")) GTEST_SKIP();
  const std::string slump = "'" + (fs::path(VOUSSOIR_SOURCE_DIR) / "cases/slump/scene.toml").string() +
                            "' --set joint_properties.rock.friction_deg=30 --overwrite --out out ";
  const auto factor = [&](const std::string& options) {
    const Ended ended = run("limit " + slump + "--factor " + options);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("factor_of_safety "), std::string::npos) << ended.out;
    const nlohmann::json value = results("out")["values"]["factor_of_safety"];
    EXPECT_LT(value["error_bar"].get<double>(), 1e-6);
    return value["value"].get<double>();
  };
  const double degree = std::numbers::pi / 180, friction = factor("");
  EXPECT_NEAR(friction, std::tan(30 * degree) / std::tan(15.335 * degree), 1e-3);
  EXPECT_EQ(factor("--joint rock"), friction);
  EXPECT_EQ(factor("--set joint_properties.rock.cohesion=1e4"), friction) << "left out unless asked for";
  EXPECT_GT(factor("--cohesion --set joint_properties.rock.cohesion=1e4"), friction * 1.01);
  expect_one_line(run("limit " + slump + "--factor --joint roc"), 2, "--joint roc: no joint_properties of this name");
  expect_one_line(run("limit " + slump + "--factor --load left"), 2, "--load");
  expect_one_line(run("limit " + slump + "--factor --friction rock"), 2, "--friction");
  expect_one_line(run("limit " + slump + "--joint rock"), 2, "--factor");
}

// under water a block has its buoyant weight: it leaves friction's part of the factor, and raises that of cohesion
TEST_F(Program, LimitCountsWater) {
  if (!is_built_in("glpk")) GTEST_SKIP();
  write("plane.toml", R"(
dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [-2, -3], max = [2, 3] } }
joints = [{ name = "A", dip = 20, dip_direction = 90, point = [0, -1] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 40, cohesion = 1e3 }]
water = [{ name = "lake", level = 5 }]
fix = [{ below = ["A"] }]
stage = [{ name = "settle", kind = "settle" }]
)");
  const double dip = 20 * std::numbers::pi / 180, friction = std::tan(2 * dip) / std::tan(dip);
  const double weight = 4 * 4 * (2000 * 10 - 9810), cohesion = 1e3 * 4 / std::cos(dip) / (weight * std::sin(dip));
  const auto factor = [&](const std::string& options) {
    EXPECT_EQ(run("limit plane.toml --factor --overwrite --out out " + options).code, 0);
    return results("out")["values"]["factor_of_safety"]["value"].get<double>();
  };
  EXPECT_NEAR(factor(""), friction, 1e-6);
  EXPECT_NEAR(factor("--cohesion"), friction + cohesion, 1e-6);
}

TEST_F(Program, LimitFindsTheFactorOfAppliedForces) {
  if (!is_built_in("glpk")) GTEST_SKIP();
  // a column of 1 x 3 m and 75 kN/m, pushed at 2 m: it tips at 75 kN / 4
  const std::string column =
      "dimension = 2\ngravity = [0, -10]\ndensity = 2500\n"
      "blocks = [{ name = \"ground\", box = { min = [-3, -1], max = [3, 0] }, fixed = true },\n"
      "          { name = \"column\", box = { min = [-0.5, 0], max = [0.5, 3] } }]\n"
      "joint_properties = [{ name = \"r\", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]\n"
      "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
  const std::string push =
      "[[stage]]\nname = \"push\"\nkind = \"run\"\nduration_s = 1\n"
      "[[stage.force]]\nname = \"rope\"\nbodies = [\"column\"]\nforce = [1e4, 0]\npoint = [0, 2]\n";
  write("column.toml", column + push);
  const Ended found = run("limit column.toml --load applied --out found");
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_EQ(found.err, "") << "nothing is left out";
  EXPECT_NE(found.out.find("multiple of the applied forces of stage 'push'"), std::string::npos) << found.out;
  EXPECT_NEAR(results("found")["values"]["collapse_factor"]["value"].get<double>(), 75e3 / 4 / 1e4, 1e-9);

  // what is left out, and what counts otherwise than in a run, is said
  expect_one_line(run("limit column.toml --load right --out right"), 0,
                  "forces of stage 'push' are left out: '--load applied'");
  EXPECT_NEAR(results("right")["values"]["collapse_factor"]["value"].get<double>(), 1.0 / 3, 1e-9);
  write("later.toml", column + push + "times_s = [0, 1]\nfactors = [0, 2]\n");
  expect_one_line(run("limit later.toml --load applied --out later"), 0,
                  "'rope' has a factor of time; it counts at a factor of 1");
  EXPECT_NEAR(results("later")["values"]["collapse_factor"]["value"].get<double>(), 75e3 / 4 / 1e4, 1e-9);
  write("two.toml", column + push +
                        "[[stage]]\nname = \"more\"\nkind = \"settle\"\n[[stage.force]]\nname = \"rope\"\n"
                        "bodies = [\"column\"]\nforce = [2e4, 0]\n");
  expect_one_line(run("limit two.toml --load applied --out two"), 0,
                  "of stage 'more' are left out; those of stage 'push'");
  EXPECT_NEAR(results("two")["values"]["collapse_factor"]["value"].get<double>(), 75e3 / 4 / 1e4, 1e-9);

  // no force, one that does nothing, one that cannot tip it
  write("none.toml", column);
  expect_one_line(run("limit none.toml --load applied --out bad"), 2, "no stage applies a force");
  expect_one_line(run("limit column.toml --load applied --out bad --set stage.push.force.rope.force=[0,0]"), 2, "zero");
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
  const Ended any = run("limit column.toml --load applied --out any --set stage.push.force.rope.force=[0,-1e4]");
  EXPECT_EQ(any.code, 1);
  EXPECT_NE(any.out.find("they press the blocks"), std::string::npos) << any.out;
}

TEST_F(Program, DocsNameTheKeys) {
  const Ended ended = run("docs");
  EXPECT_EQ(ended.code, 0);
  for (const char* key : {"joint_properties", "normal_stiffness", "dip_direction"})
    EXPECT_NE(ended.out.find(key), std::string::npos) << key;
}

TEST_F(Program, VersionTellsWhatIsBuiltIn) {
  const Ended ended = run("--version");
  EXPECT_EQ(ended.code, 0);
  for (const auto& [name, built_in] : features())
    EXPECT_NE(ended.out.find(fmt::format("{:<15} {}", name, built_in ? "yes" : "no")), std::string::npos) << ended.out;
}

// ---- the pages made of the parser -----------------------------------------------------------------------------------

struct Listed {
  std::string path;  // "", "run", …, "study run"
  std::vector<std::string> commands, options;
};

// a command and all below it, as help prints them, which the parser does by itself
class CommandPages : public Program {
 protected:
  std::vector<Listed> listed(const std::string& path = "") const {
    Listed own{path, {}, {}};
    bool among_commands = false;
    for (const std::string& line : lines_of(run(path + " --help").out)) {
      const bool indented = line.starts_with("  ") && !line.starts_with("   ");
      if (!indented) among_commands = line == "Subcommands:" || (among_commands && line.starts_with(" "));
      if (indented && among_commands) own.commands.push_back(line.substr(2, line.find(' ', 2) - 2));
      if (indented && line[2] == '-') {
        const std::size_t begin = line.find("--");
        own.options.push_back(line.substr(begin, line.find(' ', begin) - begin));
      }
    }
    std::vector<Listed> all{own};
    for (const std::string& command : own.commands)
      for (const Listed& below : listed(path.empty() ? command : path + " " + command))
        all.push_back(below);
    return all;
  }

  // what bash offers for the last of these words
  std::string completed(const std::string& words) const {
    return run("--version >/dev/null && bash -c '. <(\"$0\" docs --completion); COMP_WORDS=(" + words +
               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _voussoir; echo \"${COMPREPLY[@]}\"' " VOUSSOIR_PROGRAM)
        .out;
  }
};

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}\n", fmt::join(words, " "));
}

TEST_F(CommandPages, ManualHoldsAllThatHelpLists) {
  std::string page = run("docs --man").out;
  std::erase(page, '\\');
  const std::vector<Listed> all = listed();
  EXPECT_GE(all.size(), 14u);
  for (const auto& [path, commands, options] : all) {
    const std::size_t begin = path.empty() ? 0 : page.find(".SS voussoir " + path + " [");
    ASSERT_NE(begin, std::string::npos) << path;
    const std::string section =
        page.substr(begin, page.find(path.empty() ? ".SH COMMANDS" : "\n.S", begin + 1) - begin);
    EXPECT_GE(options.size(), 1u) << path;
    for (const std::string& option : options)
      EXPECT_NE(section.find("fB" + option + "fR"), std::string::npos) << path << ' ' << option;
  }
  for (const char* line : {"fB0fR\ndone", "fB8fR\nnot enough memory", "fB128fR + n\nended by signal n"})
    EXPECT_NE(page.find(line), std::string::npos) << line;
}

TEST_F(CommandPages, BashCompletesAllThatHelpLists) {
  for (const auto& [path, commands, options] : listed()) {
    EXPECT_EQ(completed("voussoir " + path + " --"), joined(options)) << path;
    if (commands.empty()) continue;
    EXPECT_EQ(completed("voussoir " + path + " \"\""), joined(commands)) << path;
  }
}

TEST_F(CommandPages, BashCompletesValuesFilesAndFolders) {
  write("slope.toml", "");
  fs::create_directories(folder_ / "slopes");
  EXPECT_EQ(completed("voussoir limit --load \"\""), "gravity left right applied\n");
  EXPECT_EQ(completed("voussoir limit --load = g"), "gravity\n") << "bash parts words at =";
  EXPECT_EQ(completed("voussoir run sl"), "slope.toml slopes\n");
  EXPECT_EQ(completed("voussoir run slope.toml --out sl"), "slopes\n");
  EXPECT_EQ(completed("voussoir run slope.toml --threads \"\""), "\n") << "a number";
  EXPECT_EQ(completed("voussoir study --out run --o"), "--out --overwrite\n") << "run is a folder here, no command";
}

// ---- arguments ------------------------------------------------------------------------------------------------------

TEST_F(Program, WrongArgumentsAreBadInput) {
  EXPECT_EQ(run("").code, 2);
  EXPECT_EQ(run("fly").code, 2);
  EXPECT_EQ(run("run " + cubes_ + "--threads 0").code, 2);
  EXPECT_EQ(run("run " + cubes_ + "--no-such-option").code, 2);
  EXPECT_EQ(run("run --help").code, 0);
  EXPECT_EQ(run("docs --man --completion").code, 2);
  EXPECT_TRUE(folder_is_empty());
}

}  // namespace
}  // namespace voussoir
