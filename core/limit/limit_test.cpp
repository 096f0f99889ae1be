// Rigid-block limit analysis against closed forms and published numbers, and the proofs of its results.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/limit/limit.hpp"
#include "core/limit/mechanism.hpp"
#include "core/limit/without_dilation.hpp"
#include "core/scene/scene.hpp"
#include "core/testing/limit_models.hpp"
#include "text/angle.hpp"

namespace voussoir::limit_test {
namespace {

using namespace limit_models;

constexpr double bracket = 1.01e-6 * degree;  // of find_critical_friction, as the header states it
constexpr double rounding = 1e-9;             // of a small program's sums

int body_named(const Model<2>& model, const std::string& name) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    if (model.bodies[b].name == name) return static_cast<int>(b);
  return -1;
}

// under accelerations
LoadFactor<2> load_factor(const Model<2>& model, const CornerAssembly<2>& assembly, const Vector<2>& dead,
                          const Vector<2>& live) {
  return find_load_factor(assembly, loads_of_acceleration(model, dead), loads_of_acceleration(model, live));
}

LoadFactor<2> pushed(const Model<2>& model, double direction) {
  return load_factor(model, assembly_of(model), model.gravity, {direction * model.gravity.norm(), 0});
}

// of forces on named blocks, under gravity; a point left out is the centroid
struct TestForce {
  std::string name, body;
  std::vector<double> force, point = {};
};

LoadFactor<2> forced(Model<2> model, const std::vector<TestForce>& forces) {
  Change change;
  for (const TestForce& f : forces) {
    ForcePlan plan{.name = f.name, .bodies = {}, .force = f.force, .point = f.point, .factor = {}};
    plan.bodies.names = {f.body};
    change.force.push_back(plan);
  }
  model = apply(model, change);
  const Loads<2> dead = loads_of_acceleration(model, model.gravity),
                 live = loads_of_applied_forces(model, model.applied);
  const double gravity = model.gravity.norm(), pushed_by = acceleration_of(model, live);
  return find_load_factor(corner_assembly(model, gravity > 0 ? gravity : pushed_by > 0 ? pushed_by : 1), dead, live);
}

void expect_proven(const LoadFactor<2>& found) {
  EXPECT_LE(found.evidence.gap, rounding);
  EXPECT_LE(found.evidence.out_of_balance, rounding);
  EXPECT_LE(found.evidence.inadmissible, rounding);
}

// ---- interfaces ----------------------------------------------------------------------------------------------------

TEST(Interfaces, AreTheCommonSegmentsOfFaces) {
  const Model<2> model = model_of({{"floor", box(-5, -1, 5, 0), true},
                                   {"wall", box(2, 0, 3, 5), true},
                                   {"low", box(0, 0, 2, 1)},
                                   {"high", box(1, 1, 2, 3)},
                                   {"tip", {{0.5, 1}, {0.8, 2}, {0.2, 2}}}});
  const CornerAssembly<2> assembly = assembly_of(model);
  const auto length_between = [&](const std::string& one, const std::string& other) {
    double length = 0;
    for (const CornerFace<2>& face : assembly.faces) {
      const std::string &a = model.bodies[face.body_a].name, &b = model.bodies[face.body_b].name;
      if (!(a == one && b == other) && !(a == other && b == one)) continue;
      const Vector<2> ahead = model.bodies[face.body_b].reference - model.bodies[face.body_a].reference;
      EXPECT_GT(face.normal.dot(ahead), 0) << one << ", " << other;
      EXPECT_EQ(face.friction, 30 * degree);
      length += face.area();
    }
    return length;
  };
  EXPECT_NEAR(length_between("floor", "low"), 2, rounding);
  EXPECT_NEAR(length_between("wall", "low"), 1, rounding);
  EXPECT_NEAR(length_between("wall", "high"), 2, rounding);
  EXPECT_NEAR(length_between("low", "high"), 1, rounding);
  EXPECT_EQ(length_between("low", "tip"), 0) << "a corner on a face";
  EXPECT_EQ(length_between("floor", "wall"), 0) << "both are fixed";
  EXPECT_EQ(assembly.faces.size(), 4u);
}

// ---- closed forms --------------------------------------------------------------------------------------------------

TEST(CriticalFriction, OfABlockOnAnInclineIsTheDip) {
  for (const double dip : {3.0, 30.0, 60.0, 80.0}) {
    const CriticalStrength<2> found = critical_friction(block_on_plate(2, 0.1, dip * degree));
    ASSERT_EQ(found.status, LimitStatus::found);
    EXPECT_LT(found.collapses, dip * degree);
    EXPECT_GE(found.stands, dip * degree);
    EXPECT_LE(found.stands - found.collapses, bracket);
    EXPECT_LE(found.evidence.programs, 29);
    EXPECT_GT(found.missing, 0);
  }
}

TEST(CriticalFriction, IsFoundForTheNamedPropertiesOnly) {
  Model<2> model = block_on_plate(2, 0.1, 40 * degree, 50);
  model.properties.push_back(model.properties[0]);
  model.properties[1].name = "unused";
  const CornerAssembly<2> assembly = assembly_of(model);
  EXPECT_NEAR(critical_friction(model, {"rock"}).stands, 40 * degree, bracket);
  EXPECT_EQ(critical_friction(model, {"unused"}).status, LimitStatus::carries_any);
  model.properties[0].friction = 35 * degree;
  EXPECT_EQ(critical_friction(model, {"unused"}).status, LimitStatus::carries_nothing);
  EXPECT_THROW(critical_friction(model, {"roc"}), std::out_of_range);
}

// a pebble on the incline is found although the rock beside it is stable
TEST(CriticalFriction, IsThatOfTheLightestBlockToo) {
  const double dip = 30 * degree;
  const Model<2> model = model_of({{"plate", turned(box(-3, -1, 3, 0), dip), true},
                                   {"pebble", turned(box(0, 0, 1e-3, 1e-3), dip)},
                                   {"ground", box(-200, -200, 200, -100), true},
                                   {"rock", box(-100, -100, 100, -50)}});
  EXPECT_NEAR(critical_friction(model).stands, dip, bracket);
}

// a slender block topples whatever the friction, unless it cannot rotate
TEST(CriticalFriction, DoesNotPreventToppling) {
  Model<2> model = block_on_plate(1, 4, 20 * degree);
  CriticalStrength<2> found = critical_friction(model);
  EXPECT_EQ(found.status, LimitStatus::carries_nothing);
  EXPECT_NE(found.state.velocities[body_named(model, "block")].spin[0], 0);

  model.bodies[body_named(model, "block")].free_rotation = {false};
  found = critical_friction(model);
  EXPECT_EQ(found.status, LimitStatus::found);
  EXPECT_NEAR(found.stands, 20 * degree, bracket);
}

TEST(CriticalFriction, IsNotFoundIfNothingCanMoveOrLoad) {
  Model<2> model = block_on_plate(1, 1, 0);
  EXPECT_EQ(critical_friction(model).status, LimitStatus::carries_any) << "flat";
  model.gravity.setZero();
  EXPECT_EQ(critical_friction(model).status, LimitStatus::no_load);
  EXPECT_EQ(pushed(model, 1).status, LimitStatus::no_load);
  for (Body<2>& body : model.bodies)
    body.fixed = true;
  EXPECT_EQ(critical_friction(model).status, LimitStatus::nothing_free);
  EXPECT_EQ(pushed(model, 1).status, LimitStatus::nothing_free);
}

TEST(LoadFactor, OfABlockIsItsSlendernessOrItsFriction) {
  const LoadFactor<2> tips = pushed(block_on_plate(1, 4, 0, 40), 1), slides = pushed(block_on_plate(4, 1, 0, 40), 1);
  EXPECT_NEAR(tips.factor, 1.0 / 4, rounding);
  EXPECT_NEAR(slides.factor, std::tan(40 * degree), rounding);
  expect_proven(tips);
  expect_proven(slides);
}

// the upper of two unit squares, shifted to the right, tips alone or with the lower one
TEST(LoadFactor, OfAnOverhangingStackIsThatOfItsLeastStablePart) {
  for (const double shift : {0.1, 0.3, 0.4, 0.49}) {
    const Model<2> model = model_of({{"floor", box(-5, -1, 5, 0), true},
                                     {"low", box(-0.5, 0, 0.5, 1)},
                                     {"high", box(shift - 0.5, 1, shift + 0.5, 2)}},
                                    80);
    EXPECT_NEAR(pushed(model, 1).factor, std::min((0.5 - shift) / 0.5, (0.5 - shift / 2) / 1), rounding) << shift;
    EXPECT_NEAR(pushed(model, -1).factor, std::min(0.5 / 0.5, (0.5 + shift / 2) / 1), rounding) << shift;
  }
  const Model<2> falls = model_of(
      {{"floor", box(-5, -1, 5, 0), true}, {"low", box(-0.5, 0, 0.5, 1)}, {"high", box(0.01, 1, 1.01, 2)}}, 80);
  const LoadFactor<2> found = pushed(falls, 1);
  EXPECT_EQ(found.status, LimitStatus::carries_nothing);
  const Mechanism<2> mechanism = describe_mechanism(falls, found.state.velocities);
  ASSERT_EQ(mechanism.moving.size(), 1u);
  EXPECT_EQ(mechanism.moving[0].body, body_named(falls, "high"));
  ASSERT_TRUE(mechanism.moving[0].centre);
  EXPECT_NEAR((*mechanism.moving[0].centre - Vector<2>(0.5, 1)).norm(), 0, 1e-6) << "over the lower one's edge";
}

TEST(LoadFactor, OfCohesionOnAnInclineIsCoulombs) {
  const double dip = 50 * degree, cohesion = 3e4, length = 2, height = 0.5;
  const Model<2> model = block_on_plate(length, height, dip, 30);
  CornerAssembly<2> assembly = assembly_of(model);
  ASSERT_EQ(assembly.faces.size(), 1u);
  EXPECT_EQ(load_factor(model, assembly, {0, 0}, model.gravity).factor, 0) << "nothing else resists";
  assembly.faces[0].cohesion = cohesion;
  const double weight = length * height * 2000 * 10;
  const LoadFactor<2> found = load_factor(model, assembly, {0, 0}, model.gravity);
  EXPECT_NEAR(found.factor, cohesion * length / (weight * (std::sin(dip) - std::cos(dip) * std::tan(30 * degree))),
              rounding);

  // on a flatter joint friction alone supports any weight
  const Model<2> flat = block_on_plate(length, height, 20 * degree, 30);
  EXPECT_EQ(load_factor(flat, assembly_of(flat), {0, 0}, flat.gravity).status, LimitStatus::carries_any);
}

// ---- forces at points ----------------------------------------------------------------------------------------------

// a column 1 x 3 of weight 60 kN/m
Model<2> column(double friction_deg = 40) {
  return block_on_plate(1, 3, 0, friction_deg);
}
constexpr double column_weight = 1 * 3 * 2000 * 10;

// about its edge: F y = W b/2; or, if friction fails before, F = W tan(friction)
TEST(AppliedForces, TipAColumnAboutItsEdgeOrPushItAway) {
  const double weight = column_weight;
  for (const double height : {0.5, 1.5, 2.0, 3.0})
    for (const double side : {1.0, -1.0}) {
      const LoadFactor<2> found = forced(column(), {{"push", "block", {side * 1e3, 0}, {-0.5 * side, height}}});
      ASSERT_EQ(found.status, LimitStatus::found);
      const double tips = weight * 0.5 / height, slides = weight * std::tan(40 * degree);
      EXPECT_NEAR(1e3 * found.factor, std::min(tips, slides), rounding * weight) << height;
      expect_proven(found);
      const bool turns = std::abs(found.state.velocities[body_named(column(), "block")].spin[0]) > 1e-6;
      EXPECT_EQ(turns, tips < slides);
    }
  // through its centroid, and obliquely at a corner: about the edge at (0.5, 0), gravity's lever is 0.5
  EXPECT_NEAR(forced(column(), {{"push", "block", {weight, 0}}}).factor, 0.5 / 1.5, rounding);
  const LoadFactor<2> oblique = forced(column(), {{"rope", "block", {weight, -2 * weight}, {0.5, 3}}});
  EXPECT_NEAR(oblique.factor, 0.5 / 3, rounding) << "a vertical force above the edge has no lever arm";
}

// several on one block are added; two that cancel are a couple, which tips by its moment only
TEST(AppliedForces, OnOneBlockAreAdded) {
  const double weight = column_weight;
  EXPECT_NEAR(
      forced(column(), {{"low", "block", {weight, 0}, {-0.5, 1}}, {"high", "block", {weight, 0}, {-0.5, 2}}}).factor,
      0.5 / 3, rounding);
  const LoadFactor<2> couple =
      forced(column(), {{"low", "block", {-weight, 0}, {-0.5, 1}}, {"high", "block", {weight, 0}, {-0.5, 3}}});
  EXPECT_NEAR(couple.factor, 0.5 / 2, rounding);
  expect_proven(couple);
}

TEST(AppliedForces, ActWithoutGravity) {
  Model<2> model = column();
  model.gravity.setZero();
  const LoadFactor<2> away = forced(model, {{"pull", "block", {1, 3}, {0, 3}}});
  ASSERT_EQ(away.status, LimitStatus::found);
  EXPECT_EQ(away.factor, 0);
  EXPECT_EQ(forced(model, {{"press", "block", {0.4, -3}, {0, 3}}}).status, LimitStatus::carries_any);
  EXPECT_EQ(forced(model, {{"tip", "block", {0.6, -3}, {0, 3}}}).factor, 0)
      << "its line of action meets the ground beyond the edge";
}

// for any magnitude; on fixed blocks they are no load
TEST(AppliedForces, OfAnySize) {
  const double weight = column_weight;
  for (const double size : {1e-9, 1e-3, 1e12})
    EXPECT_NEAR(forced(column(), {{"push", "block", {size, 0}, {-0.5, 3}}}).factor * size / weight, 0.5 / 3, rounding)
        << size;
  EXPECT_EQ(forced(column(), {{"push", "plate", {1, 0}}}).status, LimitStatus::no_load);
  Model<2> rail = column();
  const int block = body_named(rail, "block");
  rail.bodies[block].free_translation = {false, true};
  rail.bodies[block].free_rotation = {false};
  EXPECT_EQ(forced(rail, {{"push", "block", {1, 0}}}).status, LimitStatus::no_load);
  EXPECT_NEAR(forced(rail, {{"lift", "block", {0, 2 * weight}}}).factor, 0.5, rounding);
}

// ---- slopes of many blocks -----------------------------------------------------------------------------------------

// Equilibrium and cone at `stands`, velocities and their power at `collapses`: summed here independently.
void expect_proven(const Model<2>& model, const CornerAssembly<2>& assembly, const CriticalStrength<2>& found) {
  std::vector<Vector<3>> load(model.bodies.size(), Vector<3>::Zero());
  double weight = 0, power = 0, fastest_closing = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (model.bodies[b].fixed) continue;
    load[b].head<2>() = model.bodies[b].mass * model.gravity;
    weight += load[b].norm();
    power += load[b].head<2>().dot(found.state.velocities[b].velocity);
  }
  for (std::size_t i = 0; i < assembly.faces.size(); ++i) {
    const CornerFace<2>& face = assembly.faces[i];
    const Vector<2> n = face.normal, t(-n[1], n[0]);
    for (int k = 0; k < 2; ++k) {
      const Vector<2>& on_b = found.state.forces[i][k];
      EXPECT_LE(std::abs(on_b.dot(t)), std::tan(found.stands) * on_b.dot(n) + rounding * weight);
      const auto point_velocity = [&](int body) {
        const BodyVelocity<2>& v = found.state.velocities[body];
        return Vector<2>(v.velocity + cross(v.spin, face.corners[k] - model.bodies[body].reference));
      };
      const Vector<2> apart = point_velocity(face.body_b) - point_velocity(face.body_a);
      fastest_closing = std::max(fastest_closing, std::tan(found.collapses) * std::abs(apart.dot(t)) - apart.dot(n));
      for (const auto& [body, sign] : {std::pair(face.body_b, 1.0), std::pair(face.body_a, -1.0)}) {
        load[body].head<2>() += sign * on_b;
        load[body][2] += sign * moment(face.corners[k] - model.bodies[body].reference, on_b)[0];
      }
    }
  }
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    EXPECT_LE(model.bodies[b].fixed ? 0 : load[b].norm(), (rounding + 2 * found.evidence.out_of_balance) *
                                                              model.bodies[b].mass * model.gravity.norm() *
                                                              (1 + model.bodies[b].radius));
  EXPECT_LE(found.evidence.out_of_balance, 1e-7) << "of a block's weight";
  EXPECT_GT(power, 0);
  EXPECT_LE(fastest_closing, rounding) << "associated flow";
}

// cases/slump: 15.335 by another rigid-block limit analysis, published with three decimals
TEST(Slump, RotatesItsOuterLayerAt15335) {
  const Model<2> model =
      prepare<2>(read_scene(std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "cases/slump/scene.toml")).model;
  const CornerAssembly<2> assembly = assembly_of(model);
  EXPECT_EQ(assembly.faces.size(), 42u) << "three layers of seven blocks: as many below as behind";
  const CriticalStrength<2> found = critical_friction(model);
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_NEAR(found.stands / degree, 15.335, 0.001);
  EXPECT_LT(found.evidence.gap, 1e-3 * found.missing) << "else the lower end of the bracket is not proven";
  expect_proven(model, assembly, found);

  // the outer layer's seven blocks rotate together, nothing else moves
  const Mechanism<2> mechanism = describe_mechanism(model, found.state.velocities);
  ASSERT_EQ(mechanism.moving.size(), 7u);
  EXPECT_EQ(mechanism.turning, 7);
  const double spin = found.state.velocities[mechanism.moving[0].body].spin[0];
  EXPECT_LT(spin, 0) << "backwards: the feet move out of the slope, to the left";
  for (const BlockMotion<2>& motion : mechanism.moving) {
    EXPECT_NEAR(found.state.velocities[motion.body].spin[0], spin, 1e-6 * std::abs(spin));
    const Vector<2> centroid = model.origin + model.bodies[motion.body].reference;
    EXPECT_LT(centroid[0] * std::sin(60 * degree) - centroid[1] * std::cos(60 * degree), 4) << "behind the outer layer";
  }
}

// Goodman & Bray's (1976) slope, as in Hoek & Bray (1981, chapter 9): sixteen columns 10 m thick on a base of 30
// degrees stepped by b = 1 m, which shorten by a1 = 5 m per step below the crest and by a2 = 5.2 m above it.
constexpr int columns = 16, crest = 10;
constexpr double thickness = 10, step = 1, below = 5, above = 5.2, base_dip = 30 * degree;

double column_height(int n) {
  return n <= crest ? n * (below - step) : crest * (below - step) - (n - crest) * (above + step);
}

Model<2> toppling_slope() {
  std::vector<TestBlock> blocks;
  for (int n = 1; n <= columns; ++n) {
    const double left = (n - 1) * thickness, right = n * thickness, bottom = n * step;
    blocks.push_back(
        {"column " + std::to_string(n), turned(box(left, bottom, right, bottom + column_height(n)), base_dip)});
    // its riser is inclined backwards, so that it supports no column from behind
    blocks.push_back({"step " + std::to_string(n),
                      turned({{left + 1, -5}, {right + 1, -5}, {right, bottom}, {left, bottom}}, base_dip), true});
  }
  return model_of(blocks);
}

// Goodman & Bray's own recursion: the force that the lowest column needs at its foot, in units of weight
double toe_force(double friction) {
  const double mu = std::tan(friction), s = std::sin(base_dip), c = std::cos(base_dip);
  double push = 0;
  for (int n = columns; n >= 1; --n) {
    const double height = column_height(n), weight = height * thickness;
    const double from_above = n < crest ? height : height - above, to_below = n <= crest ? height - below : height;
    double topples = push;
    if (n > 1) topples = (push * (from_above - thickness * mu) + weight / 2 * (height * s - thickness * c)) / to_below;
    const double slides = push - weight * (c * mu - s) / (1 - mu * mu);
    push = std::max({0.0, n > 1 ? topples : 0.0, slides});
  }
  return push;
}

// Limit equilibrium finds 38.15, and so does limit analysis of joints that do not dilate; those that do stand at 33.4.
TEST(Toppling, OfJointsThatDoNotDilateIsGoodmanAndBrays) {
  double stands = 38.2 * degree, falls = 38.1 * degree;
  ASSERT_GT(toe_force(falls), 0);
  ASSERT_EQ(toe_force(stands), 0) << "the geometry is Goodman & Bray's";
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (stands + falls);
    (toe_force(middle) > 0 ? falls : stands) = middle;
  }

  const Model<2> model = toppling_slope();
  const CornerAssembly<2> assembly = assembly_of(model);
  const CriticalStrength<2> dilating = critical_friction(model);
  ASSERT_EQ(dilating.status, LimitStatus::found);
  EXPECT_NEAR(dilating.stands / degree, 33.445414603, 2e-6);
  // the three columns at the toe slide, the next ones up to the crest topple
  const Mechanism<2> mechanism = describe_mechanism(model, dilating.state.velocities);
  ASSERT_EQ(mechanism.moving.size(), 10u);
  for (const BlockMotion<2>& motion : mechanism.moving)
    EXPECT_EQ(motion.rotation_fraction > 1e-3, std::stoi(model.bodies[motion.body].name.substr(7)) > 3);
  expect_proven(model, assembly, dilating);

  const StrengthWithoutDilation<2> found = find_critical_friction_without_dilation(
      assembly, loads_of_acceleration(model, model.gravity), faces_of(assembly, {}), dilating);
  ASSERT_EQ(found.status, LimitStatus::found);
  ASSERT_TRUE(found.weakest && found.strongest);
  EXPECT_TRUE(found.settled);
  for (const EndOfFactor& end : {*found.weakest, *found.strongest}) {
    EXPECT_NEAR(end.factor / degree, stands / degree, 1e-6);
    EXPECT_LE(std::abs(end.factor - stands), end.error);
    EXPECT_LE(end.error / degree, 2e-4);
  }
}

}  // namespace
}  // namespace voussoir::limit_test
