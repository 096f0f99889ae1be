// What the arguments of several commands share: options and what they take.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/study/study_command.hpp"
#include "app/study/work.hpp"

namespace voussoir {

// what the arguments ask for, to be done once all of them are read
using Action = std::function<ExitCode()>;

inline constexpr double least_positive = 1e-9, largest_argument = 1e12;

// Within the range, and finite: nan would pass every comparison.
CLI::Validator finite(double low, double high);

// What is printed or becomes part of a file's name, and never nothing: an empty name is a variable that was not set.
CLI::Validator plain_text();

void add_out(CLI::App* command, std::filesystem::path& out, const std::string& meaning, bool required = false);
void add_overwrite(CLI::App* command, bool& overwrite);
void add_threads(CLI::App* command, int& threads);

struct AllStudyArguments {
  StudyArguments study;
  WorkArguments work;
  std::vector<std::filesystem::path> folders;
};

// `voussoir study` and its parts.
void add_study(CLI::App& program, AllStudyArguments& all, Action& action);

}  // namespace voussoir
