// Joints with an end, kinds, excavations and slicing rules as a scene states them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

// a square of 2 m, a persistent joint x = 0, and what a test adds
Prepared<2> square(const std::string& rest, const std::vector<std::string>& overrides = {}) {
  const std::string text = R"(
dimension = 2
density = 2000
[domain]
box = { min = [-1, -1], max = [1, 1] }
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 30
[[joints]]
name = "wall"
dip = 90
dip_direction = 90
point = [0, 0]
)" + rest + R"(
[[stage]]
name = "run"
kind = "run"
duration_s = 1
)";
  return prepare<2>(parse_scene(text, "scene.toml", overrides));
}

const std::string trace = R"(
[[joints]]
name = "trace"
dip = 0
point = [0.4, 0.2]
shape = "trace"
length = 1
[slicing]
)";

double mass(const Prepared<2>& prepared) {
  double sum = 0;
  for (const Body<2>& body : prepared.model.bodies)
    sum += body.mass;
  return sum;
}

TEST(SlicingScene, ATraceEndsWhereTheRuleSays) {
  // from -0.1 to 0.9: it cuts both halves, each only in part
  EXPECT_EQ(square(trace).model.bodies.size(), 4u);
  EXPECT_EQ(square(trace, {"slicing.ends=healed"}).model.bodies.size(), 2u);
  EXPECT_EQ(square(trace, {"slicing.ends=healed", "joints.trace.length=1.2"}).model.bodies.size(), 3u);
  EXPECT_EQ(square(trace, {"joints.trace.length=0.8"}).model.bodies.size(), 3u);  // ends at the wall
  EXPECT_EQ(square(trace, {"joints.trace.length=0.8", "slicing.ends=ignored"}).model.bodies.size(), 4u);
  EXPECT_EQ(square(trace, {"joints.trace.length=0.8", "slicing.order=size"}).model.bodies.size(), 3u);
  EXPECT_EQ(square(trace, {"slicing.largest_aspect_ratio=1.5"}).model.bodies.size(), 1u);
  EXPECT_NEAR(mass(square(trace, {"slicing.ends=healed"})), 8000, 1e-9);
}

TEST(SlicingScene, KindsHoldTogetherAndFix) {
  EXPECT_EQ(square(trace, {"joints.trace.kind=construction"}).model.bodies.size(), 2u);
  // a boundary joint is cut first, through everything; as the file has it, the wall had parted what lies below
  for (const auto& [order, expected] : {std::pair("size", 1), std::pair("given", 2)}) {
    const Prepared<2> prepared = square(
        trace, {"joints.trace.kind=boundary", "joints.trace.whole=below", std::string("slicing.order=") + order});
    int fixed = 0;
    for (const Body<2>& body : prepared.model.bodies)
      fixed += body.fixed;
    EXPECT_EQ(fixed, expected) << order;
  }
}

TEST(SlicingScene, AJointConfinedToASubdomainCutsWhatItMeetsThere) {
  // a level joint through everything, but on the right of the wall alone
  const std::string level = "[[joints]]\nname = \"level\"\ndip = 0\npoint = [0, 0.5]\n";
  EXPECT_EQ(square(level).model.bodies.size(), 4u);
  const std::string right =
      "within = { planes = [{ dip = 90, dip_direction = 90, point = [0, 0], keep = \"above\" }] }\n";
  EXPECT_EQ(square(level + right).model.bodies.size(), 3u);
  EXPECT_EQ(square(level + "within = { box = { min = [-0.3, 0], max = [0.2, 1] } }\n").model.bodies.size(), 4u);
  EXPECT_EQ(square(level + "within = { box = { min = [-0.3, 0.6], max = [0.2, 1] } }\n").model.bodies.size(), 2u);

  const std::string set = "[[joint_sets]]\nname = \"S\"\ndip = 0\nspacing = 0.1\narrangement = \"equal\"\n";
  EXPECT_EQ(square(set).model.bodies.size(), 42u);
  EXPECT_EQ(square(set + right).model.bodies.size(), 22u);
  try {
    square(set + "within = { box = { min = [3, 3], max = [4, 4] } }\n");
    ADD_FAILURE() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("joint_sets.S.within"), std::string::npos) << error.what();
  }
}

TEST(SlicingScene, ATunnelIsTakenOut) {
  const std::string tunnel = R"(
[[excavations]]
name = "tunnel"
cylinder = { from = [0.1, 0.1], radius = 0.5, sides = 12 }
outline = true
)";
  const Prepared<2> prepared = square(tunnel);
  EXPECT_EQ(prepared.model.bodies.size(), 2u);
  EXPECT_NEAR(mass(prepared), 2000 * (4 - 12 * 0.25 * std::tan(std::numbers::pi / 12)), 1e-9);
  EXPECT_EQ(prepared.model.joints.size(), 13u);
}

// A region that leaves 0.05 m of one of the two blocks, which is cut whatever the least size is, and then is too small.
TEST(SlicingScene, WhatAnOutlineLeavesTooSmallGoes) {
  const std::string cutting = R"(
[[excavations]]
name = "cutting"
box = { min = [-0.95, -2], max = [0, 2] }
outline = true
)";
  EXPECT_NEAR(mass(square(cutting)), 2000 * (2 + 0.05 * 2), 1e-9);
  const Prepared<2> prepared = square(cutting, {"slicing.smallest_inscribed_radius=0.1"});
  EXPECT_EQ(prepared.model.bodies.size(), 1u);
  EXPECT_NEAR(mass(prepared), 2000 * 2, 1e-9);
}

TEST(SlicingScene, OutlinesInSpace) {
  const std::string text = R"(
dimension = 3
density = 2000
[domain]
box = { min = [-1, -1, -1], max = [1, 1, 1] }
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 30
[[joints]]
name = "floor"
dip = 0
point = [0, 0, 0]
[[joints]]
name = "wall"
dip = 90
dip_direction = 90
point = [0, 0, 0.5]
shape = "polygon"
corners = [[0, -1, 0.2], [0, 1, 0.2], [0, 0, 0.9]]
[slicing]
[[stage]]
name = "run"
kind = "run"
duration_s = 1
)";
  const auto bodies = [&](const std::vector<std::string>& overrides) {
    return prepare<3>(parse_scene(text, "scene.toml", overrides)).model.bodies.size();
  };
  EXPECT_EQ(bodies({}), 3u);
  EXPECT_EQ(bodies({"joints.wall.corners=[[0, -1, -0.2], [0, 1, 0.2], [0, 0, 0.9]]"}), 4u);
  const auto refused = [&](const std::vector<std::string>& values, const std::string& expected) {
    try {
      bodies(values);
      ADD_FAILURE() << values.front();
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  };
  refused({"joints.wall.corners=[[0.1, -1, 0.2], [0, 1, 0.2], [0, 0, 0.9]]"}, "joints.wall.corners.1");
  refused({"joints.wall.corners=[[0, -1, 0.2], [0, 1, 0.2]]"}, "convex polygon");
  refused({"joints.wall.corners=[[0, -1, 0], [0, 1, 0], [0, 0, 0.1], [0, 0, 1]]"}, "convex polygon");
  refused({"joints.floor.shape=trace", "joints.floor.length=1"}, "dimension = 3");
  refused({"joints.floor.shape=rectangle"}, "length");
  refused({"joints.floor.kind=boundary"}, "whole");
  refused({"slicing.most_blocks=2"}, "slicing.most_blocks");
}

}  // namespace
}  // namespace voussoir
