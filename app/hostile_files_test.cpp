// Commands that would overwrite a file, text that controls a terminal or a spreadsheet, invalid numbers and endless
// files: refused before any work, in one line that names the option or the file; no existing file is changed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <map>
#include <span>

#include "app/base/run_scene.hpp"
#include "app/testing/program.hpp"

namespace voussoir::hostile_files_test {
namespace {

using namespace program;

const std::string scene = read(VOUSSOIR_SOURCE_DIR "/app/testing/two_cubes.toml");
const std::string plane_scene = read(VOUSSOIR_SOURCE_DIR "/app/testing/two_squares.toml");
const std::string plan =
    "scene = \"scene.toml\"\nquantity = \"top_displacement_z\"\n"
    "sweep = [{ name = \"a\", key = \"density\", values = [2000] }]\n";

// one hostile input: the files of the folder, the command, and the message it must give
struct Trial {
  std::string name;
  std::string arguments;
  std::string part;  // of the message
  std::function<void(const fs::path&)> arrange = {};
  std::string before = {};  // arguments of a command that has succeeded before
  int code = 2;

  // files that a command writes for its own use, if an earlier command made them or this one succeeds
  bool is_ours(const std::string& path) const {
    return (path == "out/.lock" && !before.empty()) || (path.starts_with("out/.") && code == 0);
  }
};

void put(const fs::path& file, const std::string& text) {
  if (file.has_parent_path()) fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

std::function<void(const fs::path&)> file(const std::string& name, const std::string& text = "mine\n") {
  return [=](const fs::path& folder) { put(folder / name, text); };
}

void make_pipe(const fs::path& path) {
  fs::remove_all(path);
  fs::create_directories(path.parent_path());
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
}

void make_sparse(const fs::path& path) {
  fs::remove_all(path);
  put(path, "");
  fs::resize_file(path, std::uintmax_t{20} << 30);
}

// every file by its name and kind, with the contents of those that can be read
std::map<std::string, std::string> stand(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string& what = all[entry.path().lexically_relative(folder).string()];
    if (entry.is_symlink())
      what = "link to " + fs::read_symlink(entry.path()).string();
    else if (entry.is_regular_file() && entry.file_size() < 100'000'000)
      what = read(entry.path());
  }
  return all;
}

class HostileFiles : public Program {
 protected:
  void expect_refused(const std::vector<Trial>& trials) {
    for (const Trial& trial : trials) {
      SCOPED_TRACE(trial.name + ": voussoir " + trial.arguments);
      fs::remove_all(folder_);
      fs::create_directories(folder_);
      write("scene.toml", scene);
      write("plane.toml", plane_scene);
      write("study.toml", plan);
      write("victim", "precious\n");
      if (!trial.before.empty()) {
        ASSERT_EQ(run(trial.before).code, 0) << trial.before;
      }
      if (trial.arrange) trial.arrange(folder_);
      const auto before = stand(folder_);
      const Ended ended = run(trial.arguments, limits_);
      EXPECT_EQ(ended.code, trial.code) << ended.err;
      if (trial.code != 0) {
        EXPECT_EQ(lines_of(ended.err).size(), 1u) << ended.err;
      }
      EXPECT_NE(ended.err.find(trial.part), std::string::npos) << ended.err;
      for (const char c : ended.out + ended.err)
        EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20) << static_cast<int>(c);
      auto after = stand(folder_);
      for (const auto& [name, text] : before)
        if (!trial.is_ours(name)) {
          EXPECT_TRUE(after.contains(name) && after[name] == text) << name << " was changed";
        }
      ++count_;
    }
  }

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  const std::string limits_ = "ulimit -t 60 && ";
#else
  const std::string limits_ = "ulimit -t 5 && ulimit -v 2000000 && ";
#endif
  int count_ = 0;
};

// ---- files that would be lost -------------------------------------------------------------------------------------

std::vector<Trial> over_inputs() {
  const auto link = [](const std::string& to, const std::string& from) {
    return [=](const fs::path& folder) {
      fs::create_directories((folder / from).parent_path());
      fs::create_symlink(to, folder / from);
    };
  };
  const auto hard_link = [](const std::string& to, const std::string& from) {
    return [=](const fs::path& folder) {
      fs::create_directories((folder / from).parent_path());
      fs::create_hard_link(folder / to, folder / from);
    };
  };
  const auto base = [](const fs::path& folder) {
    put(folder / "variant.toml", "base = \"scene.toml\"\ntitle = \"v\"\n");
  };
  const auto as_tables = [](const fs::path& folder) {
    put(folder / "blocks.csv",
        "block,normal_x,normal_y,normal_z,offset_m\na,1,0,0,1\na,-1,0,0,0\na,0,1,0,1\na,0,-1,0,0\na,0,0,1,1\na,0,0,-1,"
        "0\n");
    put(folder / "cut.toml",
        "blocks_file = \"blocks.csv\"\n" + scene.substr(0, scene.find("[domain.box]")) +
            "joint_properties = [{ name = \"rock\", normal_stiffness = 1e8, shear_stiffness = 1e7, "
            "friction_deg = 30 }]\nstage = [{ name = \"s\", kind = \"settle\" }]\n");
    std::string text = scene;
    text.erase(text.find("[[joints]]"), text.find("[[joint_properties]]") - text.find("[[joints]]"));
    put(folder / "jointed.toml", "joints_file = \"joints.csv\"\n" + text);
    put(folder / "joints.csv", "name,dip_deg,dip_direction_deg,x_m,y_m,z_m\nbed,0,0,0,0,0\n");
  };
  const std::string read_here = "is read by this command, which would write over it";
  std::vector<Trial> trials;
  for (const std::string more : {"", " --overwrite"}) {
    const std::vector<Trial> both{
        {"scene in its own folder", "run scene.toml --out ." + more, "scene.toml' " + read_here},
        {"by its whole path", "run scene.toml --out \"$PWD\"" + more, "scene.toml' " + read_here},
        {"through a folder that is a link", "run scene.toml --out here" + more, "scene.toml' " + read_here,
         link(".", "here")},
        {"a base that others share", "run variant.toml --out ." + more, "scene.toml' " + read_here, base},
        {"a link to the scene", "run scene.toml --out out" + more, "out/scene.toml' " + read_here,
         link("../scene.toml", "out/scene.toml")},
        {"a hard link to the scene", "run scene.toml --out out" + more, "out/history.csv' " + read_here,
         hard_link("scene.toml", "out/history.csv")},
        {"a frame that is the scene", "run scene.toml --out out" + more, "out/frames/blocks_0003.vtp' " + read_here,
         hard_link("scene.toml", "out/frames/blocks_0003.vtp")},
        {"a table of blocks", "slice cut.toml --out ." + more, "blocks.csv' " + read_here, as_tables},
        {"a table of joints", "slice jointed.toml --report --out ." + more, "joints.csv' " + read_here, as_tables},
        {"a link to the table", "slice cut.toml --planes --out out" + more, "out/block_planes.csv' " + read_here,
         [=](const fs::path& folder) {
           as_tables(folder);
           link("../blocks.csv", "out/block_planes.csv")(folder);
         }},
        {"a joint test", "joint-test joint_test.csv --out ." + more, "joint_test.csv' " + read_here,
         file("joint_test.csv", scene)},
        {"a study's plan", "study study.csv --out ." + more, "study.csv' " + read_here, file("study.csv", plan)},
    };
    trials.insert(trials.end(), both.begin(), both.end());
  }
  trials.push_back({"limit analysis", "limit blocks.vtp --out . --overwrite", "blocks.vtp' " + read_here,
                    file("blocks.vtp", plane_scene)});
  return trials;
}

TEST_F(HostileFiles, NoInputIsWrittenOver) {
  expect_refused(over_inputs());
  EXPECT_GE(count_, 25);
}

std::vector<Trial> over_others() {
  const std::string foreign = "' was not made by this program and would be replaced: choose another folder";
  std::vector<Trial> trials;
  for (const char* name : {"history.csv", "scene.toml", "checkpoint", "checkpoint.previous", "blocks.pvd",
                           "contacts.pvd", "frames/blocks_0000.vtp", "frames/contacts_0123.vtp"})
    trials.push_back({name, "run scene.toml --out out", name + foreign, file(std::string("out/") + name)});
  for (const char* name : {"blocks.vtp", "blocks.csv"})
    trials.push_back({name, "slice scene.toml --out out", name + foreign, file(std::string("out/") + name)});
  trials.push_back({"obj", "slice scene.toml --obj --out out", "blocks.obj" + foreign, file("out/blocks.obj")});
  trials.push_back({"report", "slice scene.toml --report --out out", "report.html" + foreign, file("out/report.html")});
  for (const char* name : {"limit.svg", "forces.vtp"})
    trials.push_back({name, "limit plane.toml --out out", name + foreign, file(std::string("out/") + name)});
  for (const char* name : {"joint_test.csv", "joint_test.svg"})
    trials.push_back({name, "joint-test scene.toml --out out", name + foreign, file(std::string("out/") + name)});
  for (const char* name : {"study.csv", "study.json", "manifest.jsonl", "input/scene.toml"})
    trials.push_back({name, "study study.toml --out out", name + foreign, file(std::string("out/") + name)});
  trials.push_back(
      {"a copy", "study plan study.toml --out out", "input/study.toml" + foreign, file("out/input/study.toml")});
  const auto dangling = [](const fs::path& folder) {
    fs::create_directories(folder / "out");
    fs::create_symlink("nowhere", folder / "out/history.csv");
  };
  trials.push_back({"a link to nowhere", "run scene.toml --out out", "history.csv" + foreign, dangling});
  trials.push_back({"a folder", "run scene.toml --out out --overwrite", "history.csv' is a folder where a file must be",
                    file("out/history.csv/mine")});
  trials.push_back({"results", "run scene.toml --out out", "'out' contains results", file("out/results.json")});
  trials.push_back({"an unfinished run", "run scene.toml --out out", "'voussoir resume out'", file("out/run.json")});
  const std::string quiet_run = "run scene.toml --quiet --out out";
  trials.push_back({"run, then slice", "slice scene.toml --out out", "'out' contains results", {}, quiet_run});
  trials.push_back({"run, then limit", "limit plane.toml --out out", "'out' contains results", {}, quiet_run});
  trials.push_back({"run, then a study", "study study.toml --out out", "'out' contains results", {}, quiet_run});
  const std::string sliced = "slice scene.toml --obj --out out";
  trials.push_back({"slice twice", "slice scene.toml --out out", "'out' contains results", {}, sliced});
  trials.push_back({"slice, then run", "run scene.toml --out out", "'out' contains results", {}, sliced});
  for (const char* command : {"run", "slice"})
    trials.push_back({"a study's folder",
                      command + std::string(" scene.toml --out out --overwrite"),
                      "'out' contains a study",
                      {},
                      "study study.toml --quiet --out out"});
  // a list with paths outside of its folder is ignored
  const std::string lies =
      R"({"schema": "voussoir.made", "schema_version": 1, "command": "run", "files": ["../victim"], "frames": false,
"folders": ["../"]})";
  trials.push_back({"a forged list", "run scene.toml --quiet --overwrite --out out", "",
                    [=](const fs::path& folder) {
                      put(folder / "out/notes.txt", "mine");
                      put(folder / "out/.voussoir-made", lies);
                    },
                    "", 0});
  return trials;
}

TEST_F(HostileFiles, NoOtherFileIsReplacedUnasked) {
  expect_refused(over_others());
  EXPECT_GE(count_, 27);
}

TEST_F(HostileFiles, OnlyOurOwnLockIsWritten) {
  const std::string no_lock = "'out/.lock' is no lock of this program";
  const auto linked = [](const fs::path& folder) {
    fs::create_directories(folder / "out");
    fs::create_symlink("../victim", folder / "out/.lock");
  };
  std::vector<Trial> trials;
  for (const char* command :
       {"run scene.toml", "slice scene.toml", "limit plane.toml", "joint-test scene.toml", "study study.toml"})
    trials.push_back({"a link", command + std::string(" --overwrite --out out"), no_lock, linked});
  trials.push_back({"a hard link", "run scene.toml --out out", no_lock, [](const fs::path& folder) {
                      fs::create_directories(folder / "out");
                      fs::create_hard_link(folder / "victim", folder / "out/.lock");
                    }});
  trials.push_back({"a text", "run scene.toml --out out", no_lock, file("out/.lock")});
  trials.push_back({"a folder", "run scene.toml --out out", no_lock, file("out/.lock/file")});
  trials.push_back(
      {"a pipe", "run scene.toml --out out", no_lock, [](const fs::path& folder) { make_pipe(folder / "out/.lock"); }});
  trials.push_back({"a link, resumed", "resume out", no_lock,
                    [](const fs::path& folder) {
                      fs::remove(folder / "out/results.json");
                      fs::remove(folder / "out/.lock");
                      fs::create_symlink("../victim", folder / "out/.lock");
                    },
                    "run scene.toml --quiet --out out"});
  expect_refused(trials);
}

// ---- text ---------------------------------------------------------------------------------------------------------

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::vector<Trial> texts() {
  struct Bad {
    std::string bytes, toml, what;  // as TOML writes it, empty if it cannot
  };
  const Bad bads[] = {{"\xE4", "", "0xE4, which is not UTF-8"},
                      {"\x1b[31m", "\\u001b[31m", "control character (U+001B)"},
                      {"\xC2\x9b", "\\u009b", "control character (U+009B)"},
                      {"\xE2\x80\xAE", "\\u202e", "turns the direction of text (U+202E)"},
                      {"\xE2\x80\xA8", "\\u2028", "line separator (U+2028)"}};
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  std::vector<Trial> trials;
  for (const Bad& bad : bads) {
    const std::string &bytes = bad.bytes, &toml = bad.toml, &what = bad.what;
    const auto scene_with = [&](const std::string& from, const std::string& to) {
      return file("bad.toml", replaced(scene, from, replaced(to, "@", toml)));
    };
    if (!toml.empty()) {
      trials.push_back({"title", "check bad.toml", "bad.toml:2: title", scene_with("One cube", "@")});
      trials.push_back({"name", "check bad.toml", what, scene_with("name = \"bed\"", "name = \"b@d\"")});
      trials.push_back({"key", "check bad.toml", what, scene_with("density = 2000", "\"d@\" = 2000")});
      trials.push_back({"a stage", "run bad.toml --out out", what, scene_with("name = \"settle\"", "name = \"s@\"")});
      trials.push_back({"a word of a list", "check bad.toml", what, scene_with("[\"displacement\"]", "[\"@\"]")});
      trials.push_back({"unit of a study", "study bad.toml --out out", what,
                        file("bad.toml", replaced(plan, "name = \"a\"", "name = \"a\", unit = \"" + toml + "\""))});
      trials.push_back({"quantity of a study", "study bad.toml --out out", "bad.toml:2: quantity",
                        file("bad.toml", replaced(plan, "top_", toml))});
    } else {
      trials.push_back({"title", "check bad.toml", "bad.toml:2", file("bad.toml", replaced(scene, "One cube", bytes))});
    }
    // how a shell hands bytes over
    const std::string set = " --set 'title=" + bytes + "'";
    trials.push_back({"--set", "run scene.toml --out out" + set, "--set: must not contain", {}});
    trials.push_back({"--out", "run scene.toml --out 'out" + bytes + "'", "--out: must not contain", {}});
    trials.push_back({"a scene's path", "check 's" + bytes + ".toml'", "must not contain", {}});
    trials.push_back({"--joint", "joint-test scene.toml --joint '" + bytes + "'", "--joint: must not contain", {}});
    const auto named = [&](const char* key, const std::string& name, const std::string& content) {
      return [=, head = scene.substr(0, scene.find("[domain.box]")),
              tail = scene.substr(scene.find("[[joint_properties]]"),
                                  scene.find("[[fix]]") - scene.find("[[joint_properties]]"))](const fs::path& folder) {
        put(folder / name, content);
        put(folder / "bad.toml",
            std::string(key) + " = \"" + name + "\"\n" + head + tail + "[[stage]]\nname = \"s\"\nkind = \"settle\"\n");
      };
    };
    trials.push_back(
        {"CSV", "check bad.toml", "bad.csv:2:2: ",
         named("joints_file", "bad.csv", "name,dip_deg,dip_direction_deg,x_m,y_m,z_m\nb" + bytes + ",0,0,0,0,0\n")});
    trials.push_back(
        {"OBJ", "check bad.toml", "bad.obj:1:4: ", named("blocks_file", "bad.obj", "o b" + bytes + "\n" + corners)});
    trials.push_back({"STL", "check bad.toml",
                      "bad.stl:1:8: ", named("blocks_file", "bad.stl", "solid b" + bytes + "\nendsolid\n")});
  }
  return trials;
}

TEST_F(HostileFiles, TextIsCheckedAtEveryInput) {
  expect_refused(texts());
  EXPECT_GE(count_, 60);
}

// ---- numbers and names of the command line ------------------------------------------------------------------------

TEST_F(HostileFiles, OptionsAreFiniteNumbersAndNamesAreNotEmpty) {
  std::vector<Trial> trials;
  // all of these at the first option, which all read by the same function; three at each of the others
  for (const char* number : {"nan", "-inf", "1e999", "-nan", "NAN", "inf"}) {
    const std::pair<const char*, const char*> options[] = {
        {"run scene.toml --out out", "--checkpoint-seconds"},  {"run scene.toml --out out", "--checkpoint-steps"},
        {"joint-test scene.toml --out out", "--stress"},       {"joint-test scene.toml --out out", "--slip"},
        {"joint-test scene.toml --out out", "--surroundings"}, {"joint-test scene.toml --out out", "--dilation"},
        {"study study.toml --out out", "--time-limit"}};
    const bool is_spelling =
        number == std::string("-nan") || number == std::string("NAN") || number == std::string("inf");
    for (const auto& [command, option] : std::span(options).first(is_spelling ? 1 : std::size(options)))
      trials.push_back({"a number", fmt::format("{} {}={}", command, option, number), option});
  }
  const std::pair<const char*, const char*> whole[] = {{"run scene.toml --out out", "--threads"},
                                                       {"resume out", "--threads"},
                                                       {"study study.toml --out out", "--jobs"},
                                                       {"joint-test scene.toml --out out", "--steps"},
                                                       {"joint-test scene.toml --out out", "--cycles"}};
  for (const auto& [command, option] : whole)
    trials.push_back({"a whole number", fmt::format("{} {} nan", command, option), option});
  for (const char* command :
       {"run scene.toml", "slice scene.toml", "limit plane.toml", "joint-test scene.toml", "study study.toml"})
    trials.push_back({"an empty folder", command + std::string(" --out ''"), "--out: must not be empty"});
  trials.push_back({"an empty scene", "check ''", "scene: must not be empty"});
  trials.push_back({"an empty run", "resume ''", "folder: must not be empty"});
  trials.push_back({"an empty plan", "study '' --out out", "plan: must not be empty"});
  trials.push_back({"an empty override", "check scene.toml --set ''", "--set: must not be empty"});
  trials.push_back({"an empty name", "joint-test scene.toml --joint ''", "--joint: must not be empty"});
  expect_refused(trials);
}

// ---- files that never end -----------------------------------------------------------------------------------------

TEST_F(HostileFiles, OnlyRegularFilesOfSaneSizeAreOpened) {
  std::vector<Trial> trials;
  const auto odd = [](const std::string& name, void (*make)(const fs::path&), bool unfinished) {
    return [=](const fs::path& folder) {
      if (unfinished) fs::remove(folder / "out/results.json");
      make(folder / name);
    };
  };
  const std::pair<void (*)(const fs::path&), std::string> kinds[] = {
      {make_pipe, "not a file"},
      {make_sparse, "larger than"},
      {[](const fs::path& path) { fs::remove_all(path), fs::create_directories(path); }, "not a file"},
      {[](const fs::path& path) { fs::remove_all(path), fs::create_symlink("/dev/zero", path); }, "not a file"}};
  const std::string quiet_run = "run scene.toml --quiet --out out";
  for (const auto& [make, reason] : kinds) {
    trials.push_back({"plan", "study odd.toml --out out2", "odd.toml: " + reason, odd("odd.toml", make, false)});
    trials.push_back({"scene", "run odd.toml --out out2", "odd.toml: " + reason, odd("odd.toml", make, false)});
    trials.push_back(
        {"scene of a plan", "study study.toml --out out2", "scene.toml: " + reason, odd("scene.toml", make, false)});
    trials.push_back({"notes", "resume out", "'out/run.json': " + reason, odd("out/run.json", make, true), quiet_run});
    trials.push_back(
        {"effective scene", "resume out", "out/scene.toml: " + reason, odd("out/scene.toml", make, true), quiet_run});
    const std::string refusal = make == make_sparse ? "is not a checkpoint of this program" : reason;
    trials.push_back({"checkpoint", "resume out", refusal, odd("out/checkpoint", make, true), quiet_run});
  }
  for (const char* device : {"/dev/zero", "/dev/null", "/dev/full"}) {
    trials.push_back({"plan", fmt::format("study {} --out out", device), fmt::format("{}: not a file", device)});
    trials.push_back({"folder", fmt::format("resume {}", device), fmt::format("'{}' is not a folder", device)});
  }
  expect_refused(trials);
}

}  // namespace
}  // namespace voussoir::hostile_files_test
