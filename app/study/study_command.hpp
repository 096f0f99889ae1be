// `voussoir study` and `study plan`.
#pragma once

#include <filesystem>

#include "app/base/exit_codes.hpp"
#include "app/study/work_options.hpp"

namespace voussoir {

struct StudyArguments {
  std::filesystem::path plan;
  std::filesystem::path out;
  bool overwrite = false;
  WorkOptions options = {};
};

// runs a scene as it is and with one setting changed at a time, in processes side by side; writes study.csv. What was
// done before is kept while scene and program are the same.
ExitCode study_command(const StudyArguments& arguments);

// The first of its parts: what is to be run, with its input, into a folder. Then come work.hpp and gather.hpp.
ExitCode study_plan_command(const StudyArguments& arguments);

}  // namespace voussoir
