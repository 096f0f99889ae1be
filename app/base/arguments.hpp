// Options that several commands share, and the values they take.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/base/command.hpp"

namespace voussoir {

template <class Arguments>
struct ParsedCommand {
  CLI::App* command;
  Arguments& arguments;
};

// A command with its arguments, which live as long as the parser.
template <class Arguments>
ParsedCommand<Arguments> add_command(CLI::App& program, Action& action, const std::string& name,
                                     const std::string& meaning, ExitCode (*act)(const Arguments&)) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(name, meaning);
  command->callback([&action, arguments, act] { action = [arguments, act] { return act(*arguments); }; });
  return {command, *arguments};
}

// The scene a command works on, and the keys stated on the command line.
struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  // key=value
};

inline constexpr double least_positive = 1e-9, largest_argument = 1e12;

// Within the range, and finite: nan would pass every comparison.
CLI::Validator finite(double low, double high);

// Text that is printed or becomes part of a file's name. It must not be empty: an empty name is a variable that was not
// set.
CLI::Validator plain_text();

// Numbers separated by a slash, the value of an option. Throws BadInput, which says to write `form`.
std::vector<double> slashed(const std::string& text, const char* option, const char* form);

void add_scene(CLI::App* command, SceneArguments& arguments);
void add_out(CLI::App* command, std::filesystem::path& out, const std::string& meaning, bool required = false);
void add_overwrite(CLI::App* command, bool& overwrite);
void add_threads(CLI::App* command, int& threads);

// an option that may be repeated, each time with one value
template <class Value>
CLI::Option* add_repeated(CLI::App* command, const std::string& name, std::vector<Value>& values,
                          const std::string& meaning) {
  return command->add_option(name, values, meaning)->expected(1)->take_all()->allow_extra_args(false);
}

}  // namespace voussoir
