// The files that a command leaves in its folder, and those that it removes: exactly the files of an older command.
#include <gtest/gtest.h>

#include <set>

#include "app/testing/program.hpp"

namespace voussoir::claimed_folder_test {
namespace {

using namespace program;

class Claimed : public Program {
 protected:
  // every file except the program's own records
  std::set<std::string> names(const std::string& where) const {
    std::set<std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / where))
      if (!entry.is_directory() && !entry.path().filename().string().starts_with('.'))
        all.insert(entry.path().lexically_relative(folder_ / where).string());
    return all;
  }

  void odd_names_come_back(int apart) const;
};

using Names = std::set<std::string>;

TEST_F(Claimed, OverwritingLeavesNoFileOfAnOlderCommand) {
  fs::create_directories(folder_ / "out/frames");
  write("out/notes.txt", "mine");
  write("out/frames/picture.png", "mine");
  write("out/frames/blocks_7.vtp", "mine");  // not numbered as the program does
  const Names mine{"notes.txt", "frames/picture.png", "frames/blocks_7.vtp"};
  const auto with_mine = [&](Names names) {
    names.insert(mine.begin(), mine.end());
    return names;
  };
  ASSERT_EQ(run("slice " + cubes_ + "--out out --planes --obj --stl").code, 0);
  ASSERT_EQ(names("out"), with_mine({"blocks.csv", "blocks.vtp", "block_planes.csv", "blocks.obj", "blocks.stl"}));
  ASSERT_EQ(run("slice " + cubes_ + "--out out --overwrite").code, 0);
  EXPECT_EQ(names("out"), with_mine({"blocks.csv", "blocks.vtp"}));

  const Names of_run{"results.json", "run.json", "scene.toml", "history.csv"};
  ASSERT_EQ(run("run " + cubes_ + "--out out --overwrite").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/blocks.pvd") && fs::exists(folder_ / "out/frames/blocks_0000.vtp"));
  EXPECT_FALSE(fs::exists(folder_ / "out/blocks.csv"));
  ASSERT_EQ(run("run " + cubes_ + "--out out --overwrite --set output.frames=false").code, 0);
  EXPECT_EQ(names("out"), with_mine(of_run)) << "no collection that names frames of the older run";

  ASSERT_EQ(run("joint-test " + cubes_ + "--out out --overwrite").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out/joint_test.csv"));
  for (const std::string& name : of_run)
    EXPECT_FALSE(fs::exists(folder_ / "out" / name)) << name;
  for (const std::string& name : mine)
    EXPECT_EQ(read(folder_ / "out" / name), "mine") << name;
}

TEST_F(Claimed, OverwritingReplacesOthersFilesOfTheSameNames) {
  write("history.csv", "mine");
  write("results.json", "mine");
  write("data.csv", "mine");
  ASSERT_EQ(run("run " + cubes_ + "--out . --overwrite").code, 0);
  EXPECT_TRUE(read(folder_ / "history.csv").starts_with("time_s,"));
  EXPECT_EQ(read(folder_ / "data.csv"), "mine");
}

// slicing writes joints.csv; a scene in the same folder that reads it protects it
TEST_F(Claimed, InputsAreKeptEvenIfACommandMadeThem) {
  const std::string scene = read(scenes / "two_cubes.toml");
  write("scene.toml", scene);
  ASSERT_EQ(run("slice scene.toml --report --out out").code, 0);
  const std::string joints = read(folder_ / "out/joints.csv");
  std::string text = scene;
  text.erase(text.find("[[joints]]"), text.find("[[joint_properties]]") - text.find("[[joints]]"));
  write("out/again.toml", "joints_file = \"joints.csv\"\n" + text);
  const Ended ended = run("slice out/again.toml --out out --overwrite");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(read(folder_ / "out/joints.csv"), joints);
  EXPECT_FALSE(fs::exists(folder_ / "out/report.html"));
  expect_one_line(run("slice out/again.toml --report --out out --overwrite"), 2, "out/joints.csv' is read by");
}

TEST_F(Claimed, ARefusedFolderIsLeftAsItWas) {
  write("history.csv", "mine");
  EXPECT_EQ(run("run " + cubes_ + "--out .").code, 2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1) << "no lock, no list";
}

TEST_F(Claimed, FilesOfAKilledCommandAreNoResults) {
  ASSERT_EQ(run("run " + cubes_ + "--out out --quiet").code, 0);
  for (const char* name : {"results.json", "run.json"})
    fs::remove(folder_ / "out" / name);
  EXPECT_EQ(run("run " + cubes_ + "--out out --quiet").code, 0);
}

// ---- accepted names are written correctly --------------------------------------------------------------------------

const char* const odd_names[] = {"plain",          "two words", " blanks ",      "Gewölbe", "岩盤",
                                 "say \\\"so\\\"", "a, b; c",   "it's",          "-45°",    "+x",
                                 "@home",          "<b>&",      "back\\\\slash", "#1",      "[x]"};

// Scenes whose joint, properties, stage and monitor have odd names, and whose title ends in one: if `apart` is 1 each
// name stands in every place in turn, else the places have names that follow one another.
void Claimed::odd_names_come_back(int apart) const {
  const std::string scene = read(scenes / "two_cubes.toml");
  const auto odd = [](std::size_t k) { return odd_names[k % std::size(odd_names)]; };
  for (std::size_t first = 0; first < std::size(odd_names); first += static_cast<std::size_t>(apart)) {
    const std::size_t next = apart == 1 ? 0 : 1;
    SCOPED_TRACE(odd(first));
    std::string text = scene;
    const std::pair<std::string, const char*> places[] = {{"name = \"bed\"", odd(first)},
                                                          {"[\"bed\"]", odd(first)},
                                                          {"name = \"rock\"", odd(first + next)},
                                                          {"name = \"settle\"", odd(first + 2 * next)},
                                                          {"name = \"top\"", odd(first + 3 * next)}};
    for (const auto& [old, name] : places)
      for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; ++at)
        text.replace(at + old.find('"'), old.rfind('"') - old.find('"') + 1, fmt::format("\"{}\"", name));
    text.replace(text.find("One cube"), 8, "= 1+1 " + std::string(odd(first)));
    write("scene.toml", text);
    ASSERT_EQ(run("run scene.toml --quiet --overwrite --out out").code, 0);
    const std::string hash = results("out")["state_hash"];
    // as if it had been killed before its first checkpoint, and run again from what it wrote
    fs::remove(folder_ / "out/results.json");
    const Ended resumed = run("resume out --quiet");
    EXPECT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_EQ(results("out")["state_hash"], hash);
    EXPECT_EQ(results("out")["title"].get<std::string>().find("= 1+1"), 0u);

    // as a table of joints, with the same bits
    ASSERT_EQ(run("slice scene.toml --report --overwrite --out sliced").code, 0);
    fs::copy_file(folder_ / "sliced/joints.csv", folder_ / "joints.csv", fs::copy_options::overwrite_existing);
    text.erase(text.find("[[joints]]"), text.find("[[joint_properties]]") - text.find("[[joints]]"));
    write("table.toml", "joints_file = \"joints.csv\"\n" + text);
    const Ended table = run("run table.toml --quiet --overwrite --out table");
    ASSERT_EQ(table.code, 0) << table.err;
    EXPECT_EQ(results("table")["state_hash"], hash);
    EXPECT_EQ(read(folder_ / "table/history.csv"), read(folder_ / "out/history.csv"));
  }
}

TEST_F(Claimed, OddNamesComeBackFromEveryFile) {
  odd_names_come_back(3);
}

using ClaimedLong = Claimed;

TEST_F(ClaimedLong, OddNamesInEveryPlaceComeBackFromEveryFile) {
  odd_names_come_back(1);
}

}  // namespace
}  // namespace voussoir::claimed_folder_test
