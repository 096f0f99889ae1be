// `voussoir study` in parts: planned once, done by any number of processes whatever happens to them, gathered to the
// same file.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <sstream>

#include "app/bad_input.hpp"
#include "app/commands/row_ranges.hpp"
#include "app/digest.hpp"
#include "app/testing/faults.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

TEST(RowRanges, GoForthAndBack) {
  for (const char* text : {"1", "1-3", "1-3,7", "2,4,6-9"})
    EXPECT_EQ(ranges_of_rows(rows_of_ranges(text, 9)), text);
  EXPECT_EQ(ranges_of_rows(rows_of_ranges("7,1-2,3-3,2", 9)), "1-3,7");
  EXPECT_EQ(ranges_of_rows({}), "");
  for (const char* text : {"", "0", "-1", "3-1", "1-", "1,", ",1", "1;2", "a", "10", "1-10", "99999999999", " 1"})
    EXPECT_THROW(rows_of_ranges(text, 9), BadInput) << text;
  EXPECT_EQ(chunk_of("3/40").place, 3);
  for (const char* text : {"", "3", "0/4", "5/4", "1/", "/4", "1/4/2", "-1/4"})
    EXPECT_THROW(chunk_of(text), BadInput) << text;
}

// the example of the algorithm's own documentation: XXH3 with 128 bits of nothing
TEST(Digest, IsThatOfTheLibrary) {
  EXPECT_EQ(digest(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_NE(digest("a"), digest("b"));
}

// 43 rows, one of them twice as hard as the scene itself, some the same run under two names
const char* const plan = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "stiffness"
key = "joint_properties.rock.normal_stiffness"
values = [1.0e8, 1.1e8, 1.2e8, 1.3e8, 1.4e8, 1.5e8, 1.6e8, 1.7e8, 1.8e8, 1.9e8,
          2.0e8, 2.1e8, 2.2e8, 2.3e8, 2.4e8, 2.5e8, 2.6e8, 2.7e8, 2.8e8, 2.9e8]
extrapolate = { power = 1 }
[[sweep]]
name = "density"
key = "density"
values = [1000, 1100, 1200, 1300, 1400, 1500, 1600, 1700, 1800, 1900,
          2000, 2100, 2200, 2300, 2400, 2500, 2600, 2700, 2800, 2900]
[[sweep]]
name = "damping"
key = "damping.statics"
values = ["local", "adaptive"]
)";
constexpr int rows = 43;

class StudyFolder : public FaultTest {
 protected:
  StudyFolder() {
    write("scene.toml", read(fs::path(VOUSSOIR_SOURCE_DIR) / "app/testing/two_cubes.toml"));
    write("study.toml", plan);
  }

  Ended study(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "study");
    return run({.arguments = std::move(arguments)});
  }
  // a folder in which all is still to be done
  std::string planned(const std::string& name) const {
    const Ended ended = study({"plan", at("study.toml"), "--out", at(name)});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return at(name);
  }
  // study.csv without the seconds, which come last in a row
  std::string table(const std::string& name) const {
    std::istringstream stream(read(folder_ / name / "study.csv"));
    std::string text;
    for (std::string row; std::getline(stream, row);)
      text += row.substr(0, row.rfind(',')) + "\n";
    return text;
  }
  // by one command, once for all tests
  struct Whole {
    std::string table;
    Contents runs;
  };
  const Whole& whole() const {
    static const Whole done = [this] {
      const Ended ended = study({at("study.toml"), "--out", at("whole")});
      EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
      Whole all{table("whole"), contents_of(at("whole") + "/runs")};
      EXPECT_EQ(std::count(all.table.begin(), all.table.end(), '\n'), 1 + rows + 19) << "19 extrapolations";
      return all;
    }();
    return done;
  }
  std::string whole_table() const { return whole().table; }
  // the processes that it has started
  static std::vector<int> children_of(int process) {
    std::istringstream list(read(fmt::format("/proc/{0}/task/{0}/children", process)));
    std::vector<int> children;
    for (int child = 0; list >> child;)
      children.push_back(child);
    return children;
  }
  nlohmann::json manifest_line(const std::string& name, int row) const {
    std::istringstream stream(read(folder_ / name / "manifest.jsonl"));
    for (std::string line; std::getline(stream, line);)
      if (nlohmann::json json = nlohmann::json::parse(line); json["row"] == row) return json;
    return {};
  }
  fs::path run_of(const std::string& name, int row) const {
    return folder_ / name / "runs" / manifest_line(name, row)["hash"].get<std::string>();
  }
};

TEST_F(StudyFolder, TheManifestHasEachRowOnceDearestFirst) {
  const std::string out = planned("out");
  std::istringstream stream(read(out + "/manifest.jsonl"));
  std::vector<int> numbers;
  double before = std::numeric_limits<double>::infinity();
  for (std::string line; std::getline(stream, line);) {
    const nlohmann::json json = nlohmann::json::parse(line);
    numbers.push_back(json["row"]);
    EXPECT_EQ(json["hash"].get<std::string>().size(), 32u);
    EXPECT_EQ(json["scene"], "input/scene.toml");
    EXPECT_LE(json["cost"].get<double>(), before);
    EXPECT_GT(json["cost"].get<double>(), 0);
    before = json["cost"];
  }
  std::sort(numbers.begin(), numbers.end());
  ASSERT_EQ(numbers.size(), static_cast<std::size_t>(rows));
  for (int k = 0; k < rows; ++k)
    EXPECT_EQ(numbers[static_cast<std::size_t>(k)], k + 1);
  EXPECT_EQ(manifest_line("out", 3)["set"][0], "joint_properties.rock.normal_stiffness=110000000");
  EXPECT_EQ(manifest_line("out", 1)["hash"], manifest_line("out", 2)["hash"]) << "the same run";
  EXPECT_EQ(read(out + "/input/scene.toml"), read(folder_ / "scene.toml"));
  EXPECT_EQ(read(out + "/input/study.toml"), plan);
  EXPECT_FALSE(fs::exists(out + "/runs"));
}

TEST_F(StudyFolder, OneProcessAndChunksAtOnceGiveTheSameFile) {
  const std::string whole = whole_table();

  const std::string one = planned("one");
  const Ended ended = study({"run", one});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("43 rows, 0 failed\n41 different runs, 0 of them kept from before\n"), std::string::npos)
      << ended.out;
  EXPECT_EQ(study({"gather", one}).code, 0);
  EXPECT_EQ(table("one"), whole);

  const std::string four = planned("four");
  {
    std::vector<std::unique_ptr<Process>> workers;
    for (const char* chunk : {"1/4", "2/4", "3/4", "4/4"})
      workers.push_back(std::make_unique<Process>(
          VOUSSOIR_PROGRAM,
          Launch{.arguments = {"study", "run", four, "--jobs", "1", "--chunk", chunk}, .environment = {}},
          folder_ / fmt::format("worker{}", chunk[0])));
    for (const auto& worker : workers) {
      const Ended end = worker->wait();
      EXPECT_EQ(end.code, 0) << end.err;
      EXPECT_NE(end.out.find(" 0 of them kept"), std::string::npos) << "a row was done twice: " << end.out;
    }
  }
  EXPECT_EQ(study({"gather", four}).code, 0);
  EXPECT_EQ(table("four"), whole);

  // the input alone is enough
  fs::remove(folder_ / "scene.toml");
  fs::rename(folder_ / "four", folder_ / "moved");
  fs::remove_all(run_of("moved", 7));
  EXPECT_EQ(study({"gather", at("moved")}).code, 1);
  EXPECT_NE(study({"run", at("moved")}).out.find("41 different runs, 40 of them kept"), std::string::npos);
  EXPECT_EQ(study({"gather", at("moved")}).code, 0);
  EXPECT_EQ(table("moved"), whole);
}

TEST_F(StudyFolder, GnuParallelGivesTheSameFile) {
  if (std::system("parallel --version 2>/dev/null </dev/null | grep -q 'GNU parallel'") != 0)
    GTEST_SKIP() << "GNU parallel is not installed (package parallel)";
  const std::string whole = whole_table(), out = planned("out");
  const std::string command = fmt::format(
      "parallel --will-cite --jobs 4 '{}' study run '{}' --jobs 1 --chunk {{}}/6 ::: 1 2 3 4 5 6 >'{}' "
      "2>&1 </dev/null",
      VOUSSOIR_PROGRAM, out, at("said"));
  ASSERT_EQ(std::system(command.c_str()), 0) << read(at("said"));
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(StudyFolder, StatusAndGatherNameWhatIsMissing) {
  const std::string whole = whole_table(), out = planned("out");
  EXPECT_EQ(study({"status", out}).out, "0 of 43 rows done\nmissing: 1-43\n");
  EXPECT_EQ(study({"run", out, "--rows", "3-12,20,40-43"}).code, 0);
  EXPECT_EQ(study({"status", out}).out, "15 of 43 rows done\nmissing: 1-2,13-19,21-39\n");
  // two more are the first by other names
  EXPECT_EQ(study({"run", out, "--rows", "1"}).code, 0);
  const std::string missing = "13-19,21-31,33-39";
  EXPECT_EQ(study({"status", out}).out, "18 of 43 rows done\nmissing: " + missing + "\n");
  const Ended short_of = study({"gather", out});
  EXPECT_EQ(short_of.code, 1);
  EXPECT_NE(short_of.out.find("missing: " + missing + "; do them with 'voussoir study run " + out), std::string::npos)
      << short_of.out;
  EXPECT_NE(
      table("out").find("stiffness,joint_properties.rock.normal_stiffness,220000000,,top_displacement_z,,,,missing"),
      std::string::npos)
      << table("out");

  const Ended rest = study({"run", out, "--rows", missing});
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_NE(rest.out.find("25 different runs, 0 of them kept"), std::string::npos) << rest.out;
  EXPECT_EQ(study({"status", out}).out, "43 of 43 rows done\nmissing: none\n");
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(StudyFolder, CopiesThatWorkedApartAreGathered) {
  const std::string whole = whole_table(), first = planned("first"), second = at("second");
  fs::copy(first, second, fs::copy_options::recursive);
  EXPECT_EQ(study({"run", first, "--rows", "1-24"}).code, 0);
  EXPECT_EQ(study({"run", second, "--rows", "24-43"}).code, 0);
  EXPECT_EQ(study({"gather", second}).code, 1);
  const Ended both = study({"gather", first, second});
  EXPECT_EQ(both.code, 0) << both.out << both.err;
  EXPECT_EQ(table("first"), whole);

  // the clock may differ, nothing else
  const fs::path results = run_of("second", 24) / "results.json";
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(read(results));
  json["timing"]["seconds"] = 1e6;
  std::ofstream(results) << json.dump(2);
  EXPECT_EQ(study({"gather", first, second}).code, 0);
  EXPECT_EQ(table("first"), whole);
  json["state_hash"] = "another";
  std::ofstream(results) << json.dump(2);
  const Ended differing = study({"gather", first, second});
  EXPECT_EQ(differing.code, 1);
  EXPECT_NE(differing.out.find("row 24: its results in '" + first + "' and '" + second + "' differ\n"),
            std::string::npos)
      << differing.out;
  EXPECT_EQ(table("first"), whole) << "those of the first";

  std::string other = plan;
  write("study.toml", other.replace(other.find("1.1e8"), 5, "1.15e8"));
  expect_one_line(study({"gather", first, planned("third")}), 2, "holds another study than");
}

// ---- what goes wrong ----------------------------------------------------------------------------------------------

TEST_F(StudyFolder, ARowThatDivergesIsAFailureOfItsOwn) {
  write("study.toml", R"(
scene = "scene.toml"
quantity = "top_displacement_z"
set = ["damping.statics=local"]
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
  EXPECT_NE(gathered.out.find("failed: time step: time.step_s = 100: "), std::string::npos) << gathered.out;
  EXPECT_EQ(gathered.out.find("missing"), std::string::npos) << gathered.out;
  const std::string status = study({"status", out}).out;
  EXPECT_NE(status.find("3 of 4 rows done\nfailed: row 3: "), std::string::npos) << status;
  EXPECT_NE(status.find("failed: 3\nmissing: none\n"), std::string::npos) << status;

  // all in one says the same
  EXPECT_EQ(study({at("study.toml"), "--out", at("whole")}).code, 1);
  EXPECT_EQ(table("whole"), table("out"));
}

TEST_F(StudyFolder, AFolderThatMustNotBeWrittenIsSeven) {
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
  EXPECT_NE(run(launch).out.find("4 of 43 rows done\n"), std::string::npos);
  expect_equal(contents_of(out), before, "a folder that must not be written");
  for (const std::string& name : {out, out + "/runs"})
    fs::permissions(name, fs::perms(0755));
  fs::permissions(out + "/.lock", fs::perms(0644));
  EXPECT_EQ(study({"run", out}).code, 0) << "nothing was lost";
}

// a limit on the size of files is met as a full disk is
TEST_F(StudyFolder, AFullDiskLosesNothing) {
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

TEST_F(StudyFolder, ARowHasOneWorkerAtATime) {
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
  EXPECT_NE(second.out.find("43 rows, 0 failed\n"), std::string::npos) << second.out;
  const std::string status =
      Process(VOUSSOIR_PROGRAM, {.arguments = {"study", "status", out}}, at("second")).wait().out;
  EXPECT_TRUE(status.starts_with("42 of 43 rows done\ngoing on: 5 by " + name)) << status;
  EXPECT_TRUE(status.ends_with("missing: none\n")) << status;

  // who works at it keeps others from planning it again
  expect_one_line(
      Process(VOUSSOIR_PROGRAM, {.arguments = {"study", "plan", at("study.toml"), "--out", out}}, at("second")).wait(),
      3, "in use by process ");
  ::kill(children[0], SIGCONT);
  first.send(SIGCONT);
  EXPECT_EQ(first.wait().code, 0);
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(StudyFolder, AByteThatDiffersFromThePlanIsRefused) {
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
        expect_one_line(study({part, out}), 2, fmt::format("'{}/{}' is not what was planned", out, name),
                        fmt::format("byte {} ", at));
    }
    write(std::string("out/") + name, whole);
  }
  EXPECT_FALSE(fs::exists(out + "/runs"));
  fs::remove(out + "/manifest.jsonl");
  expect_one_line(study({"run", out}), 2, "manifest.jsonl' is not what was planned");
  expect_one_line(study({"run", at("nowhere")}), 2, "holds no study: plan one with");
  EXPECT_FALSE(fs::exists(folder_ / "nowhere"));
}

TEST_F(StudyFolder, AnotherProgramIsRefusedUnlessAskedFor) {
  const std::string whole = whole_table(), out = planned("out");
  // what stands behind a program's end changes nothing of what it does
  const std::string other = write("other", read(VOUSSOIR_PROGRAM) + "!");
  fs::permissions(other, fs::perms(0755));
  Launch launch{.arguments = {"study", "run", out}};
  expect_one_line(Process(other, launch, at("caught")).wait(), 2, "was planned by another program");
  EXPECT_FALSE(fs::exists(out + "/runs"));
  launch.arguments.push_back("--any-program");
  EXPECT_EQ(Process(other, launch, at("caught")).wait().code, 0);
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(StudyFolder, PartsAreAskedStrictly) {
  const std::string out = planned("out");
  const auto refuse = [&](std::vector<std::string> arguments, const std::string& part) {
    expect_one_line(study(std::move(arguments)), 2, part);
  };
  refuse({}, "plan is required");
  refuse({at("study.toml")}, "--out is required");
  refuse({"plan", "--out", out}, "plan is required");
  refuse({"run"}, "folder is required");
  refuse({"gather"}, "folders is required");
  refuse({"--jobs", "2", "run", out}, "--jobs");
  refuse({"run", out, "--rows", "40-44"}, "the study has rows 1 to 43");
  refuse({"run", out, "--chunk", "5/4"}, "must be k/n");
  EXPECT_FALSE(fs::exists(out + "/runs"));
}

// a scene elsewhere, with a base and a table beside it, is copied with all that it reads; a link among them is refused
TEST_F(StudyFolder, TheInputIsCopiedWithAllThatItReads) {
  fs::create_directories(folder_ / "rock/common");
  fs::create_directories(folder_ / "studies");
  std::string scene = read(folder_ / "scene.toml");
  const std::size_t joints = scene.find("[[joints]]"), properties = scene.find("[[joint_properties]]");
  scene.erase(joints, properties - joints);
  write("rock/common/base.toml", "joints_file = \"joints.csv\"\n" + scene);
  write("rock/common/joints.csv", "name,dip_deg,x_m,y_m,z_m\nbed,0,0,0,0\n");
  write("rock/scene.toml", "base = \"common/base.toml\"\n");
  write("studies/study.toml",
        "scene = \"../rock/scene.toml\"\nquantity = \"top_displacement_z\"\n"
        "[[sweep]]\nname = \"density\"\nkey = \"density\"\nvalues = [1000]\n");
  const Ended planned = study({"plan", at("studies/study.toml"), "--out", at("out")});
  ASSERT_EQ(planned.code, 0) << planned.err;
  for (const char* name : {"rock/scene.toml", "rock/common/base.toml", "rock/common/joints.csv", "studies/study.toml"})
    EXPECT_EQ(read(folder_ / "out/input" / name), read(folder_ / name)) << name;
  fs::remove_all(folder_ / "rock");
  const Ended ended = study({"run", at("out")});
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;

  fs::create_directories(folder_ / "rock");
  write("rock/real.toml", read(folder_ / "scene.toml"));
  fs::create_symlink("real.toml", folder_ / "rock/base.toml");
  write("rock/scene.toml", "base = \"base.toml\"\n");
  expect_one_line(study({"plan", at("studies/study.toml"), "--out", at("linked")}), 2, "is a link");
}

// ---- kills --------------------------------------------------------------------------------------------------------

class StudyKills : public StudyFolder {
 protected:
  // Kills workers, and now and then the runs of one before it, at random moments; what is left is done in peace.
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
        goes_on = worker.wait().signal == SIGKILL;  // else nothing was left to do
        killed += goes_on;
      }
      const Ended ended = study({"run", out});
      EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
      EXPECT_EQ(study({"gather", out}).code, 0);
      EXPECT_EQ(table(name), whole);
      expect_whole_rows(out);
    }
  }

  // what of a run says something is that of the run that nothing disturbed
  void expect_whole_rows(const std::string& out) const {
    const Contents disturbed = contents_of(out + "/runs");
    int compared = 0;
    for (const auto& [name, text] : whole().runs)
      if (name.ends_with("/results.json") || name.ends_with("/history.csv")) {
        EXPECT_TRUE(disturbed.contains(name) && disturbed.at(name) == text) << name;
        ++compared;
      }
    EXPECT_EQ(compared, 2 * 41);
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
}  // namespace voussoir
