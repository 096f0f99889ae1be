// Mistakes in sides that waves leave.
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_open_sides_test {
namespace {

using namespace bad_scenes;

// Three blocks upon each other, and a run whose boundary each test completes.
const std::string pile = R"(dimension = 2
gravity = [0, 0]
density = 2500
domain = { box = { min = [0, 0], max = [2, 3] } }
[[joint_properties]]
name = "rock"
normal_stiffness = 1e10
shear_stiffness = 5e9
friction_deg = 40
[[joints]]
name = "lower"
dip = 0
point = [0, 1]
[[joints]]
name = "upper"
dip = 0
point = [0, 2]
)";
const std::string waves = "[[stage]]\nname = \"waves\"\nkind = \"run\"\nduration_s = 1\n[[stage.boundary]]\n";
const std::string bottom = waves + "side = [\"bottom\"]\n";

struct BadSide {
  std::string name, text, subject, reason;
};

void PrintTo(const BadSide& bad, std::ostream* out) {
  *out << bad.name;
}

class OpenSides : public testing::TestWithParam<BadSide> {};

TEST_P(OpenSides, MistakesAreReportedInOneLine) {
  const BadSide& bad = GetParam();
  try {
    prepare<2>(parse_scene(pile + bad.text, "scene.toml"));
    ADD_FAILURE() << "read without an error";
  } catch (const SceneError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find(bad.subject), std::string::npos) << message;
    EXPECT_NE(message.find(bad.reason), std::string::npos) << message;
    EXPECT_NE(message.find("scene.toml:"), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Bad, OpenSides,
    testing::Values(
        BadSide{"unknown_side", waves + "side = [\"botom\"]\nquiet = {}\n", "stage.waves.boundary.1.side", "'bottom'"},
        BadSide{"side_of_space", waves + "side = [\"west\"]\nquiet = {}\n", "stage.waves.boundary.1.side",
                "side of the model"},
        BadSide{"two_sides", waves + "side = [\"bottom\", \"left\"]\nquiet = {}\n", "stage.waves.boundary.1.side",
                "a table for each side"},
        BadSide{"by_joint", waves + "below = [\"lower\"]\nquiet = {}\n", "stage.waves.boundary.1.quiet",
                "side = [\"bottom\"]"},
        BadSide{"quiet_and_stress", bottom + "stress = [1e5, 1e5, 0]\nquiet = {}\n", "stage.waves.boundary.1.stress",
                "in an earlier stage"},
        BadSide{"quiet_and_free_field", waves + "side = [\"left\"]\nquiet = {}\nfree_field = {}\n",
                "stage.waves.boundary.1.free_field", "remove one"},
        BadSide{"free_field_below", bottom + "free_field = {}\n", "stage.waves.boundary.1.free_field", "quiet = {}"},
        BadSide{"negative_impedance", bottom + "quiet = { normal_impedance = -5e6 }\n",
                "stage.waves.boundary.1.quiet.normal_impedance = -5e+06", "must"},
        BadSide{"within", bottom + "quiet = { input = \"within\", velocity = [1, 0] }\n",
                "stage.waves.boundary.1.quiet.input", "rigid base"},
        BadSide{"no_input", bottom + "quiet = { velocity = [1, 0] }\n", "stage.waves.boundary.1.quiet.input is missing",
                "twice the wave"},
        BadSide{"no_motion", bottom + "quiet = { input = \"upgoing\" }\n", "stage.waves.boundary.1.quiet.input",
                "state velocity or a record"},
        BadSide{"at_the_side", waves + "side = [\"left\"]\nquiet = { input = \"upgoing\", velocity = [1, 0] }\n",
                "stage.waves.boundary.1.quiet.velocity", "at the base alone"},
        BadSide{"no_joint_yields", waves + "side = [\"left\"]\nquiet = {}\n",
                "stage.waves.boundary.1.quiet.normal_impedance is missing", "no joint"},
        BadSide{"settles",
                "[[stage]]\nname = \"still\"\nkind = \"settle\"\n[[stage.boundary]]\nside = [\"bottom\"]\nquiet = {}\n",
                "stage.still.kind", "seek it before"},
        BadSide{"settles_later", bottom + "quiet = {}\n[[stage]]\nname = \"still\"\nkind = \"settle\"\n",
                "stage.still.kind", "stage 'waves'"},
        BadSide{"removes_later",
                bottom + "quiet = {}\n[[stage]]\nname = \"dig\"\nkind = \"run\"\nduration_s = 1\nremove = [{ above = "
                         "[\"upper\"] }]\n",
                "stage.dig.remove", "make the change before"},
        BadSide{"twice", bottom + "quiet = {}\n[[stage.boundary]]\nside = [\"bottom\"]\nquiet = {}\n",
                "stage.waves.boundary.2.side", "open already"},
        BadSide{"one_fixed_block",
                "[[joints]]\nname = \"floor\"\ndip = 0\npoint = [0, 0.5]\nkind = \"boundary\"\nfixed_side = "
                "\"below\"\n[[joints]]\nname = \"cross\"\ndip = 90\ndip_direction = 90\npoint = [0.8, 0]\n" +
                    bottom + "quiet = {}\n",
                "stage.waves.boundary.1.side", "end domain.box at y = 0.5"},
        BadSide{"column_that_does_not_repeat",
                "[[joints]]\nname = \"tilted\"\ndip = 60\ndip_direction = 90\npoint = [1, 1.5]\n" + waves +
                    "side = [\"left\"]\nfree_field = { normal_impedance = 5e6, shear_impedance = 3e6 }\n",
                "stage.waves.boundary.1.free_field", "does not repeat"}),
    [](const auto& chosen) { return chosen.param.name; });

}  // namespace
}  // namespace voussoir::bad_open_sides_test
