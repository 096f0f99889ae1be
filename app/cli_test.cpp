// The program as users see it: arguments in, files, messages and exit codes out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/base/progress_line.hpp"
#include "app/testing/program.hpp"
#include "core/testing/dxf_drawing.hpp"

namespace voussoir::cli_test {
namespace {

using namespace program;

TEST(ProgressLine, WithoutATerminalItAddsALineOnceAMinute) {
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
  EXPECT_EQ(ended.err, "") << "no progress without a terminal";
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

// the example searches a factor of safety
TEST_F(Program, ASearchWritesItsTrialsAsTable) {
  ASSERT_EQ(run("run " + std::string(VOUSSOIR_SOURCE_DIR "/examples/wedge.toml") + " --out out").code, 0);
  const std::vector<std::string> lines = lines_of(read(folder_ / "out/search.csv"));
  ASSERT_GT(lines.size(), 4u);
  EXPECT_TRUE(lines.front().starts_with("stage,trial,level,unit,outcome,body,displacement_m,")) << lines.front();
  ASSERT_EQ(run("run " + cubes_ + "--out none").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "none/search.csv")) << "no search";
}

TEST_F(Program, TheEffectiveSceneRunsAgain) {
  ASSERT_EQ(run("run " + cubes_ + "--out first --set joint_properties.rock.normal_stiffness=2e8").code, 0);
  EXPECT_NEAR(settlement("first"), -1e-4, 1e-8);
  ASSERT_EQ(run("run first/scene.toml --out second").code, 0);
  EXPECT_EQ(results("first")["input_hash"], results("second")["input_hash"]);
  EXPECT_EQ(settlement("first"), settlement("second"));
  EXPECT_EQ(run("check first/scene.toml --hash").out, results("first")["input_hash"].get<std::string>() + "\n");
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

TEST_F(Program, ARunWhoseEnergyDoesNotCloseWarns) {
  const std::string bounce = std::string("run ") +
                             VOUSSOIR_SOURCE_DIR "/cases/bounce/scene.toml --set output.history_interval_s=0 " +
                             "--set damping.viscous_ratio=0 ";
  const auto doubts = [&](const std::string& where) {
    const nlohmann::json warnings = results(where)["warnings"];
    return std::count_if(warnings.begin(), warnings.end(), [](const nlohmann::json& w) {
      return w.get<std::string>().find("energy balance does not close") != std::string::npos;
    });
  };
  ASSERT_EQ(run(bounce + "--set time.fraction=0.05 --out fine").code, 0);
  EXPECT_EQ(doubts("fine"), 0);
  EXPECT_LT(results("fine")["energy"]["relative_energy_error"], 0.01);

  // a one-sided contact gains energy when the step is long
  const Ended coarse = run(bounce + "--set time.fraction=0.9 --out coarse");
  ASSERT_EQ(coarse.code, 0);
  EXPECT_EQ(doubts("coarse"), 1);
  EXPECT_NE(coarse.err.find("energy balance does not close"), std::string::npos) << coarse.err;
  EXPECT_GT(results("coarse")["energy"]["relative_energy_error"], 0.05);
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
  EXPECT_NE(checked.out.find("0 closed joints are in compression and can be bonded, 1 when first in compression"),
            std::string::npos)
      << checked.out;
  const Ended done = run("run " + bonded + "--out done");
  EXPECT_NE(done.out.find("bonds: 1 made, 1 whole, 0 broken"), std::string::npos) << done.out;
  EXPECT_EQ(results("done")["bonds"]["made"], 1);
  EXPECT_EQ(results("done")["bonds"]["whole"], 1);

  EXPECT_NE(run("check " + cubes_ + "--set stage.settle.bond=true").out.find("bonds nothing"), std::string::npos);
  const Ended limit = run("limit " + squares_ +
                          "--out limit --set joint_properties.rock.cohesion=1e5 "
                          "--set joint_properties.rock.bonds=by_stage");
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

TEST_F(Program, QuietPrintsNothing) {
  const Ended ended = run("run " + cubes_ + "--out out --quiet");
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out + ended.err, "");
  expect_one_line(run("run " + cubes_ + "--out short --quiet --set stage.settle.step_limit=5"), 1, "incomplete");
}

TEST_F(Program, ExchangeablePartsAgree) {
  ASSERT_EQ(run("run " + cubes_ + "--out own").code, 0);
  for (const std::string choice : {"contact.point=centroid", "contact.overlap=bracketing"}) {
    const std::string folder = choice.substr(choice.find('=') + 1);
    const Ended ended = run("run " + cubes_ + "--out " + folder + " --set " + choice);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NEAR(settlement(folder), settlement("own"), 1e-9);
  }
  expect_one_line(run("run " + cubes_ + "--out none --set contact.lp=glpk"), 2, "left the program together with GLPK");
}

// ---- check, slice, docs, the command line -------------------------------------------------------------------------

TEST_F(Program, CheckListsTheActiveFeatures) {
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

TEST_F(Program, ALevelOfAccuracyShowsTheKeysItSets) {
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

// read back as joints: every face of the drawing is a plane
TEST_F(Program, SliceDrawsTheBlocksForCad) {
  ASSERT_EQ(run("slice " + cubes_ + "--out out --dxf").code, 0);
  const std::vector<test::DxfEntity> drawing = test::read_drawing(read(folder_ / "out/blocks.dxf"));
  EXPECT_NEAR(volume_on(drawing, "BLOCKS"), 1, 1e-12);
  EXPECT_NEAR(volume_on(drawing, "FIXED_BLOCKS"), 1, 1e-12);
  const Ended read_back = run("import out/blocks.dxf --as dxf --out joints.csv");
  EXPECT_EQ(read_back.code, 0) << read_back.err;
  EXPECT_NE(read_back.out.find("joints: 12, 3-D"), std::string::npos) << read_back.out;
}

// cubes of 1 m, one on the other: the section through both is 2 m²
TEST_F(Program, SliceDrawsSectionsForCad) {
  ASSERT_EQ(run("slice " + cubes_ + "--out out --section 90/0/0.5/0.25/0").code, 0);
  const std::vector<test::DxfEntity> drawing = test::read_drawing(read(folder_ / "out/section.dxf"));
  ASSERT_EQ(drawing.size(), 2u);
  const Ended read_back = run("import out/section.dxf --as dxf --out joints.csv");
  EXPECT_EQ(read_back.code, 0) << read_back.err;
  EXPECT_NE(read_back.out.find("joints: 2, 3-D"), std::string::npos) << read_back.out;
  const std::string again = "slice " + cubes_ + "--out out --overwrite --section ";
  ASSERT_EQ(run(again + "0/0/0/0/0.5 --section 90/90/0.5/0/0").code, 0);
  EXPECT_EQ(test::read_drawing(read(folder_ / "out/section.dxf")).size(), 3u) << "planes together";
  expect_one_line(run(again + "90/0/0"), 2, "--section 90/0/0: write dip/dip direction in degrees and x/y/z");
  expect_one_line(run(again + "91/0/0/0/0"), 2, "the dip is 0 to 90");
  expect_one_line(run(again + "0/0/0/0/50"), 2, "the plane cuts no block; the blocks have x");
}

TEST_F(Program, DocsNameTheKeys) {
  const Ended ended = run("docs");
  EXPECT_EQ(ended.code, 0);
  for (const char* key : {"joint_properties", "normal_stiffness", "dip_direction"})
    EXPECT_NE(ended.out.find(key), std::string::npos) << key;
}

TEST_F(Program, VersionListsTheBuiltInFeatures) {
  const Ended ended = run("--version");
  EXPECT_EQ(ended.code, 0);
  for (const auto& [name, built_in] : features())
    EXPECT_NE(ended.out.find(fmt::format("{:<15} {}", name, built_in ? "yes" : "no")), std::string::npos) << ended.out;
}

// ---- arguments ------------------------------------------------------------------------------------------------------

TEST_F(Program, AJointThatDilatesIsTestedWithoutAnotherDilation) {
  const std::string dilating =
      " --set joint_properties.rock.dilation_law=constant --set "
      "joint_properties.rock.dilation_deg=8 --set joint_properties.rock.dilation_until_m=0.01";
  EXPECT_EQ(run("joint-test " + cubes_ + dilating + " --path stiffness --slip 5e-3 --out laboratory").code, 0);
  EXPECT_NE(read(folder_ / "laboratory/joint_test.csv").find("rise_m,plastic_offset_m,mobilised_friction_deg"),
            std::string::npos);
  const auto refused = run("joint-test " + cubes_ + dilating + " --dilation 0.05 --out again");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("have a dilation of their own"), std::string::npos) << refused.err;
}

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
}  // namespace voussoir::cli_test
