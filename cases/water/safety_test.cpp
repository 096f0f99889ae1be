// The plane failure whose joint has cohesion: its factor of safety, by distinct elements and by limit analysis.
#include <gtest/gtest.h>

#include "cases/water/plane_failure.hpp"

namespace voussoir::cases::safety_test {
namespace {

using reference::PlaneFailure;
using verification::CaseReport;
using verification::Kind;

// The bond of one point per face breaks as one; limit analysis assumes ductile cohesion, which is equivalent here.
double judge_factor(CaseReport& report, const std::string& scene, const std::string& of, double expected,
                    const std::vector<std::string>& overrides) {
  const SceneRun done = run(scene, overrides);
  report.record({"factor of safety, DEM" + of,
                 "1",
                 Kind::exact,
                 plane_source,
                 expected,
                 {0, 2e-3},
                 "half the bracket is 0.0005; the water that the block leaves before it counts as failed, 0.01 deg"},
                value(done, "factor_of_safety"), cost(done));
  const LimitRequest request{.properties = {"joint"}, .factor = true, .cohesion = true, .with_dilation = true};
  const double limit = limit_answer(scene, overrides, request);
  report.record({"factor of safety, limit analysis" + of,
                 "1",
                 Kind::exact,
                 plane_source,
                 expected,
                 {0, 1e-6},
                 "the solver's tolerance is 1e-7 of the block's weight"},
                limit);
  return limit;
}

TEST(PlaneFailure, HasTheFactorOfSafetyOfItsCohesion) {
  CaseReport report("water", {"factor of safety, DEM, crack full"});
  for (const double fill : {0.0, 0.5, 1.0})
    judge_factor(report, "safety.toml", filled(fill), factor_of_safety(plane_failure(fill)),
                 {fill == 0 ? empty_crack : table_of(plane_failure(fill))});
}

TEST(PlaneFailure, HasTheFactorsOfThePrintedExample) {
  CaseReport report("water");
  PlaneFailure printed{30, 60 * degree, 30 * degree, 9, 25.5e3, 0, 48e3, 30 * degree};
  for (const double fill : {0.0, 1.0}) {
    printed.water_in_crack = fill * forces_of(printed).crack_depth;
    const std::vector<std::string> overrides =
        fill == 0 ? std::vector<std::string>{empty_crack} : std::vector<std::string>{};
    const double found =
        judge_factor(report, "printed.toml", ", printed example" + filled(fill), factor_of_safety(printed), overrides);
    report.record({"factor of safety, limit analysis against print" + filled(fill),
                   "1",
                   Kind::published,
                   "Hoek & Bray (1981), plane failure",
                   fill == 0 ? 1.347 : 0.794,
                   {5e-4, 0},
                   "the printed digits"},
                  found);
  }
}

}  // namespace
}  // namespace voussoir::cases::safety_test
