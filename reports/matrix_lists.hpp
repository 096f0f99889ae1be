#pragma once
// The lists that the matrix is made of: equations.toml with equations.mathml, thesis_cases.toml, promises.toml and
// grounds.toml, beside this file. All readers throw std::runtime_error, which names file, line, key and repair.
#include <filesystem>
#include <string>
#include <vector>

namespace voussoir::reports {

struct Equation {
  std::string number, subject, tex;
  std::string formula;       // MathML; empty where none was set
  std::string instead;       // what the code does in its place
  std::string left_out;      // why neither code nor test has it
  std::string not_verified;  // why no test names it

  bool is_open() const { return !left_out.empty() || !not_verified.empty(); }
};

// By chapter, then number. An equation of the thesis that is missing, or one that it has not, is refused; so is a
// formula whose MathML was made of another one.
std::vector<Equation> read_equations(const std::filesystem::path& list, const std::filesystem::path& formulas);

// What the thesis computed, drew or tabulated, and which of our cases answer it.
struct ThesisCase {
  std::string thesis;  // section, with its figures and tables
  std::string subject;
  std::vector<std::string> cases;  // folders of cases/
  std::vector<std::string> tests;  // Suite.Name, where no case has it
  std::string remark;              // what is not made again, and why
};
std::vector<ThesisCase> read_thesis_cases(const std::filesystem::path& list);

// What README.md or a page of docs promises, and what guards it.
struct Promise {
  std::string readme;  // its words there
  std::string meaning;
  std::vector<std::string> tests;     // Suite.Name
  std::vector<std::string> programs;  // CTest entries, where the whole of one guards it
};
std::vector<Promise> read_promises(const std::filesystem::path& list);

// What a check may rest on besides an equation: a published work, or a principle. The check's source holds its
// name.
struct Ground {
  std::string name, meaning;
  bool is_work = false;
};
std::vector<Ground> read_grounds(const std::filesystem::path& list);

}  // namespace voussoir::reports
