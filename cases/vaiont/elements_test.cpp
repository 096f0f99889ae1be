// The section by distinct elements, without bonds: its critical friction against limit analysis on a slide of constant
// friction, and against elastic-plastic blocks with small displacements on one that softens.
#include <gtest/gtest.h>

#include "cases/vaiont/elements.hpp"
#include "reference/vaiont/section.hpp"
#include "text/angle.hpp"

namespace voussoir::cases::elements_test {
namespace {

using verification::Bound;
using verification::CaseReport;
using verification::Kind;

const std::string newton = ", Newton", relaxation = ", relaxation";

struct Ground {
  double spacing, water;  // m
};

std::string name(const Ground& ground) {
  return fmt::format(", {:g} m, {}", ground.spacing,
                     ground.water > 0 ? fmt::format("water {:g} m", ground.water) : "dry");
}

Overrides settings_of(const Ground& ground) {
  return spacing(ground.spacing) + water_above_the_seat(ground.water);
}

struct Expected {
  std::string source;
  double angle;  // deg
};

Expected limit_analysis(const Ground& ground) {
  return {"rigid-block limit analysis of the same blocks", by_limit_analysis("dem.toml", settings_of(ground))};
}

// for many blocks, for which limit analysis takes a minute and has no result at 40 m under water (NOTES.md)
Expected closed_form(const Ground& ground) {
  constexpr double vertical = 90 * degree, rock = 40 * degree;
  reference::SectionLoads loads;
  loads.unit_weight = 2395.5 * 9.81;
  loads.table = {{0, seat_m + ground.water}};
  return {
      "blocks that translate behind mobilised cross joints, reference/vaiont",
      reference::critical_slide_friction(section_blocks(reference::vaiont_section(), loads, vertical), rock, vertical) /
          degree};
}

void judge(CaseReport& report, const Ground& ground, const Expected& expected, const std::string& way,
           const Overrides& settings = {}) {
  const SceneRun found = run("dem.toml", settings_of(ground) + settings);
  report.record({"critical friction, DEM" + name(ground) + way,
                 "deg",
                 Kind::limit,
                 expected.source,
                 expected.angle,
                 {0.2, 0},
                 "half the bracket is 0.06; joints that are not rigid let the blocks move by up to 1.4 m before the "
                 "slide fails, which rotates the forces between them by some 0.1 deg"},
                value(found, "critical_friction"), cost(found));
}

TEST(VaiontElements, NeedTheFrictionOfLimitAnalysis) {
  CaseReport report("vaiont", {"critical friction, DEM, 80 m, dry, Newton"});
  report.reference("critical_friction", by_limit_analysis("dem.toml", {}), "deg");
  for (const double metres : {150, 80})
    for (const double water : {0, 90})
      judge(report, {metres, water}, limit_analysis({metres, water}), newton);
}

TEST(VaiontElementsLong, NeedTheFrictionOfTheClosedFormWithManyBlocks) {
  CaseReport report("vaiont");
  for (const double metres : {40, 20})
    for (const double water : {0, 90})
      judge(report, {metres, water}, closed_form({metres, water}), newton);
}

TEST(VaiontElementsLong, NeedTheSameByRelaxation) {
  CaseReport report("vaiont");
  const Ground dry{80, 0};
  judge(report, dry, limit_analysis(dry), relaxation, {"statics=adaptive"});
}

// a slice in space, whose blocks could leave the plane
TEST(VaiontElements, NeedTheSameAsASliceInSpace) {
  CaseReport report("vaiont", {"critical friction, DEM, 80 m, dry, slice 40 m thick"});
  for (const double water : {0, 90}) {
    const Ground ground{80, water};
    const SceneRun found = run("slice.toml", water_above_the_seat(water));
    report.record({"critical friction, DEM" + name(ground) + ", slice 40 m thick",
                   "deg",
                   Kind::limit,
                   "rigid-block limit analysis of the same section",
                   limit_analysis(ground).angle,
                   {0.2, 0},
                   "as in the plane"},
                  value(found, "critical_friction"), cost(found));
  }
}

// the results of the section's distinct elements at 80 m and of limit analysis, with blocks half as large
TEST(VaiontElementsLong, NeedTheSameAsASliceOfSmallBlocksInSpace) {
  CaseReport report("vaiont");
  Overrides small{"joint_properties.rock.normal_stiffness=1.92e8", "joint_properties.rock.shear_stiffness=7.68e7"};
  for (const char* set : {"cross", "beds above the back", "beds above the middle", "beds above the seat"})
    small.push_back(fmt::format("joint_sets.{}.spacing=40", set));
  for (const double water : {0, 90}) {
    const SceneRun found = run("slice.toml", small + water_above_the_seat(water));
    report.record({"critical friction, DEM" + name({40, water}) + ", slice 40 m thick",
                   "deg",
                   Kind::limit,
                   "rigid-block limit analysis of the section in blocks of 80 m",
                   limit_analysis({80, water}).angle,
                   {0.2, 0},
                   "as in the plane"},
                  value(found, "critical_friction"), cost(found));
  }
}

// the same by other paths, within their error bars and 0.1 degrees
void judge_way(CaseReport& report, const std::string& scene, const std::string& way) {
  const SceneRun found = run(scene);
  report.record({"critical friction, DEM, 80 m, dry, " + way,
                 "deg",
                 Kind::limit,
                 "rigid-block limit analysis of the same blocks",
                 by_limit_analysis(scene, {}),
                 {*found.results.find("critical_friction")->error_bar + 0.1, 0},
                 "its error bar, and 0.1 deg as demanded"},
                value(found, "critical_friction"), cost(found));
}

TEST(VaiontElements, NeedTheSameInSteps) {
  CaseReport report("vaiont");
  judge_way(report, "dem_steps.toml", "steps, Newton");
}

TEST(VaiontElementsLong, NeedTheSameAtTwoRates) {
  CaseReport report("vaiont");
  judge_way(report, "dem_rates.toml", "two rates");
}

// Cross joints that dip into the slope: as the rock gets stiffer, the critical friction of distinct elements falls
// towards that of limit analysis, since soft joints let the blocks move by metres before the slide fails.
TEST(VaiontElements, NeedMoreInSoftRockBehindInclinedJoints) {
  CaseReport report("vaiont");
  const Overrides leaning{"joints.upper cross.dip=50", "joints.lower cross.dip=50", "joint_sets.cross.dip=50",
                          "stage.critical.failure_displacement=1"};
  double softer = 90;
  for (const double stiffness : {0.096, 1.0, 10.0}) {  // GPa/m
    const SceneRun found =
        run("dem.toml", leaning + Overrides{fmt::format("joint_properties.rock.normal_stiffness={}", 1e9 * stiffness),
                                            fmt::format("joint_properties.rock.shear_stiffness={}", 4e8 * stiffness)});
    const double angle = value(found, "critical_friction");
    report.record({fmt::format("critical friction, DEM, cross joints 50°, rock {:g} GPa/m", stiffness),
                   "deg",
                   Kind::limit,
                   "rigid-block limit analysis of the same blocks",
                   by_limit_analysis("dem.toml", leaning),
                   {0, 0, Bound::at_least},
                   "dilation, which limit analysis implies, only adds strength"},
                  angle, cost(found));
    EXPECT_LT(angle, softer) << "stiffer rock needs less";
    softer = angle;
  }
}

// a corner of 5 cm instead of 9 and 16 m: the blocks meet the slide beyond the bends before they count as failed
TEST(VaiontElementsLong, WholeCornersHoldTheSlopeUp) {
  CaseReport report("vaiont");
  for (const double failed : {2.0, 5.0}) {
    const SceneRun found = run("dem.toml", {"slicing.smallest_inscribed_radius=0",
                                            "excavations.upper corner.planes.1.point=[718.3277, 644.04085]",
                                            "excavations.lower corner.planes.1.point=[818.3277, 620.0120012]",
                                            fmt::format("stage.critical.failure_displacement={}", failed)});
    report.report(fmt::format("critical friction, DEM, 80 m, dry, whole corners, failure at {:g} m", failed), "deg",
                  value(found, "critical_friction"), "corners that are not cut off at the bends", cost(found));
  }
}

// the path to the result must not matter
struct Path {
  std::string scene, name;
  Overrides settings;
};
const Path bisection{"softening.toml", ", bisection", {}}, steps{"softening_steps.toml", ", steps", {}};

double judge_softening(CaseReport& report, double water, const Path& path) {
  const Ground ground{80, water};
  const SceneRun found = run(path.scene, settings_of(ground) + path.settings);
  const double angle = value(found, "critical_friction");
  report.record({"critical friction, DEM, softening" + name(ground) + path.name,
                 "deg",
                 Kind::limit,
                 "comparison: elastic-plastic blocks with softening, small displacements",
                 water > 0 ? 20.5 : 18.8,
                 {0.3, 0},
                 "half a bracket or step is 0.1, half the reference's step 0.05; the reference's blocks move little, "
                 "these by a metre before the slide fails"},
                angle, cost(found));
  return angle;
}

TEST(VaiontElements, NeedMoreOnASlideThatSoftens) {
  CaseReport report("vaiont", {"critical friction, DEM, softening, 80 m, dry, bisection"});
  judge_softening(report, 0, bisection);
}

TEST(VaiontElementsLong, NeedMoreOnASlideThatSoftensInWater) {
  CaseReport report("vaiont");
  judge_softening(report, 90, bisection);
}

TEST(VaiontElementsLong, NeedTheSameBySteps) {
  CaseReport report("vaiont");
  for (const double water : {0, 90})
    judge_softening(report, water, steps);
}

TEST(VaiontElementsLong, NeedTheSameByOtherRampsAndBrackets) {
  CaseReport report("vaiont");
  double least = 90, most = 0;
  for (const Path& path : std::vector<Path>{
           {"softening.toml", ", ramps of 100 steps", {"stage.critical.ramp_steps=100"}},
           {"softening.toml", ", ramps of 4000 steps", {"stage.critical.ramp_steps=4000"}},
           {"softening.toml", ", bracket 24 to 17 deg", {"stage.critical.from_deg=24", "stage.critical.to_deg=17"}},
           {"softening_steps.toml", ", steps of 0.1 deg", {"stage.critical.step_deg=0.1"}}}) {
    const double angle = judge_softening(report, 0, path);
    least = std::min(least, angle);
    most = std::max(most, angle);
  }
  EXPECT_LE(most - least, 0.22) << "farther apart than two brackets of 0.22 deg";
}

}  // namespace
}  // namespace voussoir::cases::elements_test
