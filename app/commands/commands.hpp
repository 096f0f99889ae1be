// What the program can do. Each command returns its exit code and throws SceneError, BadInput or OutputError.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/results.hpp"

namespace voussoir {

enum class ExitCode {
  done = 0,
  incomplete = 1,  // complete, but a goal was not reached: no equilibrium, no bracket
  bad_input = 2,
  numerical = 4,  // a contact without an answer, a number that is not finite
  output = 5      // a result could not be written
};

ExitCode exit_code(Outcome outcome);

struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  // key=value
};

struct RunArguments {
  SceneArguments scene;
  std::filesystem::path out;  // empty: results/<name of the scene's file>
  int threads = 1;
  bool overwrite = false;
  bool quiet = false;
};

struct SliceArguments {
  SceneArguments scene;
  std::filesystem::path out;
};

struct StudyArguments {
  std::filesystem::path plan;
  std::filesystem::path out;
  int threads = 1;
  bool quiet = false;
};

// runs a scene and writes results.json, history.csv, scene.toml and ParaView's files
ExitCode run_command(const RunArguments& arguments);

// says what a scene activates, what follows from its numbers, and what looks wrong; writes nothing
ExitCode check_command(const SceneArguments& arguments);

// cuts the blocks and writes them with a table of their sizes
ExitCode slice_command(const SliceArguments& arguments);

// runs a scene again and again with one setting changed at a time; writes study.csv
ExitCode study_command(const StudyArguments& arguments);

// every key a scene may hold, as Markdown, on stdout
ExitCode docs_command();

}  // namespace voussoir
