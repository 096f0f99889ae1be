// `voussoir modes`: what it prints and writes, and one line for each bad input.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "app/testing/program.hpp"

namespace voussoir::modes_test {
namespace {

const std::string head =
    "dimension = 2\ngravity = [0, -9.81]\ndensity = 2600\n"
    "joint_properties = [{ name = \"rock\", normal_stiffness = 1e10, shear_stiffness = 5e9, friction_deg = 40 }]\n";
const std::string base = "[[blocks]]\nname = \"base\"\nfixed = true\nvertices = [[-3, -1], [3, -1], [3, 0], [-3, 0]]\n";
const std::string block = "[[blocks]]\nname = \"block\"\nvertices = [[-0.5, 0], [0.5, 0], [0.5, 2], [-0.5, 2]]\n";
const std::string far = "[[blocks]]\nname = \"far\"\nvertices = [[5, 5], [6, 5], [6, 6], [5, 6]]\n";
const std::string settle = "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
const std::string shake = "[[stage]]\nname = \"shake\"\nkind = \"run\"\nduration_s = 0.001\n";

class ModesCommand : public program::Program {
 protected:
  Ended modes(const std::string& scene, const std::string& options = "") const {
    write("scene.toml", scene);
    return run("modes scene.toml --out found --overwrite " + options);
  }
  nlohmann::json found() const { return nlohmann::json::parse(read(folder_ / "found/modes.json")); }
  void expect_refused(const std::string& scene, const std::string& because, const std::string& options = "",
                      int code = 2) const {
    const Ended ended = modes(scene, options);
    EXPECT_EQ(ended.code, code) << because;
    EXPECT_NE(ended.err.find(because), std::string::npos) << ended.err;
    EXPECT_FALSE(program::fs::exists(folder_ / "found/modes.json"));
  }
};

TEST_F(ModesCommand, WritesTheTableAndTheFiles) {
  const Ended ended = modes(head + base + block + settle, "--number 2 --view");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("51.3703"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("of 3"), std::string::npos);
  for (const char* file : {"modes.json", "mode_01.vtp", "mode_02.vtp", "modes.pvd", "view.bin", "view.html"})
    EXPECT_TRUE(program::fs::exists(folder_ / "found" / file)) << file;
  const nlohmann::json json = found();
  ASSERT_EQ(json["modes"].size(), 2U);
  const nlohmann::json& sway = json["modes"][0];
  EXPECT_NEAR(sway["frequency_Hz"].get<double>() * sway["period_s"].get<double>(), 1, 1e-12);
  EXPECT_EQ(sway["moves_most"]["name"], "block");
  EXPECT_FALSE(sway["unstable"]);
  // the shape is scaled to a largest displacement of 1, at the top's corners
  const double way = sway["shape"][0]["displacement"][0], turn = sway["shape"][0]["rotation_per_m"][0];
  EXPECT_NEAR(std::hypot(std::abs(way) + std::abs(turn), 0.5 * turn), 1, 1e-6);
}

TEST_F(ModesCommand, ChoosesTheStage) {
  EXPECT_EQ(modes(head + base + block + settle + shake).code, 0);
  EXPECT_EQ(found()["stage"], "settle");
  EXPECT_EQ(modes(head + base + block + settle + shake, "--stage shake").code, 0) << "still at rest";
  EXPECT_EQ(found()["stage"], "shake");
}

TEST_F(ModesCommand, NamesBlocksThatHangFreeAndGivesThemNoFrequency) {
  const Ended ended =
      modes(head + "restrain = [{ bodies = [\"far\"], translation = [\"y\"] }]\n" + base + block + far + settle);
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("nothing touches body 2 (far)"), std::string::npos) << ended.out;
  EXPECT_TRUE(found()["modes"][0]["frequency_Hz"].is_null());
  EXPECT_NEAR(found()["modes"][2]["frequency_Hz"], 51.37, 0.01);
}

TEST_F(ModesCommand, SaysThatABlockRocksOver) {
  const Ended ended = modes(head + base + block + settle,
                            "--set joint_properties.rock.normal_stiffness=5e5 --set "
                            "joint_properties.rock.shear_stiffness=2.5e5 --set statics=newton");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("the state is unstable: it buckles or rocks over along mode 1"), std::string::npos);
  EXPECT_TRUE(found()["modes"][0]["unstable"]);
  EXPECT_TRUE(found()["modes"][0]["frequency_Hz"].is_null());
}

TEST_F(ModesCommand, CountsJointsAtTheirStrength) {
  const std::string tilted =
      "dimension = 2\ngravity = [0, -9.81]\ndensity = 2600\n"
      "joint_properties = [{ name = \"rock\", normal_stiffness = 1e10, shear_stiffness = 5e9, friction_deg = 20 }]\n"
      "domain = { box = { min = [-4, -4], max = [4, 0] } }\n"
      "joints = [{ name = \"bedding\", dip = 19.99, dip_direction = 90, point = [0, -2] }]\n"
      "fix = [{ below = [\"bedding\"] }]\n"
      "restrain = [{ above = [\"bedding\"], rotation = true }]\n";
  const Ended ended = modes(tilted + settle);
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("contacts 1 of 1 on bedding"), std::string::npos) << ended.out;
  EXPECT_GT(found()["modes"][0]["frequency_Hz"], 10) << "it sticks in the mode";
}

TEST_F(ModesCommand, WarnsOfFacesOnOnePoint) {
  const Ended ended =
      modes(head + base + block + settle, "--set contact.face=point --set joint_properties.rock.sub_contacts=1");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("1 of 1 contacts act at one point: faces rock 2.9 times too stiffly"), std::string::npos);
}

TEST_F(ModesCommand, RefusesInOneLine) {
  expect_refused(head + base + block + shake, "no stage of the scene ends at rest: add one of kind = \"settle\"");
  expect_refused(head + base + block + settle, "--stage setle: no stage of the scene has this name; did you mean",
                 "--stage setle");
  expect_refused(head + base + settle, "no block is free to move");
  // free fall is no rest
  expect_refused(head + base + far + settle, "no modes, as the run to stage settle is not done", "", 1);
}

TEST_F(ModesCommand, RefusesAStateThatIsNotAtRest) {
  const std::string push =
      "[[stage]]\nname = \"pushed\"\nkind = \"run\"\nduration_s = 0.003\n"
      "[[stage.force]]\nname = \"push\"\nbodies = [\"block\"]\nforce = [5e3, 0]\n";
  expect_refused(head + base + block + settle + push, "stage pushed does not end in equilibrium", "--stage pushed");
}

TEST_F(ModesCommand, RefusesWhatNothingHolds) {
  const std::string floating =
      "dimension = 2\ngravity = [0, 0]\ndensity = 2600\n"
      "joint_properties = [{ name = \"rock\", normal_stiffness = 1e10, shear_stiffness = 5e9, friction_deg = 40 }]\n";
  expect_refused(floating + block + far + settle, "nothing is fixed");
}

}  // namespace
}  // namespace voussoir::modes_test
