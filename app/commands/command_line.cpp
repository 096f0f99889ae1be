#include "app/commands/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "app/base/exit_codes.hpp"
#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/base/run_scene.hpp"
#include "app/blocks/blocks_command.hpp"
#include "app/check/check_command.hpp"
#include "app/docs/docs_command.hpp"
#include "app/export/export_command.hpp"
#include "app/import/import_command.hpp"
#include "app/joint_test/joint_test_command.hpp"
#include "app/judge/judge_command.hpp"
#include "app/limit/limit_command.hpp"
#include "app/modes/modes_command.hpp"
#include "app/report/report_command.hpp"
#include "app/run/memory_needed.hpp"
#include "app/run/resume_command.hpp"
#include "app/run/run_command.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/slice/slice_command.hpp"
#include "app/study/study_command.hpp"
#include "app/view/view_command.hpp"
#include "core/base/bad_input.hpp"
#include "core/base/version.hpp"
#include "core/output/origin.hpp"
#include "core/output/output_error.hpp"
#include "core/scene/scene_error.hpp"
#include "core/step/neighbours.hpp"

namespace voussoir {
namespace {

// in the order of the help text
constexpr AddCommand* commands[] = {add_run,    add_resume, add_view,  add_report, add_check,
                                    add_slice,  add_blocks, add_limit, add_modes,  add_joint_test,
                                    add_import, add_export, add_study, add_judge,  add_docs};

// an allocation has failed: this must not allocate again
int not_enough_memory() {
  std::fputs("voussoir: not enough memory; a run that was under way can be resumed from its last checkpoint\n", stderr);
  return static_cast<int>(ExitCode::no_memory);
}

// an external library may forbid exceptions when it allocates memory
[[noreturn]] void end_without_handler() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::_Exit(not_enough_memory());
  } catch (...) {
  }
  std::abort();
}

std::string version_text() {
  std::string text = fmt::format("voussoir {} ({})\nbuilt by {}\n", version(), commit(), compiler());
  for (const auto& [name, built_in] : features())
    text += fmt::format("{:<15} {}\n", name, built_in ? "yes" : "no");
  return text + fmt::format("{:<15} {}, a hash of the C library's functions on this processor", "math functions",
                            math_functions_hash());
}

std::string exit_codes_text() {
  std::string text = "Exit codes: ";
  for (const auto& [code, meaning] : exit_code_meanings)
    text += fmt::format("{} {}, ", static_cast<int>(code), meaning);
  return text + fmt::format("{} + n {}.", static_cast<int>(ExitCode::signal), ended_by_signal);
}

ExitCode exit_code(OutputError::Kind kind) {
  switch (kind) {
    case OutputError::Kind::failed:
      return ExitCode::output;
    case OutputError::Kind::disk_full:
      return ExitCode::disk_full;
    case OutputError::Kind::not_permitted:
      return ExitCode::not_permitted;
  }
  return ExitCode::output;
}

// every failure is one line that states the repair, and an exit code for scripts
int guarded(const Action& action) {
  try {
    const ExitCode code = action();
    // the rest of the buffer counts as well: a pipe or a file may refuse it
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw output_error("standard output", errno);
    return static_cast<int>(code);
  } catch (const SceneError& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const BadInput& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const NotEnoughMemory& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(ExitCode::no_memory);
  } catch (const TooManyNeighbours& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const FolderInUse& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(ExitCode::in_use);
  } catch (const OutputError& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(exit_code(error.kind));
  } catch (const std::filesystem::filesystem_error& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(exit_code(output_error(error.path1(), error.code().value()).kind));
  } catch (const std::system_error& error) {
    // fmt's error for a stream that refuses to write
    const OutputError refused = output_error("standard output", error.code().value());
    tell("voussoir: {}\n", refused.what());
    return static_cast<int>(exit_code(refused.kind));
  } catch (const std::bad_alloc&) {
    return not_enough_memory();
  } catch (const std::exception& error) {
    tell("voussoir: unexpected error, please report it: {}\n", error.what());
    return static_cast<int>(ExitCode::numerical);
  }
}

int parse_and_act(int argument_count, char** arguments) {
  CLI::App program("Distinct element models of jointed rock, verified.", "voussoir");
  program.set_version_flag("--version", version_text);
  program.require_subcommand(1);
  program.footer(exit_codes_text());

  Action action;
  for (AddCommand* add : commands)
    add(program, action);

  try {
    program.parse(argument_count, arguments);
  } catch (const CLI::ParseError& error) {
    // help and version are no errors; anything else is bad input, whatever code the parser has for it
    if (error.get_exit_code() != 0) {
      tell("voussoir: {}; 'voussoir --help' and 'voussoir <command> --help' list commands and options\n", error.what());
      return static_cast<int>(ExitCode::bad_input);
    }
    program.exit(error);
    return guarded([] { return ExitCode::done; });
  }
  return guarded(action);
}

}  // namespace

int command_line(int argument_count, char** arguments) {
  prepare_process();
  std::set_terminate(end_without_handler);
  try {
    return parse_and_act(argument_count, arguments);
  } catch (const std::bad_alloc&) {
    return not_enough_memory();
  }
}

}  // namespace voussoir
