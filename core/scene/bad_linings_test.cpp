// Errors of linings in a scene, and their messages.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "core/scene/scene_error.hpp"
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_linings_test {
namespace {

using bad_scenes::complaint_about;

const std::string rock = R"(
dimension = 2
gravity = [0, -10]
density = 2500
domain = { box = { min = [-9, -9], max = [9, 9] } }
joint_properties = [{ name = "bed", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 },
                    { name = "by force", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, constant_stiffness = true },
                    { name = "by stress", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, normal_law = "linear", normal_growth = 1e4 },
                    { name = "dilating", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40, dilation_law = "constant", dilation_deg = 5, dilation_until_m = 0.01 },
                    { name = "by roughness", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 30, friction_law = "barton_bandis", jrc = 8, jcs = 50e6 }]
joints = [{ name = "bed", dip = 0, point = [0, 2], properties = "bed" }]
fix = [{ side = ["bottom"] }]
[[excavations]]
name = "tunnel"
outline = true
cylinder = { from = [0, 0], radius = 3, sides = 12 }
)";
const std::string rough = "[[excavations]]\nname = \"rough\"\ncylinder = { from = [0, 5.5], radius = 1, sides = 12 }\n";
const std::string open =
    "[[excavations]]\nname = \"open\"\noutline = true\n"
    "planes = [{ dip = 0, point = [0, 8], keep = \"above\" }]\n";
const std::string stage = "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
const std::string dig = stage + "excavate = [\"tunnel\"]\ninstall = [\"shell\"]\n";
const std::string section = "nodes = 48\nthickness = 0.3\nyoung_modulus = 25e9\n";

std::string lining(const std::string& keys, const std::string& excavation = "tunnel",
                   const std::string& properties = "bed") {
  return "[[linings]]\nname = \"shell\"\nexcavation = \"" + excavation + "\"\njoint_properties = \"" + properties +
         "\"\n" + keys;
}
std::string monitor(const std::string& keys) {
  return "[[monitors]]\nname = \"m\"\n" + keys;
}

struct Case {
  std::string text, key, says;
};

TEST(BadLinings, AreRefusedWithAReasonAndARepair) {
  ASSERT_EQ(complaint_about(rock + lining(section) + dig), "");
  const std::vector<Case> cases{
      {lining(section, "tunel") + dig, "excavation", "no excavation has this name; did you mean"},
      {rough + lining(section, "rough") + dig, "excavation", "write outline = true"},
      {open + lining(section, "open") + dig, "excavation", "no closed outline"},
      {lining(section, "tunnel", "bad") + dig, "joint_properties", "no joint_properties of this name"},
      {lining(section, "tunnel", "by force") + dig, "joint_properties", "stiffness per area"},
      {lining(section, "tunnel", "by stress") + dig, "joint_properties", "depends on stress"},
      {lining(section, "tunnel", "dilating") + dig, "joint_properties", "dilates"},
      {lining(section, "tunnel", "by roughness") + dig, "joint_properties", "has Barton and Bandis' friction"},
      {lining("thickness = 0.3\nyoung_modulus = 25e9\n") + dig, "nodes", "missing"},
      {lining("nodes = 48\nyoung_modulus = 25e9\n") + dig, "thickness", "missing"},
      {lining("nodes = 48\nthickness = 0.3\n") + dig, "young_modulus", "missing"},
      {lining(section + "nodes_x = 3\n") + dig, "nodes_x", "no such key"},
      {lining("nodes = 2\nthickness = 0.3\nyoung_modulus = 25e9\n") + dig, "nodes", "3"},
      {lining("nodes = 48\nthickness = -0.3\nyoung_modulus = 25e9\n") + dig, "thickness", "greater than 0"},
      {lining(section + "to_deg = 180\n") + dig, "to_deg", "from_deg is missing"},
      {lining(section + "from_deg = 180\nto_deg = 0\n") + dig, "to_deg", "must be beyond"},
      {lining(section + "from_deg = 0\nto_deg = 360\n") + dig, "to_deg", "leave to_deg out"},
      {lining(section + "compressive_strength = 25e6\n") + dig, "compressive_strength", "tensile_strength is missing"},
      {lining(section + "tensile_strength = 2e6\n") + dig, "tensile_strength", "compressive_strength is missing"},
      {lining(section) + stage, "name", "no stage installs this lining"},
      {lining(section) + stage + "install = [\"shel\"]\n", "install", "did you mean"},
      {lining(section) + stage + "install = [\"shell\"]\n" +
           "[[stage]]\nname = \"dig\"\nkind = \"settle\"\nexcavate = [\"tunnel\"]\n",
       "install", "before 'tunnel' is excavated"},
      {lining(section) + dig + "[[stage]]\nname = \"again\"\nkind = \"settle\"\ninstall = [\"shell\"]\n", "install",
       "again; name"},
      {lining(section) + "[[bolts]]\nname = \"shell\"\nfrom = [0, 3]\nto = [0, 5]\nstiffness = 1e8\n" + dig, "name",
       "name of bolts"},
      {lining(section) + dig + monitor("quantities = [\"lining_force\"]\nlining = \"x\"\n"), "lining",
       "no lining of this name"},
      {lining(section) + dig + monitor("quantities = [\"lining_force\"]\njoint = \"bed\"\n"), "lining",
       "is a quantity of"},
      {lining(section) + dig + monitor("quantities = [\"displacement\"]\nlining = \"shell\"\n"), "quantities",
       "lining_force only"},
      {lining(section) + dig +
           monitor("quantities = [\"displacement\"]\nall = true\nover = \"mean\"\nangles_deg = [90]\n"),
       "angles_deg", "of a lining"},
  };
  for (const Case& c : cases) {
    const std::string message = complaint_about(rock + c.text);
    EXPECT_NE(message.find("scene.toml:"), std::string::npos) << c.text << message;
    EXPECT_NE(message.find(c.key), std::string::npos) << c.text << message;
    EXPECT_NE(message.find(c.says), std::string::npos) << c.text << "said: " << message;
  }
}

TEST(BadLinings, ArePlaneOnly) {
  try {
    parse_scene("dimension = 3\ndensity = 2500\ndomain = { box = { min = [0, 0, 0], max = [1, 1, 1] } }\n" +
                    lining(section) + stage,
                "scene.toml", {});
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("dimension = 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace voussoir::bad_linings_test
