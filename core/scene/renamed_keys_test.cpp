// Keys under their earlier names: the same scene, the same hash, and one name at a time.
#include "core/scene/renamed_keys.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/scene/effective_scene.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/scene.hpp"

namespace voussoir::renamed_keys_test {
namespace {

namespace fs = std::filesystem;

// `head`: keys of the top; `side`: of the joint "floor"; `dig`: of the stage that excavates
struct Parts {
  std::string head = "", side = "fixed_side = \"below\"", dig = "";
};

std::string scene_of(const Parts& parts) {
  return "dimension = 2\ndensity = 2000\ngravity = [0, -10]\n" + parts.head + R"(
domain = { box = { min = [0, 0], max = [6, 4] } }
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 5e8, friction_deg = 40 }]
[[joints]]
name = "floor"
dip = 0
point = [0, 1]
kind = "boundary"
)" + parts.side +
         R"(
[[joints]]
name = "bed"
dip = 0
point = [0, 2]
[[excavations]]
name = "pit"
outline = true
box = { min = [2, 2], max = [4, 4] }
[[stage]]
name = "stress"
kind = "settle"
[[stage]]
name = "dig"
kind = "settle"
excavate = ["pit"]
)" + parts.dig +
         "\n";
}

Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "scene.toml", overrides);
}

void expect_same(const Scene& earlier, const Scene& present, const std::string& which) {
  EXPECT_EQ(canonical_text(earlier), canonical_text(present)) << which;
  EXPECT_EQ(toml_text(*earlier.tree), toml_text(*present.tree)) << which;
  EXPECT_FALSE(earlier.renamed.empty()) << which;
  EXPECT_TRUE(present.renamed.empty()) << which;
}

struct Twins {
  Parts earlier, present;
};

// each row of the table at least once, alone and among keys that keep their names
const std::vector<Twins>& twins() {
  static const std::vector<Twins> all{
      {{.head = "damping = { statics = \"newton\" }"}, {.head = "statics = \"newton\""}},
      {{.head = "damping.statics = \"local\"\ndamping.local = 0.5"},
       {.head = "statics = \"local\"\ndamping.local = 0.5"}},
      {{.head = "damping = { increments = 4, viscous_ratio = 0.1, statics = \"newton\" }"},
       {.head = "static_increments = 4\nstatics = \"newton\"\ndamping = { viscous_ratio = 0.1 }"}},
      {{.side = "whole = \"below\""}, {}},
      {{.dig = "damping = { statics = \"newton\" }"}, {.dig = "statics = \"newton\""}},
      {{.dig = "damping = { increments = 3, local = 0.1 }"},
       {.dig = "static_increments = 3\ndamping = { local = 0.1 }"}},
      {{.dig = "let_off = { share = 0.4, duration_s = 1 }"},
       {.dig = "excavation_forces = { remaining = 0.4, duration_s = 1 }"}},
      {{.dig = "let_off = { remaining = 0.4, duration_s = 1 }"},
       {.dig = "excavation_forces = { remaining = 0.4, duration_s = 1 }"}},
      {{.dig = "excavation_forces = { share = 0.4, duration_s = 1 }"},
       {.dig = "excavation_forces = { remaining = 0.4, duration_s = 1 }"}}};
  return all;
}

TEST(RenamedKeys, GiveTheSameSceneAndHash) {
  for (const Twins& pair : twins()) {
    const std::string text = scene_of(pair.earlier);
    expect_same(parse(text), parse(scene_of(pair.present)), text);
  }
  const Scene scene = parse(scene_of({.head = "damping = { statics = \"newton\", increments = 4 }",
                                      .dig = "let_off = { share = 0.4, duration_s = 1 }"}));
  EXPECT_EQ(scene.settings.statics.method, Statics::newton);
  EXPECT_EQ(scene.settings.statics.increments, 4);
  ASSERT_TRUE(scene.stages[1].plan.excavation_forces);
  EXPECT_EQ(scene.stages[1].plan.excavation_forces->remaining, 0.4);
  EXPECT_EQ(scene.tree->find("damping"), nullptr) << "a table that held nothing else is gone";
}

// what the program printed as input_hash before it knew the present names
TEST(RenamedKeys, KeepTheHashOfEarlierRuns) {
  const Parts earlier{
      .head = "preset = \"thesis\"\ndamping = { statics = \"newton\", increments = 4, viscous_ratio = 0.1 }",
      .side = "whole = \"below\"",
      .dig = "let_off = { share = 0.4, duration_s = 1 }\ndamping = { statics = \"adaptive\" }"};
  EXPECT_EQ(input_hash(parse(scene_of(earlier))), "fnv1a64:8b6a01df2055afd4");
}

TEST(RenamedKeys, ExistUnderTheirPresentNamesOnly) {
  const auto row_of = [](std::string_view path) {
    const std::size_t dot = path.rfind('.');
    const std::string_view table = dot == std::string_view::npos ? "" : path.substr(0, dot);
    const std::string_view group = table.substr(table.rfind('.') == std::string_view::npos ? 0 : table.rfind('.') + 1);
    return find_row({group}, path.substr(dot == std::string_view::npos ? 0 : dot + 1));
  };
  const std::string documentation = scene_documentation();
  for (const RenamedKey& row : renamed_keys) {
    EXPECT_EQ(row_of(row.earlier), nullptr) << row.earlier;
    EXPECT_NE(row_of(row.present), nullptr) << row.present;
    EXPECT_NE(documentation.find("| `" + std::string(row.earlier) + "` | `" + std::string(row.present) + "` |"),
              std::string::npos);
  }
}

TEST(RenamedKeys, AreNamedWithFileAndLine) {
  const Scene scene = parse(
      scene_of({.head = "damping = { statics = \"newton\" }", .dig = "let_off = { share = 0.4, duration_s = 1 }"}),
      {"stage.stress.damping.increments=2", "joints.floor.whole=above"});
  EXPECT_EQ(scene.renamed,
            (std::vector<std::string>{
                "scene.toml:4: damping.statics is now statics",
                "scene.toml:28: stage.dig.let_off is now stage.dig.excavation_forces",
                "scene.toml:28: stage.dig.excavation_forces.share is now stage.dig.excavation_forces.remaining",
                "scene.toml: --set stage.stress.damping.increments=2: stage.stress.damping.increments is now "
                "stage.stress.static_increments",
                "scene.toml: --set joints.floor.whole=above: joints.floor.whole is now joints.floor.fixed_side"}));
}

void expect_refused(const std::string& text, const std::vector<std::string>& overrides,
                    const std::vector<std::string>& parts) {
  try {
    parse(text, overrides);
    ADD_FAILURE() << text;
  } catch (const SceneError& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << "\n" << error.what();
  }
}

TEST(RenamedKeys, AreRefusedUnderBothNames) {
  expect_refused(scene_of({.head = "statics = \"local\"\ndamping = { statics = \"newton\" }"}), {},
                 {"scene.toml:5: damping.statics = \"newton\": is the earlier name of statics, which is stated too in "
                  "line 4; remove damping.statics"});
  expect_refused(scene_of({.side = "fixed_side = \"below\"\nwhole = \"below\""}), {},
                 {"scene.toml:13: joints.floor.whole = \"below\"", "joints.floor.fixed_side", "in line 12"});
  const std::string forces = "excavation_forces = { remaining = 0.4, duration_s = 1 }";
  expect_refused(scene_of({.dig = forces + "\nlet_off = { share = 0.4, duration_s = 1 }"}), {},
                 {"scene.toml:29: stage.dig.let_off", "stage.dig.excavation_forces, which is stated too in line 28"});
  expect_refused(scene_of({.dig = "let_off = { share = 0.4, remaining = 0.4, duration_s = 1 }"}), {},
                 {"scene.toml:28: stage.dig.excavation_forces.share = 0.4",
                  "remaining, which is stated too in line 28; remove stage.dig.excavation_forces.share"});
  expect_refused(scene_of({}), {"stage.dig.let_off={ share = 0.4, remaining = 0.3, duration_s = 1 }"},
                 {"--set stage.dig.let_off=", "remove stage.dig.excavation_forces.share"});
}

TEST(RenamedKeys, AreTakenInOverrides) {
  const std::string text = scene_of({.head = "statics = \"local\"\ndamping = { local = 0.5 }",
                                     .dig = "excavation_forces = { remaining = 0.4, duration_s = 1 }"});
  const std::vector<std::pair<std::string, std::string>> pairs{
      {"damping.statics=newton", "statics=newton"},
      {"damping.increments = 4", "static_increments=4"},
      {"stage.dig.damping.statics=newton", "stage.dig.statics=newton"},
      {"stage.2.let_off.share=0.2", "stage.dig.excavation_forces.remaining=0.2"},
      {"stage.dig.let_off.remaining=0.2", "stage.dig.excavation_forces.remaining=0.2"},
      {"stage.dig.excavation_forces.share=0.2", "stage.dig.excavation_forces.remaining=0.2"},
      {"stage.dig.let_off={ share = 0.3, duration_s = 2 }",
       "stage.dig.excavation_forces={ remaining = 0.3, duration_s = 2 }"},
      {"joints.floor.whole=above", "joints.floor.fixed_side=above"}};
  for (const auto& [earlier, present] : pairs) {
    expect_same(parse(text, {earlier}), parse(text, {present}), earlier);
    EXPECT_NE(canonical_text(parse(text, {earlier})), canonical_text(parse(text))) << earlier;
  }
  // a table replaces the one that was there
  expect_same(parse(text, {"damping={ statics = \"newton\" }"}),
              parse(scene_of(
                  {.head = "statics = \"newton\"", .dig = "excavation_forces = { remaining = 0.4, duration_s = 1 }"})),
              "a whole table");
  // an unknown key has the message of any other
  expect_refused(text, {"damping.static=newton"}, {"damping.static: no such key"});
}

class RenamedBase : public ::testing::Test {
 protected:
  RenamedBase() { fs::create_directories(folder_); }
  ~RenamedBase() override { fs::remove_all(folder_); }
  Scene read(const std::string& base, const std::string& variant) const {
    std::ofstream(folder_ / "scene.toml") << base;
    std::ofstream(folder_ / "variant.toml") << "base = \"scene.toml\"\n" << variant;
    return read_scene(folder_ / "variant.toml");
  }

 private:
  const fs::path folder_ = fs::temp_directory_path() / ("voussoir_renamed_" + std::to_string(getpid()));
};

// The variant overrides its base, whichever of the two has the earlier name.
TEST_F(RenamedBase, IsOverriddenByAVariant) {
  const Parts earlier{.head = "damping = { statics = \"local\", local = 0.5 }",
                      .side = "whole = \"below\"",
                      .dig = "let_off = { share = 0.4, duration_s = 1 }"};
  const Parts present{.head = "statics = \"local\"\ndamping = { local = 0.5 }",
                      .dig = "excavation_forces = { remaining = 0.4, duration_s = 1 }"};
  const std::string stage = "[[stage]]\nname = \"dig\"\n", floor = "[[joints]]\nname = \"floor\"\n";
  const std::string in_earlier =
      "[damping]\nstatics = \"newton\"\n" + stage + "let_off = { share = 0.2 }\n" + floor + "whole = \"above\"\n";
  const std::string in_present = "statics = \"newton\"\n" + stage + "excavation_forces = { remaining = 0.2 }\n" +
                                 floor + "fixed_side = \"above\"\n";
  const Scene wanted = read(scene_of(present), in_present);
  EXPECT_EQ(wanted.settings.statics.method, Statics::newton);
  EXPECT_EQ(wanted.stages[1].plan.excavation_forces->remaining, 0.2);
  for (const Parts& base : {earlier, present})
    for (const std::string& variant : {in_earlier, in_present}) {
      const Scene mixed = read(scene_of(base), variant);
      EXPECT_EQ(canonical_text(mixed), canonical_text(wanted)) << scene_of(base) << variant;
      EXPECT_EQ(toml_text(*mixed.tree), toml_text(*wanted.tree));
    }
}

}  // namespace
}  // namespace voussoir::renamed_keys_test
