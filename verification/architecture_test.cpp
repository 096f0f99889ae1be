// unit.architecture: reads the #include arrows of the sources; first it shows that a wrong arrow would be seen.
#include <gtest/gtest.h>

#include "verification/architecture.hpp"

namespace voussoir::verification {
namespace {

std::vector<std::string> arrow(const std::string& from, const std::string& to) {
  return violations({{from, {to}, 10}});
}

TEST(Architecture, AllowsArrowsTowardsTheGround) {
  EXPECT_TRUE(arrow("core/contact/overlap.cpp", "core/geometry/polytope.hpp").empty());
  EXPECT_TRUE(arrow("core/contact/overlap.cpp", "core/contact/contact.hpp").empty());
  EXPECT_TRUE(arrow("core/model.hpp", "core/support/lining.hpp").empty());
  EXPECT_TRUE(arrow("core/scene/reader.cpp", "core/slicing/cut.hpp").empty());
  EXPECT_TRUE(arrow("core/scene/reader.cpp", "core/settings.hpp").empty());
  EXPECT_TRUE(arrow("core/output/results.cpp", "core/state.hpp").empty());
  EXPECT_TRUE(arrow("core/step.cpp", "core/motion/integrate.hpp").empty());
  EXPECT_TRUE(arrow("app/main.cpp", "core/reduction/bisection.hpp").empty());
  EXPECT_TRUE(arrow("cases/wedge/wedge_test.cpp", "reference/wedge/wedge.hpp").empty());
  EXPECT_TRUE(arrow("reports/manual.cpp", "verification/verdicts.hpp").empty());
  EXPECT_TRUE(arrow("reports/study_report.hpp", "core/accuracy.hpp").empty());
  EXPECT_TRUE(arrow("core/contact/overlap.cpp", "Eigen/Dense").empty());

  // a unit test may make its blocks with a neighbour
  EXPECT_TRUE(arrow("core/contact/overlap_test.cpp", "core/slicing/cut.hpp").empty());
}

TEST(Architecture, RefusesArrowsBackUp) {
  EXPECT_FALSE(arrow("core/geometry/polytope.cpp", "core/contact/contact.hpp").empty());
  EXPECT_FALSE(arrow("core/contact/overlap.cpp", "core/model.hpp").empty());
  EXPECT_FALSE(arrow("core/law/coulomb.cpp", "core/state.hpp").empty());
  EXPECT_FALSE(arrow("core/load/gravity.cpp", "core/model.hpp").empty());
  EXPECT_FALSE(arrow("core/motion/integrate.cpp", "core/step.hpp").empty());
  EXPECT_FALSE(arrow("core/step.cpp", "core/run.hpp").empty());
  EXPECT_FALSE(arrow("core/run.cpp", "core/reduction/bisection.hpp").empty());
  EXPECT_FALSE(arrow("core/reduction/bisection.cpp", "app/main.hpp").empty());
}

TEST(Architecture, RefusesArrowsAcross) {
  EXPECT_FALSE(arrow("core/contact/overlap.cpp", "core/slicing/cut.hpp").empty());
  EXPECT_FALSE(arrow("core/scene/reader.cpp", "core/results.hpp").empty());
  EXPECT_FALSE(arrow("core/output/results.cpp", "core/scene/scene.hpp").empty());
  EXPECT_FALSE(arrow("core/scene/reader.cpp", "core/output/results.hpp").empty());
  EXPECT_FALSE(arrow("core/geometry/polytope.cpp", "core/settings.hpp").empty());
}

TEST(Architecture, KeepsTheHousesApart) {
  for (const char* other : {"reference/wedge/wedge.hpp", "cases/wedge/x.hpp", "verification/verification.hpp",
                            "app/main.hpp", "reports/text.hpp", "benchmarks/x.hpp"}) {
    EXPECT_FALSE(arrow("core/step.cpp", other).empty()) << other;
    EXPECT_FALSE(arrow("core/contact/overlap_test.cpp", other).empty()) << other;
  }
  for (const char* folder : {"reference", "verification", "text"})
    EXPECT_FALSE(arrow(std::string(folder) + "/x.cpp", "core/model.hpp").empty()) << folder;
  for (const char* from : {"core/exchange/x.cpp", "verification/x.cpp", "app/x.cpp", "reports/x.cpp"})
    EXPECT_TRUE(arrow(from, "text/csv_table.hpp").empty()) << from;
  EXPECT_FALSE(arrow("reference/x.cpp", "text/csv_table.hpp").empty());
  EXPECT_FALSE(arrow("reference/wedge/wedge_test.cpp", "verification/verification.hpp").empty());
  EXPECT_FALSE(arrow("verification/summary.cpp", "reports/text.hpp").empty());
  EXPECT_FALSE(arrow("reports/study_report.cpp", "core/model.hpp").empty());
  EXPECT_FALSE(arrow("benchmarks/step.cpp", "cases/wedge/x.hpp").empty());
  EXPECT_FALSE(arrow("core/step.cpp", "fuzz/require.hpp").empty());
}

TEST(Architecture, RefusesUnknownRoomsRelativePathsAndLongFiles) {
  EXPECT_FALSE(violations({{"core/helpers/misc.cpp", {}, 10}}).empty());
  EXPECT_FALSE(arrow("core/contact/overlap.cpp", "../geometry/polytope.hpp").empty());
  EXPECT_FALSE(arrow("core/contact/overlap.cpp", "./contact.hpp").empty());
  EXPECT_FALSE(violations({{"core/contact/overlap.cpp", {}, 501}}).empty());
  EXPECT_TRUE(violations({{"core/contact/overlap.cpp", {}, 500}}).empty());
  EXPECT_FALSE(violations({{"core/step.cpp", {}, 61}}).empty());
}

TEST(Architecture, ReadsIncludesHoweverTheyAreWritten) {
  const auto paths =
      include_paths("#include \"core/a.hpp\"\n#  include <core/b.hpp> // why\n// #include \"core/c.hpp\"\n");
  EXPECT_EQ(paths, (std::vector<std::string>{"core/a.hpp", "core/b.hpp"}));
}

TEST(Architecture, HoldsInTheSources) {
  const std::vector<SourceFile> sources = read_sources(VOUSSOIR_SOURCE_DIR);
  ASSERT_GT(sources.size(), 5u) << "no sources were read, so nothing would be found";
  for (const std::string& violation : violations(sources))
    ADD_FAILURE() << violation;
}

}  // namespace
}  // namespace voussoir::verification
