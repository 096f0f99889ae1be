#include "app/judge/judge_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/base/arguments.hpp"
#include "app/base/message.hpp"
#include "app/judge/judgement.hpp"
#include "app/judge/judgement_text.hpp"
#include "app/run_folder/claimed_folder.hpp"
#include "core/base/bad_input.hpp"
#include "core/output/atomic_file.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

constexpr const char *answer_name = "answer.csv", *reference_name = "reference.json";
const Outputs judge_outputs{"judge", {"judgement.md", "judgement.html", "judgement.csv", "error_against_cost.svg"}};

struct JudgeArguments {
  std::vector<fs::path> folders;
  fs::path out, references;
  bool overwrite = false;
};

// the answers in a folder and below it, in the order of their paths
std::vector<fs::path> answers_below(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw BadInput(fmt::format("{}: is no folder of answers", folder.string()));
  std::vector<fs::path> found;
  for (auto at = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied);
       at != fs::recursive_directory_iterator(); ++at)
    if (at->path().filename() == answer_name && at->is_regular_file(error)) found.push_back(at->path());
  if (found.empty())
    throw BadInput(fmt::format("{}: contains no {}; name a problem's folder, or one of such folders", folder.string(),
                               answer_name));
  std::ranges::sort(found);
  return found;
}

// beside the answer, or of the folder of problems the one that is named as the answer's folder
fs::path reference_of(const fs::path& answer, const fs::path& references) {
  const fs::path beside = answer.parent_path() / reference_name;
  if (references.empty()) return beside;
  const fs::path folder = fs::weakly_canonical(answer).parent_path().filename();
  return references / folder / reference_name;
}

// one answer; what is wrong with its file is a fault of the judgement
void judge_file(const fs::path& file, const JudgeArguments& arguments, std::vector<fs::path>& inputs,
                Judgement& judgement) {
  try {
    const AnswerFile answer = read_answer(file);
    inputs.push_back(file);
    if (answer.empty) {
      judgement.notes.push_back(file.string() + ": not filled in, left out");
      return;
    }
    const fs::path reference = reference_of(file, arguments.references);
    std::error_code error;
    if (!fs::exists(reference, error))
      throw BadInput(fmt::format("{}: no {}; name the folder of the problems with --references", file.string(),
                                 reference.string()));
    inputs.push_back(reference);
    judge_answer(answer, read_reference(reference), judgement);
  } catch (const BadInput& fault) {
    judgement.faults.emplace_back(fault.what());
  }
}

void write_judgement(const Judgement& judgement, const fs::path& out) {
  const std::string figure = error_against_cost(judgement);
  write_file(out / "judgement.md", judgement_markdown(judgement));
  write_file(out / "judgement.html", judgement_html(judgement, figure));
  write_file(out / "judgement.csv", judgement_csv(judgement));
  if (figure.empty())
    remove_file(out / "error_against_cost.svg");
  else
    write_file(out / "error_against_cost.svg", figure);
}

void print_judgement(const Judgement& judgement) {
  for (const JudgedRow& row : judgement.rows) {
    if (row.verdict == JudgedAs::not_asked) continue;
    fmt::print("{:<13}{:<18}{:<17}{}", name_of(row.verdict), row.code, row.problem, row.quantity);
    if (row.error)
      fmt::print(": {:.7g} {}, error {:.2g}, tolerance {:.2g}", *row.value, row.unit, *row.error, *row.tolerance);
    fmt::print("\n");
  }
}

ExitCode judge_command(const JudgeArguments& arguments) {
  Judgement judgement;
  std::vector<fs::path> inputs;
  for (const fs::path& folder : arguments.folders)
    for (const fs::path& file : answers_below(folder))
      judge_file(file, arguments, inputs, judgement);
  complete(judgement);
  const ClaimedFolder claimed(arguments.out, judge_outputs, inputs, arguments.overwrite);
  write_judgement(judgement, arguments.out);
  print_judgement(judgement);
  for (const std::string& note : judgement.notes)
    fmt::print("{}\n", note);
  for (const std::string& fault : judgement.faults)
    tell("voussoir: {}", fault);
  fmt::print("{}: {}\n", judgement_counts(judgement), (arguments.out / "judgement.md").string());
  if (!judgement.faults.empty()) return ExitCode::bad_input;
  const bool all = std::ranges::none_of(judgement.rows, [](const JudgedRow& row) {
    return row.verdict == JudgedAs::failed || row.verdict == JudgedAs::not_run;
  });
  return all && !judgement.rows.empty() ? ExitCode::done : ExitCode::incomplete;
}

}  // namespace

void add_judge(CLI::App& program, Action& action) {
  const auto [command, arguments] = add_command(
      program, action, "judge",
      "judge the answers of any code to the problem files: verdict, error and tolerance, one table over codes",
      judge_command);
  command
      ->add_option("folders", arguments.folders,
                   "folders with answer.csv, of one problem or of many in their subfolders, of one code or several")
      ->required()
      ->type_name("FOLDER");
  add_out(command, arguments.out, "folder of judgement.md, .html, .csv and error_against_cost.svg", true);
  command
      ->add_option("--references", arguments.references,
                   "folder of the problems, for answers without reference.json beside them: an answer's folder has its "
                   "problem's name")
      ->type_name("FOLDER");
  add_overwrite(command, arguments.overwrite);
}

}  // namespace voussoir
