// Faults of a study that is run in parts: rows, folders, workers and plans that fail, and kills.
#include <gtest/gtest.h>

#include <random>

#include "app/base/digest.hpp"
#include "app/testing/planned_study.hpp"

namespace voussoir::study_faults_test {
namespace {

namespace fs = std::filesystem;

using StudyFaults = PlannedStudy;

// ---- failures -----------------------------------------------------------------------------------------------------

TEST_F(StudyFaults, ARowThatDivergesIsAFailureOfItsOwn) {
  write("study.toml", R"(
scene = "scene.toml"
quantity = "top_displacement_z"
set = ["statics=local"]
[[sweep]]
name = "time step"
key = "time.step_s"
values = [1e-4, 100, 2e-4]
)");
  const std::string out = planned("out");
  const Ended ended = study({"run", out});
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_NE(ended.out.find("4 rows, 1 failed\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("failed: row 3: "), std::string::npos) << ended.out;
  const Ended gathered = study({"gather", out});
  EXPECT_EQ(gathered.code, 1);
  EXPECT_NE(gathered.out.find("failed: row 3 (time step: time.step_s = 100): "), std::string::npos) << gathered.out;
  EXPECT_EQ(gathered.out.find("not run"), std::string::npos) << gathered.out;
  const std::string status = study({"status", out}).out;
  EXPECT_NE(status.find("3 of 4 rows done\nfailed: row 3: "), std::string::npos) << status;
  EXPECT_NE(status.find("failed: 3\nnot run: none\n"), std::string::npos) << status;

  // the same as in one command
  EXPECT_EQ(study({at("study.toml"), "--out", at("whole")}).code, 1);
  EXPECT_EQ(table("whole"), table("out"));
}

TEST_F(StudyFaults, AFolderThatMustNotBeWrittenIsSeven) {
  const std::string out = planned("out");
  EXPECT_EQ(study({"run", out, "--rows", "1-3"}).code, 0);
  const Contents before = contents_of(out);
  fs::permissions(out, fs::perms(0555));
  fs::permissions(out + "/runs", fs::perms(0555));
  fs::permissions(out + "/.lock", fs::perms(0444));
  Launch launch{.arguments = {"study", "run", out}, .ordinary_user = true};
  const Ended ended = run(launch);
  if (ended.code == cannot_start) GTEST_SKIP() << "root that cannot become an ordinary user";
  expect_one_line(ended, 7, "cannot write '" + out);
  launch.arguments = {"study", "gather", out};
  expect_one_line(run(launch), 7, "cannot write '" + out);
  launch.arguments = {"study", "status", out};
  EXPECT_NE(run(launch).out.find("4 of 19 rows done\n"), std::string::npos);
  expect_equal(contents_of(out), before, "a folder that must not be written");
  for (const std::string& name : {out, out + "/runs"})
    fs::permissions(name, fs::perms(0755));
  fs::permissions(out + "/.lock", fs::perms(0644));
  EXPECT_EQ(study({"run", out}).code, 0) << "nothing was lost";
}

// a limit on the size of files acts as a full disk
TEST_F(StudyFaults, AFullDiskLosesNothing) {
  const std::string whole = whole_table(), out = planned("out");
  EXPECT_EQ(study({"run", out, "--rows", "1-3"}).code, 0);
  const Ended ended = run({.arguments = {"study", "run", out, "--rows", "1-9"}, .largest_file = 1500});
  EXPECT_EQ(ended.code, 1) << ended.err;
  EXPECT_NE(ended.out.find("9 rows, 6 failed\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("failed: row 9: cannot write '"), std::string::npos) << ended.out;
  expect_one_line(run({.arguments = {"study", "gather", out}, .largest_file = 1500}), 6, "study.csv'");
  EXPECT_EQ(study({"run", out}).code, 0);
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(StudyFaults, ARowHasOneWorkerAtATime) {
  const std::string whole = whole_table(), out = planned("out");
  Process first = start({.arguments = {"study", "run", out, "--rows", "5", "--jobs", "1"}});
  std::vector<int> children;
  ASSERT_TRUE(wait_until([&] { return !(children = children_of(first.pid())).empty(); }));
  ASSERT_EQ(children.size(), 1u);
  ::kill(children[0], SIGSTOP);
  first.send(SIGSTOP);
  ASSERT_FALSE(fs::exists(run_of("out", 5) / "results.json"));
  const std::string name = fmt::format("process {} ", first.pid());
  const Ended second = Process(VOUSSOIR_PROGRAM, {.arguments = {"study", "run", out}}, at("second")).wait();
  expect_one_line(second, 3, "5 by " + name);
  EXPECT_NE(second.out.find("19 rows, 0 failed\n"), std::string::npos) << second.out;
  const std::string status =
      Process(VOUSSOIR_PROGRAM, {.arguments = {"study", "status", out}}, at("second")).wait().out;
  EXPECT_TRUE(status.starts_with("18 of 19 rows done\nrunning: 5 by " + name)) << status;
  EXPECT_TRUE(status.ends_with("not run: none\n")) << status;

  // a worker prevents others from planning the study again
  expect_one_line(
      Process(VOUSSOIR_PROGRAM, {.arguments = {"study", "plan", at("study.toml"), "--out", out}}, at("second")).wait(),
      3, "in use by process ");
  ::kill(children[0], SIGCONT);
  first.send(SIGCONT);
  EXPECT_EQ(first.wait().code, 0);
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(StudyFaults, AWorkerThatIsAskedToStopContinuesLater) {
  const std::string whole = whole_table(), out = planned("out");
  Process worker = start({.arguments = {"study", "run", out, "--jobs", "2"}});
  ASSERT_TRUE(wait_until([&] { return !children_of(worker.pid()).empty(); }));
  worker.send(SIGTERM);
  expect_one_line(worker.wait(), 128 + SIGTERM, "the same command continues with the completed runs in '" + out + "'");
  EXPECT_EQ(study({"status", out}).out.find("failed"), std::string::npos) << "an interruption is no failure";
  EXPECT_EQ(study({"run", out}).code, 0);
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(StudyFaults, AByteThatDiffersFromThePlanIsRefused) {
  const std::string out = planned("out");
  std::mt19937 random(31);
  for (const char* name : {"manifest.jsonl", "study.json", "input/scene.toml", "input/study.toml"}) {
    const std::string whole = read(out + "/" + name);
    for (int k = 0; k < 5; ++k) {
      std::string bytes = whole;
      const std::size_t at = random() % bytes.size();
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
      write(std::string("out/") + name, bytes);
      if (name == std::string("study.json") && nlohmann::json::accept(bytes) &&
          nlohmann::json::parse(bytes) == nlohmann::json::parse(whole))
        continue;  // of its layout
      for (const char* part : {"run", "gather", "status"})
        expect_one_line(study({part, out}), 2, fmt::format("'{}/{}' differs from the plan", out, name),
                        fmt::format("byte {} ", at));
    }
    write(std::string("out/") + name, whole);
  }
  EXPECT_FALSE(fs::exists(out + "/runs"));
  fs::remove(out + "/manifest.jsonl");
  expect_one_line(study({"run", out}), 2, "manifest.jsonl' differs from the plan");
  expect_one_line(study({"run", at("nowhere")}), 2, "contains no study: plan one with");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(StudyFaults, AnotherProgramIsRefusedUnlessRequested) {
  const std::string whole = whole_table(), out = planned("out");
  // bytes after a program's end do not change its behaviour
  const std::string other = write("other", read(VOUSSOIR_PROGRAM) + "!");
  fs::permissions(other, fs::perms(0755));
  Launch launch{.arguments = {"study", "run", out}};
  expect_one_line(Process(other, launch, at("caught")).wait(), 2, "was planned by another program");
  EXPECT_FALSE(fs::exists(out + "/runs"));
  EXPECT_EQ(study({"run", out, "--rows", "1-9"}).code, 0);
  launch.arguments.push_back("--any-program");
  EXPECT_EQ(Process(other, launch, at("caught")).wait().code, 0);
  const Ended gathered = study({"gather", out});
  EXPECT_EQ(gathered.code, 0);
  EXPECT_EQ(table("out"), whole);
  EXPECT_NE(gathered.out.find("rows 1-9,13 computed by the program that planned them, "), std::string::npos)
      << gathered.out;
  EXPECT_NE(gathered.out.find("computed by program " + digest(read(other)) + ", "), std::string::npos) << gathered.out;
  expect_one_line(gathered, 0, "warning: 2 programs computed these rows");
}

// ---- kills --------------------------------------------------------------------------------------------------------

class StudyKills : public PlannedStudy {
 protected:
  // Kills workers, and sometimes the runs of one before it, at random moments; the rest runs undisturbed.
  void survive_kills(int kills) const {
    const std::string whole = whole_table();
    std::mt19937 random(20);
    int killed = 0;
    for (int studies = 0; killed < kills; ++studies) {
      const std::string name = fmt::format("out{}", studies), out = planned(name);
      for (bool goes_on = true; goes_on && killed < kills;) {
        Process worker = start({.arguments = {"study", "run", out, "--jobs", "2"}});
        std::this_thread::sleep_for(std::chrono::milliseconds(20 + random() % 100));
        if (random() % 3 == 0) {
          for (const int child : children_of(worker.pid()))
            ::kill(child, SIGKILL);
          std::this_thread::sleep_for(std::chrono::milliseconds(random() % 20));
        }
        worker.send(SIGKILL);
        goes_on = worker.wait().signal == SIGKILL;  // else all runs were done
        killed += goes_on;
      }
      const Ended ended = study({"run", out});
      EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
      EXPECT_EQ(study({"gather", out}).code, 0);
      EXPECT_EQ(table(name), whole);
      expect_whole_rows(out);
    }
  }

  // the results of a run are those of the undisturbed run
  void expect_whole_rows(const std::string& out) const {
    const Contents disturbed = contents_of(out + "/runs");
    int compared = 0;
    for (const auto& [name, text] : whole().runs)
      if (name.ends_with("/results.json") || name.ends_with("/history.csv")) {
        EXPECT_TRUE(disturbed.contains(name) && disturbed.at(name) == text) << name;
        ++compared;
      }
    EXPECT_EQ(compared, 2 * study_runs);
    for (const auto& [name, text] : disturbed)
      EXPECT_EQ(name.find("voussoir-part"), std::string::npos) << name;
  }
};

TEST_F(StudyKills, TwentyLoseNothing) {
  survive_kills(20);
}

using StudyKillsLong = StudyKills;

TEST_F(StudyKillsLong, TwoHundredLoseNothing) {
  survive_kills(200);
}

}  // namespace
}  // namespace voussoir::study_faults_test
