#pragma once
// How code, tests and pages name the thesis's equations, and where they do. One form: `Eq. 3.27` names one, `Eqs`
// several: `Eqs 3.1 and 3.2`, `Eqs 4.10-4.14, 4.16 and 6.3`. Appendices have letters: `Eq. A.3`.
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace voussoir::reports {

// The numbers that a text names, in its order, ranges written out.
std::vector<std::string> equations_named(std::string_view text);

// Names that are written in another form ("equation 3.27", "Eq 3.27", "Eqs. 3.1"), unchanged.
std::vector<std::string> wrongly_named(std::string_view text);

enum class Place {
  code,       // of the method, the program or a case
  reference,  // of a closed form that shares no code with it
  helper,     // of tests or benchmarks
  test,       // a comment above a test or anything within it
  source,     // of a check of a case: text within quotes
  page        // markdown, gnuplot and scenes
};

struct Naming {
  std::string number;
  std::string file;  // relative to the repository's folder
  int line = 0;      // first line of the text that names it
  Place place = Place::code;
  std::string test;  // Suite.Name, of Place::test
};

// The equations that the sources of a repository name, and its tests.
struct SourceNames {
  std::vector<Naming> namings;     // by file, then in its order
  std::set<std::string> tests;     // every test of the sources: Suite.Name
  std::set<std::string> programs;  // every CTest entry that CMake files name: unit.contact, case.wedge, …
  std::vector<std::string> wrong;  // one line each: file, line, text
};
SourceNames read_source_names(const std::filesystem::path& repository);

}  // namespace voussoir::reports
