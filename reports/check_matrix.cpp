// voussoir_matrix: whether equations, thesis cases, promises and the sources of the checks fit together; lists those
// that do not.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>

#include "reports/matrix.hpp"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  using namespace voussoir;
  CLI::App app{"Judges the matrix of equations, thesis cases and promises by tests and checks."};
  fs::path source, verdict_file;
  app.add_option("--source", source, "the repository")->required();
  app.add_option("--verdicts", verdict_file, "verdicts.json of the summary, for the sources of the checks")->required();
  CLI11_PARSE(app, argc, argv);

  try {
    const reports::Matrix matrix = reports::read_matrix(source);
    const auto verdicts =
        verification::verdicts_from_json(nlohmann::json::parse(verification::read_text(verdict_file)));
    std::vector<std::string> found = reports::problems(matrix);
    for (const std::string& problem : reports::problems(matrix, verdicts))
      found.push_back(problem);
    for (const std::string& problem : found)
      fmt::print("{}\n", problem);
    int open = 0, left_out = 0, checks = 0;
    for (const reports::Equation& equation : matrix.equations) {
      open += verified(equation) == reports::Verified::not_verified;
      left_out += verified(equation) == reports::Verified::left_out;
    }
    for (const verification::Row& row : verdicts.rows)
      checks += row.check.kind != verification::Kind::reported;
    fmt::print("{} equations, {} left out, {} not verified; {} thesis cases, {} promises, sources of {} checks: {}\n",
               matrix.equations.size(), left_out, open, matrix.thesis_cases.size(), matrix.promises.size(), checks,
               found.empty() ? "all fit" : fmt::format("{} problems", found.size()));
    return found.empty() ? 0 : 1;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "voussoir_matrix: {}\n", problem.what());
    return 2;
  }
}
