// A slope of three beds under a record: implicit steps against explicit ones.
#include <gtest/gtest.h>

#include <cmath>

#include "cases/case_tools.hpp"

namespace voussoir::cases::slope_test {
namespace {

using verification::CaseReport;
using verification::Kind;

const std::vector<std::string> implicit{"stage.earthquake.time.integration=implicit"};

// joints so much stiffer that they are nearly rigid: as slope.toml states them, times 100
const std::vector<std::string> stiff{"joint_properties.rock.normal_stiffness=5e11",
                                     "joint_properties.rock.shear_stiffness=2e11"};

std::vector<std::string> both(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// m: of the beds' mean
double moved(const SceneRun& run) {
  return std::hypot(value(run, "slope_mean_displacement_x"), value(run, "slope_mean_displacement_y"));
}

TEST(Slope, SlidesAsFarByImplicitSteps) {
  CaseReport report("shaking",
                    {"slope under a record, implicit steps of 1e-7 m", "slope under a record, implicit steps"});
  const SceneRun by_explicit = cases::run("slope.toml"), by_implicit = cases::run("slope.toml", implicit),
                 fine = cases::run("slope.toml", both(implicit, {"stage.earthquake.time.error_m=1e-7"})),
                 rigid = cases::run("slope.toml", both(implicit, stiff));
  const double expected = moved(by_explicit);
  report.report("slope under a record, explicit steps", "m", expected, "record of cases/shaking/slope.at2",
                cost(by_explicit));
  const std::string source = "comparison: explicit steps of a tenth of their limit";
  report.record({"slope under a record, implicit steps of 1e-7 m",
                 "m",
                 Kind::limit,
                 source,
                 expected,
                 {1e-7 * static_cast<double>(fine.results.stages.back().steps), 0},
                 "each step errs by its tolerance at most, and all of them in one direction"},
                moved(fine), cost(fine));
  report.record({"slope under a record, implicit steps",
                 "m",
                 Kind::limit,
                 source,
                 expected,
                 {std::abs(expected - moved(rigid)), 0},
                 "the joints' own springiness, which steps of 5 ms do not resolve: that between these joints and "
                 "joints a hundred times as stiff"},
                moved(by_implicit), cost(by_implicit));
}

TEST(SlopeLong, SlidesAsFarOnStiffJoints) {
  CaseReport report("shaking", {"slope under a record, stiff joints, implicit steps"});
  const SceneRun by_explicit = cases::run("slope.toml", stiff),
                 by_implicit = cases::run("slope.toml", both(implicit, stiff));
  report.report("slope under a record, stiff joints, explicit steps", "m", moved(by_explicit),
                "record of cases/shaking/slope.at2", cost(by_explicit));
  report.record({"slope under a record, stiff joints, implicit steps",
                 "m",
                 Kind::limit,
                 "comparison: explicit steps of a tenth of their limit",
                 moved(by_explicit),
                 {0, 1e-2},
                 "what steps of 1/100 of the record's main period may err in slip"},
                moved(by_implicit), cost(by_implicit));
}

}  // namespace
}  // namespace voussoir::cases::slope_test
