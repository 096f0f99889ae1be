// Errors of monitors of an opening's wall, and of motion since a stage.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/scene_error.hpp"
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_monitors_test {
namespace {

using bad_scenes::complaint_about;

const std::string rock = R"(
dimension = 2
gravity = [0, -10]
density = 2500
domain = { box = { min = [-4, -4], max = [4, 4] } }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 }]
joints = [{ name = "bed", dip = 0, point = [0, -3] }, { name = "side", dip = 90, dip_direction = 90, point = [2, 0] }]
fix = [{ below = ["bed"] }]
excavations = [{ name = "tunnel", cylinder = { from = [0, 0], radius = 1 }, outline = true },
               { name = "bench", box = { min = [-4, -2.5], max = [2, -1] }, outline = true },
               { name = "cut", planes = [{ dip = 0, point = [0, 3.5], keep = "above" }], outline = true },
               { name = "half", box = { min = [2.5, -1], max = [3.5, 1] }, outline = true, planes = [{ dip = 0, point = [0, 0.5], keep = "above" }] }]
[[stage]]
name = "stress"
kind = "settle"
[[stage]]
name = "dig"
kind = "settle"
excavate = ["tunnel"]
[[stage]]
name = "later"
kind = "settle"
excavate = ["bench", "cut", "half"]
)";

std::string monitor(const std::string& keys) {
  return "[[monitors]]\nname = \"m\"\n" + keys + "\n";
}
const std::string wall = "quantities = [\"convergence\"]\nexcavation = \"tunnel\"\n",
                  block = "inside = [3.8, 0]\nquantities = [\"displacement\"]\n";

TEST(BadMonitors, OfWallsAndOfStagesAreRefusedWithAReasonAndARepair) {
  EXPECT_EQ(complaint_about(rock + monitor(wall + "angles_deg = [90, 0]\nsince = \"stress\"")), "");
  EXPECT_EQ(complaint_about(rock + monitor(block + "since = \"dig\"")), "");
  EXPECT_EQ(complaint_about(rock + monitor(block + "since_start = \"later\"")), "");
  struct Case {
    std::string text, key, says;
  };
  const std::vector<Case> cases{
      {monitor(wall), "angles_deg", "is missing"},
      {monitor(wall + "angles_deg = []"), "angles_deg", "list of numbers"},
      {monitor(wall + "angles_deg = 90"), "angles_deg", "list"},
      {monitor(wall + "angles_deg = [400]"), "angles_deg", "360"},
      {monitor("quantities = [\"convergence\"]\nangles_deg = [90]"), "excavation", "is missing"},
      {monitor("quantities = [\"convergence\"]\nangles_deg = [90]\nexcavation = \"tunel\""), "excavation", "tunnel"},
      {monitor("quantities = [\"convergence\"]\nangles_deg = [90]\nexcavation = \"cut\""), "excavation", "planes only"},
      {monitor("quantities = [\"convergence\"]\nangles_deg = [90]\nexcavation = \"half\""), "excavation", "its own"},
      {monitor("quantities = [\"convergence\", \"displacement\"]\nangles_deg = [90]\nexcavation = \"tunnel\""),
       "quantities", "convergence only"},
      {monitor(wall + "angles_deg = [90]\ninside = [3, 0]"), "excavation", "remove one"},
      {monitor(wall + "angles_deg = [90]\njoint = \"bed\""), "excavation", "remove one"},
      {monitor(wall + "angles_deg = [-90]"), "angles_deg", "stage 'later'"},
      {monitor("quantities = [\"convergence\"]\nangles_deg = [180]\nexcavation = \"bench\""), "angles_deg",
       "meets no rock"},
      {monitor(block + "angles_deg = [90]"), "angles_deg", "write excavation"},
      {monitor(block + "since = \"stres\""), "since", "stress"},
      {monitor(block + "since = \"later\""), "since", "last stage"},
      {monitor("inside = [3.8, 0]\nquantities = [\"displacement\", \"velocity\"]\nsince = \"dig\""), "since",
       "velocity is not a motion"},
      {monitor(block + "since_start = \"digg\""), "since_start", "dig"},
      {monitor(block + "since_start = 2"), "since_start", "text in double quotes"},
      {monitor(block + "since_start = \"dig\"\nsince = \"stress\""), "since_start", "together with since"},
      {monitor("inside = [3.8, 0]\nquantities = [\"velocity\"]\nsince_start = \"dig\""), "since_start",
       "velocity is not a motion"},
      {monitor("joint = \"bed\"\nquantities = [\"contact_force\"]\nsince = \"dig\""), "since", "contact_force"},
  };
  for (const Case& c : cases) {
    const std::string message = complaint_about(rock + c.text);
    EXPECT_NE(message.find(c.key), std::string::npos) << c.text << message;
    EXPECT_NE(message.find(c.says), std::string::npos) << c.text << message;
    EXPECT_EQ(message.find("scene.toml:"), 0u) << c.text << message;
  }
}

TEST(BadMonitors, InThreeDimensionsAnOpeningNeedsAnAxis) {
  const std::string text = R"(
dimension = 3
density = 2500
domain = { box = { min = [-4, -4, -4], max = [4, 4, 4] } }
excavations = [{ name = "tunnel", box = { min = [-1, -5, -1], max = [1, 5, 1] }, outline = true }]
[[stage]]
name = "settle"
kind = "settle"
excavate = ["tunnel"]
)";
  try {
    prepare<3>(parse_scene(text + monitor(wall + "angles_deg = [90]"), "scene.toml", {}));
    FAIL() << "was taken";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("has no axis"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace voussoir::bad_monitors_test
