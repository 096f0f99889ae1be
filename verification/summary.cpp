// voussoir_summary: gathers the rows of all cases into the verdict table and fails when anything is not as it should
// be.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "verification/history.hpp"

namespace {

namespace fs = std::filesystem;
using namespace voussoir::verification;

std::string commit_in(const fs::path& file) {
  if (file.empty() || !fs::exists(file)) return "unknown";
  std::string commit = read_text(file);
  while (!commit.empty() && std::isspace(static_cast<unsigned char>(commit.back())))
    commit.pop_back();
  return commit.empty() ? "unknown" : commit;
}

// The values that have moved since the newest version of the history, and the drawing's data.
void compare(Verdicts& verdicts, const fs::path& folder, const fs::path& changelog, const fs::path& out,
             const std::string& math_functions) {
  const std::vector<PastVersion> history = read_history(folder);
  write_atomically(out / "history.csv", history_csv(history, verdicts));
  if (history.empty()) return;
  verdicts.compared_with = history.back().version;
  verdicts.moved = moved_since(history.back(), verdicts);
  const auto idle = mark_announced(verdicts.moved, fs::exists(changelog) ? read_text(changelog) : "");
  if (math_functions != history.back().math_functions && !verdicts.moved.empty()) {
    fmt::print(
        "note: the C library computes other functions here (hash {}) than those of {} (hash {}): values that moved are "
        "reported, not judged\n",
        math_functions, verdicts.compared_with, history.back().math_functions);
    for (Moved& moved : verdicts.moved)
      moved.announced = true;
  }
  for (const Moved& moved : verdicts.moved)
    fmt::print("MOVED {}{}\n", describe(moved, verdicts.compared_with), moved.announced ? " (announced)" : "");
  if (!all_announced(verdicts))
    fmt::print("Announce intended moves in the first section of CHANGELOG.md: - Moved: `case`: `quantity`, since …\n");
  for (const std::string& line : idle)
    fmt::print("note: CHANGELOG.md announces a move that did not happen since {}: {}\n", verdicts.compared_with, line);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Gathers the verdict rows of all cases into one table."};
  std::vector<std::string> cases, not_modelled;
  fs::path rows, out, commit_file, version_file, history, changelog, keep;
  app.add_option("--cases", cases, "the cases that must have run")->delimiter(',')->required();
  app.add_option("--not-modelled", not_modelled, "cases that are listed but not modelled yet")->delimiter(',');
  app.add_option("--rows", rows, "folder with <case>.json")->required();
  app.add_option("--out", out, "folder for verdicts.md, verdicts.csv and verdicts.json")->required();
  app.add_option("--commit-file", commit_file, "file that holds the commit's name");
  app.add_option("--history", history, "folder of earlier versions' rows, to compare with");
  app.add_option("--changelog", changelog, "file that announces which values are meant to move");
  app.add_option("--version-file", version_file, "file with the output of `voussoir --version`");
  app.add_option("--keep", keep, "write the rows as a version of the history into this file, when all is good");
  CLI11_PARSE(app, argc, argv);

  try {
    Verdicts verdicts = collect(rows, cases, not_modelled, commit_in(commit_file));
    const std::string math_functions = math_functions_in(fs::exists(version_file) ? read_text(version_file) : "");
    if (!history.empty()) compare(verdicts, history, changelog, out, math_functions);
    write_atomically(out / "verdicts.md", verdict_markdown(verdicts));
    write_atomically(out / "verdicts.csv", verdict_csv(verdicts));
    write_atomically(out / "verdicts.json", verdict_json(verdicts).dump(1) + "\n");
    write_atomically(out / "verdicts.txt", one_line(verdicts) + "\n");

    // list all failures before the last line counts them
    for (const Row& row : verdicts.rows)
      if (!passed(row))
        fmt::print("FAILED {}: {} = {} {}, expected {} within {}\n", row.case_name, row.check.quantity,
                   show(row.computed), row.check.unit, show_expected(row.check),
                   show(width(row.check.expected, row.check.tolerance)));
    for (const Failure& failure : verdicts.failures)
      fmt::print("FAILED {}: {}\n", failure.case_name, failure.message);
    for (const CaseStatus& status : verdicts.cases)
      if (status.state == CaseState::not_run) fmt::print("NOT RUN {}\n", status.name);
    fmt::print("{}: {}\n", one_line(verdicts), (out / "verdicts.md").string());
    if (!keep.empty()) write_atomically(keep, history_lines(verdicts, math_functions));
    return all_good(verdicts) && all_announced(verdicts) ? 0 : 1;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_summary: {}\n", problem.what());
    return 2;
  }
}
