#include "app/study/study_command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/base/message.hpp"
#include "app/run_folder/child_process.hpp"
#include "app/study/folder.hpp"
#include "app/study/gather.hpp"
#include "app/study/idle.hpp"
#include "app/study/work.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// a study whose folder is held by this process alone
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
  for (const std::string& line : idle)
    tell("voussoir: warning: {}\n", line);
  return {std::move(claim), read_study_folder(out)};
}

}  // namespace

ExitCode study_plan_command(const StudyArguments& arguments) {
  const PlannedStudy planned = plan_study(arguments.plan, arguments.out, arguments.overwrite);
  const std::size_t rows = planned.study.rows.size();
  fmt::print("{0} rows planned: {1}/manifest.jsonl; do them with 'voussoir study run {1}'\n", rows,
             arguments.out.string());
  return ExitCode::done;
}

ExitCode study_command(const StudyArguments& arguments) {
  const PlannedStudy planned = plan_study(arguments.plan, arguments.out, arguments.overwrite);
  const RunsEnded ended = work_at(planned.study, planned.study.rows, arguments.options, arguments.plan.string());
  if (ended.interrupted) return tell_interruption(arguments.out);
  return write_gathered(planned.study, gather(planned.study, {arguments.out}),
                        fmt::format("{} different runs, {} of them kept from before\n", ended.runs, ended.kept));
}

}  // namespace voussoir
