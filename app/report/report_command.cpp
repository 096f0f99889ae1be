#include "app/report/report_command.hpp"

#include <fmt/format.h>

#include "app/base/arguments.hpp"
#include "app/report/joints_data.hpp"
#include "app/report/report_data.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "app/run_folder/run_folder.hpp"
#include "app/view/page.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/view.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  fs::path folder;
  fs::path out;  // empty: report.html in the folder
  TitleBlock block;
  bool overwrite = false;
};

ExitCode report_command(const ReportArguments& arguments) {
  const std::string data = report_data(arguments.folder, arguments.block);
  const fs::path target = arguments.out.empty() ? arguments.folder / report_file : arguments.out;
  const fs::path blocks = arguments.folder / view_file;
  std::error_code error;
  const bool shown = fs::exists(blocks, error);
  const bool ours = arguments.out.empty() && made_here(arguments.folder, report_file);
  std::vector<fs::path> inputs;
  for (const char* name : {"results.json", "scene.toml", "history.csv", "search.csv", "lining.csv", view_file,
                           "study.json", "study.csv", "kinematics.json", "kinematic_pairs.csv", joints_data_file})
    inputs.push_back(arguments.folder / name);
  claim_file(target, "report", inputs, arguments.overwrite || ours);
  write_file(target, report_page(data, shown ? blocks : fs::path{}));
  fmt::print("{}\n", target.string());
  if (!shown && holds_results(arguments.folder))
    fmt::print("the run kept no blocks to turn: run the scene again with --view, and the report shows them\n");
  return ExitCode::done;
}

}  // namespace

void add_report(CLI::App& program, Action& action) {
  const auto [command, arguments] =
      add_command(program, action, "report", "write report.html, one page of a run, a study or joints for a dossier",
                  report_command);
  command->add_option("folder", arguments.folder, "folder of the run, study, kinematic analysis or slice")
      ->required()
      ->check(plain_text());
  add_out(command, arguments.out, "the page (default: report.html in the folder)");
  TitleBlock& block = arguments.block;
  command->add_option("--project", block.project, "of the title block");
  command->add_option("--section", block.section, "of the title block: station or part");
  command->add_option("--author", block.author, "of the title block");
  command->add_option("--checked-by", block.checked_by, "of the title block");
  command->add_option("--date", block.date, "of the title block; the page states none by itself");
  add_overwrite(command, arguments.overwrite);
}

}  // namespace voussoir
