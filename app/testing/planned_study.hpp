// A study of cheap rows, planned into folders and run in parts; its result by one command is made once for all tests.
#pragma once

#include <sstream>

#include "app/testing/faults.hpp"

namespace voussoir {

// 19 rows, one of them twice as stiff as the scene itself, some the same run under two names
inline const char* const study_plan = R"(
scene = "scene.toml"
quantity = "top_displacement_z"
[[sweep]]
name = "stiffness"
key = "joint_properties.rock.normal_stiffness"
values = [1.0e8, 1.1e8, 1.2e8, 1.3e8, 1.4e8, 1.5e8, 1.7e8, 2.0e8]
extrapolate = { power = 1 }
[[sweep]]
name = "density"
key = "density"
values = [1700, 1800, 1900, 2000, 2100, 2200, 2300, 2400]
[[sweep]]
name = "damping"
key = "statics"
values = ["local", "adaptive"]
)";
inline constexpr int study_rows = 19;
inline constexpr int study_runs = 17;  // that differ

class PlannedStudy : public FaultTest {
 protected:
  PlannedStudy() {
    write("scene.toml", read(std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "app/testing/two_cubes.toml"));
    write("study.toml", study_plan);
  }

  Ended study(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "study");
    return run({.arguments = std::move(arguments)});
  }
  // a planned folder in which no row is done
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
      EXPECT_EQ(std::count(all.table.begin(), all.table.end(), '\n'), 1 + study_rows + 7) << "7 extrapolations";
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
  std::filesystem::path run_of(const std::string& name, int row) const {
    return folder_ / name / "runs" / manifest_line(name, row)["hash"].get<std::string>();
  }
};

}  // namespace voussoir
