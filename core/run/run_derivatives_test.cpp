// Derivatives of runs: against closed forms, and against central differences of whole runs.
#include "core/run/run_derivatives.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/output/monitor.hpp"
#include "core/run/twin.hpp"
#include "core/testing/whole_runs.hpp"
#include "text/angle.hpp"

namespace voussoir::run_derivatives_test {
namespace {

using Overrides = std::vector<std::string>;
using SceneWith = std::function<Scene(const Overrides&)>;
// the overrides that change a number of the scene by a distance
using Number = std::function<Overrides(double distance)>;

Number key(const std::string& name, double value) {
  return [=](double distance) { return Overrides{fmt::format("{}={:.17g}", name, value + distance)}; };
}

template <int Dim>
TwinScenes<Dim> twins_of(const SceneWith& scene, const Number& number, double step) {
  return {prepare<Dim>(scene(number(-step))), prepare<Dim>(scene(number(step))), step};
}

template <int Dim>
std::vector<double> monitored(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state) {
  return monitor_values<Dim>(scene.monitors, model, state);
}

template <int Dim>
RunDerivatives derivatives(const SceneWith& scene, const std::vector<TwinScenes<Dim>>& numbers) {
  Progress<Dim> progress;
  RunDerivatives found = run_with_derivatives<Dim>(prepare<Dim>(scene({})), numbers, monitored<Dim>, progress);
  EXPECT_EQ(found.reason, "");
  return found;
}

template <int Dim>
double by(const SceneWith& scene, const Number& number, double step, const std::string& value) {
  const double above = whole_run(prepare<Dim>(scene(number(step)))).results.find(value)->value;
  return (above - whole_run(prepare<Dim>(scene(number(-step)))).results.find(value)->value) / (2 * step);
}

// A block that leans on a joint of 60 degrees to the right, or has none there, under an inclined gravity.
const char* const block_text = R"(
title = "block on a level joint"
preset = "thesis"
statics = "newton"
dimension = 2
gravity = [6.5, -7.5]
density = 2600
[domain]
box = { min = [-1, -1], max = [3, 2] }
[[joints]]
name = "base"
dip = 0
dip_direction = 90
point = [0, 0]
properties = "base"
[[joint_properties]]
name = "base"
normal_stiffness = 1e9
shear_stiffness = 5e8
friction_deg = 25
[[fix]]
below = ["base"]
[[stage]]
name = "settle"
kind = "settle"
[[monitors]]
name = "block"
above = ["base"]
quantities = ["displacement"]
[[monitors]]
name = "base"
joint = "base"
quantities = ["contact_force"]
[[restrain]]
above = ["base"]
rotation = true
)";
const char* const wall_text = R"(
[[joints]]
name = "wall"
dip = 60
dip_direction = 270
point = [1.5, 0]
properties = "wall"
[[joint_properties]]
name = "wall"
normal_stiffness = 5e7
shear_stiffness = 1e3
friction_deg = 0
[[fix]]
below = ["wall"]
)";

SceneWith text_with(const std::string& text, const Overrides& always) {
  return [=](const Overrides& more) {
    Overrides all = always;
    all.insert(all.end(), more.begin(), more.end());
    return parse_scene(text, "scene.toml", all);
  };
}
SceneWith file_with(const std::string& file, const Overrides& always) {
  return [=](const Overrides& more) {
    Overrides all = always;
    all.insert(all.end(), more.begin(), more.end());
    return read_scene(std::string(VOUSSOIR_SOURCE_DIR "/") + file, all);
  };
}

// gravity on a slope, seen from the slope
Number slope(double dip) {
  return [=](double distance) {
    const double angle = (dip + distance) * degree;
    return Overrides{fmt::format("gravity=[{:.17g}, {:.17g}]", 9.81 * std::sin(angle), -9.81 * std::cos(angle))};
  };
}

// ks A u = W sin θ. As the block moves, its joint of length L keeps A = L - u of its area, so that every derivative is
// 1/(1 - u/(L - u)) of that without this.
TEST(RunDerivatives, OfABlockAtRestAreThoseOfItsSpring) {
  const double dip = 20, ks = 5e8, density = 2600, length = 4;
  const SceneWith scene = text_with(block_text, {slope(dip)(0).front(), "equilibrium.unbalanced=1e-9"});
  const RunDerivatives found = derivatives<2>(
      scene, {twins_of<2>(scene, key("joint_properties.base.shear_stiffness", ks), 1e-4 * ks),
              twins_of<2>(scene, key("density", density), 1e-4 * density), twins_of<2>(scene, slope(dip), 5e-3),
              twins_of<2>(scene, key("joint_properties.base.friction_deg", 25), 1e-3)});
  const double u = found.answers.at(0), share = 1 - u / (length - u);
  ASSERT_GT(u, 0);
  EXPECT_NEAR(found.at_rest[0][0].value * ks / u * share, -1, 1e-6);
  EXPECT_NEAR(found.at_rest[1][0].value * density / u * share, 1, 1e-6);
  EXPECT_NEAR(found.at_rest[2][0].value / degree / (u / std::tan(dip * degree)) * share, 1, 1e-6);
  EXPECT_EQ(found.at_rest[3][0].value, 0) << "nothing slips";
}

// It slips on its base: the tangent is unsymmetric.
TEST(RunDerivatives, OfABlockThatSlipsAndLeansAreThoseOfWholeRuns) {
  const SceneWith scene = text_with(std::string(block_text) + wall_text,
                                    {"restrain.1.above=[\"base\", \"wall\"]",
                                     "monitors.block.above=[\"base\", \"wall\"]", "equilibrium.unbalanced=1e-9"});
  const std::vector<std::pair<Number, double>> numbers{{key("joint_properties.base.friction_deg", 25), 25},
                                                       {key("density", 2600), 2600},
                                                       {key("joint_properties.wall.normal_stiffness", 5e7), 5e7},
                                                       {key("joint_properties.base.normal_stiffness", 1e9), 1e9},
                                                       {key("joints.wall.dip", 60), 60}};
  std::vector<TwinScenes<2>> twins;
  for (const auto& number : numbers)
    twins.push_back(twins_of<2>(scene, number.first, 1e-5 * number.second));
  const RunDerivatives found = derivatives<2>(scene, twins);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const double of_runs = by<2>(scene, numbers[n].first, 1e-4 * numbers[n].second, "block_displacement_x");
    EXPECT_NEAR(found.at_rest[n][0].value, of_runs, 1e-4 * std::abs(of_runs)) << n;
    EXPECT_LE(found.at_rest[n][0].bar, 1e-3 * std::abs(of_runs)) << n;
  }
}

// Some 150 blocks, of which many slip: in eight increments of gravity contacts close and open.
TEST(RunDerivatives, OfSlicedRockAreThoseOfWholeRuns) {
  const SceneWith scene = file_with("cases/slicing/rock_mass.toml",
                                    {"statics=newton", "domain.box.max=[5, 4, 2]", "equilibrium.unbalanced=1e-8",
                                     "static_increments=8", "stage.settle.gravity_ramp_s=0.5"});
  const auto way = [](const State<3>& state) {
    Vector<3> sum = Vector<3>::Zero();
    for (const Motion<3>& m : state.bodies.motions)
      sum += m.displacement;
    return sum;
  };
  const std::vector<std::pair<Number, double>> numbers{{key("joint_properties.rock.friction_deg", 35), 57},
                                                       {key("joint_properties.rock.shear_stiffness", 5e8), 5e8}};
  std::vector<TwinScenes<3>> twins;
  for (const auto& number : numbers)
    twins.push_back(twins_of<3>(scene, number.first, 1e-6 * number.second));
  Progress<3> progress;
  const AnswersAtRest<3> answers = [&](const Prepared<3>&, const Model<3>&, const State<3>& state) {
    return std::vector<double>{way(state)[0], way(state)[2]};
  };
  const RunDerivatives found = run_with_derivatives<3>(prepare<3>(scene({})), twins, answers, progress);
  ASSERT_EQ(found.reason, "");
  EXPECT_EQ(found.counters.increments, 8);
  for (std::size_t n = 0; n < numbers.size(); ++n) {
    const double step = 1e-5 * numbers[n].second;
    const Vector<3> above = way(whole_run(prepare<3>(scene(numbers[n].first(step)))).state),
                    below = way(whole_run(prepare<3>(scene(numbers[n].first(-step)))).state);
    for (const int axis : {0, 2}) {
      const double of_runs = (above[axis] - below[axis]) / (2 * step);
      EXPECT_NEAR(found.at_rest[n][axis / 2].value, of_runs, 1e-4 * std::abs(of_runs)) << n << ", axis " << axis;
    }
  }
}

// A stack that leans over: the solver keeps its increment in three parts, of which two end without equilibrium.
TEST(RunDerivatives, OfAnIncrementInPartsAreThoseOfWholeRuns) {
  const SceneWith scene = file_with("cases/overhang/scene.toml", {"statics=newton", "equilibrium.unbalanced=1e-9"});
  const Number density = key("density", 2500);
  const RunDerivatives found = derivatives<3>(scene, {twins_of<3>(scene, density, 2e-3)});
  EXPECT_GT(found.counters.increments, 1);
  const double of_runs = by<3>(scene, density, 0.2, "top_displacement_x");
  EXPECT_NEAR(found.at_rest.at(0).at(0).value, of_runs, 1e-5 * std::abs(of_runs));
}

// Critical friction of a block on a plane, which sticks until it slides: d/d(dip) = 1, and its size does not matter.
TEST(RunDerivatives, OfABlockOnAPlaneAreOnesOfItsDip) {
  const SceneWith scene =
      text_with(std::string(block_text) + R"(
[[stage]]
name = "reduce"
kind = "reduce"
method = "bisection"
from_deg = 60
to_deg = 5
tolerance_deg = 0.01
)",
                {"joint_properties.base.friction_deg=60", "joints.base.dip=5", slope(15)(0).front()});
  const RunDerivatives found =
      derivatives<2>(scene, {twins_of<2>(scene, slope(15), 1e-4), twins_of<2>(scene, key("density", 2600), 1e-3),
                             twins_of<2>(scene, key("joints.base.dip", 5), 1e-4)});
  ASSERT_TRUE(found.critical);
  EXPECT_TRUE(found.critical->near_collapse);
  EXPECT_NEAR(found.critical->level, 20 * degree, 1e-8);
  EXPECT_NEAR(found.critical->by[0].value / degree, 1, 1e-6);
  EXPECT_NEAR(found.critical->by[1].value / degree * 2600, 0, 1e-6);
  EXPECT_NEAR(found.critical->by[2].value / degree, 1, 1e-6) << "the plane is cut again";
}

// Hoek and Bray's plane failure, its crack full of water; closed forms with the water's level kept.
TEST(RunDerivatives, OfAPlaneFailureWithWaterAreThoseOfItsClosedForm) {
  const SceneWith scene = file_with("cases/water/scene.toml", {"statics=newton"});
  const double unit_weight = 9810, density = 2650.3567787971457;
  const Number level = [](double distance) {
    return Overrides{fmt::format("water.crack and joint.table=[[0, 0], [15.547005383792518, {:.17g}]]", 20 + distance)};
  };
  const RunDerivatives found = derivatives<2>(
      scene, {twins_of<2>(scene, key("joints.joint.dip", 35), 5e-5), twins_of<2>(scene, level, 1e-6),
              twins_of<2>(scene, key("domain.planes.face.dip", 60), 5e-5),
              twins_of<2>(scene, key("water.crack and joint.unit_weight", unit_weight), 1e-6 * unit_weight),
              twins_of<2>(scene, key("density", density), 1e-6 * density)});
  ASSERT_TRUE(found.critical);
  const std::vector<RunDerivative>& d = found.critical->by;
  EXPECT_NEAR(found.critical->level / degree, 57.2352326972929, 5e-4);
  const double expected[] = {0.57655036788276, 3.904865284785, -1.1104412921573, 2.695896564177e-3,
                             -1.0171825113298e-3 * 9.81};
  for (std::size_t n = 0; n < d.size(); ++n)
    EXPECT_NEAR(d[n].value / degree, expected[n], 1e-4 * std::abs(expected[n])) << n;
}

// A bolted block: a turn of the plane alone is one of the plane against gravity and against the bolt.
TEST(RunDerivatives, OfABoltedSlopeAreThoseOfItsClosedForm) {
  const SceneWith scene = file_with("cases/support/slope.toml", {"statics=newton"});
  const double density = 5096.839959;
  const RunDerivatives found = derivatives<2>(scene, {twins_of<2>(scene, key("joints.plane.dip", 40), 5e-5),
                                                      twins_of<2>(scene, key("bolts.bolt.yield", 20e3), 2e-2),
                                                      twins_of<2>(scene, key("density", density), 1e-6 * density)});
  ASSERT_TRUE(found.critical);
  const std::vector<RunDerivative>& d = found.critical->by;
  EXPECT_NEAR(d[0].value / degree, 0.99456966172619 + 0.0054303382738063, 1e-4);
  // its slip of a millimetre has turned the bolt
  EXPECT_NEAR(d[1].value / degree * 1e3 / -0.58138031921011, 1, 5e-4);
  EXPECT_NEAR(d[2].value / degree * density / 100 / 0.11627606384202, 1, 5e-4);
}

// Of the wedge's dip, whose joints' histories count: with them frozen these derivatives are 0.6045, 0.5884, 0.5688.
TEST(RunDerivatives, OfAWedgeCarryItsHistories) {
  for (const double ratio : {0.1, 0.5, 1.0}) {
    const auto scene_to = [&](const char* tolerance) {
      return file_with(
          "cases/wedge/scene.toml",
          {"statics=newton", "static_increments=100", fmt::format("stage.reduce.tolerance_deg={}", tolerance),
           fmt::format("joint_properties.rock.shear_stiffness={}", ratio * 10e6)});
    };
    const SceneWith scene = scene_to("1e-3");
    const Number dip = key("joints.A.dip", 40), a = key("joints.A.dip_direction", 130),
                 b = key("joints.B.dip_direction", 220);
    const RunDerivatives found = derivatives<3>(
        scene, {twins_of<3>(scene, dip, 6e-6), twins_of<3>(scene, a, 6e-6), twins_of<3>(scene, b, 6e-6)});
    ASSERT_TRUE(found.critical);
    const std::vector<RunDerivative>& d = found.critical->by;
    const double of_runs = by<3>(scene_to("1e-5"), dip, 0.1, "critical_friction");
    EXPECT_NEAR(d[0].value / degree, of_runs, 1e-3 * of_runs) << ratio;
    EXPECT_TRUE(found.critical->near_collapse);
    // the motion: along the line of intersection, 37.06 degrees steep; the weight of the derivatives: level
    const Vector<3> u = found.critical->motion.head<3>().normalized(),
                    v = found.critical->weight.head<3>().normalized();
    EXPECT_NEAR(std::asin(std::abs(u[2])) / degree, 37.058, 0.3 + ratio);
    EXPECT_LT(std::abs(v[2]), 0.2);
  }
}

// K = U diag(s) V': the smallest singular values and their vectors
TEST(NullVectors, AreThoseOfTheSmallestSingularValue) {
  Eigen::Matrix3d left, right;
  left << 2, -1, 2, 2, 2, -1, -1, 2, 2;
  right << 6, 2, 3, -3, 6, 2, 2, 3, -6;
  left /= 3;
  right /= 7;
  const Eigen::Vector3d values(1e-9, 0.5, 3);
  BlockMatrix<3> k;
  k.lay_out({{0}});
  k.at(0, 0) = left * values.asDiagonal() * right.transpose();
  const TangentFactors<2> factors(k);
  ASSERT_TRUE(factors.regular());
  const NullVectors found = null_vectors<2>(factors, Eigen::VectorXd::Ones(3));
  EXPECT_NEAR(found.smallest, values[0], 1e-6 * values[0]);
  EXPECT_NEAR(found.second, values[1], 1e-6);
  EXPECT_NEAR(std::abs(found.motion.dot(right.col(0))), 1, 1e-12);
  EXPECT_NEAR(std::abs(found.weight.dot(left.col(0))), 1, 1e-12);
}

// The run itself is not changed; a twin costs a few evaluations in each increment.
TEST(RunDerivatives, LeaveTheRunAsItIs) {
  const SceneWith scene = file_with("cases/wedge/scene.toml", {"statics=newton", "static_increments=16"});
  const Prepared<3> prepared = prepare<3>(scene({}));
  std::vector<TwinScenes<3>> twins(20, twins_of<3>(scene, key("joints.A.dip", 40), 6e-6));
  Progress<3> progress;
  const RunDerivatives found = run_with_derivatives<3>(prepared, twins, monitored<3>, progress);
  EXPECT_EQ(found.reason, "");
  EXPECT_EQ(progress.results.state_hash, whole_run(prepared).results.state_hash);
  const TwinCounters& n = found.counters;
  EXPECT_LE(n.back_substitutions, 14 * 20 * n.increments);
  EXPECT_LE(n.evaluations, 16 * 20 * n.increments);
  EXPECT_LE(n.factorisations, n.increments + 4);
}

// The forces at a place belong to the place and the histories at the base alone, also where a joint has closed since,
// of whose parts each has its own history.
TEST(Twin, HasTheForcesOfItsPlaceWhateverCameBefore) {
  const Prepared<3> scene = prepare<3>(file_with("cases/overhang/scene.toml", {"statics=newton"})({}));
  const Progress<3> ended = whole_run(scene);
  Twin<3> twin(scene);
  twin.enter(0);
  const Schedule& schedule = ended.state.schedule;
  twin.begin_increment(schedule);
  const Eigen::VectorXd place = twin.motion_to(ended.state.bodies.motions), none = Eigen::VectorXd::Zero(place.size());
  const Eigen::VectorXd first = twin.residual(schedule, twin.base, place);
  const double size = twin.state().contacts.list.front().force.norm();
  const auto again = [&](const Eigen::VectorXd& before) {
    twin.residual(schedule, twin.base, before);
    return Eigen::VectorXd(twin.residual(schedule, twin.base, place));
  };
  EXPECT_LT((again(place) - first).norm(), 1e-9 * size);
  EXPECT_LT((again(none) - first).norm(), 1e-9 * size);
  EXPECT_LT((again(-place) - first).norm(), 1e-9 * size) << "all joints were open";
}

TEST(RunDerivatives, AreRefusedWithTheReason) {
  const SceneWith wedge = file_with("cases/wedge/scene.toml", {});
  EXPECT_NE(not_differentiable(prepare<3>(wedge({}))).find("does not use Newton's method"), std::string::npos);
  EXPECT_EQ(not_differentiable(prepare<3>(wedge({"statics=newton"}))), "");
  const Prepared<3> one = prepare<3>(wedge({"statics=newton"}));
  EXPECT_EQ(not_twins(one.model, prepare<3>(wedge({"joints.A.dip=40.0001"})).model), "");
  EXPECT_NE(not_twins(one.model, prepare<3>(wedge({"joints.A.dip=75"})).model), "");
  Progress<3> progress;
  const RunDerivatives refused = run_with_derivatives<3>(prepare<3>(wedge({})), {}, monitored<3>, progress);
  EXPECT_FALSE(refused.reason.empty());
  EXPECT_TRUE(refused.at_rest.empty());
  EXPECT_FALSE(refused.critical);
}

}  // namespace
}  // namespace voussoir::run_derivatives_test
