// Which keys of a scene are varied, and the overrides that set them.
#include "app/derivatives/moving_keys.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/scene/scene.hpp"

namespace voussoir::moving_keys_test {
namespace {

using Overrides = std::vector<std::string>;

constexpr const char* slope = R"(dimension = 2
gravity = [0, -10]
density = 2000
domain = { box = { min = [-4, -4], max = [4, 4] }, planes = [{ dip = 45, dip_direction = 270, point = [0, 1], keep = "below" }] }
joints = [{ name = "a", dip = 1, dip_direction = 90, point = [0, 0] },
          { name = "b", dip = 90, dip_direction = 270, point = [2, 0] },
          { name = "c", normal = [0.6, 0.8], point = [1, 0] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30, cohesion = 0 }]
water = [{ name = "rain", table = [[0, 1], [4, 3]] }]
fix = [{ below = ["a"] }]
)";

std::vector<MovingKey> keys_of(const std::string& text) {
  return moving_keys(*parse_scene(text, "keys.toml").tree);
}

bool has(const std::vector<MovingKey>& keys, const std::string& name) {
  return std::ranges::find(keys, name, &MovingKey::key) != keys.end();
}

const MovingKey& named(const std::vector<MovingKey>& keys, const std::string& name) {
  const auto found = std::ranges::find(keys, name, &MovingKey::key);
  if (found == keys.end()) throw std::runtime_error(name + " is not varied");
  return *found;
}

TEST(MovingKeys, AreThoseThatTheSceneStates) {
  const std::vector<MovingKey> keys = keys_of(slope);
  // no cohesion, which is 0; no dip of a plane stated by its normal; no directions in the plane
  for (const char* name : {"joint_properties.rock.cohesion", "joints.c.dip", "joints.a.dip_direction"})
    EXPECT_FALSE(has(keys, name)) << name;
  for (const char* name : {"joint_properties.rock.friction_deg", "domain.planes.1.dip", "water.rain.table, point 2 up",
                           "water.rain.table, all points up", "joints.c.point along its normal", "domain.box.max, y"})
    EXPECT_TRUE(has(keys, name)) << name;
  EXPECT_EQ(named(keys, "water.rain.unit_weight").value, 9810);
  EXPECT_DOUBLE_EQ(named(keys, "density").shown, 100);
  EXPECT_EQ(named(keys, "gravity, its size").overrides(1), Overrides{"gravity=[0, -11]"});
  EXPECT_EQ(named(keys, "water.rain.table, point 2 up").overrides(0.5),
            Overrides{"water.rain.table=[[0, 1], [4, 3.5]]"});
  EXPECT_EQ(named(keys, "joints.c.point along its normal").overrides(10), Overrides{"joints.c.point=[7, 8]"});
}

TEST(MovingKeys, DipsPassZeroAndStopAt90) {
  const std::vector<MovingKey> keys = keys_of(slope);
  EXPECT_EQ(named(keys, "joints.a.dip").overrides(-3), (Overrides{"joints.a.dip=2", "joints.a.dip_direction=270"}));
  EXPECT_EQ(named(keys, "joints.b.dip").above, 0);
  EXPECT_EQ(named(keys, "joint_properties.rock.friction_deg").below, 30);
}

TEST(MovingKeys, DirectionsGoAroundTheCompass) {
  for (const double direction : {0.0, 360.0}) {
    const std::vector<MovingKey> keys = keys_of(
        "dimension = 3\ngravity = [0, 0, -9.81]\ndensity = 2000\ndomain = { box = { min = [-1, -1, -1], max = [1, 1, "
        "1] } }\n"
        "joint_properties = [{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30 }]\n"
        "joints = [{ name = \"a\", dip = 30, dip_direction = " +
        std::to_string(direction) + ", point = [0, 0, 0] }]\n");
    const MovingKey& key = named(keys, "joints.a.dip_direction");
    EXPECT_EQ(key.overrides(-1), Overrides{"joints.a.dip_direction=359"});
    EXPECT_EQ(key.overrides(1), Overrides{"joints.a.dip_direction=1"});
  }
}

// every override is a scene
TEST(MovingKeys, OverridesAreLegal) {
  const Scene scene = parse_scene(slope, "keys.toml");
  for (const MovingKey& key : moving_keys(*scene.tree))
    for (const double step : {-1e-3, 1e-3}) {
      if (-step > key.below || step > key.above) continue;
      EXPECT_NO_THROW(read_tree(*scene.tree, scene.file, key.overrides(step))) << key.key;
    }
}

}  // namespace
}  // namespace voussoir::moving_keys_test
