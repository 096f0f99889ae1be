// The friction that a search for a factor of safety divides: random sequences of stages, compared with bookkeeping of
// their text.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "core/output/results.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_text.hpp"
#include "text/angle.hpp"

namespace voussoir::divided_strength_test {
namespace {

// the text of a stage
struct WrittenStage {
  std::string name = {}, search = {};          // search: "", "friction" or "factor"
  std::vector<std::string> named = {};         // by the search; none: all
  std::string all = {};                        // friction_deg
  std::map<std::string, std::string> of = {};  // friction, by name

  std::string text() const {
    std::string text = fmt::format("[[stage]]\nname = \"{}\"\n", name);
    if (search.empty()) text += "kind = \"settle\"\n";
    if (search == "factor")
      text += "kind = \"reduce\"\nsearch = \"factor\"\nfrom_factor = 0.5\nto_factor = 4\ntolerance_factor = 0.1\n";
    if (search == "friction") text += "kind = \"reduce\"\nfrom_deg = 60\nto_deg = 5\ntolerance_deg = 1\n";
    if (!named.empty()) text += fmt::format("joint_properties = [\"{}\"]\n", fmt::join(named, "\", \""));
    if (!all.empty()) text += fmt::format("friction_deg = {}\n", all);
    std::vector<std::string> items;
    for (const auto& [joint, angle] : of)
      items.push_back(fmt::format("{{ name = \"{}\", friction_deg = {} }}", joint, angle));
    if (!items.empty()) text += fmt::format("friction = [{}]\n", fmt::join(items, ", "));
    return text;
  }
  bool states(const std::string& joint) const { return !all.empty() || of.contains(joint); }
  // as texts only, so that equal angles have equal texts
  std::string angle_of(const std::string& joint, const std::string& before) const {
    if (of.contains(joint)) return of.at(joint);
    return all.empty() ? before : all;
  }
  bool divides(const std::string& joint) const {
    return search == "factor" && (named.empty() || std::ranges::find(named, joint) != named.end());
  }
};

struct WrittenScene {
  std::map<std::string, std::string> joints;  // angle by name
  std::vector<WrittenStage> stages;

  std::string text() const {
    std::string text =
        "dimension = 2\ngravity = [0, -9.81]\ndensity = 2600\n[domain]\nbox = { min = [-1, -1], max = [1, 1] }\n"
        "[[joints]]\nname = \"plane\"\ndip = 20\ndip_direction = 270\npoint = [0, 0]\nproperties = \"a\"\n"
        "[[fix]]\nbelow = [\"plane\"]\n";
    for (const auto& [name, angle] : joints)
      text += fmt::format(
          "[[joint_properties]]\nname = \"{}\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = {}\n",
          name, angle);
    for (const WrittenStage& stage : stages)
      text += stage.text();
    return text;
  }
};

class RandomSearch {
 public:
  explicit RandomSearch(unsigned seed) : random_(seed) {}

  WrittenScene scene() {
    WrittenScene scene;
    for (const char* name : {"a", "b", "c"})
      if (scene.joints.empty() || chance(0.7)) scene.joints[name] = angle();
    for (int k = 0, count = 1 + below(4); k <= count; ++k) {
      WrittenStage stage;
      stage.name = fmt::format("stage{}", k);
      if (k == count || chance(0.2)) stage.search = chance(0.85) ? "factor" : "friction";
      if (chance(0.2)) stage.all = angle();
      for (const auto& [name, own] : scene.joints) {
        if (chance(0.3)) stage.of[name] = angle();
        if (!stage.search.empty() && chance(0.4)) stage.named.push_back(name);
      }
      scene.stages.push_back(stage);
    }
    return scene;
  }

 private:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  bool chance(double p) { return std::uniform_real_distribution<double>()(random_) < p; }
  std::string angle() { return std::vector<std::string>{"20", "38", "38.5", "75"}[below(4)]; }
  std::mt19937 random_;
};

struct Offence {
  std::size_t stage;
  std::map<std::string, std::pair<std::string, std::string>> joints;  // angle in force, own angle
};

// the first search whose joints have another angle than their own, which its stage does not state
std::optional<Offence> offence_of(const WrittenScene& scene) {
  std::map<std::string, std::string> now = scene.joints;
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    Offence offence{k, {}};
    for (auto& [joint, angle] : now) {
      const WrittenStage& stage = scene.stages[k];
      if (stage.divides(joint) && !stage.states(joint) && angle != scene.joints.at(joint))
        offence.joints[joint] = {angle, scene.joints.at(joint)};
      angle = stage.angle_of(joint, angle);
    }
    if (!offence.joints.empty()) return offence;
  }
  return {};
}

std::string complaint_about(const WrittenScene& scene) {
  try {
    parse_scene(scene.text(), "scene.toml");
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(DividedStrength, IsThatOfItsOwnStageOrOfTheJointNeverOfAnEarlierStage) {
  RandomSearch random(52);
  int refused = 0, accepted = 0;
  for (int k = 0; k < 400; ++k) {
    WrittenScene scene = random.scene();
    while (const std::optional<Offence> offence = offence_of(scene)) {
      ++refused;
      const std::string said = complaint_about(scene);
      WrittenStage& stage = scene.stages[offence->stage];
      ASSERT_NE(said.find(fmt::format("stage.{}.friction", stage.name)), std::string::npos) << said << scene.text();
      for (const auto& [joint, angles] : offence->joints) {
        ASSERT_NE(said.find(fmt::format("'{}' has {} deg since stage '", joint, angles.first)), std::string::npos)
            << said;
        ASSERT_NE(said.find(fmt::format("state {} deg", angles.second)), std::string::npos) << said;
        stage.of[joint] = angles.second;
      }
      // the line in the message is that of the repaired stage
      const std::string line = said.substr(said.find("write friction = ["));
      for (const auto& [joint, angle] : stage.of)
        ASSERT_NE(line.find(fmt::format("{{ name = \"{}\", friction_deg = {} }}", joint, angle)), std::string::npos)
            << said;
    }
    ++accepted;
    ASSERT_EQ(complaint_about(scene), "") << scene.text();

    // a search then divides the value of its own stage, or the joint's own
    const Prepared<2> prepared = prepare<2>(parse_scene(scene.text(), "scene.toml"));
    Model<2> model = prepared.model;
    for (std::size_t s = 0; s < scene.stages.size(); ++s) {
      model = apply(std::move(model), prepared.stages[s].change);
      for (const JointProperties& p : model.properties)
        if (scene.stages[s].divides(p.name)) {
          const std::string own = scene.stages[s].angle_of(p.name, scene.joints.at(p.name));
          ASSERT_NEAR(p.friction, std::stod(own) * degree, 1e-15)
              << p.name << " in " << scene.stages[s].name << scene.text();
        }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_EQ(accepted, 400);
}

// a search for an angle may start from another value
TEST(DividedStrength, ASearchForAnAngleReplacesEarlierAngles) {
  RandomSearch random(53);
  for (int k = 0; k < 100; ++k) {
    WrittenScene scene = random.scene();
    for (WrittenStage& stage : scene.stages)
      if (stage.search == "factor") stage.search = "friction";
    ASSERT_EQ(complaint_about(scene), "") << scene.text();
  }
}

TEST(DividedStrength, TheWetSlopeNeedsItsRestoringLine) {
  std::string text = file_text(std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "examples/wet_slope.toml");
  EXPECT_NO_THROW(parse_scene(text, "wet_slope.toml"));
  const std::string line = "friction = [{ name = \"joint\", friction_deg = 38 }]";
  text.erase(text.find(line), line.size());
  try {
    parse_scene(text, "wet_slope.toml");
    FAIL() << "3.06 for 0.841";
  } catch (const SceneError& error) {
    const std::string said = error.what();
    EXPECT_EQ(said.find('\n'), std::string::npos);
    EXPECT_NE(said.find("'joint' has 75 deg since stage 'settle', and its joint_properties state 38 deg"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("write " + line), std::string::npos) << said;
    EXPECT_EQ(error.key, "stage.safety.friction");
  }
}

// A stage's angle replaces Barton and Bandis' law until a stage restores it.
TEST(DividedStrength, BartonAndBandisLawIsSetAsideAndRestored) {
  WrittenScene scene{{{"a", "26"}}, {{.name = "settle", .all = "75"}, {.name = "safety", .search = "factor"}}};
  const auto with_law = [&] {
    std::string text = scene.text();
    const std::string angle = "shear_stiffness = 1e8\n";
    return text.insert(text.find(angle) + angle.size(), "friction_law = \"barton_bandis\"\njrc = 10\njcs = 30e6\n");
  };
  const auto complaint = [&](const std::string& text) {
    try {
      parse_scene(text, "scene.toml");
      return std::string();
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
  };
  const std::string said = complaint(with_law());
  const std::string line = "friction = [{ name = \"a\", as_stated = true }]";
  EXPECT_NE(said.find("'a' has 75 deg since stage 'settle', and its joint_properties state Barton and Bandis' law"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("write " + line), std::string::npos) << said;
  for (const std::string& restored : {line, std::string("friction_as_stated = true")}) {
    const Prepared<2> prepared = prepare<2>(parse_scene(with_law() + restored + "\n", "scene.toml"));
    Model<2> model = apply(Model<2>(prepared.model), prepared.stages[0].change);
    EXPECT_EQ(model.properties[0].laws.friction, FrictionLaw::constant);
    EXPECT_TRUE(model.properties[0].states_barton_bandis());
    EXPECT_TRUE(model.properties[0].remembers_place());
    EXPECT_FALSE(model.properties[0].dilates());
    EXPECT_NEAR(model.properties[0].friction, 75 * degree, 1e-15);
    model = apply(std::move(model), prepared.stages[1].change);
    EXPECT_TRUE(model.properties[0].follows_barton_bandis());
    EXPECT_FALSE(model.properties[0].laws.set_aside);
    EXPECT_NEAR(model.properties[0].friction, 26 * degree, 1e-15);
  }
  EXPECT_NE(complaint(with_law() + "friction_deg = 30\nfriction_as_stated = true\n").find("remove one of the two"),
            std::string::npos);

  // a search for an angle
  scene.stages = {{.name = "settle"}, {.name = "critical", .search = "friction"}};
  EXPECT_NE(complaint(with_law()).find("write search = \"factor\""), std::string::npos);
  scene.stages[1].all = "75";
  EXPECT_EQ(complaint(with_law()), "");
}

TEST(DividedStrength, ASentenceNamesTheDividedStrengths) {
  EXPECT_EQ(divided_by_factor({"joint", "crack"}),
            "divides tan φ and cohesion of 'joint', 'crack'; not tensile strength, bolts, linings' beams or water");
  EXPECT_EQ(divided_by_factor({}, false),
            "divides tan φ of all joints; not cohesion, which is left out, tensile strength, bolts, linings' beams or "
            "water");
}

}  // namespace
}  // namespace voussoir::divided_strength_test
