// Monitors on motions made by hand: convergence of a wall, and values measured from the end of a stage.
#include "core/output/monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/run/checkpoint.hpp"
#include "core/run/excavate.hpp"
#include "core/run/history.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::monitor_test {
namespace {

// Four blocks about a square opening of 2 m whose centre is (5, 5): a joint above, one below, and one on each side.
const std::string rock = R"(
dimension = 2
density = 2000
gravity = [0, -10]
domain = { box = { min = [1, 1], max = [9, 9] } }
equilibrium = { unbalanced = 1e-9 }
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 }]
joints = [{ name = "upper", dip = 0, point = [0, 6.5] }, { name = "lower", dip = 0, point = [0, 3] }]
fix = [{ below = ["lower"] }]
[[excavations]]
name = "tunnel"
box = { min = [4, 4], max = [6, 6] }
outline = true
[[stage]]
name = "stress"
kind = "settle"
gravity_ramp_s = 0.1
[[stage]]
name = "dig"
kind = "settle"
excavate = ["tunnel"]
[[stage]]
name = "last"
kind = "settle"
)";

std::string wall(const std::string& angles, const std::string& more = "") {
  return "[[monitors]]\nname = \"wall\"\nquantities = [\"convergence\"]\nexcavation = \"tunnel\"\nangles_deg = " +
         angles + "\n" + more;
}

int body_at(const Model<2>& model, double x, double y) {
  const int b = body_around<2>(model, Vector<2>(x, y) - model.origin);
  EXPECT_GE(b, 0);
  return b;
}

// a rotation of a body about a point of the scene by an angle, then a displacement
void move(const Model<2>& model, State<2>& state, int body, double angle, const Vector<2>& about, const Vector<2>& by) {
  const Vector<2> arm = model.origin + model.bodies[body].reference - about;
  const double c = std::cos(angle), s = std::sin(angle);
  state.bodies.motions[body].rotation.angle = angle;
  state.bodies.motions[body].displacement = Vector<2>(c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]) - arm + by;
}

constexpr double rounding = 1e-14;  // m: sums of a few coordinates of some metres

TEST(Convergence, IsTheMotionOfThePointOfTheWallTowardsTheCentre) {
  const Prepared<2> scene = scene_of(rock + wall("[90, 0, 180, 45]"));
  Model<2> model = scene.model;
  State<2> state = scene.state;
  excavate({"tunnel"}, scene.settings, false, model, state);
  ASSERT_EQ(scene.monitors.size(), 1u);
  for (const double value : monitor_values<2>(scene.monitors, model, state))
    EXPECT_EQ(value, 0);

  // the wall is on the outline: the crown at (5, 6), the sides at (6, 5) and (4, 5), the corner at (6, 6)
  const Vector<2> points[] = {{5, 6}, {6, 5}, {4, 5}, {6, 6}};
  for (int k = 0; k < 4; ++k)
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(scene.monitors[0].wall[k].point[axis], points[k][axis] - model.origin[axis], rounding);

  // the block around the opening rotates by a finite angle about the right side, and is displaced
  const int ring = body_at(model, 5, 6.2);
  const double angle = 0.3, x = 0.02, y = -0.05, c = std::cos(angle), s = std::sin(angle);
  move(model, state, ring, angle, {6, 5}, {x, y});
  const std::vector<double> values = monitor_values<2>(scene.monitors, model, state);
  ASSERT_EQ(values.size(), 4u);
  // the crown's arm from there is (-1, 1), that of the left side (-2, 0), that of the corner (0, 1)
  EXPECT_NEAR(values[0], -(-s + c - 1 + y), rounding);
  EXPECT_NEAR(values[1], -x, rounding);
  EXPECT_NEAR(values[2], -2 * c + 2 + x, rounding);
  EXPECT_NEAR(values[3], -(-s + x + c - 1 + y) / std::sqrt(2.0), rounding);
}

// A tunnel of 8 m along y: the wall is seen from its middle, angles are from x towards z.
TEST(Convergence, InThreeDimensionsIsAtTheMiddleOfTheAxis) {
  const Prepared<3> scene = prepare<3>(parse_scene(R"(
dimension = 3
density = 2500
domain = { box = { min = [-4, 0, -4], max = [4, 10, 4] } }
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 }]
joints = [{ name = "across", dip = 90, dip_direction = 0, point = [0, 5, 0] }]
excavations = [{ name = "tunnel", cylinder = { from = [0, 0, 0], to = [0, 8, 0], radius = 1, sides = 4 }, outline = true }]
[[stage]]
name = "dig"
kind = "settle"
excavate = ["tunnel"]
[[monitors]]
name = "wall"
quantities = ["convergence"]
excavation = "tunnel"
angles_deg = [0, 90]
)",
                                                   "scene.toml", {}));
  const WallPoint &right = scene.monitors.at(0).wall[0], &up = scene.monitors[0].wall[1];
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(right.inwards[k], k == 0 ? -1 : 0, rounding);
    EXPECT_NEAR(up.inwards[k], k == 2 ? -1 : 0, rounding);
    EXPECT_NEAR(up.point[k] + scene.model.origin[k],
                k == 1   ? 4
                : k == 2 ? right.point[0] + scene.model.origin[0]
                         : 0,
                rounding);
  }
  Model<3> model = scene.model;
  State<3> state = scene.state;
  excavate({"tunnel"}, scene.settings, false, model, state);
  const int body = body_around<3>(model, Vector<3>(0, 2, 3) - model.origin);
  ASSERT_GE(body, 0);
  state.bodies.motions[body].displacement = {-0.02, 0.5, -0.03};
  const std::vector<double> values = monitor_values<3>(scene.monitors, model, state);
  EXPECT_NEAR(values[0], 0.02, rounding);
  EXPECT_NEAR(values[1], 0.03, rounding);
}

TEST(Convergence, SumAndMeanAreOfAllPoints) {
  const std::vector<double> moved{0.01, -0.03};
  for (const auto& [over, expected] : {std::pair{"sum", 0.0}, std::pair{"mean", 0.0}}) {
    const Prepared<2> scene = scene_of(rock + wall("[0, 180]", "over = \"" + std::string(over) + "\"\n"));
    Model<2> model = scene.model;
    State<2> state = scene.state;
    excavate({"tunnel"}, scene.settings, false, model, state);
    // a displacement without rotation changes no sum
    move(model, state, body_at(model, 5, 6.2), 0, {0, 0}, {moved[0], moved[1]});
    const std::vector<double> values = monitor_values<2>(scene.monitors, model, state);
    ASSERT_EQ(values.size(), 1u);
    EXPECT_NEAR(values[0], expected, rounding) << over;
    EXPECT_EQ(monitor_columns<2>(scene.monitors)[0].header(), "wall_" + std::string(over) + "_convergence_m");
  }
  // a rotation about the centre moves each of two opposite points inwards by 1 - cos
  for (const auto& [over, factor] : {std::pair{"sum", 2.0}, std::pair{"mean", 1.0}}) {
    const Prepared<2> scene = scene_of(rock + wall("[0, 180]", "over = \"" + std::string(over) + "\"\n"));
    Model<2> model = scene.model;
    State<2> state = scene.state;
    excavate({"tunnel"}, scene.settings, false, model, state);
    move(model, state, body_at(model, 5, 6.2), 0.2, {5, 5}, {0, 0});
    EXPECT_NEAR(monitor_values<2>(scene.monitors, model, state)[0], factor * (1 - std::cos(0.2)), rounding) << over;
  }
}

TEST(Convergence, IsMonitoredBeforeTheExcavation) {
  const Prepared<2> scene = scene_of(rock + wall("[90]"));
  State<2> state = scene.state;
  // the rock of the opening and that about it are still one block, with another centroid
  move(scene.model, state, body_at(scene.model, 5, 5), 0.1, {5, 5}, {0, -0.2});
  EXPECT_NEAR(monitor_values<2>(scene.monitors, scene.model, state)[0], 0.2 + (1 - std::cos(0.1)), rounding);
}

TEST(Since, MeasuresFromTheEndOfAStageThroughAnExcavation) {
  const std::string text = rock + wall("[90, 0]", "since = \"stress\"\n") +
                           "[[monitors]]\nname = \"block\"\nquantities = [\"displacement\", \"rotation\"]\ninside = "
                           "[2, 5]\nsince = \"stress\"\n";
  const Prepared<2> scene = scene_of(text);
  Model<2> model = scene.model;
  State<2> state = scene.state;
  const int block = body_at(model, 5, 5);
  move(model, state, block, 0.1, {5, 5}, {0.3, -0.2});
  // zero before the stage has ended, and at its end
  for (const double value : monitor_values<2>(scene.monitors, model, state))
    EXPECT_EQ(value, 0);
  std::vector<StageEnd<2>> ends{stage_end<2>(0, state)};
  for (const double value : monitor_values<2>(scene.monitors, model, state, ends))
    EXPECT_EQ(value, 0);

  // the excavation moves nothing, though the block has another centroid from then on
  carry(excavate({"tunnel"}, scene.settings, false, model, state), ends[0]);
  for (const double value : monitor_values<2>(scene.monitors, model, state, ends))
    EXPECT_NEAR(value, 0, rounding);
  move(model, state, block, 0.15, {5, 5}, {0.32, -0.25});
  const std::vector<double> values = monitor_values<2>(scene.monitors, model, state, ends);
  ASSERT_EQ(values.size(), 5u);
  EXPECT_NEAR(values[0], 0.05 + (std::cos(0.1) - std::cos(0.15)), rounding);
  EXPECT_NEAR(values[1], -0.02 + (std::cos(0.1) - std::cos(0.15)), rounding);
  // its centroid is the middle of the two joints and the hole; it rotated about (5, 5) by another 0.05
  const Vector<2> arm = model.origin + model.bodies[block].reference - Vector<2>(5, 5);
  const auto at = [&](double angle, int k) {
    const double c = std::cos(angle), s = std::sin(angle);
    return k == 0 ? c * arm[0] - s * arm[1] : s * arm[0] + c * arm[1];
  };
  EXPECT_NEAR(values[2], 0.02 + at(0.15, 0) - at(0.1, 0), rounding);
  EXPECT_NEAR(values[3], -0.05 + at(0.15, 1) - at(0.1, 1), rounding);
  EXPECT_NEAR(values[4], 0.05 * 180 / M_PI, 180 / M_PI * rounding);
}

TEST(Since, InThreeDimensionsRotationsAreThoseSinceThen) {
  Monitor monitor{.name = "b", .followed = {"rotation", Quantity::rotation}};
  monitor.since = 0;
  State<3> state;
  state.bodies.motions.resize(1);
  Model<3> model;
  model.bodies.resize(1);
  const auto about = [](double angle, const Vector<3>& axis) {
    return Rotation<3>{Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis))};
  };
  const Rotation<3> then = about(1, Vector<3>::UnitX());
  state.bodies.motions[0].rotation = then;
  const std::vector<StageEnd<3>> ends{stage_end<3>(0, state)};
  state.bodies.motions[0].rotation.quaternion = about(0.2, Vector<3>::UnitZ()).quaternion * then.quaternion;
  const std::vector<double> values = monitor_values<3>({monitor}, model, state, ends);
  EXPECT_NEAR(values[0], 0, 1e-13);
  EXPECT_NEAR(values[1], 0, 1e-13);
  EXPECT_NEAR(values[2], 0.2 * 180 / M_PI, 1e-13);
}

// A block that has tilted loses rock on one side: its centroid is another from then on, and it has not moved yet.
TEST(Since, ASimulationKeepsItsReferenceThroughAnExcavation) {
  std::string text = rock;
  text.replace(text.find("gravity = [0, -10]"), 18, "gravity = [3, -10]");
  text.replace(text.find("friction_deg = 40"), 17, "friction_deg = 40, sub_contacts = 2");
  text.replace(text.find("min = [4, 4]"), 12, "min = [2, 4]");
  const Prepared<2> scene = scene_of(text +
                                     "[[monitors]]\nname = \"block\"\nquantities = [\"displacement\"]\ninside = "
                                     "[8, 5]\nsince = \"stress\"\n");
  Progress<2> whole = initial_progress(scene);
  ASSERT_TRUE(simulate<2>(scene, whole, {}));
  ASSERT_EQ(whole.results.outcome, Outcome::done) << whole.results.message;
  const auto first = std::ranges::find_if(whole.results.history.rows, [](const auto& row) { return row[1] == 2; });
  ASSERT_NE(first, whole.results.history.rows.end());
  EXPECT_NEAR((*first)[2], 0, rounding);
  EXPECT_NEAR((*first)[3], 0, rounding);
  const int block = body_at(scene.model, 8, 5);
  EXPECT_GT(std::abs(whole.state.bodies.motions[block].rotation.angle), 1e-6) << "else there was nothing to test";
}

// a monitor of the block beside the opening, which measures from the start of a stage
std::string counted(const std::string& stage) {
  return "[[monitors]]\nname = \"" + stage + "\"\nquantities = [\"displacement\"]\ninside = [2, 5]\nsince_start = \"" +
         stage + "\"\n";
}

// The rows of a simulation: nothing until the stage has ended, the same bits after a pause at any step.
TEST(Since, ASimulationMeasuresFromThereAndResumesTheSame) {
  const Prepared<2> scene =
      scene_of(rock + wall("[90]", "since = \"stress\"\n") +
               "[[monitors]]\nname = \"all\"\nquantities = [\"displacement\"]\ninside = [2, 5]\n" + counted("stress") +
               counted("dig") + counted("last"));
  Progress<2> whole = initial_progress(scene);
  ASSERT_TRUE(simulate<2>(scene, whole, {}));
  ASSERT_EQ(whole.results.outcome, Outcome::done) << whole.results.message;
  const History& history = whole.results.history;
  ASSERT_EQ(history.columns[2], "wall_convergence_m");
  double settled = 0;
  for (const std::vector<double>& row : history.rows)
    if (row[1] == 1) {
      EXPECT_EQ(row[2], 0);
      settled = row[4];
    }
  EXPECT_LT(settled, -1e-5) << "the rock has moved in the first stage";
  // from the start of the first stage: as without it; of the second: from the end of the first; of the last: zero until
  // the second has ended
  double dug = 0;
  for (const std::vector<double>& row : history.rows) {
    if (row[1] == 2) dug = row[4];
    EXPECT_EQ(row[6], row[4]);
    EXPECT_EQ(row[8], row[1] == 1 ? 0 : row[4] - settled);
    EXPECT_EQ(row[10], row[1] == 3 ? row[4] - dug : 0);
  }
  EXPECT_GT(dug - settled, 1e-6) << "the excavation has lifted it";
  // the floor's joint, 8 m at 1 GPa/m, supports 4 m2 of rock less, and the crown rises with its block. The equilibrium
  // tolerance is 1e-9 of the mean contact force, at most 1 MN, over the joint's 8 GN/m
  EXPECT_NEAR(history.rows.back()[2], -4 * 2000 * 10 / 8e9, 1e-9 * 1e6 / 8e9);

  for (const long long steps : {5, 400, 900}) {
    Progress<2> progress = initial_progress(scene);
    Watcher<2> watcher;
    watcher.pause = [&](const Progress<2>& now) { return now.state.counters.steps >= steps; };
    if (simulate<2>(scene, progress, watcher)) continue;
    Progress<2> read = read_checkpoint<2>(checkpoint_bytes<2>(progress, "scene"), "scene");
    ASSERT_TRUE(simulate<2>(scene, read, {}));
    EXPECT_EQ(read.results.history.rows, history.rows) << steps;
    EXPECT_EQ(read.results.state_hash, whole.results.state_hash);
  }
}

}  // namespace
}  // namespace voussoir::monitor_test
