#pragma once
// The lists from which the matrix is made: equations.toml with equations.mathml, thesis_cases.toml, promises.toml and
// grounds.toml, beside this file. All readers throw std::runtime_error, which names file, line, key and repair.
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir::reports {

struct Equation {
  std::string number, subject, tex;
  std::string formula;       // MathML; empty if it was not made
  std::string instead;       // the code's method in its place
  std::string left_out;      // why neither code nor test has it
  std::string not_verified;  // why no test names it

  bool is_open() const { return !left_out.empty() || !not_verified.empty(); }
};

// By chapter, then number. A missing equation of the thesis, or one that it does not have, is refused; so is a formula
// whose MathML was made of another one.
std::vector<Equation> read_equations(const std::filesystem::path& list, const std::filesystem::path& formulas);

// A computation, figure or table of the thesis, and our cases for it.
struct ThesisCase {
  std::string thesis;  // section, with its figures and tables
  std::string subject;
  std::vector<std::string> cases;  // folders of cases/
  std::vector<std::string> tests;  // Suite.Name, if no case has it
  std::string remark;              // parts that are not repeated, and why
};
std::vector<ThesisCase> read_thesis_cases(const std::filesystem::path& list);

// A promise of README.md or a page of docs, and the tests that guard it.
struct Promise {
  std::string readme;  // its words there
  std::string meaning;
  std::vector<std::string> tests;     // Suite.Name
  std::vector<std::string> programs;  // CTest entries, if one guards it as a whole
};
std::vector<Promise> read_promises(const std::filesystem::path& list);

// The basis of a check besides an equation: a published work, or a principle. The check's source contains its name.
struct Ground {
  std::string name, meaning;
  bool is_work = false;
};
std::vector<Ground> read_grounds(const std::filesystem::path& list);

}  // namespace voussoir::reports
