// Runs that begin at the end of another one: the bits of the complete run, or a refusal with its reason.
#include <gtest/gtest.h>
#include <sys/file.h>

#include <csignal>

#include "app/testing/process.hpp"
#include "app/testing/program.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// tunnel.toml: the stages stress, dig, support and slip; bolts `early` are installed before stress, `roof` after dig
class Begin : public program::Program {
 protected:
  // all results except wall-clock time; the begin of the run and the states it kept do not count
  std::string found(const std::string& where) const {
    nlohmann::json json = results(where);
    json.erase("timing");
    return json.dump() + read(folder_ / where / "history.csv") + read(folder_ / where / "bolts.csv");
  }
  void run_well(const std::string& arguments) const {
    const Ended ended = run(arguments);
    ASSERT_EQ(ended.code, 0) << arguments << ": " << ended.err;
    EXPECT_EQ(ended.err, "") << arguments;
  }
  std::string scene_without(const std::string& part) const {
    std::string text = read(program::scenes / "tunnel.toml");
    const auto at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    return text.erase(at, part.size());
  }

  const std::string tunnel_ = "'" + (program::scenes / "tunnel.toml").string() + "' ";
};

TEST_F(Begin, GivesTheBitsOfTheWholeRunFromTheEndOfEveryStage) {
  run_well("run " + tunnel_ + "--out whole");
  for (const std::string stage : {"stress", "dig", "support"}) {
    run_well("run " + tunnel_ + "--out to_" + stage + " --until " + stage);
    EXPECT_EQ(results("to_" + stage)["stages"].back()["name"], stage);
    run_well("run " + tunnel_ + "--out from_" + stage + " --begin to_" + stage + " --threads 2");
    EXPECT_EQ(found("from_" + stage), found("whole")) << stage;
  }
  // and an initial state that itself began at the end of a run
  run_well("run " + tunnel_ + "--out again --begin to_stress --until support");
  run_well("run " + tunnel_ + "--out last --begin again");
  EXPECT_EQ(found("last"), found("whole"));
}

TEST_F(Begin, ManySupportVariantsStartFromOneInitialState) {
  run_well("run " + tunnel_ + "--out generation --until dig");
  const std::vector<std::string> supports{"--set bolts.roof.stiffness=3e7 ",
                                          "--set stage.slip.friction.rock.friction_deg=33 ",
                                          "--set joint_properties.spare.friction_deg=12 --set title=other "};
  for (const std::string& support : supports) {
    run_well("run " + tunnel_ + support + "--out whole --overwrite");
    run_well("run " + tunnel_ + support + "--out begun --overwrite --begin generation");
    EXPECT_EQ(found("begun"), found("whole")) << support;
  }

  // bolts of a name that comes before those in place, and a table of joint properties behind those of the joints
  const std::string more =
      "[[bolts]]\nname = \"anchors\"\nfrom = [6.5, 2]\nto = [6.5, 6]\nstiffness = 1e7\n"
      "[[stage]]\nname = \"last\"\nkind = \"settle\"\ninstall = [\"anchors\"]\n"
      "[[joint_properties]]\nname = \"liner\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = 20\n";
  std::string text = read(program::scenes / "tunnel.toml");
  const std::string one_line_tables =
      text.substr(text.find("joint_properties = ["), text.find("\njoints = ") - text.find("joint_properties = ["));
  text.replace(text.find(one_line_tables), one_line_tables.size(), "");
  text +=
      "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9\nshear_stiffness = 5e8\nfriction_deg = "
      "40\nsub_contacts = 2\n"
      "[[joint_properties]]\nname = \"spare\"\nnormal_stiffness = 1e9\nshear_stiffness = 5e8\nfriction_deg = 30\n" +
      more;
  write("more.toml", text);
  run_well("run more.toml --out whole --overwrite");
  run_well("run more.toml --out begun --overwrite --begin generation");
  EXPECT_EQ(found("begun"), found("whole"));
  EXPECT_NE(read(folder_ / "begun/bolts.csv").find("anchors"), std::string::npos);
}

TEST_F(Begin, RowsOfMonitorsThatTheOtherDidNotFollowAreEmptyUntilThere) {
  write("generation.toml", scene_without("[[monitors]]\nname = \"top\"\nquantities = [\"displacement\", \"rotation\"]\n"
                                         "inside = [4, 7]\nsince = \"dig\"\n"));
  run_well("run generation.toml --out generation --until dig");
  run_well("run " + tunnel_ + "--out whole");
  run_well("run " + tunnel_ + "--out begun --begin generation");
  EXPECT_EQ(results("begun")["state_hash"], results("whole")["state_hash"]);
  EXPECT_EQ(results("begun")["values"], results("whole")["values"]);
  const auto begun = program::lines_of(read(folder_ / "begun/history.csv")),
             whole = program::lines_of(read(folder_ / "whole/history.csv"));
  ASSERT_EQ(begun.size(), whole.size());
  EXPECT_EQ(begun[0], whole[0]);
  EXPECT_TRUE(begun[1].ends_with(",,,")) << begun[1];
  EXPECT_EQ(begun.back(), whole.back());

  // the positions of the blocks at the end of an earlier stage are not stored
  write("stress.toml", scene_without("[[monitors]]\nname = \"crown\"\nquantities = [\"convergence\"]\nexcavation = "
                                     "\"tunnel\"\nangles_deg = [90, 0, 180]\nsince = \"stress\"\n"));
  run_well("run stress.toml --out no_stress --until dig");
  expect_one_line(run("run " + tunnel_ + "--out bad --begin no_stress"), 2, "'stress', from which a monitor measures");
}

TEST_F(Begin, AKilledRunContinuesWithoutTheFolderItBeganWith) {
  const std::string finer = tunnel_ + "--set equilibrium.unbalanced=1e-8 ";
  run_well("run " + finer + "--out whole");
  run_well("run " + finer + "--out generation --until stress");
  const Launch launch{.arguments = {"run", (program::scenes / "tunnel.toml").string(), "--set",
                                    "equilibrium.unbalanced=1e-8", "--out", (folder_ / "begun").string(), "--begin",
                                    (folder_ / "generation").string(), "--checkpoint-steps", "20"}};
  Process process(VOUSSOIR_PROGRAM, launch, folder_ / "killed");
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "begun/run.json"); }));
  process.send(SIGKILL);
  ASSERT_EQ(process.wait().signal, SIGKILL) << "it was done before it was killed";
  fs::remove_all(folder_ / "generation");
  run_well("resume begun --threads 2");
  EXPECT_EQ(found("begun"), found("whole"));
}

TEST_F(Begin, AnInitialRunThatWasKilledKeepsItsEndToo) {
  run_well("run " + tunnel_ + "--out whole");
  const Launch launch{.arguments = {"run", (program::scenes / "tunnel.toml").string(), "--out",
                                    (folder_ / "generation").string(), "--until", "dig", "--checkpoint-steps", "20"}};
  Process process(VOUSSOIR_PROGRAM, launch, folder_ / "killed");
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "generation/checkpoint"); }));
  process.send(SIGKILL);
  ASSERT_EQ(process.wait().signal, SIGKILL) << "it was done before it was killed";
  expect_one_line(run("run " + tunnel_ + "--out begun --begin generation"), 2, "voussoir resume generation");
  run_well("resume generation");
  run_well("run " + tunnel_ + "--out begun --begin generation");
  EXPECT_EQ(found("begun"), found("whole"));
}

// with the names that keys had before they were renamed
std::string with_earlier_names(std::string text) {
  for (const auto& [present, earlier] : {std::pair<std::string, std::string>{"excavation_forces", "let_off"},
                                         std::pair<std::string, std::string>{"remaining", "share"}})
    for (auto at = text.find(present); at != std::string::npos; at = text.find(present))
      text.replace(at, present.size(), earlier);
  return text;
}

// A folder of an earlier version holds a scene with the names of its time.
TEST_F(Begin, FoldersOfScenesWithEarlierNamesOfKeysContinue) {
  run_well("run " + tunnel_ + "--out whole");
  write("earlier.toml", with_earlier_names(read(program::scenes / "tunnel.toml")));
  const auto as_it_was_kept = [&] {
    const std::string text = read(folder_ / "generation/scene.toml");
    ASSERT_NE(text.find("excavation_forces"), std::string::npos);
    write("generation/scene.toml", with_earlier_names(text));
  };
  const Launch launch{.arguments = {"run", (folder_ / "earlier.toml").string(), "--out",
                                    (folder_ / "generation").string(), "--until", "dig", "--checkpoint-steps", "20"}};
  Process process(VOUSSOIR_PROGRAM, launch, folder_ / "killed");
  ASSERT_TRUE(wait_until([&] { return fs::exists(folder_ / "generation/checkpoint"); }));
  process.send(SIGKILL);
  ASSERT_EQ(process.wait().signal, SIGKILL) << "it was done before it was killed";
  as_it_was_kept();
  run_well("resume generation");
  for (const std::string& scene : {tunnel_, std::string("earlier.toml ")}) {
    run_well("run " + scene + "--out begun --begin generation --overwrite");
    EXPECT_EQ(found("begun"), found("whole")) << scene;
  }
}

TEST_F(Begin, AnotherSceneIsRefusedWithWhatDiffers) {
  run_well("run " + tunnel_ + "--out generation --until dig");
  const auto refused = [&](const std::string& changes, const std::string& part) {
    const Ended ended = run("run " + tunnel_ + changes + " --out bad --begin generation");
    expect_one_line(ended, 2, part);
    EXPECT_NE(ended.err.find("--until"), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(folder_ / "bad"));
  };
  refused("--set joints.c.dip=81", "joints.c.dip = 81: is 80 in 'generation'");
  refused("--set density=2100", "density = 2100: is 2000 in 'generation'");
  refused("--set joint_properties.rock.friction_deg=41", "joint_properties.rock.friction_deg = 41: is 40");
  refused("--set stage.stress.gravity_ramp_s=0.2", "stage.stress.gravity_ramp_s = 0.2: is 0.1");
  refused("--set stage.stress.zero_slip=true", "stage.stress.zero_slip = true: is not stated");
  refused("--set stage.dig.excavation_forces.remaining=0.4", "stage.dig.excavation_forces.remaining = 0.4: is 0.5");
  refused("--set bolts.early.stiffness=2e7", "bolts.early.stiffness = 2e+07: is 1e+07");
  refused("--set equilibrium.unbalanced=1e-5", "equilibrium.unbalanced = 1e-05: is 1e-06");
  refused("--set excavations.tunnel.cylinder.radius=1.1", "excavations.tunnel.cylinder.radius = 1.1: is 1");

  // without a stage that excavates it the tunnel is open from the start
  const std::string text = read(program::scenes / "tunnel.toml");
  write("open.toml",
        text.substr(0, text.find("[[bolts]]\nname = \"roof\"")) +
            "[[stage]]\nname = \"stress\"\nkind = \"settle\"\ngravity_ramp_s = 0.1\ninstall = [\"early\"]\n");
  run_well("run open.toml --out open --keep");
  expect_one_line(run("run " + tunnel_ + "--out bad --begin open"), 2,
                  "excavations.tunnel.taken_out = \"by a stage\": is \"before the first stage\" in 'open'");
  expect_one_line(run("run " + tunnel_ + "--out bad --until stress --begin generation"), 2,
                  "has done that stage already");

  write("shorter.toml", scene_without("gravity_ramp_s = 0.1\n"));
  expect_one_line(run("run shorter.toml --out bad --begin generation"), 2, "stage.stress.gravity_ramp_s is missing");
  run_well("run " + tunnel_ + "--out complete --keep");
  expect_one_line(run("run " + tunnel_ + "--out bad --begin complete"), 2, "add a stage after 'slip'");
  expect_one_line(run("run " + cubes_ + "--out bad --begin generation"), 2, "dimension = 2 there and 3");
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

TEST_F(Begin, AnUnsuitableFolderIsRefusedWithARepair) {
  const std::string begun = "run " + tunnel_ + "--out bad --begin generation";
  expect_one_line(run(begun), 2, "there is no such folder");
  fs::create_directory(folder_ / "generation");
  expect_one_line(run(begun), 2, "contains no run");
  expect_one_line(run("run " + tunnel_ + "--out generation --until digg"), 2, "did you mean 'dig'");
  run_well("run " + tunnel_ + "--out generation");
  expect_one_line(run(begun), 2, "has not kept its end");
  run_well("run " + tunnel_ + "--out generation --until dig --overwrite");

  // never written over, nor read while it is written
  expect_one_line(run("run " + tunnel_ + "--out generation --overwrite --begin generation"), 2,
                  "is read by this command");
  const int lock = ::open((folder_ / "generation/.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  expect_one_line(run(begun), 3, "is being written by");
  ::close(lock);

  const fs::path state = folder_ / "generation/end_state";
  const std::string good = read(state);
  std::string damaged = good;
  damaged[damaged.size() / 2] ^= 1;
  std::ofstream(state) << damaged;
  expect_one_line(run(begun), 2, "end_state' is damaged");
  std::ofstream(state) << good.substr(0, good.size() / 2);
  expect_one_line(run(begun), 2, "end_state' is damaged or cut short");
  std::ofstream(state) << good;
  std::ofstream(folder_ / "generation/scene.toml", std::ios::app) << "[[stage]]\nname = \"more\"\nkind = \"settle\"\n";
  expect_one_line(run(begun), 2, "is not the scene that was run there");

  // a run cannot begin at a goal that was not reached
  EXPECT_EQ(run("run " + tunnel_ + "--set stage.dig.step_limit=5 --out short --until dig").code, 1);
  expect_one_line(run("run " + tunnel_ + "--set stage.dig.step_limit=5 --out bad --quiet --begin short"), 2,
                  "did not reach its goal");
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

TEST_F(Begin, AStudyMakesTheInitialStateOnce) {
  const std::string sweeps =
      "scene = \"tunnel.toml\"\nquantity = \"crown_convergence_1\"\n"
      "[[sweep]]\nname = \"bolts\"\nkey = \"bolts.roof.stiffness\"\nvalues = [1e6, 1e8]\n"
      "[[sweep]]\nname = \"rock\"\nkey = \"density\"\nvalues = [2100]\n";
  write("tunnel.toml", read(program::scenes / "tunnel.toml"));
  write("apart.toml", sweeps);
  write("shared.toml", "begin = \"dig\"\n" + sweeps);
  run_well("study apart.toml --out apart --jobs 1");
  run_well("study shared.toml --out shared --jobs 1");
  const auto table = [&](const std::string& where) {
    std::string text;
    for (const std::string& row : program::lines_of(read(folder_ / where / "study.csv")))
      text += row.substr(0, row.rfind(',')) + "\n";
    return text;
  };
  EXPECT_EQ(table("shared"), table("apart"));
  const auto folders = [&](const std::string& where) {
    return std::distance(fs::directory_iterator(folder_ / where / "runs"), fs::directory_iterator());
  };
  EXPECT_EQ(folders("apart"), 4);
  EXPECT_EQ(folders("shared"), 4 + 2) << "one initial state for each density";
  const Ended again = run("study shared.toml --out shared");
  EXPECT_NE(again.out.find("4 different runs, 4 of them kept from before"), std::string::npos) << again.out;

  write("short.toml", "set = [\"stage.dig.step_limit=5\"]\nbegin = \"dig\"\n" + sweeps);
  EXPECT_EQ(run("study short.toml --out short").code, 1);
  EXPECT_NE(read(folder_ / "short/study.csv").find("did not reach its goal"), std::string::npos);
  write("nowhere.toml", "begin = \"digg\"\n" + sweeps);
  expect_one_line(run("study nowhere.toml --out nowhere"), 2, "did you mean 'dig'");
}

}  // namespace
}  // namespace voussoir
