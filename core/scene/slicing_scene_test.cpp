// Finite joints, kinds of joints, excavations and slicing rules in scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/scene/scene.hpp"

namespace voussoir::slicing_scene_test {
namespace {

// a square of 2 m, a persistent joint x = 0, and the additions of a test
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

TEST(SlicingScene, ATraceEndsByTheRule) {
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

TEST(SlicingScene, KindsJoinAndFixBlocks) {
  EXPECT_EQ(square(trace, {"joints.trace.kind=construction"}).model.bodies.size(), 2u);
  // a boundary joint is cut first, through everything; in the order of the file, the wall would have divided the side
  // below
  for (const auto& [order, expected] : {std::pair("size", 1), std::pair("given", 2)}) {
    const Prepared<2> prepared = square(
        trace, {"joints.trace.kind=boundary", "joints.trace.fixed_side=below", std::string("slicing.order=") + order});
    int fixed = 0;
    for (const Body<2>& body : prepared.model.bodies)
      fixed += body.fixed;
    EXPECT_EQ(fixed, expected) << order;
  }
}

TEST(SlicingScene, AJointConfinedToASubdomainCutsTheBlocksThatItMeets) {
  // a horizontal joint through everything, but only to the right of the wall
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

// the reason for refusing a scene; empty: it is accepted
std::string refusal(const std::string& rest, const std::vector<std::string>& overrides = {}) {
  try {
    square(rest, overrides);
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

std::string level_joint(double x, double y, const std::string& more) {
  return "[[joints]]\nname = \"level\"\ndip = 0\npoint = [" + std::to_string(x) + ", " + std::to_string(y) + "]\n" +
         more;
}

// areas, ascending
std::vector<double> areas(const Prepared<2>& prepared) {
  std::vector<double> all;
  for (const Body<2>& body : prepared.model.bodies)
    all.push_back(body.mass / 2000);
  std::sort(all.begin(), all.end());
  return all;
}

void expect_areas(const Prepared<2>& prepared, const std::vector<double>& expected) {
  const std::vector<double> found = areas(prepared);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], 1e-12) << k;
}

TEST(SlicingScene, AJointEndsAtAnotherOnTheSideOfItsPoint) {
  expect_areas(square(level_joint(0.3, 0.5, "ends_at = \"wall\"\n")), {0.5, 1.5, 2});
  expect_areas(square(level_joint(-0.3, 0.5, "ends_at = [\"wall\"]\n")), {0.5, 1.5, 2});
  const Prepared<2> right = square(level_joint(0.3, 0.5, "ends_at = \"wall\"\n"));
  for (const Body<2>& body : right.model.bodies) {
    if (body.mass < 3999) {
      EXPECT_GT(body.reference[0], 0);
    }
  }
  // for any order of cutting, and with healed: the joint divides the blocks that it reaches
  for (const char* order : {"size", "given", "alternating"})
    for (const char* ends : {"extended", "healed"})
      EXPECT_EQ(square(level_joint(0.3, 0.5, "ends_at = \"wall\"\n") + "[slicing]\n",
                       {std::string("slicing.order=") + order, std::string("slicing.ends=") + ends})
                    .model.bodies.size(),
                3u)
          << order << " " << ends;
  EXPECT_EQ(
      square(level_joint(0.3, 0.5, "ends_at = \"wall\"\n") + "[slicing]\nends = \"ignored\"\n").model.bodies.size(),
      4u);

  // a finite joint, which would be cut last: the infinite one that ends at it comes after it. In the lower right
  // quarter the trace is at x = 0.5, the low joint runs from the wall to it
  const std::string trace_down =
      "[[joints]]\nname = \"trace\"\ndip = 90\ndip_direction = 90\npoint = [0.5, -0.5]\nshape = \"trace\"\nlength = "
      "0.9\n";
  const std::string low = "[[joints]]\nname = \"low\"\ndip = 0\npoint = [0.2, -0.6]\nends_at = [\"wall\", \"trace\"]\n";
  expect_areas(square(level_joint(0, 0, "") + trace_down + low), {0.2, 0.3, 0.5, 1, 1, 1});
  // a chain: a joint that ends at a delayed joint is delayed too
  const std::string upright =
      "[[joints]]\nname = \"upright\"\ndip = 90\ndip_direction = 90\npoint = [0.25, -0.8]\nends_at = \"low\"\n";
  expect_areas(square(level_joint(0, 0, "") + trace_down + low + upright), {0.1, 0.1, 0.3, 0.5, 1, 1, 1});
}

TEST(SlicingScene, AJointEndsAtAnExcavationsFace) {
  const std::string box =
      "[[excavations]]\nname = \"cut\"\nbox = { min = [-0.5, -0.5], max = [0.5, 0.5] }\noutline = true\n";
  // two horizontal joints, one of which comes from the right; it cuts only the block right of the wall, of 2 - 0.5 m2
  const std::string from_right = level_joint(0.8, 0.2, "ends_at = \"cut\"\n");
  expect_areas(square(box + from_right), {0.8 * 1 - 0.3 * 0.5, 1.2 * 1 - 0.7 * 0.5, 1.5});
  expect_areas(square(box + level_joint(0.8, 0.2, "")), {0.65, 0.65, 0.85, 0.85});
  // below the opening: from the right to the line of its right side, which the outline has cut as far as the block
  // goes. Between that line and the wall the rock holds both parts together
  expect_areas(square(box + level_joint(0.8, -0.8, "ends_at = \"wall\"\n")), {0.2, 1.3, 1.5});
  EXPECT_NE(refusal(box + level_joint(0.8, -0.8, "ends_at = \"cut\"\n")).find("misses the excavation 'cut'"),
            std::string::npos);
  // inside: nothing of it remains after the excavation of the opening
  expect_areas(square(box + level_joint(0.2, 0.2, "ends_at = \"cut\"\n")), {1.5, 1.5});
  // through a circle, from both sides, the faces are those that the joint meets
  const std::string circle =
      "[[excavations]]\nname = \"cut\"\ncylinder = { from = [0, 0], radius = 0.5, sides = 16 }\noutline = true\n";
  for (const double x : {0.8, -0.8}) {
    const Prepared<2> prepared = square(circle + level_joint(x, 0.2, "ends_at = \"cut\"\n"));
    EXPECT_EQ(prepared.model.bodies.size(), 3u) << x;
    EXPECT_NEAR(mass(prepared), 2000 * (4 - 16 * 0.25 * std::tan(std::numbers::pi / 16)), 1e-9);
  }
}

TEST(SlicingScene, ImpossibleEndsOfJointsAreRefused) {
  const std::string box =
      "[[excavations]]\nname = \"cut\"\nbox = { min = [-0.5, -0.5], max = [0.5, 0.5] }\noutline = true\n";
  struct Case {
    std::string text, key, says;
  };
  const std::string other = "[[joints]]\nname = \"other\"\ndip = 30\ndip_direction = 90\npoint = [0, 0.3]\n";
  const std::vector<Case> cases{
      {level_joint(0.3, 0.5, "ends_at = \"wal\"\n"), "ends_at", "did you mean 'wall'"},
      {level_joint(0.3, 0.5, "ends_at = \"other\"\n") + other, "ends_at", "comes later"},
      {level_joint(0.3, 0.5, "ends_at = \"S-1\"\n") +
           "[[joint_sets]]\nname = \"S\"\ndip = 90\ndip_direction = 90\nspacing = 0.1\n",
       "ends_at", "joints of sets are cut after"},
      {level_joint(0.3, 0.5, "ends_at = \"level\"\n"), "ends_at", "the joint itself"},
      {level_joint(0.3, 0.5, "ends_at = 5\n"), "ends_at", "list of names"},
      {level_joint(0.3, 0.5, "ends_at = [\"wall\", \"wall\"]\n"), "ends_at", "twice"},
      {level_joint(0.3, 0.5, "") + "[[joints]]\nname = \"bed\"\ndip = 0\npoint = [0.3, 0.6]\nends_at = \"level\"\n",
       "ends_at", "parallel to 'level'"},
      {level_joint(0, 0.5, "ends_at = \"wall\"\n"), "point", "is on 'wall'"},
      {level_joint(0.3, 0.5, "ends_at = \"wall\"\nkind = \"boundary\"\nwhole = \"below\"\n"), "ends_at", "boundary"},
      {box + level_joint(0.5, 0.2, "ends_at = \"cut\"\n"), "point", "is on 'cut'"},
      {box.substr(0, box.find("outline")) + level_joint(0.8, 0.2, "ends_at = \"cut\"\n"), "ends_at", "outline = true"},
      {box + level_joint(0.8, 0.2, "ends_at = \"cut\"\n") +
           "[[joints]]\nname = \"cut\"\ndip = 60\ndip_direction = 90\npoint = [0, 0]\n",
       "ends_at", "a joint and an excavation"},
  };
  for (const Case& c : cases) {
    const std::string message = refusal(c.text);
    EXPECT_EQ(message.find("scene.toml:"), 0u) << c.text << message;
    EXPECT_NE(message.find(c.key), std::string::npos) << c.text << message;
    EXPECT_NE(message.find(c.says), std::string::npos) << c.text << message;
  }
}

TEST(SlicingScene, ATunnelIsExcavated) {
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

// A region that leaves 0.05 m of one of the two blocks, which is cut whatever the least size is, and is then too small.
TEST(SlicingScene, SmallPiecesLeftByAnOutlineAreExcavated) {
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
  refused({"joints.floor.kind=boundary"}, "fixed_side");
  refused({"slicing.most_blocks=2"}, "slicing.most_blocks");
}

}  // namespace
}  // namespace voussoir::slicing_scene_test
