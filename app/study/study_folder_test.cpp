// `voussoir study` in parts: planned once, run by any number of processes, gathered into the same file.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "app/base/digest.hpp"
#include "app/base/row_ranges.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/run_folder/origin.hpp"
#include "app/run_folder/results_hash.hpp"
#include "app/testing/planned_study.hpp"
#include "core/base/bad_input.hpp"

namespace voussoir::study_folder_test {
namespace {

namespace fs = std::filesystem;

TEST(RowRanges, RoundTrip) {
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

// the example of the algorithm's documentation: XXH3 with 128 bits of the empty string
TEST(Digest, IsThatOfTheLibrary) {
  EXPECT_EQ(digest(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_NE(digest("a"), digest("b"));
}

TEST_F(PlannedStudy, TheManifestHasEachRowOnceMostExpensiveFirst) {
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
  ASSERT_EQ(numbers.size(), static_cast<std::size_t>(study_rows));
  for (int k = 0; k < study_rows; ++k)
    EXPECT_EQ(numbers[static_cast<std::size_t>(k)], k + 1);
  EXPECT_EQ(manifest_line("out", 3)["set"][0], "joint_properties.rock.normal_stiffness=110000000");
  EXPECT_EQ(manifest_line("out", 1)["hash"], manifest_line("out", 2)["hash"]) << "the same run";
  EXPECT_EQ(read(out + "/input/scene.toml"), read(folder_ / "scene.toml"));
  EXPECT_EQ(read(out + "/input/study.toml"), study_plan);
  EXPECT_FALSE(fs::exists(out + "/runs"));
}

TEST_F(PlannedStudy, OneProcessAndConcurrentChunksGiveTheSameFile) {
  const std::string whole = whole_table();

  const std::string one = planned("one");
  const Ended ended = study({"run", one});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("19 rows, 0 failed\n17 different runs, 0 of them kept from before\n"), std::string::npos)
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
  EXPECT_NE(study({"run", at("moved")}).out.find("17 different runs, 16 of them kept"), std::string::npos);
  EXPECT_EQ(study({"gather", at("moved")}).code, 0);
  EXPECT_EQ(table("moved"), whole);
}

// examples/cluster, run by a shell that finds the program by its name
class ClusterExamples : public PlannedStudy {
 protected:
  // its output; empty: it succeeded
  std::string complaint(const std::string& command) const {
    const std::string line = fmt::format("cd '{}' && PATH='{}':\"$PATH\" {} >said 2>&1 </dev/null", folder_.string(),
                                         fs::path(VOUSSOIR_PROGRAM).parent_path().string(), command);
    return std::system(line.c_str()) == 0 ? "" : read(folder_ / "said");
  }
  const std::string examples_ = VOUSSOIR_SOURCE_DIR "/examples/cluster/";
};

TEST_F(ClusterExamples, GnuParallelGivesTheSameFile) {
  if (!complaint("parallel --version | grep -q 'GNU parallel'").empty())
    GTEST_SKIP() << "GNU parallel is not installed (package parallel)";
  const std::string whole = whole_table(), out = planned("a folder");
  EXPECT_EQ(complaint(fmt::format("'{}parallel.sh' '{}' 6 --jobs 4", examples_, out)), "");
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("a folder"), whole);
}

using ClusterExamplesLong = ClusterExamples;

// snakemake is most of a gigabyte: it is not among the packages of the tests
TEST_F(ClusterExamplesLong, SnakemakeGivesTheSameFile) {
  if (!complaint("snakemake --version").empty()) GTEST_SKIP() << "Snakemake is not installed (package snakemake)";
  const std::string whole = whole_table();
  const std::string command = fmt::format(
      "snakemake --quiet --cores 4 --snakefile '{}Snakefile' --config plan=study.toml folder='a folder' shares=6",
      examples_);
  EXPECT_EQ(complaint(command), "");
  EXPECT_EQ(table("a folder"), whole);

  // existing runs stay; only lost ones are repeated
  const fs::file_time_type before = fs::last_write_time(run_of("a folder", 8) / "results.json");
  fs::remove_all(run_of("a folder", 7));
  fs::remove_all(folder_ / "a folder.shares");
  EXPECT_EQ(complaint(command), "");
  EXPECT_EQ(table("a folder"), whole);
  EXPECT_EQ(fs::last_write_time(run_of("a folder", 8) / "results.json"), before);
}

TEST_F(PlannedStudy, StatusAndGatherListMissingRows) {
  const std::string whole = whole_table(), out = planned("out");
  EXPECT_EQ(study({"status", out}).out, "0 of 19 rows done\nnot run: 1-19\n");
  EXPECT_EQ(study({"run", out, "--rows", "3-6,8,16-19"}).code, 0);
  EXPECT_EQ(study({"status", out}).out, "9 of 19 rows done\nnot run: 1-2,7,9-15\n");
  // two more rows are the first by other names
  EXPECT_EQ(study({"run", out, "--rows", "1"}).code, 0);
  const std::string missing = "7,9-12,14-15";
  EXPECT_EQ(study({"status", out}).out, "12 of 19 rows done\nnot run: " + missing + "\n");
  const Ended short_of = study({"gather", out});
  EXPECT_EQ(short_of.code, 1);
  EXPECT_NE(short_of.out.find("not run: " + missing + "; run them with 'voussoir study run " + out), std::string::npos)
      << short_of.out;
  EXPECT_NE(
      table("out").find("stiffness,joint_properties.rock.normal_stiffness,150000000,,top_displacement_z,,,,not run"),
      std::string::npos)
      << table("out");

  const Ended rest = study({"run", out, "--rows", missing});
  EXPECT_EQ(rest.code, 0) << rest.err;
  EXPECT_NE(rest.out.find("7 different runs, 0 of them kept"), std::string::npos) << rest.out;
  EXPECT_EQ(study({"status", out}).out, "19 of 19 rows done\nnot run: none\n");
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), whole);
}

TEST_F(PlannedStudy, CopiesThatRanSeparatelyAreGathered) {
  const std::string whole = whole_table(), first = planned("first"), second = at("second");
  fs::copy(first, second, fs::copy_options::recursive);
  EXPECT_EQ(study({"run", first, "--rows", "1-10"}).code, 0);
  EXPECT_EQ(study({"run", second, "--rows", "10-19"}).code, 0);
  EXPECT_EQ(study({"gather", second}).code, 1);
  const Ended both = study({"gather", first, second});
  EXPECT_EQ(both.code, 0) << both.out << both.err;
  EXPECT_EQ(table("first"), whole);

  // only the clock and the folder's name may differ
  const fs::path results = run_of("second", 10) / "results.json";
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(read(results));
  json["timing"]["seconds"] = 1e6;
  json["warnings"] = {second + "/input/scene.toml:3: odd"};
  write_results(results.parent_path(), json.dump(2));
  EXPECT_EQ(study({"gather", first, second}).code, 0);
  EXPECT_EQ(table("first"), whole);
  json["state_hash"] = "another";
  write_results(results.parent_path(), json.dump(2));
  const Ended differing = study({"gather", first, second});
  EXPECT_EQ(differing.code, 1);
  EXPECT_NE(differing.out.find("row 10: its results in '" + first + "' and '" + second + "' differ\n"),
            std::string::npos)
      << differing.out;
  EXPECT_EQ(table("first"), whole) << "those of the first";

  std::string other = study_plan;
  write("study.toml", other.replace(other.find("1.1e8"), 5, "1.15e8"));
  expect_one_line(study({"gather", first, planned("third")}), 2, "contains another study than");
}

// ---- the C library's functions --------------------------------------------------------------------------------------

TEST(PortableMath, IsAddedToTheStatedTunables) {
  EXPECT_EQ(with_portable_math(""), "glibc.cpu.hwcaps=-FMA,-FMA4");
  EXPECT_EQ(with_portable_math("glibc.malloc.check=3"), "glibc.malloc.check=3:glibc.cpu.hwcaps=-FMA,-FMA4");
  EXPECT_EQ(with_portable_math("glibc.cpu.hwcaps=-AVX2:glibc.malloc.check=3"),
            "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4:glibc.malloc.check=3");
  for (const char* text : {"", "a=1", "glibc.cpu.hwcaps=-AVX2", "a=1:glibc.cpu.hwcaps=-AVX2:b=2"})
    EXPECT_EQ(with_portable_math(with_portable_math(text)), with_portable_math(text)) << "requested twice";
}

// on a processor with fused multiply-adds; glibc's tunable makes it act as one without
class OtherProcessor : public PlannedStudy {
 protected:
  static constexpr int rows = 6;

  OtherProcessor() {
    write("scene.toml", read(fs::path(VOUSSOIR_SOURCE_DIR) / "cases/shaking/scene.toml"));
    std::string slow = cubes_scene(2, 2, 2, 1.0, 10);
    write("slow.toml", slow.replace(slow.find("\"top\""), 5, "\"block\""));
    write("study.toml", R"(
scene = "scene.toml"
quantity = "block_displacement_x"
[[sweep]]
name = "density"
key = "density"
values = [1500, 1750, 2250, 2500, 2750]
)");
  }

  Ended there(std::vector<std::string> arguments) const {
    return run({.arguments = std::move(arguments), .environment = {{"GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA"}}});
  }
  static std::string functions_in(const std::string& text) { return text.substr(text.find("fnv1a64:"), 24); }
  bool is_other() const {
    return functions_in(there({"--version"}).out) != functions_in(run({.arguments = {"--version"}}).out);
  }
  // rows 1 to 3 here, 4 to 6 there
  std::string done_in_halves(const std::string& name, const std::vector<std::string>& options) const {
    std::vector<std::string> first{"study", "run", planned(name), "--rows", "1-3"}, second = first;
    second.back() = "4-6";
    for (std::vector<std::string>* half : {&first, &second})
      half->insert(half->end(), options.begin(), options.end());
    EXPECT_EQ(run({.arguments = first}).code, 0);
    EXPECT_EQ(there(second).code, 0);
    return at(name);
  }
};

TEST_F(OtherProcessor, GatherNamesItAndWarns) {
  if (!is_other()) GTEST_SKIP() << "this processor has no fused multiply-adds";
  const std::string here_functions = functions_in(run({.arguments = {"--version"}}).out),
                    there_functions = functions_in(there({"--version"}).out);
  const std::string halves = done_in_halves("halves", {});
  const Ended gathered = study({"gather", halves});
  EXPECT_EQ(gathered.code, 0);
  EXPECT_NE(gathered.out.find("rows 1-3 computed by the program that planned them, math functions " + here_functions +
                              "\nrows 4-6 computed by the program that planned them, math functions " +
                              there_functions + "\n"),
            std::string::npos)
      << gathered.out;
  expect_one_line(gathered, 0, "warning: these rows were computed with 2 variants of the C library's functions");

  // the effect is real: the same rows differ
  const std::string whole = planned("whole");
  EXPECT_EQ(study({"run", whole}).code, 0);
  const Ended both = study({"gather", whole, halves});
  EXPECT_EQ(both.code, 1);
  EXPECT_NE(both.out.find("' differ, and so do the programs that computed them\n"), std::string::npos) << both.out;
  EXPECT_NE(both.out.find("\nrows 1-6 computed by"), std::string::npos) << both.out;
  EXPECT_EQ(both.err, "");
}

TEST_F(OtherProcessor, PortableMathGivesItTheSameBits) {
  const std::string halves = done_in_halves("halves", {"--portable-math"});
  const Ended gathered = study({"gather", halves});
  EXPECT_EQ(gathered.code, 0);
  EXPECT_EQ(gathered.err, "");
  EXPECT_NE(gathered.out.find("rows 1-6 computed by the program that planned them, math functions " +
                              functions_in(there({"--version"}).out) + " (portable)\n"),
            std::string::npos)
      << gathered.out;
  EXPECT_EQ(study({at("study.toml"), "--portable-math", "--out", at("whole")}).code, 0);
  Contents by_halves = contents_of(halves + "/runs"), by_one = contents_of(at("whole") + "/runs");
  for (Contents* const contents : {&by_halves, &by_one})
    std::erase_if(*contents, [](const auto& file) { return file.first.ends_with(worker_file); });
  expect_equal(by_halves, by_one, "rows of two processors");
  EXPECT_EQ(table("halves"), table("whole"));
}

TEST_F(OtherProcessor, ARowThatMovesThereNamesBoth) {
  if (!is_other()) GTEST_SKIP() << "this processor has no fused multiply-adds";
  std::string plan = read(at("study.toml"));
  write("study.toml", plan + "[[sweep]]\nscene = \"slow.toml\"\nname = \"slow\"\nkey = \"density\"\nvalues = [2000]\n");
  const std::string out = planned("out");
  const nlohmann::json row = manifest_line("out", rows + 1);
  const fs::path folder = run_of("out", rows + 1);
  std::vector<std::string> arguments =
      run_arguments(out + "/" + row["scene"].get<std::string>(), folder.string(), 1000);
  for (const std::string text : row["set"])
    arguments.insert(arguments.end(), {"--set", text});
  {
    const Process begun = start({.arguments = arguments});
    ASSERT_TRUE(wait_until([&] { return fs::exists(folder / "checkpoint"); }));
  }
  EXPECT_EQ(there({"study", "run", out, "--rows", std::to_string(rows + 1)}).code, 0);
  const nlohmann::json origins = nlohmann::json::parse(read(folder / "results.json"))["program"]["origins"];
  ASSERT_EQ(origins.size(), 2u);
  EXPECT_NE(origins[0]["math_functions"], origins[1]["math_functions"]);
  EXPECT_EQ(origins[0]["program_hash"], origins[1]["program_hash"]);
  const Ended gathered = study({"gather", out});
  EXPECT_NE(gathered.out.find("; and in part by the program that planned them, math functions "), std::string::npos)
      << gathered.out;
  EXPECT_NE(gathered.err.find("with 2 variants"), std::string::npos) << gathered.err;
}

// the first row that needs an initial state makes it; the others wait for it
TEST_F(PlannedStudy, WorkersShareInitialStates) {
  write("tunnel.toml", read(fs::path(VOUSSOIR_SOURCE_DIR) / "app/testing/tunnel.toml"));
  write("study.toml", R"(
scene = "tunnel.toml"
quantity = "crown_convergence_1"
begin = "dig"
[[sweep]]
name = "bolts"
key = "bolts.roof.stiffness"
values = [1e6, 3e7, 1e8]
)");
  ASSERT_EQ(study({at("study.toml"), "--out", at("whole")}).code, 0);
  const std::string out = planned("out");
  std::vector<std::unique_ptr<Process>> workers;
  for (const char* chunk : {"1/4", "2/4", "3/4", "4/4"})
    workers.push_back(std::make_unique<Process>(
        VOUSSOIR_PROGRAM,
        Launch{.arguments = {"study", "run", out, "--jobs", "1", "--chunk", chunk}, .environment = {}},
        folder_ / fmt::format("worker{}", chunk[0])));
  for (const auto& worker : workers) {
    const Ended end = worker->wait();
    EXPECT_EQ(end.code, 0) << end.err << end.out;
  }
  EXPECT_EQ(study({"gather", out}).code, 0);
  EXPECT_EQ(table("out"), table("whole"));
  EXPECT_EQ(std::distance(fs::directory_iterator(out + "/runs"), fs::directory_iterator()), 4 + 1);
}

TEST_F(PlannedStudy, OptionsOfPartsAreCheckedStrictly) {
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
  refuse({"run", out, "--rows", "16-20"}, "the study has rows 1 to 19");
  refuse({"run", out, "--chunk", "5/4"}, "must be k/n");
  EXPECT_FALSE(fs::exists(out + "/runs"));
}

// a scene in another folder, with a base and a table, is copied with all files it reads; a link among them is refused
TEST_F(PlannedStudy, TheInputIsCopiedWithAllFilesItReads) {
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

}  // namespace
}  // namespace voussoir::study_folder_test
