// unit.architecture: reads the #include arrows of the sources; first it shows that a wrong arrow would be found.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "verification/architecture.hpp"

namespace voussoir::verification::architecture_test {
namespace {

std::vector<std::string> arrow(const std::string& from, const std::string& to) {
  return violations({{from, {to}, 10}});
}

TEST(Architecture, AllowsArrowsTowardsTheGround) {
  EXPECT_TRUE(arrow("core/contact/pair.hpp", "core/geometry/polytope.hpp").empty());
  EXPECT_TRUE(arrow("core/model/model.hpp", "core/load/boundary_stress.hpp").empty());
  EXPECT_TRUE(arrow("core/scene/prepare.cpp", "core/slicing/slice.hpp").empty());
  EXPECT_TRUE(arrow("core/model/prepared.hpp", "core/base/settings.hpp").empty());
  EXPECT_TRUE(arrow("core/output/paraview.hpp", "core/model/state.hpp").empty());
  EXPECT_TRUE(arrow("core/step.cpp", "core/step/integrate.hpp").empty());
  EXPECT_TRUE(arrow("app/main.cpp", "core/run/reduction.hpp").empty());
  EXPECT_TRUE(arrow("cases/wedge/wedge_test.cpp", "reference/wedge/wedge.hpp").empty());
  EXPECT_TRUE(arrow("reports/manual.cpp", "verification/verdicts.hpp").empty());
  EXPECT_TRUE(arrow("reports/study_report.hpp", "core/base/accuracy.hpp").empty());
  EXPECT_TRUE(arrow("app/judge/judgement.cpp", "verification/comparison/comparison.hpp").empty());
  EXPECT_TRUE(arrow("verification/problems/rock_mass.cpp", "core/scene/scene.hpp").empty());
  EXPECT_TRUE(arrow("core/contact/pair.hpp", "Eigen/Dense").empty());

  // a unit test may make its blocks with a neighbour
  EXPECT_TRUE(arrow("core/contact/overlap_test.cpp", "core/slicing/slice.hpp").empty());
  EXPECT_TRUE(arrow("core/contact/overlap_test.cpp", "core/testing/shapes.hpp").empty());
}

TEST(Architecture, RefusesArrowsBackUp) {
  EXPECT_FALSE(arrow("core/geometry/polytope.cpp", "core/contact/contact.hpp").empty());
  EXPECT_FALSE(arrow("core/contact/pair.hpp", "core/model/model.hpp").empty());
  EXPECT_FALSE(arrow("core/joint_laws/joint_law.cpp", "core/model/state.hpp").empty());
  EXPECT_FALSE(arrow("core/load/boundary_stress.cpp", "core/model/model.hpp").empty());
  EXPECT_FALSE(arrow("core/step/integrate.cpp", "core/step.hpp").empty());
  EXPECT_FALSE(arrow("core/step.cpp", "core/run/run.hpp").empty());
  EXPECT_FALSE(arrow("core/run/reduction.cpp", "app/main.hpp").empty());
  EXPECT_FALSE(arrow("core/contact/narrow_phase.cpp", "core/testing/shapes.hpp").empty());
}

TEST(Architecture, RefusesArrowsAcross) {
  EXPECT_FALSE(arrow("app/judge/judgement.cpp", "verification/verdicts.hpp").empty());
  EXPECT_FALSE(arrow("verification/verdicts.cpp", "core/scene/scene.hpp").empty());
  EXPECT_FALSE(arrow("verification/problems/rock_mass.cpp", "app/base/run_scene.hpp").empty());
  EXPECT_FALSE(arrow("core/contact/pair.hpp", "core/slicing/slice.hpp").empty());
  EXPECT_FALSE(arrow("core/scene/prepare.cpp", "core/output/results.hpp").empty());
  EXPECT_FALSE(arrow("core/output/paraview.cpp", "core/scene/scene.hpp").empty());
  EXPECT_FALSE(arrow("core/scene/prepare.cpp", "core/output/paraview.hpp").empty());
  EXPECT_FALSE(arrow("core/geometry/polytope.cpp", "core/base/settings.hpp").empty());
}

TEST(Architecture, RefusesCirclesInAnyFolder) {
  const auto found = [](const std::vector<SourceFile>& sources) { return violations(sources); };
  // two files of a room, in either order; a header and its source are one
  EXPECT_TRUE(arrow("core/contact/narrow_phase.cpp", "core/contact/narrow_phase.hpp").empty());
  EXPECT_TRUE(arrow("core/contact/narrow_phase.cpp", "core/contact/pair.hpp").empty());
  EXPECT_TRUE(arrow("core/contact/pair.hpp", "core/contact/narrow_phase.hpp").empty());
  EXPECT_EQ(found({{"core/solvers/feasibility.cpp", {"core/solvers/program.hpp"}, 10},
                   {"core/solvers/program.hpp", {"core/solvers/feasibility.hpp"}, 10}}),
            std::vector<std::string>{"a circle in core/solvers: core/solvers/feasibility.cpp includes "
                                     "core/solvers/program.hpp, core/solvers/program.hpp includes "
                                     "core/solvers/feasibility.hpp"});

  // a folder counts as one of its neighbours
  EXPECT_EQ(found({{"core/contact/narrow_phase.cpp", {"core/contact/kernel/kernel.hpp"}, 10},
                   {"core/contact/kernel/lanes_inl.hpp", {"core/contact/narrow_phase.hpp"}, 10}})
                .size(),
            1u);
  // two folders, by four different files; and outside of the core
  EXPECT_EQ(
      found({{"app/study/rows.cpp", {"app/run/folder.hpp"}, 10}, {"app/run/budget.cpp", {"app/study/work.hpp"}, 10}})
          .size(),
      1u);
  // of three, reported once; a test may close one
  EXPECT_EQ(found({{"reports/a.hpp", {"reports/b.hpp"}, 10},
                   {"reports/b.cpp", {"reports/c.hpp"}, 10},
                   {"reports/c.cpp", {"reports/a.hpp"}, 10}})
                .size(),
            1u);
  EXPECT_TRUE(found({{"core/contact/pair.hpp", {"core/contact/contact.hpp"}, 10},
                     {"core/contact/contact_test.cpp", {"core/contact/pair.hpp"}, 10}})
                  .empty());
}

TEST(Architecture, FindsTheTypesOfAFile) {
  const std::string text =
      "namespace voussoir {\nstruct Ahead;\nclass Ahead2;\n"
      "template <int Dim> struct Block {  // struct Said\n  struct Within {};\n};\n"
      "enum class Kind { one };\nstruct alignas(2 * sizeof(double)) Pair {\n};\nstruct\nnamespace {\nstruct Hidden "
      "{\n};\n}\n"
      "namespace cases {\nclass Trial final : public Base {\n};\nconst char* brace = \"{\";\n}\n"
      "inline namespace parts {\nstruct Wall\n{\n};\n}\n}\nstruct Free {};\n";
  EXPECT_EQ(type_names(text), (std::vector<std::string>{"voussoir::Block", "voussoir::Kind", "voussoir::Pair",
                                                        "voussoir::cases::Trial", "voussoir::parts::Wall", "Free"}));
}

TEST(Architecture, RefusesTwoTypesOfOneName) {
  const auto both = [](const std::string& one, const std::string& other) {
    return violations({{one, {}, 10, {"voussoir::Origin"}}, {other, {}, 10, {"voussoir::Origin", "voussoir::Else"}}});
  };
  EXPECT_EQ(both("app/import/imported.hpp", "core/output/origin.hpp"),
            std::vector<std::string>{"app/import/imported.hpp and core/output/origin.hpp both define voussoir::Origin: "
                                     "one program may contain both, rename one"});
  EXPECT_EQ(both("cases/wedge/wedge_scene.hpp", "cases/wedge/wedge_test.cpp").size(), 1u);
  EXPECT_TRUE(both("cases/arch/arch_trial.hpp", "cases/wedge/wedge_test.cpp").empty());
}

TEST(Architecture, KeepsTopFoldersApart) {
  for (const char* other : {"reference/wedge/wedge.hpp", "cases/wedge/x.hpp", "verification/verification.hpp",
                            "app/main.hpp", "reports/text.hpp", "benchmarks/x.hpp"}) {
    EXPECT_FALSE(arrow("core/step.cpp", other).empty()) << other;
    EXPECT_FALSE(arrow("core/contact/overlap_test.cpp", other).empty()) << other;
  }
  for (const char* folder : {"reference", "verification", "text"})
    EXPECT_FALSE(arrow(std::string(folder) + "/x.cpp", "core/model/model.hpp").empty()) << folder;
  for (const char* from : {"core/exchange/mesh.hpp", "verification/x.cpp", "app/x.cpp", "reports/x.cpp"})
    EXPECT_TRUE(arrow(from, "text/csv_table.hpp").empty()) << from;
  EXPECT_FALSE(arrow("reference/x.cpp", "text/csv_table.hpp").empty());
  EXPECT_FALSE(arrow("reference/wedge/wedge_test.cpp", "verification/verification.hpp").empty());
  EXPECT_FALSE(arrow("verification/summary.cpp", "reports/text.hpp").empty());
  EXPECT_FALSE(arrow("reports/study_report.cpp", "core/model/model.hpp").empty());
  EXPECT_FALSE(arrow("benchmarks/step.cpp", "cases/wedge/x.hpp").empty());
  EXPECT_FALSE(arrow("core/step.cpp", "fuzz/require.hpp").empty());
}

TEST(Architecture, RefusesUnknownRoomsRelativePathsAndLongFiles) {
  EXPECT_EQ(violations({{"core/helpers/misc.cpp", {}, 10}, {"core/helpers/misc.hpp", {}, 10}}),
            std::vector<std::string>{"core/helpers/ has no floor: give it one in verification/architecture.cpp"});
  EXPECT_FALSE(arrow("core/contact/pair.hpp", "../geometry/polytope.hpp").empty());
  EXPECT_FALSE(arrow("core/contact/pair.hpp", "./contact.hpp").empty());
  EXPECT_FALSE(violations({{"core/contact/pair.hpp", {}, 501}}).empty());
  EXPECT_TRUE(violations({{"core/contact/pair.hpp", {}, 500}}).empty());
  EXPECT_FALSE(violations({{"core/step.cpp", {}, 61}}).empty());
}

TEST(Architecture, ReadsIncludesHoweverTheyAreWritten) {
  const auto paths =
      include_paths("#include \"core/a.hpp\"\n#  include <core/b.hpp> // why\n// #include \"core/c.hpp\"\n");
  EXPECT_EQ(paths, (std::vector<std::string>{"core/a.hpp", "core/b.hpp"}));
}

TEST(Architecture, FindsWhatCommentsCite) {
  EXPECT_EQ(
      cited_paths("// as core/model/state.hpp and core/step/neighbours (method.md section 4), see README\n"
                  "int x;  // cases/wedge/README.md; Schur's 1/2\nauto y = \"// core/none.hpp\";\n"),
      (std::vector<std::string>{"core/model/state.hpp", "core/step/neighbours", "method.md", "cases/wedge/README.md"}));
  EXPECT_TRUE(cited_paths("// history.csv and km/h, and/or 3.5 m\n").empty());
}

// a page that was deleted, a file that was renamed
TEST(Architecture, RefusesCitationsOfMissingFiles) {
  const std::filesystem::path root = std::filesystem::temp_directory_path() / "voussoir_architecture_test";
  std::filesystem::remove_all(root);
  std::filesystem::create_directories(root / "core/law");
  const auto write = [&](const char* name, const char* text) { std::ofstream(root / name) << text; };
  write("core/joint_laws/README.md", "");
  write("core/joint_laws/joint_law.hpp",
        "// core/joint_laws/README.md, core/joint_laws/joint_law, law/joint_law, README.md, joint_law.hpp\n");
  EXPECT_TRUE(dead_citations(root).empty());
  write("core/law/other.hpp", "// decisions in method.md; core/joint_laws.cpp\n#include <map>  // core/neighbours\n");
  EXPECT_EQ(dead_citations(root),
            (std::vector<std::string>{"core/law/other.hpp cites method.md, which does not exist",
                                      "core/law/other.hpp cites core/joint_laws.cpp, which does not exist",
                                      "core/law/other.hpp cites core/neighbours, which does not exist"}));
  std::filesystem::remove_all(root);
}

TEST(Architecture, RefusesFilesThatNothingUses) {
  const std::vector<SourceFile> sources{{"core/contact/pair.cpp", {"core/contact/pair.hpp"}},
                                        {"core/contact/pair.hpp", {}},
                                        {"core/contact/twin.cpp", {"core/contact/pair.hpp"}},
                                        {"core/contact/twin.hpp", {"core/contact/twin.hpp"}}};
  EXPECT_EQ(unused_files(sources, {"core/contact/pair.cpp"}),
            (std::vector<std::string>{"core/contact/twin.cpp is in no target of CMake",
                                      "core/contact/twin.hpp is included by no file"}));
}

TEST(Architecture, HoldsInTheSources) {
  const std::vector<SourceFile> sources = read_sources(VOUSSOIR_SOURCE_DIR);
  ASSERT_GT(sources.size(), 5u) << "no sources were read, so no violation would be found";
  for (const std::string& violation : violations(sources))
    ADD_FAILURE() << violation;
  for (const std::string& room : rooms_without_file(sources))
    ADD_FAILURE() << room << " has a floor in verification/architecture.cpp, but no file";
  std::ifstream list(VOUSSOIR_BUILT_SOURCES);
  const std::set<std::string> built{std::istream_iterator<std::string>(list), {}};
  for (const std::string& file : unused_files(sources, built))
    ADD_FAILURE() << file;
  for (const std::string& citation : dead_citations(VOUSSOIR_SOURCE_DIR))
    ADD_FAILURE() << citation;
}

}  // namespace
}  // namespace voussoir::verification::architecture_test
