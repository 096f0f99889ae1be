// Errors of bolts in a scene, and their messages.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/scene_error.hpp"
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_bolts_test {
namespace {

using bad_scenes::complaint_about;

const std::string rock = R"(
dimension = 2
gravity = [0, -10]
density = 2500
domain = { box = { min = [0, 0], max = [4, 4] } }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 }]
joints = [{ name = "bed", dip = 0, point = [0, 2] }]
fix = [{ above = ["bed"] }]
)";
const std::string stage = "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
const std::string install = stage + "install = [\"roof\"]\n";

std::string bolts(const std::string& keys) {
  return "[[bolts]]\nname = \"roof\"\n" + keys + "\n";
}
const std::string grouted = "kind = \"grouted\"\naxial_stiffness = 1e8\nbond_stiffness = 5e8\n";
const std::string line = "from = [1, 1]\nto = [1, 3]\n", stiff = "stiffness = 2e8\n",
                  fan = "from_deg = 60, to_deg = 120, spacing_deg = 30, length = 2 }\n";

TEST(BadBolts, AreRefusedWithAReasonAndARepair) {
  EXPECT_EQ(complaint_about(rock + bolts(line + stiff) + install), "");
  EXPECT_EQ(complaint_about(rock + bolts("fan = { centre = [2, 0], start = 1, " + fan + stiff) + install), "");
  EXPECT_EQ(complaint_about(rock + bolts(line + grouted) + install), "");
  EXPECT_EQ(
      complaint_about(rock + bolts(line + grouted + "plate = \"spring\"\nplate_stiffness = 1e8\npretension = 1e5\n") +
                      install),
      "");
  struct Case {
    std::string text, key, says;
  };
  const std::vector<Case> cases{
      {bolts(line) + install, "stiffness", "is missing"},
      {bolts(line + "stiffness = 0") + install, "stiffness", "greater than 0"},
      {bolts(line + "stiffness = -1e8") + install, "stiffness", "greater than 0"},
      {bolts(stiff) + install, "from", "write from and to, or fan"},
      {bolts("from = [1, 1]\n" + stiff) + install, "to", "needs both"},
      {bolts("to = [1, 1]\n" + stiff) + install, "from", "needs both"},
      {bolts("from = [1, 1]\nto = [1, 1]\n" + stiff) + install, "to", "no length"},
      {bolts("from = [1, 1, 0]\nto = [1, 2, 0]\n" + stiff) + install, "from", "2"},
      {bolts(line + "fan = { centre = [2, 0], " + fan + stiff) + install, "fan", "either"},
      {bolts("fan = { centre = [2, 0], axis = [0, 1], " + fan + stiff) + install, "axis", "dimension = 2"},
      {bolts("fan = { centre = [2, 0], from_deg = 90, to_deg = 60, spacing_deg = 5, length = 1 }\n" + stiff) + install,
       "to_deg", "swap"},
      {bolts("fan = { centre = [2, 0], from_deg = 0, to_deg = 60, spacing_deg = 0, length = 1 }\n" + stiff) + install,
       "spacing_deg", "greater than 0"},
      {bolts("fan = { centre = [2, 0], from_deg = 0, to_deg = 60, spacing_deg = 1e-6, length = 1 }\n" + stiff) +
           install,
       "fan", "bolts, more than"},
      {bolts("fan = { centre = [2, 0], from_deg = 0, to_deg = 60, spacing_deg = 5 }\n" + stiff) + install, "length",
       "is missing"},
      {bolts(line + stiff + "repeat = [{ step = [0, 0], count = 2 }]") + install, "step", "zero"},
      {bolts(line + stiff + "repeat = [{ step = [1, 0], count = 1 }]") + install, "count", "2"},
      {bolts(line + stiff + "anchors = \"glued\"") + install, "anchors", "midway"},
      {bolts(line + stiff + "anchors = \"midway\"\ndiameter = 0.03") + install, "diameter", "anchors"},
      {bolts(line + stiff + "pretension = -1") + install, "pretension", "0"},
      {bolts(line + stiff + "pretension = 2e5\nyield = 1e5") + install, "pretension", "more than yield"},
      {bolts(line + stiff + "rupture_extension = 0.1") + install, "rupture_extension", "yield is missing"},
      {bolts(line + stiff + "dowel_strength = 1e5") + install, "dowel_strength", "dowel_stiffness is missing"},
      {bolts(line + stiff + "axial_stiffness = 1e8") + install, "axial_stiffness", "end_anchored"},
      {bolts(line + "kind = \"end_anchored\"") + install, "axial_stiffness", "is missing"},
      {bolts(line + "kind = \"end_anchored\"\naxial_stiffness = 1e8\nstiffness = 1e8") + install, "stiffness",
       "springs"},
      {bolts(line + "kind = \"end_anchored\"\naxial_stiffness = 1e8\ntension_only = true") + install, "tension_only",
       "springs"},
      {bolts(line + "kind = \"grouted\"\nbond_stiffness = 5e8") + install, "axial_stiffness", "is missing"},
      {bolts(line + "kind = \"grouted\"\naxial_stiffness = 1e8") + install, "bond_stiffness", "is missing"},
      {bolts(line + "kind = \"grouted\"\naxial_stiffness = 1e8\nbond_stiffness = 0") + install, "bond_stiffness",
       "greater than 0"},
      {bolts(line + "kind = \"grout\"") + install, "kind", "grouted"},
      {bolts(line + stiff + "bond_stiffness = 5e8") + install, "bond_stiffness", "grouted"},
      {bolts(line + grouted + "stiffness = 1e8") + install, "stiffness", "springs"},
      {bolts(line + grouted + "anchors = \"midway\"\ndiameter = 0.03") + install, "diameter", "anchors"},
      {bolts(line + grouted + "tension_only = true") + install, "tension_only", "springs"},
      {bolts(line + grouted + "dowel_stiffness = 1e7") + install, "dowel_stiffness", "end_anchored"},
      {bolts(line + grouted + "yield = 1e5\nrupture_extension = 0.1") + install, "rupture_extension", "end_anchored"},
      {bolts(line + grouted + "bond_strength = 0") + install, "bond_strength", "greater than 0"},
      {bolts(line + grouted + "plate = \"steel\"") + install, "plate", "tied"},
      {bolts(line + grouted + "plate = \"spring\"") + install, "plate_stiffness", "is missing"},
      {bolts(line + grouted + "plate = \"tied\"\nplate_stiffness = 1e8") + install, "plate_stiffness", "spring"},
      {bolts(line + grouted + "pretension = 1e4") + install, "pretension", "requires a plate"},
      {bolts(line + grouted + "plate = \"tied\"\npretension = 1e5\nbond_strength = 4e4") + install, "pretension",
       "the strength of the grout"},
      {bolts(line + grouted + "plate = \"tied\"\npretension = 2e5\nyield = 1e5") + install, "pretension",
       "more than yield"},
      {bolts(line + grouted + "free_length = 2") + install, "free_length", "leaves no grouted length"},
      {bolts(line + grouted + "free_length = -1") + install, "free_length", "0"},
      {bolts(line + grouted + "node_spacing = 3") + install, "node_spacing", "2 m long"},
      {bolts(line + grouted + "node_spacing = 1e-4") + install, "node_spacing", "nodes, more than"},
      {bolts(line + grouted + "node_spacing = 0") + install, "node_spacing", "greater than 0"},
      {bolts(line + stiff + "spacing = 0") + install, "spacing", "greater than 0"},
      {bolts(line + stiff) + stage, "name", "no stage installs"},
      {bolts(line + stiff) + stage + "install = [\"rof\"]\n", "install", "roof"},
      {stage + "install = [\"roof\"]\n", "install", "there is nothing to install"},
      {bolts(line + stiff) + install + "[[stage]]\nname = \"again\"\nkind = \"settle\"\ninstall = [\"roof\"]\n",
       "install", "again; name"},
      {bolts(line + stiff) + bolts(line + stiff) + install, "name", "roof"},
      {bolts(line + stiff) + install + "[[monitors]]\nname = \"m\"\nquantities = [\"bolt_force\"]\nbolts = \"x\"\n",
       "bolts", "no bolts of this name"},
      {bolts(line + stiff) + install + "[[monitors]]\nname = \"m\"\nquantities = [\"bolt_force\"]\njoint = \"bed\"\n",
       "bolts", "a quantity of bolts"},
      {bolts(line + stiff) + install +
           "[[monitors]]\nname = \"m\"\nquantities = [\"displacement\"]\nbolts = \"roof\"\n",
       "quantities", "bolt_force only"},
      {bolts(line + stiff) + install +
           "[[monitors]]\nname = \"m\"\nquantities = [\"bolt_force\"]\nbolts = \"roof\"\n"
           "over = \"sum\"\n",
       "over", "this monitor has none"},
      {stage + "[[monitors]]\nname = \"m\"\nquantities = [\"displacement\"]\nall = true\n", "monitors", "over ="},
  };
  for (const Case& c : cases) {
    const std::string message = complaint_about(rock + c.text);
    EXPECT_NE(message.find("scene.toml:"), std::string::npos) << c.text << message;
    EXPECT_NE(message.find(c.key), std::string::npos) << c.text << message;
    EXPECT_NE(message.find(c.says), std::string::npos) << c.text << "said: " << message;
  }
}

}  // namespace
}  // namespace voussoir::bad_bolts_test
