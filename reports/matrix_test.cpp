// unit.manual: names of equations and the matrix made of them, on this repository and on damaged copies.
#include "reports/matrix.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/matrix_page.hpp"
#include "verification/verdict_file.hpp"

namespace voussoir::reports::matrix_test {
namespace {

namespace fs = std::filesystem;
using namespace verification;
using Numbers = std::vector<std::string>;

TEST(EquationNames, HaveOneForm) {
  EXPECT_EQ(equations_named("by Eq. 3.27."), Numbers{"3.27"});
  EXPECT_EQ(equations_named("(Eqs 3.7 and 3.27): min s"), (Numbers{"3.7", "3.27"}));
  EXPECT_EQ(equations_named("Eqs 4.10-4.12, 4.14, 6.3 and A.9, at 1.5 m"),
            (Numbers{"4.10", "4.11", "4.12", "4.14", "6.3", "A.9"}));
  EXPECT_EQ(equations_named("Eqs F.1–F.3, and 5 more"), (Numbers{"F.1", "F.2", "F.3"}));
  EXPECT_EQ(equations_named("Eqs 3.38 and 3.49. The 3.3 m"), (Numbers{"3.38", "3.49"}));
  EXPECT_EQ(equations_named("Eq. 3.1 Eq. I.4"), (Numbers{"3.1", "I.4"}));
  for (const char* none : {"Eq. J.1", "Eq 3.1", "Eq. 3", "TheEq. 3.1", "Eq. 3.1x", "hn::Eq(x)", "4.13"})
    EXPECT_TRUE(equations_named(none).empty()) << none;
  for (const char* wrong : {"equation 3.27", "Equations E.1", "Eq 3.1", "Eqs. 3.1", "Eqn. 3.1", "Eq.(3.1)"})
    EXPECT_EQ(wrongly_named(wrong).size(), 1u) << wrong;
  EXPECT_TRUE(wrongly_named("Eq. 3.27, Eqs 3.1 and 3.2, an equation of 3 m").empty());
}

// ---- a small repository ------------------------------------------------------------------------------------------

const fs::path source = VOUSSOIR_SOURCE_DIR;

// the lists of this repository, and three sources that name some equations
struct Copy {
  fs::path root = fs::path(testing::TempDir()) / "voussoir_matrix";

  explicit Copy(const std::string& test = "") {
    fs::remove_all(root);
    for (const char* list :
         {"equations.toml", "equations.mathml", "thesis_cases.toml", "promises.toml", "grounds.toml"})
      write_atomically(root / "reports" / list, read_text(source / "reports" / list));
    write_atomically(root / "README.md", "It is fast.\n");
    write_atomically(root / "core/law/law.cpp", "// the cone (Eqs 4.8\n// and 4.9)\nvoid f() {}\n");
    write_atomically(
        root / "core/joint_laws/law_test.cpp",
        "// Eq. 4.8\nTEST(Cone, Holds) {\n  int x;  // Eq. 4.9\n}\n\n// Eq. 4.7, of a helper\nint helper();\n" + test);
    write_atomically(root / "cases/beam/beam_test.cpp", "const char* source = \"Boon (2013), Eq. E.2\";\n");
    write_atomically(root / "cases/CMakeLists.txt", "voussoir_case(beam SOURCES beam_test.cpp)\n");
  }

  void replace(const std::string& file, const std::string& old, const std::string& by) const {
    std::string text = read_text(root / file);
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    write_atomically(root / file, text.replace(at, old.size(), by));
  }
};

std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::runtime_error& problem) {
    return problem.what();
  }
  return "";
}

const Equation& equation(const Matrix& matrix, const std::string& number) {
  for (const Equation& one : matrix.equations)
    if (one.number == number) return one;
  throw std::logic_error("no equation " + number);
}

bool holds(const std::vector<std::string>& problems, const std::string& part) {
  for (const std::string& problem : problems)
    if (problem.find(part) != std::string::npos) return true;
  return false;
}

TEST(Matrix, IsMadeOfTheNamesInTheSources) {
  const Copy copy;
  const Matrix matrix = read_matrix(copy.root);
  const EquationPlaces limit = equation_places(matrix, equation(matrix, "4.8"));
  EXPECT_EQ(limit.code, Numbers{"core/law/law.cpp"});
  EXPECT_EQ(limit.tests, Numbers{"Cone.Holds"});
  EXPECT_EQ(equation_places(matrix, equation(matrix, "4.9")).tests, Numbers{"Cone.Holds"});
  EXPECT_EQ(equation_places(matrix, equation(matrix, "E.2")).cases, Numbers{"beam"});
  const EquationPlaces helper = equation_places(matrix, equation(matrix, "4.7"));
  EXPECT_TRUE(helper.code.empty() && helper.tests.empty());
  EXPECT_TRUE(matrix.names.tests.contains("Cone.Holds"));
  EXPECT_TRUE(matrix.names.programs.contains("case.beam"));
}

TEST(Matrix, OfThisRepositoryFits) {
  const Matrix matrix = read_matrix(source);
  EXPECT_EQ(matrix.equations.size(), 133u);
  for (const std::string& problem : problems(matrix))
    ADD_FAILURE() << problem;
  int open = 0;
  for (const Equation& one : matrix.equations)
    open += verified(one) == Verified::not_verified;
  EXPECT_LE(open, most_not_verified);
}

// ---- every problem, on a damaged copy ------------------------------------------------------------------------------

TEST(Matrix, ReportsANameWithoutEquation) {
  const Copy copy("// Eq. 4.19\nTEST(Cone, More) {\n}\n");
  EXPECT_TRUE(holds(problems(read_matrix(copy.root)), "core/joint_laws/law_test.cpp:8: the thesis has no Eq. 4.19"));
}

TEST(Matrix, ReportsAnEquationWithoutTest) {
  const Copy copy;
  const auto found = problems(read_matrix(copy.root));
  EXPECT_TRUE(holds(found, "Eq. 3.27 is named by no code"));
  EXPECT_TRUE(holds(found, "Eq. 3.27 is named by no test"));
  EXPECT_FALSE(holds(found, "Eq. 4.8 "));
  EXPECT_TRUE(holds(found, "Eq. E.2 is named by no code"));
  EXPECT_FALSE(holds(found, "Eq. E.2 is named by no test"));
}

TEST(Matrix, ReportsATestOfAnEquationThatIsLeftOut) {
  const Copy copy("// Eq. 4.15\nTEST(Cone, Falls) {\n}\n");
  EXPECT_TRUE(holds(problems(read_matrix(copy.root)),
                    "Eq. 4.15 is listed as not verified or left out, but Cone.Falls names it"));
}

TEST(Matrix, ReportsAMissingTestOrCase) {
  const Copy copy;
  const auto found = problems(read_matrix(copy.root));
  EXPECT_TRUE(holds(found, "there is no test Faults.FifteenKillsLoseNothing"));
  EXPECT_TRUE(holds(found, "thesis_cases.toml: 4.8, Fig. 4.11: CTest knows no case.wedge"));
  EXPECT_TRUE(holds(found, "is found neither in README.md nor in a page of docs"));
}

TEST(Matrix, ReportsAnotherFormOfName) {
  const Copy copy("// equation 4.8\nTEST(Cone, More) {\n}\n");
  EXPECT_TRUE(
      holds(problems(read_matrix(copy.root)), "law_test.cpp:8: 'equation 4.8' is not a valid name of an equation"));
}

// a case's notes are read as its README.md is
TEST(Matrix, ReportsWrongNamesInNotes) {
  const Copy copy;
  write_atomically(copy.root / "cases/beam/NOTES.md", "# Beam: notes\n\nEq. 4.19, equation 4.8.\n");
  const auto found = problems(read_matrix(copy.root));
  EXPECT_TRUE(holds(found, "cases/beam/NOTES.md:3: the thesis has no Eq. 4.19"));
  EXPECT_TRUE(holds(found, "cases/beam/NOTES.md:3: 'equation 4.8' is not a valid name of an equation"));
}

TEST(Matrix, ReportsMoreThanFifteenWithoutTest) {
  const Copy copy;
  std::string text = read_text(copy.root / "reports/equations.toml");
  for (int count = 1; count <= most_not_verified; ++count) {
    const std::size_t at = text.find("formula", text.find("[3." + std::to_string(count) + "]"));
    text.insert(at, "not_verified = \"no test\"\n");
  }
  write_atomically(copy.root / "reports/equations.toml", text);
  EXPECT_TRUE(holds(problems(read_matrix(copy.root)), "18 equations are not verified, 15 may be"));
}

TEST(Matrix, ADamagedListIsRefusedWithItsPlace) {
  const auto refused = [](const std::string& old, const std::string& by) {
    const Copy copy;
    copy.replace("reports/equations.toml", old, by);
    return refusal([&] { read_matrix(copy.root); });
  };
  EXPECT_NE(refused("[4.9]", "[4.19]").find("the thesis has no Eq. 4.19"), std::string::npos);
  EXPECT_NE(refused("[4.9]\n", "[4.8]\n").find("equations.toml:"), std::string::npos);  // an equation is listed once
  EXPECT_NE(refused("[4.9]\nsubject", "[4.x]\nsubject").find("the thesis has no Eq. 4.x"), std::string::npos);
  EXPECT_NE(refused("subject = \"its limit\"\n", "").find("4.8: subject is missing"), std::string::npos);
  EXPECT_NE(refused("\\mu F_n'", "\\mu F'").find("4.8: its MathML was made of another formula"), std::string::npos);
  EXPECT_NE(refused("left_out = ", "reason = ").find("reason is not a key here"), std::string::npos);
}

TEST(Matrix, ReportsASourceThatNamesNoGround) {
  const Copy copy;
  write_atomically(copy.root / "reference/CMakeLists.txt", "voussoir_test(reference.arch LABEL reference)\n");
  const Matrix matrix = read_matrix(copy.root);
  const auto found = [&](const std::string& named) {
    Verdicts verdicts;
    verdicts.rows = {{"wedge", {"angle", "deg", Kind::exact, named, 30, {1, 0}, "why"}, 30, {}, ""}};
    return problems(matrix, verdicts);
  };
  EXPECT_TRUE(holds(found("a number"), "case wedge: check 'angle': its source 'a number' names neither"));
  EXPECT_TRUE(holds(found("reference/nothing"), "names neither"));
  EXPECT_TRUE(holds(found("Boon (2013), Eq. 4.19"), "names Eq. 4.19, which is not in the thesis"));
  EXPECT_TRUE(holds(found("Boon (2013), equation 4.8"), "is not a valid name of an equation"));
  for (const char* good :
       {"Eq. 4.8", "least mechanism, reference/arch", "Newmark (1965), sliding block", "equilibrium: W/k"})
    EXPECT_TRUE(found(good).empty()) << good;
  Verdicts reported;
  reported.rows = {{"wedge", {"angle", "deg", Kind::reported, "", 0, {}, "a note"}, 30, {}, ""}};
  EXPECT_TRUE(problems(matrix, reported).empty());
}

// ---- pages ---------------------------------------------------------------------------------------------------------

TEST(MatrixPage, SetsFormulasAndLinksToChecks) {
  const Copy copy;
  const Matrix matrix = read_matrix(copy.root);
  Verdicts verdicts;
  verdicts.rows = {{"beam", {"weight", "N", Kind::exact, "Boon (2013), Eq. E.2", 30, {1, 0}, "why"}, 30, {}, ""}};
  const std::string page = equations_page(matrix, verdicts);
  for (const char* part : {"id=\"eq-4-8\"", "<math displaystyle", "core/<wbr>law/<wbr>law.<wbr>cpp", "Cone.<wbr>Holds",
                           "<a href=\"#beam\">beam: 1 check</a>", "not verified", "left out", "Instead"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_NE(thesis_page(matrix).find("<a href=\"#hingedbeam\">hingedbeam</a>"), std::string::npos);
  EXPECT_NE(promises_page(matrix).find("Faults.<wbr>Fifteen<wbr>Kills<wbr>Lose<wbr>Nothing"), std::string::npos);
  EXPECT_NE(grounds_page(matrix, verdicts).find("Newmark (1965)"), std::string::npos);
}

}  // namespace
}  // namespace voussoir::reports::matrix_test
