// Mistakes about integrated face contacts (contact.face = "integrated").
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_faces_test {
namespace {

using namespace bad_scenes;

class BadFace : public testing::TestWithParam<BadInput> {};

TEST_P(BadFace, IsReportedInOneLine) {
  expect_reported(GetParam());
}

const std::string damping = "[damping]\n", whole = "[contact]\nface = \"integrated\"\n";
const std::string friction = "friction_deg = 40\n";

// a key that only point contacts use
BadInput unused(const char* name, const std::string& key, const std::string& value, const char* phrase) {
  return {name, damping, whole + key + " = \"" + value + "\" #!\n" + damping, "contact." + key + " = \"" + value + "\"",
          phrase};
}

INSTANTIATE_TEST_SUITE_P(
    Face, BadFace,
    testing::Values(BadInput{"unknown", damping, "[contact]\nface = \"whole\" #!\n" + damping,
                             "contact.face = \"whole\"", "must be one of \"point\", \"integrated\""},
                    BadInput{"number", damping, "[contact]\nface = 1 #!\n" + damping, "contact.face = 1", "text"},
                    BadInput{"list", damping, "[contact]\nface = [\"integrated\"] #!\n" + damping, "contact.face",
                             "text"},
                    BadInput{"of_joint_properties", friction, friction + "face = \"integrated\" #!\n",
                             "joint_properties.rock.face", "no such key"},
                    unused("multipliers", "normal", "multipliers", "leave one of the two out"),
                    unused("centroid", "point", "centroid", "has an integrated face contact"),
                    unused("chebyshev", "point", "chebyshev", "of contacts that act at a point"),
                    unused("central_path", "point", "central_path", "every joint of this scene"),
                    unused("bracketing", "overlap", "bracketing", "the search for the overlap")),
    by_name);

// no joint that could be integrated, and the reason
BadInput none(const char* name, const std::string& properties, const char* phrase) {
  return {name, friction, friction + properties + "[contact]\nface = \"integrated\" #!\n",
          "contact.face = \"integrated\"", phrase};
}

INSTANTIATE_TEST_SUITE_P(
    None, BadFace,
    testing::Values(none("constant_stiffness", "constant_stiffness = true\n", "rock has constant_stiffness"),
                    none("cohesion", "cohesion = 1e5\n", "rock has tension or cohesion"),
                    none("tension", "tension = 1e5\n", "which is lost point by point"),
                    none("law_of_stress", "normal_law = \"linear\"\nnormal_growth = 1e4\n",
                         "depends on stress or slip"),
                    none("dilation", "dilation_law = \"falling\"\ndilation_deg = 8\ndilation_decay_m = 0.01\n",
                         "rock dilates, by a rise that varies"),
                    none("barton_bandis", "friction_law = \"barton_bandis\"\njrc = 10\njcs = 30e6\n",
                         "rock follows Barton and Bandis' law"),
                    none("softening", "friction_law = \"softening\"\nsoftening_drop = 0.1\nsoftening_slip_m = 0.01\n",
                         "would change nothing")),
    by_name);

// one such joint is enough; keys of point contacts then apply to the others
TEST(Faces, AreAcceptedTogetherWithPoints) {
  std::string text = good_scene;
  EXPECT_EQ(complaint_about(text, {"contact.face='integrated'", "joint_properties.rock.sub_contacts=4"}), "");
  const std::string joint = "point = [0, 0, 0]\n";
  text.replace(text.find(joint), joint.size(), joint + "properties = \"tied\"\n");
  text +=
      "[[joint_properties]]\nname = \"tied\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = 40\n"
      "cohesion = 1e5\n[[joint_properties]]\nname = \"default\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\n"
      "friction_deg = 40\n";
  EXPECT_EQ(complaint_about(text, {"contact.face='integrated'", "contact.point='centroid'"}), "");
}

}  // namespace
}  // namespace voussoir::bad_faces_test
