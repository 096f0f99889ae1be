// Common parts of the tests of faults: a scene of any size, an empty folder for each test, and the comparison: every
// file of a run that was disturbed and resumed equals that of an undisturbed run.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "app/testing/process.hpp"
#include "core/run/checkpoint.hpp"

namespace voussoir {

// cubes of 1 m in a box, the lowest layer fixed, while gravity is switched on
inline std::string cubes_scene(int nx, int ny, int nz, double seconds, int frames) {
  std::string text = fmt::format(R"(title = "Cubes"
dimension = 3
gravity = [0, 0, -10]
density = 2500
domain = {{ box = {{ min = [0, 0, 0], max = [{}, {}, {}] }} }}
joint_properties = [{{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }}]
fix = [{{ below = ["z1"] }}]
stage = [{{ name = "load", kind = "run", duration_s = {}, gravity_ramp_s = {} }}]
output = {{ frame_interval_s = {}, history_interval_s = {} }}
monitors = [{{ name = "top", inside = [0.5, 0.5, {}], quantities = ["displacement", "velocity"] }}]
)",
                                 nx, ny, nz, seconds, seconds / 2, seconds / frames, seconds / 50, nz - 0.5);
  const auto joints = [&text](const char* axis, int count, int dip, const char* point) {
    for (int k = 1; k < count; ++k)
      text += fmt::format("[[joints]]\nname = \"{}{}\"\ndip = {}\ndip_direction = {}\npoint = {}\n", axis, k, dip,
                          axis[0] == 'x' ? 90 : 0, fmt::format(fmt::runtime(point), k));
  };
  joints("z", nz, 0, "[0, 0, {}]");
  joints("x", nx, 90, "[{}, 0, 0]");
  joints("y", ny, 90, "[0, {}, 0]");
  return text;
}

// every file by its name; of results.json all but the clock, of the lock, and the hash that counts the clock, nothing
using Contents = std::map<std::string, std::string>;

inline Contents contents_of(const std::filesystem::path& folder) {
  Contents contents;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path name = entry.path().filename();
    if (!entry.is_regular_file() || name == ".lock" || name == "results.hash") continue;
    std::string text = read(entry.path());
    if (name == "results.json") {
      nlohmann::ordered_json results = nlohmann::ordered_json::parse(text);
      results.erase("timing");
      text = results.dump();
    }
    contents[entry.path().lexically_relative(folder).string()] = text;
  }
  return contents;
}

inline void expect_equal(const Contents& found, const Contents& wanted, const std::string& what) {
  std::string differences;
  for (const auto& [name, text] : wanted)
    if (!found.contains(name))
      differences += " " + name + " is missing,";
    else if (found.at(name) != text)
      differences += " " + name + " differs,";
  for (const auto& [name, text] : found)
    if (!wanted.contains(name)) differences += " " + name + " is left over,";
  EXPECT_EQ(differences, "") << what;
}

// no file is partly written, even if others are missing
inline void expect_whole_files(const std::filesystem::path& folder, const Contents& complete, const std::string& what) {
  for (const auto& [name, text] : contents_of(folder)) {
    EXPECT_EQ(name.find("voussoir-part"), std::string::npos) << what << name;
    if (name.starts_with("checkpoint")) {
      EXPECT_NO_THROW(checkpoint_record(text)) << what << name;
    } else if (name.ends_with(".pvd")) {
      EXPECT_TRUE(text.ends_with("</VTKFile>\n")) << what << name;
    } else if (name != "history.csv") {
      EXPECT_TRUE(complete.contains(name) && complete.at(name) == text) << what << name;
    } else {
      EXPECT_TRUE(complete.at(name).starts_with(text)) << what << name;
    }
  }
}

class FaultTest : public ::testing::Test {
 protected:
  FaultTest() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~FaultTest() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  Process start(const Launch& launch) const { return {VOUSSOIR_PROGRAM, launch, folder_ / "caught"}; }
  Ended run(const Launch& launch) const { return start(launch).wait(); }

  static std::vector<std::string> run_arguments(const std::string& scene, const std::string& out, int steps) {
    return {"run", scene, "--out", out, "--quiet", "--checkpoint-steps", std::to_string(steps)};
  }
  static std::vector<std::string> resume_arguments(const std::string& out) { return {"resume", out, "--quiet"}; }

  // continues an existing run, or begins a new one
  Ended finish(const std::string& scene, const std::string& out, int steps) const {
    const bool begun = std::filesystem::exists(std::filesystem::path(out) / "run.json");
    return run({.arguments = begun ? resume_arguments(out) : run_arguments(scene, out, steps)});
  }

  // the undisturbed run
  Contents undisturbed(const std::string& scene, int steps) const {
    const Ended ended = run({.arguments = run_arguments(scene, at("undisturbed"), steps)});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return contents_of(at("undisturbed"));
  }

  const std::filesystem::path folder_ = scratch_folder("faults");
};

}  // namespace voussoir
