// Block on an incline: the mode map of sliding and toppling, on both sides of each of its borders.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cases/budget_trial.hpp"
#include "cases/case_tools.hpp"
#include "reference/small/block_on_joint.hpp"
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

// Thresholds of motion. A hinge deforms by T/(k_s a) = 0.07 mm at most while the block rotates by 0.1 rad, the end of
// the start; in equilibrium it rotates by 0.002 rad.
constexpr double slid = 2e-4, turned = 0.02, started = 0.1;  // m, rad, rad
constexpr double duration = 1.2;                             // s, as the scenes state it

struct Point {
  double slope, friction;  // deg
};

struct Variant {
  std::string scene, name, test;
  int dimension;
  std::vector<std::string> carried = {};  // contact model of the faces: a scene's own points, or an override
};

void PrintTo(const Variant& v, std::ostream* out) {
  *out << v.name;
}

// deg: the slope, or for a sliding block the friction angle, at which the block overturns on its elastic joint
double overturns_at(double slope_deg) {
  return to_degrees(reference::overturning_angle(breadth, height, weight * std::cos(slope_deg * degree), stiffness));
}

// two points on either side of each of the four borders, and one far inside each region
constexpr double flat = 20, steep = 35, holding = 40;  // deg
struct Borders {
  double overturns, sliding, both;  // deg
};
std::vector<Point> points_beside(const Borders& border, double apart) {
  return {{flat, flat + apart},
          {flat, flat - apart},
          {border.overturns - apart, holding},
          {border.overturns + apart, holding},
          {steep, border.sliding - apart},
          {steep, border.sliding + apart},
          {steep, border.both - apart},
          {steep, border.both + apart},
          {10, 35},
          {30, 15},
          {40, 50},
          {42, 29}};
}

std::vector<Point> points() {
  return points_beside({overturns_at(26), overturns_at(steep),
                        to_degrees(reference::least_toppling_friction({breadth, height, steep * degree, 0}))},
                       0.3);
}

// the reference's mode, on elastic joints: the joint decides the borders of overturning
BlockMode expected_mode(const Point& p) {
  const InclinedBlock block{breadth, height, p.slope * degree, p.friction * degree};
  const double overturns = overturns_at(p.slope);
  if (std::min(p.slope, p.friction) < overturns) return p.slope < p.friction ? BlockMode::stays : BlockMode::slides;
  // between the elastic border and the rigid one all friction angles above the border hold the block's foot
  if (std::tan(block.slope) <= breadth / height) return BlockMode::topples;
  return block.friction_angle < reference::least_toppling_friction(block) ? BlockMode::slides_and_topples
                                                                          : BlockMode::topples;
}

BlockMode mode_of(double slip, double turn) {
  if (slip > slid) return turn > turned ? BlockMode::slides_and_topples : BlockMode::slides;
  return turn > turned ? BlockMode::topples : BlockMode::stays;
}

// the same for the block on an integrated face contact, loaded as in the scenes
reference::JointStart start_on_joint(const Point& p, double until) {
  reference::BlockOnJoint block{breadth, height, p.slope * degree, p.friction * degree};
  block.normal_stiffness = block.shear_stiffness = stiffness;
  block.dashpot_ratio = 0.1;
  block.ramp = 0.1;
  return reference::start_on_joint(block, until, duration);
}

BlockMode mode_on_joint(const Point& p) {
  const reference::JointStart start = start_on_joint(p, started);
  return mode_of(start.slip, start.turn);
}

// the angle within half a degree of `near` at which the block changes its mode, to 0.001 degrees
template <typename At>
double changes_mode(double near, const At& at) {
  double low = near - 0.5, high = near + 0.5;
  const BlockMode below = mode_on_joint(at(low));
  if (below == mode_on_joint(at(high))) throw std::logic_error("the block has one mode on both sides");
  while (high - low > 1e-3) {
    const double middle = 0.5 * (low + high);
    (mode_on_joint(at(middle)) == below ? low : high) = middle;
  }
  return low;
}

// deg: distance of points on integrated face contacts from their borders, twenty times the bracket of these
constexpr double apart_on_joint = 0.02;

const Borders& borders_on_joint() {
  static const Borders borders = [] {
    const double near = overturns_at(26);
    const auto slope = [](double deg) { return Point{deg, holding}; };
    const auto friction = [](double deg) { return Point{steep, deg}; };
    const double rigid = to_degrees(reference::least_toppling_friction({breadth, height, steep * degree, 0}));
    return Borders{changes_mode(near, slope), changes_mode(near, friction), changes_mode(rigid - 0.3, friction)};
  }();
  return borders;
}

// motion of the lower corner and of the block at the end of the start
struct Start {
  double slip = 0, turn = 0;  // m down the plane, rad down the slope
  SceneRun run;

  BlockMode mode() const { return mode_of(slip, turn); }
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
  const bool whole = !v.carried.empty();
  CaseReport report("toppling");
  std::map<BlockMode, std::vector<std::vector<double>>> found;
  for (const Point& p : whole ? points_beside(borders_on_joint(), apart_on_joint) : points()) {
    const BlockMode expected = whole ? mode_on_joint(p) : expected_mode(p);
    const Start moved = start(v, p);
    char where[60];
    std::snprintf(where, sizeof where, "slope %.2f, friction %.2f: ", p.slope, p.friction);
    report.record({where + std::string(name_of(expected)) + ", " + v.name,
                   "1",
                   Kind::exact,
                   whole ? "Newton's laws of a block on an elastic joint, reference/small"
                         : "Sagaseta (1986), with the border of overturning on an elastic joint",
                   static_cast<double>(expected),
                   {0, 0},
                   "the number of the mode: 0 stays, 1 slides, 2 topples, 3 both"},
                  static_cast<double>(moved.mode()), cost(moved.run));
    std::vector<std::vector<double>>& columns = found[moved.mode()];
    columns.resize(2);
    columns[0].push_back(p.slope);
    columns[1].push_back(p.friction);
  }
  if (v.dimension == 3 || whole) return;
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

class TopplingFoot : public testing::TestWithParam<Variant> {};

// the foot of a toppling block, 0.1 degrees below the friction angle that holds it and 0.1 above
TEST_P(TopplingFoot, SlipsAsFarAsOnAJointThatIsIntegrated) {
  const Variant& v = GetParam();
  CaseReport report("toppling");
  const double both = borders_on_joint().both;
  for (const auto& [friction, which] : {std::pair{both - 0.1, "slips"}, std::pair{both + 0.1, "holds"}}) {
    const Start moved = start(v, {steep, friction});
    report.record(
        {"way of the foot that " + std::string(which) + " by the time the block has turned by 0.1 rad, " + v.name,
         "m",
         Kind::exact,
         "Newton's laws of a block on an elastic joint, reference/small",
         start_on_joint({steep, friction}, moved.turn).slip,
         {1e-7, 5e-4},
         "twice a time step, 0.03 ms, of the 0.2 s in which it slips and the reference's own 1e-4"},
        moved.slip, cost(moved.run));
  }
}

INSTANTIATE_TEST_SUITE_P(All, TopplingFoot,
                         testing::Values(Variant{"plane.toml", "2-D, whole faces", "Plane", 2, {whole_faces}},
                                         Variant{"scene.toml", "3-D, whole faces", "Space", 3, {whole_faces}}),
                         [](const auto& chosen) { return chosen.param.test; });

// The map at points for which statics gives another mode: inertia enters the balance.
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
                "26.565 for a rigid block; the points are on either side of the elastic border");
  const Borders& loaded = borders_on_joint();
  report.report(
      "slope at which the block turns by 0.02 rad within the scene", "deg", loaded.overturns,
      "Newton's laws of a block on an elastic joint; the points on integrated face contacts are on either side");
  report.report("friction angle at which the block turns by 0.02 rad within the scene as it slides", "deg",
                loaded.sliding, "the same");
  report.report("friction angle that holds the foot of a toppling block", "deg", loaded.both, "the same");
  int apart = 0;
  for (const Point& p : points()) {
    const InclinedBlock block{breadth, height, p.slope * degree, p.friction * degree};
    apart += block_mode(block) != block_mode_of_statics(block);
  }
  EXPECT_GE(apart, 3) << "the points distinguish the two maps";
}

// A stage of kind run at its defaults: only inertia delays the fall of the column. As a fraction of the time of a rigid
// block about its corner, by how much it falls sooner; within `allowed`.
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
                 "Newton: a rigid block about its corner",
                 expected,
                 {0, allowed},
                 because},
                found, cost(run));
  return 1 - found / expected;
}

TEST(TopplingColumn, FallsAsFastAsARigidBlock) {
  const std::string because = "the initial lean is only 1.6 deg, which elastic joints and the sudden weight change";
  judge_column("", {}, 0.1, because);
  const double sooner = judge_column(", whole faces", {whole_faces}, 0.1, because);
  judge_column(
      ", whole faces, ten times as stiff",
      {whole_faces, "joint_properties.rock.normal_stiffness=100e9", "joint_properties.rock.shear_stiffness=10e9"},
      std::pow(10, -1.0 / 3) * std::abs(sooner),
      "the time by which a block overturns sooner on an elastic joint is proportional to the power -1/3 of its "
      "stiffness");
}

// Goodman & Bray's slope: an angle at which it is known to be stable, one at which it is known to fail, and a bracket
SceneRun judge_columns(const std::string& which, const std::vector<std::string>& overrides) {
  CaseReport report("toppling");
  const double expected = to_degrees(reference::stepped_columns_friction({}));
  report.reference("stepped columns, critical friction", expected, "deg");
  SceneRun done = run("columns.toml", overrides);
  const double bar = *done.results.find("critical_friction")->error_bar;
  report.record(
      {"critical friction of columns on steps" + which,
       "deg",
       Kind::limit,
       "Goodman & Bray (1976): limit equilibrium",
       expected,
       {bar + 0.1, 0},
       "half the bracket, and the effect of 0.14 m of displacement and of elastic corners: 0.05 at a bracket of 0.08"},
      value(done, "critical_friction"), cost(done));
  EXPECT_LE(bar, 0.3);
  return done;
}

TEST(SteppedColumns, ColumnsOnASteppedBaseFallAtTheAngleOfLimitEquilibrium) {
  judge_columns("", {"stage.critical.from_deg=40", "stage.critical.to_deg=36", "stage.critical.tolerance_deg=0.51"});
}

// the scene as committed
TEST(SteppedColumnsLong, ColumnsOnASteppedBaseFallByTheWholeSearch) {
  judge_columns(", whole search", {});
  judge_columns(", whole search on whole faces", {whole_faces});
}

TEST(SteppedColumnsLong, BudgetEnclosesLimitEquilibrium) {
  CaseReport report("toppling");
  judge_budget(report, "toppling", "Goodman & Bray (1976): limit equilibrium",
               {"columns on steps",
                std::filesystem::path(VOUSSOIR_CASE_DIR) / "columns.toml",
                {},
                to_degrees(reference::stepped_columns_friction({}))});
}

}  // namespace
}  // namespace voussoir::cases
