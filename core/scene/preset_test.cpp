// What a scene gets that states no numerical choice, and what it keeps.
#include "core/scene/preset.hpp"

#include <gtest/gtest.h>

#include "core/scene/scene.hpp"

namespace voussoir::preset_test {
namespace {

using Lines = std::vector<std::string>;

const std::string wedge = R"(dimension = 2
density = 2000
gravity = [0, -10]
[domain]
box = { min = [-1, -1], max = [1, 1] }
[[joints]]
name = "A"
dip = 30
dip_direction = 90
point = [0, 0]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 60
[[fix]]
below = ["A"]
[[stage]]
name = "critical"
kind = "reduce"
from_deg = 60
to_deg = 10
)";
const std::string bisected = wedge + "tolerance_deg = 0.1\n";

std::vector<std::string> set_in(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "scene.toml", overrides).from_preset;
}

TEST(Preset, StandardSetsWhatIsNotStated) {
  EXPECT_EQ(set_in(bisected),
            (Lines{"statics = \"newton\"", "contact.face = \"integrated\"",
                   "stage.critical.failure_criterion = \"required_strength\"", "accuracy.error_bar = \"stiffness\""}));
  const Scene scene = parse_scene(bisected, "scene.toml");
  EXPECT_EQ(scene.settings.statics.method, Statics::newton);
  EXPECT_EQ(scene.settings.contact.face, ContactFace::integrated);
  EXPECT_EQ(std::get<ReducePlan>(scene.stages.back().plan.plan).criterion, FailureCriterion::required_strength);
}

TEST(Preset, ThesisKeepsTheDefaultsOfEachKey) {
  const Scene scene = parse_scene("preset = \"thesis\"\n" + bisected, "scene.toml");
  EXPECT_TRUE(scene.from_preset.empty());
  EXPECT_EQ(scene.settings.statics.method, StaticsSettings{}.method);
  EXPECT_EQ(scene.settings.contact.face, ContactSettings{}.face);
  EXPECT_EQ(std::get<ReducePlan>(scene.stages.back().plan.plan).criterion, ReducePlan{}.criterion);
}

TEST(Preset, StatedKeysStay) {
  EXPECT_EQ(set_in(bisected, {"statics=\"local\"", "contact.face=\"point\"",
                              "stage.critical.failure_criterion=\"displacement\""}),
            (Lines{"stage.critical.static_increments = 16"}));
  EXPECT_EQ(set_in(bisected, {"stage.critical.failure_displacement=0.01"}),
            (Lines{"statics = \"newton\"", "stage.critical.static_increments = 16", "contact.face = \"integrated\""}));
  // a scene that states its contact point keeps one contact point per face
  EXPECT_EQ(set_in(bisected, {"contact.point=\"centroid\""}),
            (Lines{"statics = \"newton\"", "stage.critical.failure_criterion = \"required_strength\"",
                   "accuracy.error_bar = \"stiffness\""}));
}

TEST(Preset, FacesThatCannotBeIntegratedGetPoints) {
  const std::vector<std::string> bonded{"joint_properties.rock.cohesion=1e5"};
  EXPECT_EQ(set_in(bisected, bonded),
            (Lines{"statics = \"newton\"", "joint_properties.rock.sub_contacts = 4",
                   "joint_properties.rock.cohesion_law = \"plastic\"", "joint_properties.rock.bonds = \"as_sliced\"",
                   "stage.critical.failure_criterion = \"required_strength\"", "accuracy.error_bar = \"stiffness\""}));
  const std::string soil =
      "[[joint_properties]]\nname = \"soil\"\nnormal_stiffness = 1e8\nshear_stiffness = 1e7\n"
      "friction_deg = 20\ntension = 1e3\n";
  EXPECT_EQ(set_in(bisected + soil),
            (Lines{"statics = \"newton\"", "contact.face = \"integrated\"", "joint_properties.soil.sub_contacts = 4",
                   "joint_properties.soil.cohesion_law = \"plastic\"", "joint_properties.soil.bonds = \"as_sliced\"",
                   "stage.critical.failure_criterion = \"required_strength\"", "accuracy.error_bar = \"stiffness\""}));
}

TEST(Preset, SearchesAtARateFollowTheMotion) {
  EXPECT_EQ(set_in(wedge + "method = \"rate\"\nrate_deg_per_s = 1\n"),
            (Lines{"statics = \"newton\"", "stage.critical.statics = \"adaptive\"", "contact.face = \"integrated\""}));
  EXPECT_EQ(set_in(wedge + "method = \"steps\"\nstep_deg = 1\n"),
            (Lines{"statics = \"newton\"", "stage.critical.static_increments = 16", "contact.face = \"integrated\""}));
}

// a folder of an earlier version has the hash of its scene with the defaults of then
TEST(Preset, InputHashDependsOnWhatItSetsAlone) {
  const std::vector<std::string> spelled{"statics=\"newton\"", "contact.face=\"integrated\"",
                                         "stage.critical.failure_criterion=\"required_strength\"",
                                         "accuracy.error_bar=\"stiffness\""};
  const std::string standard = input_hash(parse_scene(bisected, "scene.toml"));
  EXPECT_EQ(input_hash(parse_scene("preset = \"standard\"\n" + bisected, "scene.toml")), standard);
  EXPECT_EQ(input_hash(parse_scene("preset = \"thesis\"\n" + bisected, "scene.toml", spelled)), standard);
  EXPECT_NE(input_hash(parse_scene("preset = \"thesis\"\n" + bisected, "scene.toml")), standard);
}

TEST(Preset, ScenesWithoutJointsStayAsTheyAre) {
  EXPECT_EQ(set_in("dimension = 3\ndensity = 1\n[[blocks]]\nname = \"a\"\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n"
                   "[[stage]]\nname = \"fall\"\nkind = \"run\"\nduration_s = 1\n"),
            (Lines{"statics = \"newton\""}));
}

}  // namespace
}  // namespace voussoir::preset_test
