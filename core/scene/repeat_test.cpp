// [[repeat]]: copies of blocks, joints and bolts equal those stated one by one.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/scene/scene.hpp"

namespace voussoir::repeat_test {
namespace {

std::string head(int dimension) {
  return "dimension = " + std::to_string(dimension) + R"(
density = 2000
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 30
[[stage]]
name = "run"
kind = "run"
duration_s = 1
)";
}

Scene parse(int dimension, const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(head(dimension) + text, "scene.toml", overrides);
}

std::vector<std::string> block_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const BlockSpec& block : scene.blocks)
    names.push_back(block.name);
  return names;
}

using Names = std::vector<std::string>;
constexpr double rounding = 1e-14;  // sums of a few coordinates of some metres

template <int Dim>
const Body<Dim>& body(const Prepared<Dim>& prepared, const std::string& name) {
  for (const Body<Dim>& b : prepared.model.bodies)
    if (b.name == name) return b;
  throw std::runtime_error("no block " + name);
}

template <int Dim>
Vector<Dim> centroid(const Prepared<Dim>& prepared, const std::string& name) {
  return prepared.model.origin + body(prepared, name).reference;
}

const std::string stone = "[[blocks]]\nname = \"stone\"\nbox = { min = [0, 0], max = [2, 1] }\nvelocity = [1, 0]\n";

TEST(Repeat, ShiftsAndRotatesBlocksInThePlane) {
  const Prepared<2> prepared = prepare<2>(parse(
      2, stone + "[[repeat]]\nblocks = [\"stone\"]\ncount = 4\nshift = [10, 3]\nturn_deg = 90\nabout = [1, 1]\n"));
  ASSERT_EQ(prepared.model.bodies.size(), 4u);
  // a quarter turn about (1, 1) takes (1, 0.5) to (1.5, 1), then (1, 1.5), then (0.5, 1)
  const Vector<2> turned[] = {{1, 0.5}, {1.5, 1}, {1, 1.5}, {0.5, 1}};
  const Vector<2> velocities[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (int k = 0; k < 4; ++k) {
    const std::string name = "stone-" + std::to_string(k + 1);
    EXPECT_LT((centroid(prepared, name) - turned[k] - k * Vector<2>(10, 3)).norm(), 40 * rounding) << name;
    EXPECT_NEAR(body(prepared, name).mass, 4000, 1e-9);
    const Body<2>& stands = body(prepared, name);
    const std::size_t b = &stands - prepared.model.bodies.data();
    EXPECT_EQ(prepared.state.bodies.motions[b].velocity, velocities[k]) << "quarter turns are exact";
    // upright and level in turn
    double width = 0;
    for (const Vector<2>& v : stands.parts[0].vertices)
      width = std::max(width, 2 * std::abs(v[0]));
    EXPECT_NEAR(width, k % 2 == 0 ? 2 : 1, 40 * rounding) << name;
  }
}

// three statements of one body, rotated about an oblique axis: the same copies, and the rotation is a rotation
TEST(Repeat, RotatesBlocksOfEveryShapeInThreeDimensions) {
  const std::string repeat =
      "[[repeat]]\nblocks = [\"box\", \"planes\", \"vertices\"]\ncount = 3\nshift = [0, 0, 5]\nturn_deg = 37\n"
      "about = [0.3, 0.2, 0.1]\naxis = [1, 2, 2]\n";
  const Prepared<3> prepared = prepare<3>(parse(3, R"(
[[blocks]]
name = "box"
box = { min = [1, 0, 0], max = [2, 1, 0.5] }
[[blocks]]
name = "planes"
planes = [{ normal = [3, 0, 0], offset = 6 }, { normal = [-1, 0, 0], point = [1, 9, 9] }, { normal = [0, 1, 0], offset = 1 },
          { normal = [0, -1, 0], offset = 0 }, { normal = [0, 0, 2], offset = 1 }, { normal = [0, 0, -1], offset = 0 }]
[[blocks]]
name = "vertices"
vertices = [[1, 0, 0], [2, 0, 0], [1, 1, 0], [2, 1, 0], [1, 0, 0.5], [2, 0, 0.5], [1, 1, 0.5], [2, 1, 0.5]]
)" + repeat));
  ASSERT_EQ(prepared.model.bodies.size(), 9u);
  const Vector<3> about(0.3, 0.2, 0.1), axis = Vector<3>(1, 2, 2) / 3;
  for (int k = 0; k < 3; ++k) {
    const Eigen::AngleAxisd turn(k * 37 * std::numbers::pi / 180, axis);
    const Vector<3> expected = about + turn * (Vector<3>(1.5, 0.5, 0.25) - about) + k * Vector<3>(0, 0, 5);
    for (const char* name : {"box-", "planes-", "vertices-"}) {
      const std::string copy = name + std::to_string(k + 1);
      EXPECT_LT((centroid(prepared, copy) - expected).norm(), 20 * rounding) << copy;
      const Body<3>& there = body(prepared, copy);
      EXPECT_NEAR(there.mass, 1000, 1e-9) << copy;
      // its corners are those of the turned box
      for (const Vector<3>& v : there.parts[0].vertices) {
        const Vector<3> back = turn.inverse() * v;
        EXPECT_LT((back.cwiseAbs() - Vector<3>(0.5, 0.5, 0.25)).norm(), 20 * rounding) << copy;
      }
    }
  }
}

TEST(Repeat, RotatesJointsWithTheirOutlinesAndSides) {
  const std::string joint = R"(
[domain]
box = { min = [-9, -9, -9], max = [9, 9, 9] }
[[joints]]
name = "A"
dip = 40
dip_direction = 130
point = [1, 2, 0]
shape = "rectangle"
length = 4
width = 2
)";
  const Scene scene = parse(
      3, joint + "[[repeat]]\njoints = [\"A\"]\ncount = 5\nturn_deg = -72\nabout = [0, 0, 0]\naxis = [0, 0, 1]\n");
  ASSERT_EQ(scene.joints.size(), 5u);
  for (int k = 0; k < 5; ++k) {
    // about the vertical the dip stays, and the dip direction gains 72 degrees clockwise
    const JointSpec& spec = scene.joints[k];
    EXPECT_EQ(spec.name, "A-" + std::to_string(k + 1));
    const double direction = (130 + 72.0 * k) * std::numbers::pi / 180;
    const Vector<3> expected = upward_normal_3d(40 * std::numbers::pi / 180, direction);
    if (k > 0) {
      EXPECT_LT((Eigen::Map<const Vector<3>>(spec.plane.normal.data()) - expected).norm(), rounding) << k;
      ASSERT_EQ(spec.outline.corners.size(), 4u);
      const auto corner = [&](int i) { return Eigen::Map<const Vector<3>>(spec.outline.corners[i].data()); };
      EXPECT_NEAR((corner(1) - corner(0)).norm(), 4, 20 * rounding);
      EXPECT_NEAR((corner(2) - corner(1)).norm(), 2, 20 * rounding);
      EXPECT_NEAR(corner(0)[2], corner(1)[2], 20 * rounding) << "along the strike";
    }
  }
  EXPECT_EQ(prepare<3>(scene).model.joints.size(), 5u);

  // turned upside down: the side below becomes the side above
  const std::string boundary =
      "[domain]\nbox = { min = [-1, -1], max = [1, 1] }\n[[joints]]\nname = \"A\"\ndip = 30\ndip_direction = 90\n"
      "point = [0, 0.5]\nkind = \"boundary\"\nfixed_side = \"above\"\n[[repeat]]\njoints = [\"A\"]\ncount = "
      "2\nturn_deg = "
      "180\nabout = [0, 0]\n";
  const Scene flat = parse(2, boundary);
  EXPECT_EQ(flat.joints[1].fixed_side, JointSide::below);
  EXPECT_NEAR(flat.joints[1].plane.point[1], -0.5, rounding);
  int fixed = 0;
  for (const Body<2>& b : prepare<2>(flat).model.bodies)
    fixed += b.fixed;
  EXPECT_EQ(fixed, 2);
}

TEST(Repeat, RotatesBoltsAndTheirFans) {
  const std::string bolts = R"(
[domain]
box = { min = [-9, -9, -9], max = [9, 9, 9] }
[[joints]]
name = "A"
dip = 0
point = [0, 0, 0]
[[bolts]]
name = "single"
from = [1, 0, -3]
to = [1, 0, 3]
stiffness = 1e8
[[bolts]]
name = "fan"
fan = { centre = [0, 1, 0], axis = [0, 1, 0], from_deg = 45, to_deg = 135, spacing_deg = 45, length = 1 }
repeat = [{ step = [0, 2, 0], count = 2 }]
stiffness = 1e8
[[repeat]]
bolts = ["single", "fan"]
count = 2
turn_deg = 90
about = [0, 0, 0]
axis = [0, 0, 1]
)";
  const Scene scene = parse(3, bolts);
  ASSERT_EQ(scene.bolts.size(), 4u);
  EXPECT_EQ(scene.bolts[1].properties.name, "single-2");
  EXPECT_EQ(scene.bolts[1].from, (std::vector<double>{0, 1, -3}));
  const BoltSpec& fan = scene.bolts[3];
  EXPECT_EQ(fan.fan->centre, (std::vector<double>{-1, 0, 0}));
  EXPECT_EQ(fan.fan->axis, (std::vector<double>{-1, 0, 0}));
  EXPECT_EQ(fan.repeat[0].step, (std::vector<double>{-2, 0, 0}));
  // right and up rotate with the axis, since it stays horizontal
  EXPECT_NEAR(fan.fan->from, std::numbers::pi / 4, rounding);
  // about its own axis the rays rotate
  const Scene rolled = parse(3, bolts, {"repeat.1.axis=[0, 1, 0]", "repeat.1.turn_deg=-30"});
  EXPECT_NEAR(std::abs(rolled.bolts[3].fan->from - rolled.bolts[2].fan->from), std::numbers::pi / 6, rounding);
  EXPECT_NEAR(rolled.bolts[3].fan->to - rolled.bolts[3].fan->from, std::numbers::pi / 2, rounding);
}

TEST(Repeat, NamesCopiesOfCopiesAndPartsOfBodies) {
  const std::string wall = R"(
[[blocks]]
name = "brick"
box = { min = [0, 0], max = [2, 1] }
[[blocks]]
name = "ear"
box = { min = [2, 0], max = [3, 0.5] }
part_of = "brick"
[[blocks]]
name = "other"
box = { min = [0, -2], max = [1, -1] }
[[repeat]]
blocks = ["brick", "ear"]
count = 3
shift = [4, 0]
[[repeat]]
name = "courses"
blocks = ["brick", "ear"]
count = 2
shift = [0.5, 1]
)";
  const Scene scene = parse(2, wall);
  EXPECT_EQ(block_names(scene), (Names{"brick-1-1", "brick-1-2", "brick-2-1", "brick-2-2", "brick-3-1", "brick-3-2",
                                       "ear-1-1", "ear-1-2", "ear-2-1", "ear-2-2", "ear-3-1", "ear-3-2", "other"}));
  const Prepared<2> prepared = prepare<2>(scene);
  EXPECT_EQ(prepared.model.bodies.size(), 7u);
  EXPECT_NEAR(body(prepared, "brick-3-2").mass, 5000, 1e-9);
  EXPECT_NEAR(centroid(prepared, "brick-3-2")[0] - centroid(prepared, "brick-1-1")[0], 8.5, 20 * rounding);

  // overrides: of the repeated table, of the count, of one copy, of its number in the list
  EXPECT_EQ(parse(2, wall, {"repeat.courses.count=3"}).blocks.size(), 19u);
  EXPECT_NEAR(body(prepare<2>(parse(2, wall, {"blocks.brick.box.max=[2, 2]"})), "brick-2-1").mass, 9000, 1e-9);
  const Prepared<2> heavy = prepare<2>(parse(2, wall, {"blocks.brick-2-1.density=3000"}));
  EXPECT_NEAR(body(heavy, "brick-2-1").mass, 7500, 1e-9);
  EXPECT_NEAR(body(heavy, "brick-2-2").mass, 5000, 1e-9);
  EXPECT_EQ(block_names(parse(2, wall, {"blocks.brick-3-3.density=1", "repeat.courses.count=3"})).size(), 19u);
  EXPECT_THROW(parse(2, wall, {"blocks.brick-3-3.density=3000"}), SceneError);
  EXPECT_THROW(parse(2, wall, {"blocks.brick-1.density=3000"}), SceneError) << "it is no block in the end";
}

TEST(Repeat, ATableOfACopysNameChangesIt) {
  const Scene scene = parse(2, stone +
                                   "[[repeat]]\nblocks = [\"stone\"]\ncount = 3\nshift = [3, 0]\n[[blocks]]\nname = "
                                   "\"stone-2\"\ndensity = 3000\n"
                                   "[[blocks]]\nname = \"stone-4\"\nbox = { min = [20, 0], max = [21, 1] }\n");
  EXPECT_EQ(block_names(scene), (Names{"stone-1", "stone-2", "stone-3", "stone-4"}));
  EXPECT_EQ(scene.blocks[1].density, 3000);
  EXPECT_EQ(scene.blocks[1].box->min, (std::vector<double>{3, 0}));
  EXPECT_EQ(scene.blocks[2].density, std::nullopt);

  // a scene with a base can therefore change the repeated table, the repetition and a single copy
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("voussoir_repeat_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "base.toml")
      << head(2) + stone + "[[repeat]]\nname = \"row\"\nblocks = [\"stone\"]\ncount = 3\nshift = [3, 0]\n";
  std::ofstream(folder / "scene.toml") << "base = \"base.toml\"\nrepeat = [{ name = \"row\", count = 4 }]\nblocks = [{ "
                                          "name = \"stone\", density = 2500 }, "
                                          "{ name = \"stone-4\", density = 3000 }]\n";
  const Scene over = read_scene(folder / "scene.toml", {"blocks.stone-1.density=2600"});
  std::filesystem::remove_all(folder);
  ASSERT_EQ(over.blocks.size(), 4u);
  EXPECT_EQ(over.blocks[0].density, 2600);
  EXPECT_EQ(over.blocks[1].density, 2500);
  EXPECT_EQ(over.blocks[3].density, 3000);
}

TEST(Repeat, EndsOfJointsFollowTheCopiedJoint) {
  // steps: a riser at each tread's end
  const std::string steps = R"(
[domain]
box = { min = [-5, -5], max = [5, 5] }
[[joints]]
name = "tread"
dip = 0
point = [0, 0]
[[joints]]
name = "riser"
dip = 90
dip_direction = 90
point = [0.5, 0.5]
ends_at = "tread"
[[repeat]]
joints = ["tread", "riser"]
count = 3
shift = [1, 1]
)";
  const Scene scene = parse(2, steps);
  EXPECT_EQ(scene.joints[4].name, "riser-2");
  EXPECT_EQ(scene.joints[4].ends_at, Names{"tread-2"});
  // four layers, the upper three cut by one, two and three risers
  EXPECT_EQ(prepare<2>(scene).model.bodies.size(), 1u + 2 + 3 + 4);
}

TEST(Repeat, ImpossibleRepeatsAreRefused) {
  const std::string block = "[[blocks]]\nname = \"stone\"\nbox = { min = [0, 0, 0], max = [2, 1, 1] }\n";
  const auto repeat = [](const std::string& keys) { return "[[repeat]]\n" + keys + "\n"; };
  const std::string two = "blocks = [\"stone\"]\ncount = 2\n";
  struct Case {
    std::string text, key, says;
  };
  const std::vector<Case> cases{
      {repeat("count = 2\nshift = [1, 0, 0]"), "repeat.1.blocks", "nothing is repeated"},
      {repeat("blocks = [\"ston\"]\ncount = 2\nshift = [1, 0, 0]"), "repeat.1.blocks", "did you mean 'stone'"},
      {repeat("blocks = 5\ncount = 2\nshift = [1, 0, 0]"), "repeat.1.blocks", "list of names"},
      {repeat("joints = [\"A\"]\ncount = 2\nshift = [1, 0, 0]"), "repeat.1.joints", "no joint named 'A'"},
      {repeat("blocks = [\"stone\"]\nshift = [1, 0, 0]"), "repeat.1.count", "is missing"},
      {repeat("blocks = [\"stone\"]\ncount = 1\nshift = [1, 0, 0]"), "repeat.1.count", "between 2 and 10000"},
      {repeat("blocks = [\"stone\"]\ncount = nan\nshift = [1, 0, 0]"), "repeat.1.count", "finite number"},
      {repeat("blocks = [\"stone\"]\ncount = 2.5\nshift = [1, 0, 0]"), "repeat.1.count", "whole number"},
      {repeat(two), "repeat.1.shift", "would coincide"},
      {repeat(two + "shift = [0, 0, 0]"), "repeat.1.shift", "would coincide"},
      {repeat(two + "shift = [1, 0]"), "repeat.1.shift", "3 numbers"},
      {repeat(two + "turn_deg = 10"), "repeat.1.about", "is missing"},
      {repeat(two + "turn_deg = 10\nabout = [0, 0, 0]"), "repeat.1.axis", "is missing"},
      {repeat(two + "turn_deg = 10\nabout = [0, 0, 0]\naxis = [0, 0, 0]"), "repeat.1.axis", "direction"},
      {repeat(two + "turn_deg = 400\nabout = [0, 0, 0]\naxis = [0, 0, 1]"), "repeat.1.turn_deg", "360"},
      {repeat(two + "shift = [1, 0, 0]\naxis = [0, 0, 1]"), "repeat.1.axis", "without a rotation"},
      {repeat(two + "shift = [1, 0, 0]\nabout = [0, 0, 1]"), "repeat.1.about", "without a rotation"},
      {repeat(two + "shift = [1, 0, 0]\nstep = 3"), "repeat.1.step", "no such key"},
      {repeat(two + "shift = [3, 0, 0]") + repeat("blocks = [\"stone-1\"]\ncount = 2\nshift = [0, 3, 0]") +
           block.substr(0, 10) + "\nname = \"stone-1-2\"\nbox = { min = [9, 0, 0], max = [10, 1, 1] }\ndensity = 0\n",
       "blocks.stone-1-2.density", "greater than 0"},
      {repeat("blocks = [\"stone\"]\ncount = 10000\nshift = [3, 0, 0]") +
           repeat("blocks = [\"stone\"]\ncount = 10000\nshift = [0, 3, 0]"),
       "repeat.2.count", "more than 500000 values"},
      {"[[joints]]\nname = \"A\"\ndip = 40\ndip_direction = 90\npoint = [0, 0, 0]\nshape = \"ellipse\"\nlength = "
       "2\nwidth = 1\n" +
           repeat("joints = [\"A\"]\ncount = 2\nturn_deg = 20\nabout = [0, 0, 0]\naxis = [1, 0, 1]"),
       "joints.A.shape", "strike and dip"},
      {"repeat = 5\n", "repeat", "list of tables"},
      {"[[repeat]]\nblocks = [\"stone\"]\ncount = 2\nshift = [3, 0, 0]\n[[repeat]]\nblocks = [\"stone\"]\ncount = "
       "2\nshift = [0, 3, 0]\n"
       "[[blocks]]\nname = \"stone-2\"\nbox = { min = [9, 0, 0], max = [10, 1, 1] }\n",
       "repeat.1.blocks", "but one of [[blocks]] already has this name"},
  };
  for (const Case& c : cases)
    try {
      const bool plain = c.text.starts_with("repeat");
      parse_scene((plain ? c.text + head(3) : head(3) + c.text) + block, "scene.toml", {});
      ADD_FAILURE() << "was taken: " << c.text;
    } catch (const SceneError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("scene.toml:"), 0u) << message;
      EXPECT_NE(message.find(c.key), std::string::npos) << c.text << message;
      EXPECT_NE(message.find(c.says), std::string::npos) << c.text << message;
    }
  EXPECT_NO_THROW(parse_scene(head(3) + block + repeat(two + "shift = [3, 0, 0]"), "scene.toml", {}));
}

// the results contain the scene with its copies, which reads back to the same scene
TEST(Repeat, IsAbsentFromTheScenesRun) {
  const Scene scene = parse(2, stone + "[[repeat]]\nblocks = [\"stone\"]\ncount = 3\nturn_deg = 25\nabout = [9, 9]\n");
  EXPECT_EQ(scene.tree->find("repeat"), nullptr);
  EXPECT_EQ(scene.tree->find("blocks")->items.size(), 3u);
}

}  // namespace
}  // namespace voussoir::repeat_test
