#include "app/study/study_command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/base/arguments.hpp"
#include "app/base/message.hpp"
#include "app/run_folder/child_process.hpp"
#include "app/study/folder.hpp"
#include "app/study/gather.hpp"
#include "app/study/idle.hpp"
#include "app/study/work.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::filesystem::path plan;
  std::filesystem::path out;
  bool overwrite = false;
  WorkOptions options = {};
};

struct AllStudyArguments {
  StudyArguments study;
  WorkArguments work;
  std::vector<fs::path> folders;
};

// a study whose folder is locked by this process
struct PlannedStudy {
  ClaimedFolder claim;
  StudyFolder study;
};

PlannedStudy plan_study(const fs::path& file, const fs::path& out, bool overwrite) {
  const StudyPlan plan = read_study_plan(file);
  const std::string program = program_digest();
  const std::vector<PlannedRow> rows = rows_of_plan(plan, program);
  const std::vector<std::string> idle = idle_keys(plan);
  const std::vector<InputFile> input = input_files(file, rows);
  std::vector<fs::path> inputs;
  for (const InputFile& f : input)
    inputs.push_back(f.from);
  ClaimedFolder claim(out, study_outputs(plan, input, rows), inputs, overwrite);
  write_study_folder(out, plan, input, rows, program);
  tell_warnings(idle);
  return {std::move(claim), read_study_folder(out)};
}

// The first part: the planned runs, with their input, into a folder. Then come work.hpp and gather.hpp.
ExitCode study_plan_command(const StudyArguments& arguments) {
  const PlannedStudy planned = plan_study(arguments.plan, arguments.out, arguments.overwrite);
  const std::size_t rows = planned.study.rows.size();
  fmt::print("{0} rows planned: {1}/manifest.jsonl; run them with 'voussoir study run {1}'\n", rows,
             arguments.out.string());
  return ExitCode::done;
}

ExitCode study_command(const StudyArguments& arguments) {
  const PlannedStudy planned = plan_study(arguments.plan, arguments.out, arguments.overwrite);
  const RunsEnded ended = work_at(planned.study, planned.study.rows, arguments.options, arguments.plan.string());
  if (ended.interrupted) return tell_interruption(arguments.out);
  return write_gathered(planned.study, gather(planned.study, {arguments.out}),
                        fmt::format("{} different runs, {} of them kept from before\n", ended.runs, ended.kept),
                        arguments.options);
}

void add_work(CLI::App* command, WorkOptions& work) {
  command->add_option("--jobs", work.jobs, "runs at the same time (default: as many as there are cores)")
      ->check(CLI::Range(1, 1024));
  command
      ->add_option("--time-limit", work.time_limit,
                   "seconds of wall clock after which a run counts as failed (default: none)")
      ->check(finite(least_positive, largest_argument));
  add_threads(command, work.threads);
  command->add_flag(
      "--portable-math", work.portable_math,
      "run with the functions of the C library that every x86-64 processor has, for the same bits on all");
  command->add_flag("--quiet", work.quiet, "no progress");
}

void add_plan(CLI::App* command, StudyArguments& arguments) {
  // of `voussoir study` itself, whose parts have other options
  const auto optional = [](CLI::Option* option) { return option->check(plain_text()); };
  optional(command->add_option("plan", arguments.plan, "study.toml"))->type_name("FILE");
  optional(
      command->add_option("--out", arguments.out, "folder of study.csv; completed runs of this study in it are kept"))
      ->type_name("FOLDER");
  command->add_flag("--overwrite", arguments.overwrite, "replace the results of other commands in the folder");
}

void require_plan(const StudyArguments& arguments) {
  if (arguments.plan.empty()) throw CLI::RequiredError("plan");
  if (arguments.out.empty()) throw CLI::RequiredError("--out");
}

void add_study_parts(CLI::App* study, AllStudyArguments& all, Action& action) {
  CLI::App* plan = study->add_subcommand("plan", "write the list of runs and copy their input, without running");
  add_plan(plan, all.study);
  plan->callback([&] {
    require_plan(all.study);
    action = [&] { return study_plan_command(all.study); };
  });

  WorkArguments& work = all.work;
  CLI::App* run = study->add_subcommand(
      "run", "execute the missing runs of a planned study, alone or together with other processes");
  run->add_option("folder", work.folder, "folder of the study")->required()->check(plain_text())->type_name("FOLDER");
  run->add_option("--rows", work.rows, "only these rows, e.g. 120-139,7 (default: all)")->check(plain_text());
  run->add_option("--chunk", work.chunk, "k/n: the k-th of n shares of them, of about equal cost")->check(plain_text());
  add_work(run, work.options);
  run->add_flag("--any-program", work.any_program, "accept a study that another program has planned");
  run->callback([&] { action = [&] { return study_run_command(all.work); }; });

  CLI::App* gather = study->add_subcommand("gather", "write study.csv, and list rows that are missing or differ");
  gather->add_option("folders", all.folders, "folder of the study, and of copies that other processes worked at")
      ->required()
      ->check(plain_text())
      ->type_name("FOLDER");
  gather->callback([&] { action = [&] { return study_gather_command(all.folders); }; });

  CLI::App* status = study->add_subcommand("status", "list rows that are done, running, failed and missing");
  status->add_option("folder", work.folder, "folder of the study")
      ->required()
      ->check(plain_text())
      ->type_name("FOLDER");
  status->callback([&] { action = [&] { return study_status_command(all.work.folder); }; });
}

}  // namespace

void add_study(CLI::App& program, Action& action) {
  const auto owned = std::make_shared<AllStudyArguments>();
  AllStudyArguments& all = *owned;
  CLI::App* command = program.add_subcommand(
      "study", "run a scene with settings changed: one at a time, in every combination, or at random");
  StudyArguments& arguments = all.study;
  add_plan(command, arguments);
  add_work(command, arguments.options);
  add_study_parts(command, all, action);
  command->require_subcommand(0, 1);
  command->callback([owned, &action, command] {
    if (!command->get_subcommands().empty()) {
      for (const CLI::Option* option : command->get_options())
        if (option->count() > 0) throw CLI::ExtrasError({option->get_name() + " (state it after the part's name)"});
      return;
    }
    require_plan(owned->study);
    action = [owned] { return study_command(owned->study); };
  });
}

}  // namespace voussoir
