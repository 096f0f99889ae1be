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

#include "app/base/bad_input.hpp"
#include "app/base/exit_codes.hpp"
#include "app/base/interruption.hpp"
#include "app/base/message.hpp"
#include "app/base/run_scene.hpp"
#include "app/base/scene_arguments.hpp"
#include "app/check/check_command.hpp"
#include "app/commands/arguments.hpp"
#include "app/commands/command_pages.hpp"
#include "app/docs/docs_command.hpp"
#include "app/export/export_command.hpp"
#include "app/import/import_command.hpp"
#include "app/joint_test/joint_test_command.hpp"
#include "app/limit/limit_command.hpp"
#include "app/run/run_command.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/slice/slice_command.hpp"
#include "app/view/view_command.hpp"
#include "core/base/version.hpp"
#include "core/output/origin.hpp"
#include "core/output/output_error.hpp"
#include "core/scene/scene_error.hpp"
#include "core/step/neighbours.hpp"
#include "text/plain_text.hpp"

namespace voussoir {
namespace {

// memory was asked for and not given: this must not ask again
int not_enough_memory() {
  std::fputs("voussoir: not enough memory; a run that was under way can be resumed from its last checkpoint\n", stderr);
  return static_cast<int>(ExitCode::no_memory);
}

// an outside library may forbid exceptions where it asks for memory
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

void add_scene(CLI::App* command, SceneArguments& arguments) {
  command->add_option("scene", arguments.scene, "scene file (TOML)")
      ->required()
      ->check(plain_text())
      ->type_name("FILE");
  command
      ->add_option("--set", arguments.overrides,
                   "replaces a value of the scene; tables of a list by their name, e.g. joints.A.dip=65. Each takes a "
                   "--set of its "
                   "own")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->check(plain_text());
}

void add_run(CLI::App& program, RunArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand("run", "run a scene and write its results");
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of the results (default: results/<scene>)");
  add_threads(command, arguments.threads);
  command
      ->add_option("--checkpoint-steps", arguments.checkpoint_steps,
                   "steps between checkpoints (default: by time alone)")
      ->check(finite(0, largest_argument));
  command
      ->add_option("--checkpoint-seconds", arguments.checkpoint_seconds,
                   "wall clock between checkpoints; 0: none (default: 300)")
      ->check(finite(0, largest_argument));
  command
      ->add_option("--until", arguments.until,
                   "end with this stage and keep its last state, so that other runs can begin there")
      ->check(plain_text());
  command->add_flag("--keep", arguments.keep, "keep the state at the end, so that other runs can begin there");
  command
      ->add_option(
          "--begin", arguments.begin,
          "folder of a run of the same blocks and first stages that kept its end: begin there, with the results "
          "of the whole run")
      ->check(plain_text())
      ->type_name("FOLDER");
  command->add_flag("--budget", arguments.budget,
                    "vary what was chosen, one thing at a time, in runs beside the answer: every value then says what "
                    "moves it, and its error bar covers that (accuracy.budget)");
  command->add_flag("--view", arguments.view,
                    "write view.html, one page in which the blocks can be turned, with the frames that ParaView would "
                    "get (output.view)");
  add_overwrite(command, arguments.overwrite);
  command->add_flag("--quiet", arguments.quiet, "no progress and no summary");
  command->callback([&] { action = [&] { return run_command(arguments); }; });
}

void add_resume(CLI::App& program, ResumeArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand("resume", "continue with a run that was interrupted");
  command->add_option("folder", arguments.folder, "the folder of its results")
      ->required()
      ->check(plain_text())
      ->type_name("FOLDER");
  command->add_option("--threads", arguments.threads, "number of threads (default: as before)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--quiet", arguments.quiet, "no progress and no summary");
  command->callback([&] { action = [&] { return resume_command(arguments); }; });
}

void add_view(CLI::App& program, ViewArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand(
      "view", "write the page in which the blocks of a run can be turned; the run was asked for --view");
  command->add_option("folder", arguments.folder, "the folder of its results")->check(plain_text());
  add_out(command, arguments.out, "the page (default: view.html in the folder)");
  CLI::Option* fragment = command->add_flag(
      "--fragment", arguments.fragment,
      "instead of a page the piece of one, for a page that holds many of them and what --script writes once");
  command->add_flag("--script", arguments.script, "what a page with fragments holds once; takes no folder")
      ->excludes(fragment);
  command
      ->add_option("--poster", arguments.poster,
                   "PNG or WebP that a fragment shows until it is clicked (viewer/poster.mjs makes it)")
      ->needs(fragment)
      ->check(plain_text());
  command
      ->add_option(
          "--look", arguments.look,
          "what a fragment shows at first, as behind # in a page's address: frame=3&magnified=100&forces=arrows")
      ->needs(fragment);
  command->add_flag("--overwrite", arguments.overwrite, "replace the file");
  command->callback([&] { action = [&] { return view_command(arguments); }; });
}

void add_check(CLI::App& program, SceneArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand("check", "say what a scene activates and what looks wrong");
  add_scene(command, arguments);
  command->callback([&] { action = [&] { return check_command(arguments); }; });
}

void add_slice(CLI::App& program, SliceArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand("slice", "cut the blocks and write them, without running");
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of blocks.vtp and blocks.csv", true);
  command->add_flag("--report", arguments.report,
                    "joint sets against what was stated, listed joints by their set: report.md, joints.csv, stereonet, "
                    "spacings, block "
                    "sizes");
  command->add_flag("--view", arguments.view, "view.html, one page in which the blocks can be turned");
  command->add_flag("--planes", arguments.planes,
                    "the planes of the blocks: block_planes.csv, readable as blocks_file");
  command->add_flag("--stl", arguments.stl, "the blocks as blocks.stl (ASCII; 3-D)");
  command->add_flag("--obj", arguments.obj, "the blocks as blocks.obj (3-D), readable as blocks_file");
  add_overwrite(command, arguments.overwrite);
  command->callback([&] { action = [&] { return slice_command(arguments); }; });
}

void add_limit(CLI::App& program, LimitArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand("limit",
                                             "critical friction angle, factor of safety or collapse load of blocks in "
                                             "the plane by rigid-block limit analysis");
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of the results (default: results/<scene>_limit)");
  CLI::Option* load =
      command
          ->add_option(
              "--load", arguments.load,
              "seek the factor of this load at the scene's friction: gravity; or, beside gravity, an acceleration to "
              "the left or right, or the applied forces of the first stage that states any, factors of time taken as "
              "1 (default: seek the critical friction under gravity)")
          ->check(CLI::IsMember({"gravity", "left", "right", "applied"}));
  command
      ->add_option(
          "--friction", arguments.properties,
          "name of joint_properties whose critical friction is sought, the others keep theirs; may be repeated "
          "(default: all)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->check(plain_text())
      ->excludes(load);
  CLI::Option* factor = command
                            ->add_flag("--factor", arguments.factor,
                                       "seek the factor of safety: what tan φ and cohesion are divided by until the "
                                       "blocks collapse under gravity")
                            ->excludes(load)
                            ->excludes("--friction");
  command
      ->add_option("--joint", arguments.joints,
                   "name of joint_properties whose strength --factor divides; may be repeated (default: all)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->check(plain_text())
      ->needs(factor);
  command->add_flag("--cohesion", arguments.cohesion,
                    "count the cohesion that joint_properties state, as of bonds that are whole; tension is left out");
  add_overwrite(command, arguments.overwrite);
  command->add_flag("--quiet", arguments.quiet, "no warnings and no summary");
  command->callback([&] { action = [&] { return limit_command(arguments); }; });
}

void add_joint_test(CLI::App& program, JointTestArguments& arguments, Action& action) {
  CLI::App* command =
      program.add_subcommand("joint-test", "take the joint laws of a scene along laboratory paths, without any block");
  add_scene(command, arguments.scene);
  add_out(command, arguments.out, "folder of the results (default: results/<scene>_joint_test)");
  command->add_option("--joint", arguments.properties, "name of joint_properties; may be repeated (default: all)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->check(plain_text());
  command
      ->add_option("--path", arguments.path,
                   "normal: compression and back; shear: at constant normal stress; stiffness: in surroundings of "
                   "constant normal stiffness; cyclic: to slip, -slip and back (default: shear)")
      ->check(CLI::IsMember({"normal", "shear", "stiffness", "cyclic"}));
  command
      ->add_option("--stress", arguments.stresses,
                   "normal stress in Pa; may be repeated (default: 0.1, 0.5, 1, 2, 5 MPa)")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->check(finite(least_positive, largest_argument));
  command->add_option("--slip", arguments.slip, "in m (default: 1e-3)")
      ->check(finite(least_positive, largest_argument));
  command->add_option("--surroundings", arguments.surroundings, "of path stiffness, in Pa/m (default: 1e9)")
      ->check(finite(least_positive, largest_argument));
  command->add_option("--dilation", arguments.dilation, "of path stiffness: rise over slip (default: 0.05)")
      ->check(finite(0, 1));
  command->add_option("--cycles", arguments.cycles, "of path cyclic (default: 2)")->check(CLI::Range(1, 1000));
  command->add_option("--steps", arguments.steps, "points along each leg of a path (default: 200)")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--bonded", arguments.bonded, "tension and cohesion are intact when shear begins");
  add_overwrite(command, arguments.overwrite);
  command->callback([&] { action = [&] { return joint_test_command(arguments); }; });
}

void add_import(CLI::App& program, ImportArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand(
      "import", "joints of a scan, a drawing or a fracture network as a table that scenes read (joints_file)");
  command->add_option("file", arguments.file, "the file")->required()->check(plain_text())->type_name("FILE");
  command
      ->add_option(
          "--as", arguments.format,
          "facets: CloudCompare's table of facets (CSV); fab: FracMan's fractures (ASCII); dxf: 3DFACE, POLYLINE "
          "and LWPOLYLINE of an ASCII DXF, its layers are sets; traces: GeoJSON lines in a plane")
      ->required()
      ->check(CLI::IsMember({"facets", "fab", "dxf", "traces"}));
  command->add_option("--out", arguments.out, "the table, e.g. joints.csv beside the scene")
      ->required()
      ->check(plain_text())
      ->type_name("FILE");
  command
      ->add_option("--shift", arguments.shift,
                   "x,y,z in m, added to every coordinate, e.g. --shift=-458000,-5210000,-900 (traces leave out z)")
      ->delimiter(',')
      ->expected(3)
      ->allow_extra_args(false)
      ->check(finite(-largest_argument, largest_argument));
  command->add_flag("--overwrite", arguments.overwrite, "replace the table; the file that is read is never replaced");
  command->callback([&] { action = [&] { return import_command(arguments); }; });
}

void add_export(CLI::App& program, ExportArguments& arguments, Action& action) {
  CLI::App* command = program.add_subcommand(
      "export", "blocks, joints and properties of a scene in space as text for another program, which is not run here");
  add_scene(command, arguments.scene);
  command
      ->add_option("--as", arguments.format,
                   "3dec: a data file of 3DEC 7, polyhedra by their faces; yade: a script for YADE with PotentialBlock")
      ->required()
      ->check(CLI::IsMember({"3dec", "yade"}));
  command->add_option("--out", arguments.out, "the file, e.g. scene.dat or scene.py")->required()->check(plain_text());
  add_overwrite(command, arguments.overwrite);
  command->callback([&] { action = [&] { return export_command(arguments); }; });
}

struct DocsArguments {
  bool manual = false, completion = false;
};

void add_docs(CLI::App& program, DocsArguments& arguments, Action& action) {
  CLI::App* command =
      program.add_subcommand("docs", "every key of scenes and studies and every column of history.csv, as Markdown");
  CLI::Option* manual =
      command->add_flag("--man", arguments.manual, "instead, the page that man voussoir shows (troff)");
  command
      ->add_flag("--completion", arguments.completion, "instead, what bash sources to complete the program's arguments")
      ->excludes(manual);
  command->callback([&] {
    if (arguments.manual || arguments.completion)
      action = [&] {
        fmt::print("{}", arguments.manual ? manual_page(program) : bash_completion(program));
        return ExitCode::done;
      };
    else
      action = docs_command;
  });
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

// every failure is one line that says what to do, and a code that a script can ask for
int guarded(const Action& action) {
  try {
    const ExitCode code = action();
    // what is still in the buffer counts as well: a pipe or a file may refuse it
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw output_error("standard output", errno);
    return static_cast<int>(code);
  } catch (const SceneError& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const BadInput& error) {
    tell("voussoir: {}\n", error.what());
    return static_cast<int>(ExitCode::bad_input);
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
    // fmt's word for a stream that takes no more
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
  RunArguments run;
  ResumeArguments resume;
  ViewArguments view;
  SceneArguments check;
  SliceArguments slice;
  LimitArguments limit;
  JointTestArguments joint_test;
  ImportArguments imported;
  ExportArguments to_export;
  AllStudyArguments study;
  DocsArguments docs;
  add_run(program, run, action);
  add_resume(program, resume, action);
  add_view(program, view, action);
  add_check(program, check, action);
  add_slice(program, slice, action);
  add_limit(program, limit, action);
  add_joint_test(program, joint_test, action);
  add_import(program, imported, action);
  add_export(program, to_export, action);
  add_study(program, study, action);
  add_docs(program, docs, action);

  try {
    program.parse(argument_count, arguments);
  } catch (const CLI::ParseError& error) {
    // help and version are no errors; anything else is bad input, whatever number the parser has for it
    if (error.get_exit_code() != 0) {
      tell("voussoir: {}; 'voussoir --help' and 'voussoir <command> --help' list what there is\n", error.what());
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
