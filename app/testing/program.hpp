// The program as users see it: arguments in, files, messages and exit codes out.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "app/base/run_scene.hpp"
#include "app/testing/process.hpp"

namespace voussoir::program {

namespace fs = std::filesystem;

inline const fs::path scenes = fs::path(VOUSSOIR_SOURCE_DIR) / "app/testing";

inline std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

// every test works in an empty folder of its own
class Program : public ::testing::Test {
 protected:
  Program() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Program() override { fs::remove_all(folder_); }

  // `before` is shell text that ends in &&
  Ended run(const std::string& arguments, const std::string& before = "") const {
    const std::string command =
        fmt::format("cd '{}' && {}'{}' {} >../{}.out 2>../{}.err </dev/null", folder_.string(), before,
                    VOUSSOIR_PROGRAM, arguments, folder_.filename().string(), folder_.filename().string());
    const int status = std::system(command.c_str());
    Ended ended{.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                .out = read(folder_.string() + ".out"),
                .err = read(folder_.string() + ".err")};
    fs::remove(folder_.string() + ".out");
    fs::remove(folder_.string() + ".err");
    return ended;
  }
  nlohmann::json results(const std::string& where) const {
    return nlohmann::json::parse(read(folder_ / where / "results.json"));
  }
  double settlement(const std::string& where) const {
    return results(where)["values"]["top_displacement_z"]["value"].get<double>();
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  bool folder_is_empty() const { return fs::is_empty(folder_); }

  const std::string cubes_ = "'" + (scenes / "two_cubes.toml").string() + "' ";
  const std::string squares_ = "'" + (scenes / "two_squares.toml").string() + "' ";
  const fs::path folder_ = scratch_folder("cli");
};

}  // namespace voussoir::program
