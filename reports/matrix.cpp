#include "reports/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>

namespace voussoir::reports {
namespace {

namespace fs = std::filesystem;
using namespace verification;

void add_once(std::vector<std::string>& list, const std::string& item) {
  if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char character : text) {
    const bool blank = std::isspace(static_cast<unsigned char>(character));
    if (!blank) line += character;
    if (blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  return line;
}

const Equation* find_equation(const Matrix& matrix, const std::string& number) {
  const auto at = std::find_if(matrix.equations.begin(), matrix.equations.end(),
                               [&](const Equation& equation) { return equation.number == number; });
  return at == matrix.equations.end() ? nullptr : &*at;
}

std::vector<CaseChecks> count_checks(const Verdicts& verdicts,
                                     const std::function<bool(const std::string&)>& rests_on) {
  std::vector<CaseChecks> counts;
  for (const Row& row : verdicts.rows) {
    if (row.check.kind == Kind::reported || !rests_on(row.check.source)) continue;
    if (counts.empty() || counts.back().case_name != row.case_name) counts.push_back({row.case_name, 0});
    ++counts.back().checks;
  }
  return counts;
}

bool names(const std::string& source, const std::string& ground) {
  return source.find(ground) != std::string::npos;
}

// "reference/arch" if reference.arch is a test
bool names_a_reference(const Matrix& matrix, const std::string& source) {
  static const std::string room = "reference/";
  for (std::size_t at = source.find(room); at != std::string::npos; at = source.find(room, at + 1)) {
    std::string name;
    for (std::size_t k = at + room.size(); k < source.size(); ++k) {
      if (!std::isalnum(static_cast<unsigned char>(source[k])) && source[k] != '_') break;
      name += source[k];
    }
    if (matrix.names.programs.contains("reference." + name)) return true;
  }
  return false;
}

void judge(const Matrix& matrix, const Equation& equation, std::vector<std::string>& found) {
  const EquationPlaces at = equation_places(matrix, equation);
  const bool tested = !at.tests.empty() || !at.cases.empty();
  const auto say = [&](const std::string& what) {
    found.push_back(fmt::format("equations.toml: Eq. {} {}", equation.number, what));
  };
  if (equation.is_open()) {
    if (tested)
      say(fmt::format("is listed as not verified or left out, but {} names it; remove the reason, or the name",
                      at.tests.empty() ? "case " + at.cases.front() : at.tests.front()));
    return;
  }
  if (at.code.empty() && at.references.empty())
    say("is named by no code; name it at its place, or state in left_out why it has none");
  if (!tested)
    say("is named by no test; name it in the test that verifies it, or state in not_verified why there is none");
}

void judge_tests(const Matrix& matrix, const std::string& who, const std::vector<std::string>& tests,
                 std::vector<std::string>& found) {
  for (const std::string& test : tests)
    if (!matrix.names.tests.contains(test))
      found.push_back(fmt::format("{}: there is no test {}; correct its name", who, test));
}

void judge_programs(const Matrix& matrix, const std::string& who, const std::vector<std::string>& programs,
                    std::vector<std::string>& found) {
  for (const std::string& program : programs)
    if (!matrix.names.programs.contains(program))
      found.push_back(fmt::format("{}: CTest knows no {}; correct its name", who, program));
}

// README.md and the pages of docs, by name
std::string pages_in_one_line(const fs::path& repository) {
  std::vector<fs::path> pages;
  if (fs::is_directory(repository / "docs"))
    for (const auto& entry : fs::directory_iterator(repository / "docs"))
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  std::string text = read_text(repository / "README.md");
  for (const fs::path& page : pages)
    text += "\n" + read_text(page);
  return in_one_line(text);
}

}  // namespace

Matrix read_matrix(const fs::path& repository) {
  const fs::path reports = repository / "reports";
  return {read_equations(reports / "equations.toml", reports / "equations.mathml"),
          read_thesis_cases(reports / "thesis_cases.toml"),
          read_promises(reports / "promises.toml"),
          read_grounds(reports / "grounds.toml"),
          read_source_names(repository),
          pages_in_one_line(repository)};
}

EquationPlaces equation_places(const Matrix& matrix, const Equation& equation) {
  EquationPlaces at;
  for (const Naming& naming : matrix.names.namings) {
    if (naming.number != equation.number) continue;
    switch (naming.place) {
      case Place::code:
        add_once(at.code, naming.file);
        break;
      case Place::reference:
        add_once(at.references, naming.file);
        break;
      case Place::test:
        add_once(at.tests, naming.test);
        break;
      case Place::source: {
        const fs::path path(naming.file);
        add_once(at.cases, path.parent_path().filename().string());
        break;
      }
      case Place::helper:
      case Place::page:
        break;
    }
  }
  return at;
}

Verified verified(const Equation& equation) {
  if (!equation.left_out.empty()) return Verified::left_out;
  return equation.not_verified.empty() ? Verified::yes : Verified::not_verified;
}

std::vector<CaseChecks> checks_on_equation(const Verdicts& verdicts, const std::string& number) {
  return count_checks(verdicts, [&](const std::string& source) {
    const std::vector<std::string> named = equations_named(source);
    return std::find(named.begin(), named.end(), number) != named.end();
  });
}

std::vector<CaseChecks> checks_on_ground(const Verdicts& verdicts, const std::string& name) {
  return count_checks(verdicts, [&](const std::string& source) { return names(source, name); });
}

std::vector<std::string> problems(const Matrix& matrix) {
  std::vector<std::string> found = matrix.names.wrong;
  for (const Naming& naming : matrix.names.namings)
    if (!find_equation(matrix, naming.number))
      found.push_back(
          fmt::format("{}:{}: the thesis has no Eq. {}; correct the number", naming.file, naming.line, naming.number));
  int open = 0;
  for (const Equation& equation : matrix.equations) {
    judge(matrix, equation, found);
    open += !equation.not_verified.empty();
  }
  if (open > most_not_verified)
    found.push_back(fmt::format("equations.toml: {} equations are not verified, {} may be; write tests that name them",
                                open, most_not_verified));
  for (const ThesisCase& entry : matrix.thesis_cases) {
    const std::string who = fmt::format("thesis_cases.toml: {}", entry.thesis);
    judge_tests(matrix, who, entry.tests, found);
    std::vector<std::string> programs;
    for (const std::string& name : entry.cases)
      programs.push_back("case." + name);
    judge_programs(matrix, who, programs, found);
    if (entry.cases.empty() && entry.tests.empty() && entry.remark.empty())
      found.push_back(who + ": names neither case nor test; name one, or state in remark why there is none");
  }
  for (const Promise& promise : matrix.promises) {
    const std::string who = fmt::format("promises.toml: '{}'", promise.readme);
    if (matrix.readme.find(promise.readme) == std::string::npos)
      found.push_back(who + ": is found neither in README.md nor in a page of docs; take its words from there");
    judge_tests(matrix, who, promise.tests, found);
    judge_programs(matrix, who, promise.programs, found);
    if (promise.tests.empty() && promise.programs.empty())
      found.push_back(who + ": names no test; name the tests that guard it");
  }
  return found;
}

std::vector<std::string> problems(const Matrix& matrix, const Verdicts& verdicts) {
  std::vector<std::string> found;
  for (const Row& row : verdicts.rows) {
    if (row.check.kind == Kind::reported) continue;
    const std::string& source = row.check.source;
    const auto say = [&](const std::string& what) {
      found.push_back(
          fmt::format("case {}: check '{}': its source '{}' {}", row.case_name, row.check.quantity, source, what));
    };
    const std::vector<std::string> equations = equations_named(source);
    for (const std::string& number : equations)
      if (!find_equation(matrix, number))
        say(fmt::format("names Eq. {}, which is not in the thesis; correct the number", number));
    const bool rests = std::any_of(matrix.grounds.begin(), matrix.grounds.end(),
                                   [&](const Ground& ground) { return names(source, ground.name); });
    if (equations.empty() && !rests && !names_a_reference(matrix, source))
      say("names neither an equation, nor a work or principle of reports/grounds.toml, nor a folder of reference/; "
          "name one");
    for (const std::string& form : wrongly_named(source))
      say(fmt::format("has '{}', which is not a valid name of an equation; write Eq. or Eqs", form));
  }
  return found;
}

}  // namespace voussoir::reports
