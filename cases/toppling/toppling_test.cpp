// Block on an incline: the mode map of sliding and toppling, on both sides of each of its borders.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cases/budget_trial.hpp"
#include "cases/case_tools.hpp"
#include "reference/small/small.hpp"
#include "reference/small/toppling.hpp"
#include "text/angle.hpp"

namespace voussoir::cases {
namespace {

using reference::BlockMode;
using reference::InclinedBlock;
using verification::CaseReport;
using verification::Kind;

// as the scenes state it
constexpr double breadth = 1, height = 2, weight = 2500 * 9.81 * breadth * height, stiffness = 100e9;

// What counts as moved. A hinge gives by T/(k_s a) = 0.07 mm at most while the block turns by 0.1 rad, where the start
// ends; at rest it turns by 0.002 rad.
constexpr double slid = 2e-4, turned = 0.02, started = 0.1;  // m, rad, rad

struct Point {
  double slope, friction;  // deg
};

struct Variant {
  std::string scene, name, test;
  int dimension;
  std::vector<std::string> carried = {};  // how the faces are carried: a scene's own points, or an override
};

void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

std::string text(double number) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.15g", number);
  return buffer;
}

// deg: the slope, or where it slides the friction angle, at which the block overturns on its elastic joint
double overturns_at(double slope_deg) {
  return to_degrees(reference::overturning_angle(breadth, height, weight * std::cos(slope_deg * degree), stiffness));
}

// Two points on either side of each of the four borders, and one far inside each region. Below the friction that holds
// a block's foot as it topples it slides for as long as it hardly leans: on an elastic joint, whose hinge lies inside
// by up to a third of what is pressed, 0.2 degrees less friction hold it once it leans by 0.002 rad, and 0.9 at 0.02
// rad. So that point stands farther off.
std::vector<Point> points() {
  constexpr double apart = 0.3, steep = 35;  // deg
  const double flat = 20, overturns = overturns_at(26), sliding = overturns_at(steep);
  const double both = to_degrees(reference::least_toppling_friction({breadth, height, steep * degree, 0}));
  return {{flat, flat + apart},
          {flat, flat - apart},
          {overturns - apart, 40},
          {overturns + apart, 40},
          {steep, sliding - apart},
          {steep, sliding + apart},
          {steep, both - 2.5 * apart},
          {steep, both + apart},
          {10, 35},
          {30, 15},
          {40, 50},
          {42, 29}};
}

// the reference's mode, on elastic joints: the borders of overturning lie where the joint puts them
BlockMode expected_mode(const Point& p) {
  const InclinedBlock block{breadth, height, p.slope * degree, p.friction * degree};
  const double overturns = overturns_at(p.slope);
  if (std::min(p.slope, p.friction) < overturns) return p.slope < p.friction ? BlockMode::stays : BlockMode::slides;
  // between the elastic border and the rigid one all friction angles above the border hold the block's foot
  if (std::tan(block.slope) <= breadth / height) return BlockMode::topples;
  return block.friction_angle < reference::least_toppling_friction(block) ? BlockMode::slides_and_topples
                                                                          : BlockMode::topples;
}

// how the lower corner and the block have moved when the start is over
struct Start {
  double slip = 0, turn = 0;  // m down the plane, rad down the slope
  SceneRun run;

  BlockMode mode() const {
    if (slip > slid) return turn > turned ? BlockMode::slides_and_topples : BlockMode::slides;
    return turn > turned ? BlockMode::topples : BlockMode::stays;
  }
};

Start start(const Variant& v, const Point& p) {
  const double along = 9.81 * std::sin(p.slope * degree), into = -9.81 * std::cos(p.slope * degree);
  const std::string middle = v.dimension == 3 ? ", 0, " : ", ";
  Start start;
  std::vector<std::string> overrides{"gravity=[" + text(along) + middle + text(into) + "]",
                                     "joint_properties.rock.friction_deg=" + text(p.friction)};
  overrides.insert(overrides.end(), v.carried.begin(), v.carried.end());
  start.run = run(v.scene, overrides);
  const std::vector<double> moved = column(start.run, "column_displacement_x_m");
  const std::vector<double> turn =
      column(start.run, v.dimension == 3 ? "column_rotation_y_deg" : "column_rotation_deg");
  for (std::size_t i = 0; i < moved.size(); ++i) {
    start.turn = (v.dimension == 3 ? 1 : -1) * turn[i] * degree;
    // of the lower corner, breadth/2 down the slope and height/2 below the centroid
    start.slip = moved[i] + 0.5 * breadth * (std::cos(start.turn) - 1) - 0.5 * height * std::sin(start.turn);
    if (start.turn > started) break;
  }
  return start;
}

class Toppling : public testing::TestWithParam<Variant> {};

TEST_P(Toppling, HasTheModesOfTheMap) {
  const Variant& v = GetParam();
  CaseReport report("toppling");
  std::map<BlockMode, std::vector<std::vector<double>>> found;
  for (const Point& p : points()) {
    const BlockMode expected = expected_mode(p);
    const Start moved = start(v, p);
    char where[60];
    std::snprintf(where, sizeof where, "slope %.2f, friction %.2f: ", p.slope, p.friction);
    report.record({where + std::string(name_of(expected)) + ", " + v.name,
                   "1",
                   Kind::exact,
                   "Sagaseta (1986), with the border of overturning on an elastic joint",
                   static_cast<double>(expected),
                   {0, 0},
                   "the number of the mode: 0 stays, 1 slides, 2 topples, 3 both"},
                  static_cast<double>(moved.mode()), cost(moved.run));
    std::vector<std::vector<double>>& columns = found[moved.mode()];
    columns.resize(2);
    columns[0].push_back(p.slope);
    columns[1].push_back(p.friction);
  }
  if (v.dimension == 3 || !v.carried.empty()) return;
  for (const auto& [mode, columns] : found)
    write_csv("toppling", "mode_" + std::to_string(static_cast<int>(mode)) + ".csv", {"slope_deg", "friction_deg"},
              columns);
}

INSTANTIATE_TEST_SUITE_P(
    All, Toppling,
    testing::Values(Variant{"plane.toml", "2-D", "Plane", 2}, Variant{"scene.toml", "3-D", "Space", 3},
                    Variant{"plane.toml", "2-D, whole faces", "PlaneOnWholeFaces", 2, {whole_faces}},
                    Variant{"scene.toml", "3-D, whole faces", "SpaceOnWholeFaces", 3, {whole_faces}}),
    [](const auto& chosen) { return chosen.param.test; });

// What the map says of points where statics says something else: inertia enters the balance.
TEST(TopplingMap, IsNotThatOfStatics) {
  std::vector<double> slope, least;
  const double rigid = to_degrees(std::atan(breadth / height)), end = 50;
  for (int i = 0; i <= 100; ++i) {
    slope.push_back(rigid + 1e-9 + (end - rigid) * i / 100);
    least.push_back(to_degrees(reference::least_toppling_friction({breadth, height, slope.back() * degree, 0})));
  }
  write_csv("toppling", "toppling_alone.csv", {"slope_deg", "friction_deg", "rigid_deg"},
            {slope, least, std::vector<double>(slope.size(), rigid)});
  CaseReport report("toppling");
  const double elastic = overturns_at(26);
  report.report("slope that overturns the block on its elastic joint", "deg", elastic,
                "26.565 for a rigid block; the points stand on either side of the elastic border");
  int apart = 0;
  for (const Point& p : points()) {
    const InclinedBlock block{breadth, height, p.slope * degree, p.friction * degree};
    apart += block_mode(block) != block_mode_of_statics(block);
  }
  EXPECT_GE(apart, 3) << "the points distinguish the two maps";
}

// A stage of kind run at its defaults: nothing holds the column up but its inertia. As a fraction of the time of a
// rigid block about its corner, by how much it falls sooner; within `allowed`.
double judge_column(const std::string& which, const std::vector<std::string>& overrides, double allowed,
                    const std::string& because) {
  CaseReport report("toppling");
  const SceneRun run = cases::run("two_blocks.toml", overrides);
  constexpr double b = 1, h = 3, g = 9.81, slope = 20 * degree, turn = 45 * degree;
  const double start = slope - std::atan(b / h);
  const double expected =
      reference::fall_over_time({1, (b * b + h * h) / 3, 0.5 * std::hypot(b, h), start, g}, start + turn);
  const std::vector<double> time = column(run, "time_s"), rotation = column(run, "lower_rotation_deg");
  const auto after = std::find_if(rotation.begin(), rotation.end(), [](double deg) { return deg < -turn / degree; });
  if (after == rotation.end()) throw std::runtime_error("the column does not topple");
  const double found = time[after - rotation.begin()];
  report.record({"time in which a column of two blocks has turned by 45 deg" + which,
                 "s",
                 Kind::limit,
                 "a rigid block about its corner",
                 expected,
                 {0, allowed},
                 because},
                found, cost(run));
  return 1 - found / expected;
}

TEST(TopplingColumn, FallsAsFastAsARigidBlock) {
  const std::string because =
      "the start leans by 1.6 deg only, which elastic joints and the weight that comes on at once change";
  judge_column("", {}, 0.1, because);
  const double sooner = judge_column(", whole faces", {whole_faces}, 0.1, because);
  judge_column(
      ", whole faces, ten times as stiff",
      {whole_faces, "joint_properties.rock.normal_stiffness=100e9", "joint_properties.rock.shear_stiffness=10e9"},
      std::pow(10, -1.0 / 3) * std::abs(sooner),
      "by how much an elastic joint lets a block overturn sooner goes by the power -1/3 of its stiffness");
}

// Goodman & Bray's slope: an angle at which it is known to stand, one at which it is known to fall, and a bracket
SceneRun judge_columns(const std::string& which, const std::vector<std::string>& overrides) {
  CaseReport report("toppling");
  const double expected = to_degrees(reference::stepped_columns_friction({}));
  report.reference("stepped columns, critical friction", expected, "deg");
  SceneRun done = run("columns.toml", overrides);
  const double bar = *done.results.find("critical_friction")->error_bar;
  report.record({"critical friction of columns on steps" + which,
                 "deg",
                 Kind::limit,
                 "limit equilibrium (Goodman & Bray 1976)",
                 expected,
                 {bar + 0.1, 0},
                 "half the bracket, and what 0.14 m of way and elastic corners are worth: 0.05 at a bracket of 0.08"},
                value(done, "critical_friction"), cost(done));
  EXPECT_LE(bar, 0.3);
  return done;
}

TEST(SteppedColumns, ColumnsOnASteppedBaseFallWhereLimitEquilibriumSays) {
  judge_columns("", {"stage.critical.from_deg=40", "stage.critical.to_deg=36", "stage.critical.tolerance_deg=0.51"});
}

// the scene as it stands
TEST(SteppedColumnsLong, ColumnsOnASteppedBaseFallByTheWholeSearch) {
  judge_columns(", whole search", {});
  judge_columns(", whole search on whole faces", {whole_faces});
}

TEST(SteppedColumnsLong, BudgetEnclosesLimitEquilibrium) {
  CaseReport report("toppling");
  judge_budget(report, "toppling", "limit equilibrium (Goodman & Bray 1976)",
               {"columns on steps",
                std::filesystem::path(VOUSSOIR_CASE_DIR) / "columns.toml",
                {},
                to_degrees(reference::stepped_columns_friction({}))});
}

}  // namespace
}  // namespace voussoir::cases
