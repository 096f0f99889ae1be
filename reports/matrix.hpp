#pragma once
// Equations, thesis cases and promises by the tests and checks that verify them: made from the lists, from the
// equations that the sources name, and from the sources of the checks.
#include <filesystem>
#include <string>
#include <vector>

#include "reports/equation_names.hpp"
#include "reports/matrix_lists.hpp"
#include "verification/verdicts.hpp"

namespace voussoir::reports {

// at most so many equations may have no test that names them
constexpr int most_not_verified = 15;

struct Matrix {
  std::vector<Equation> equations;
  std::vector<ThesisCase> thesis_cases;
  std::vector<Promise> promises;
  std::vector<Ground> grounds;
  SourceNames names;
  std::string readme;  // README.md and docs/*.md, every run of blanks and line ends one blank
};

// The lists of reports/ and the sources of a repository. Throws std::runtime_error for a list that cannot be read.
Matrix read_matrix(const std::filesystem::path& repository);

// The places of an equation, each file or test once, in order.
struct EquationPlaces {
  std::vector<std::string> code;        // files of the method, the program or a case
  std::vector<std::string> references;  // files of closed forms
  std::vector<std::string> tests;       // Suite.Name
  std::vector<std::string> cases;       // cases whose checks name it in their source, as their code states it
};
EquationPlaces equation_places(const Matrix& matrix, const Equation& equation);

enum class Verified { yes, not_verified, left_out };
Verified verified(const Equation& equation);

// The number of checks of each case that rest on an equation or on a ground, as their sources name them.
struct CaseChecks {
  std::string case_name;
  int checks = 0;
};
std::vector<CaseChecks> checks_on_equation(const verification::Verdicts& verdicts, const std::string& number);
std::vector<CaseChecks> checks_on_ground(const verification::Verdicts& verdicts, const std::string& name);

// Problems, a line each, with file and repair; empty when there are none. Of the sources and the lists: a name without
// equation, an equation without code or test, a test that does not exist, too many equations that are not verified.
std::vector<std::string> problems(const Matrix& matrix);
// Of the checks: a source that names neither an equation, nor a ground, nor a reference, or an equation that does not
// exist.
std::vector<std::string> problems(const Matrix& matrix, const verification::Verdicts& verdicts);

}  // namespace voussoir::reports
