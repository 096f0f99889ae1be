// The key table: its defaults, its examples and its documentation agree with what is read.
#include "core/scene/keys.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "core/scene/scene.hpp"

namespace voussoir {
namespace {

// every key of the table can stand in it
const std::string everything = R"(dimension = 3
density = 2000
[domain]
box = { min = [-1, -1, -1], max = [1, 1, 1] }
[[domain.planes]]
dip = 0
point = [0, 0, 0.9]
keep = "below"
[[joints]]
name = "A"
dip = 0
point = [0, 0, 0]
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 30
[[blocks]]
name = "by planes"
planes = [{ normal = [1, 0, 0], offset = 11 }, { normal = [-2, 0, 0], offset = -20 },
          { normal = [0, 1, 0], offset = 1 }, { normal = [0, -1, 0], offset = 1 },
          { normal = [0, 0, 1], point = [0, 0, 1] }, { normal = [0, 0, -1], offset = 0 }]
[[blocks]]
name = "by vertices"
vertices = [[20, 0, 0], [21, 0, 0], [20, 1, 0], [20, 0, 1]]
[[fix]]
below = ["A"]
[[restrain]]
above = ["A"]
rotation = true
[[initial_velocity]]
bodies = ["by planes"]
velocity = [1, 0, 0]
[contact]
[damping]
[time]
[equilibrium]
[slicing]
[[stage]]
name = "settle"
kind = "settle"
damping = {}
fix = [{ bodies = ["by planes"] }]
[[stage]]
name = "run"
kind = "run"
duration_s = 1
release = [{ bodies = ["by planes"] }]
remove = [{ bodies = ["by vertices"] }]
[[stage]]
name = "bisection"
kind = "reduce"
from_deg = 60
to_deg = 5
tolerance_deg = 0.01
[[stage]]
name = "steps"
kind = "reduce"
method = "steps"
from_deg = 60
to_deg = 5
step_deg = 0.5
[[stage]]
name = "rate"
kind = "reduce"
method = "rate"
from_deg = 60
to_deg = 5
rate_deg_per_s = 0.1
[[monitors]]
name = "body"
quantities = ["displacement"]
above = ["A"]
inside = [0.1, 0.1, 0.1]
[[monitors]]
name = "joint"
quantities = ["contact_force"]
joint = "A"
[output]
)";

Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "scene.toml", overrides);
}

// all numbers that a scene's defaults may touch, as text
std::string dump(const Scene& s) {
  std::ostringstream out;
  out.precision(17);
  const ContactSettings& c = s.settings.contact;
  out << static_cast<int>(c.lp) << ' ' << static_cast<int>(c.centre) << ' ' << static_cast<int>(c.point) << ' '
      << c.tolerance << ' ' << c.potential_radius << ' ' << c.newton_tolerance << ' ' << c.newton_limit << ' ' << c.skin
      << '\n'
      << s.settings.damping.local << ' ' << s.settings.damping.viscous_ratio << ' ' << s.settings.time.fraction << ' '
      << s.settings.equilibrium.unbalanced << ' ' << s.settings.equilibrium.window << ' ' << s.smallest_inscribed_radius
      << '\n'
      << s.output.history_interval << ' ' << s.output.frame_interval << ' ' << s.output.frames << '\n';
  for (const PropertiesSpec& p : s.properties)
    out << p.properties.constant_stiffness << '\n';
  for (const BlockSpec& b : s.blocks)
    out << b.fixed << '\n';
  for (const StageSpec& stage : s.stages) {
    if (const auto* settle = std::get_if<SettlePlan>(&stage.plan.plan))
      out << settle->gravity_ramp << ' ' << settle->time_limit << ' ' << settle->step_limit << '\n';
    if (const auto* run = std::get_if<RunPlan>(&stage.plan.plan))
      out << run->gravity_ramp << ' ' << run->duration << '\n';
    if (const auto* reduce = std::get_if<ReducePlan>(&stage.plan.plan))
      out << static_cast<int>(reduce->method) << ' ' << reduce->failure_displacement << ' ' << reduce->ramp_steps << ' '
          << reduce->step_limit << '\n';
    if (stage.plan.damping) out << stage.plan.damping->local << ' ' << stage.plan.damping->viscous_ratio << '\n';
  }
  return out.str();
}

// where in `everything` a row's key can be set
std::string address(const KeyRow& row) {
  const std::map<std::string_view, std::string> tables = {{"box", "domain.box"},
                                                          {"domain.planes", "domain.planes.1"},
                                                          {"joints", "joints.A"},
                                                          {"joint_properties", "joint_properties.rock"},
                                                          {"blocks", "blocks.by planes"},
                                                          {"blocks.planes", "blocks.by planes.planes.1"},
                                                          {"label", "fix.1"},
                                                          {"selector", "fix.1"},
                                                          {"restrain", "restrain.1"},
                                                          {"motion", "initial_velocity.1"},
                                                          {"monitors", "monitors.body"}};
  std::string table(row.table);
  if (const auto at = tables.find(row.table); at != tables.end()) table = at->second;
  if (row.table == "stage") {
    const std::string kind(row.when.value.substr(0, row.when.value.find('|')));
    table = "stage." + (kind.empty() ? "settle" : kind == "reduce" ? "bisection" : kind);
  }
  if (row.table == "blocks" && row.key == "vertices") table = "blocks.by vertices";
  if (row.table == "blocks.planes" && row.key == "point") table = "blocks.by planes.planes.5";
  if (row.table == "monitors" && row.key == "joint") table = "monitors.joint";
  return key_path(table, row.key);
}

TEST(Prepare, TakesBlocksByVerticesPlanesAndBox) {
  const Prepared<3> p = prepare<3>(parse(everything));
  std::map<std::string, Body<3>> named;
  for (const Body<3>& b : p.model.bodies)
    named[b.name] = b;
  ASSERT_TRUE(named.count("by planes") && named.count("by vertices"));
  EXPECT_NEAR(named["by planes"].mass, 2000 * 1 * 2 * 1, 1e-6);
  EXPECT_NEAR(named["by vertices"].mass, 2000 / 6.0, 1e-6);
  const Vector<3> centroid = named["by planes"].reference + p.model.origin;
  EXPECT_LT((centroid - Vector<3>(10.5, 0, 0.5)).norm(), 1e-9);
  for (std::size_t b = 0; b < p.model.bodies.size(); ++b)
    EXPECT_EQ(p.state.motions[b].velocity[0], p.model.bodies[b].name == "by planes" ? 1 : 0);
}

TEST(Keys, HoldTheDefaultsOfSettings) {
  EXPECT_TRUE(dump(parse(everything)).starts_with(dump(Scene{})));
  for (const KeyRow& row : key_rows()) {
    if (row.fallback.empty()) continue;
    const std::string text = address(row) + "=" + std::string(row.fallback);
    EXPECT_EQ(dump(parse(everything, {text})), dump(parse(everything))) << text;
  }
}

TEST(Keys, HaveExamplesThatAreAccepted) {
  for (const KeyRow& row : key_rows()) {
    if (row.type == KeyType::table || row.type == KeyType::tables) continue;
    ASSERT_FALSE(row.example.empty()) << row.key;
    const std::string text = address(row) + "=" + std::string(row.example);
    // what else must fit together is judged after types and ranges, with its own words
    try {
      parse(everything, {text});
    } catch (const SceneError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.find("must exceed min") != std::string::npos || message.find("beside") != std::string::npos ||
                  message.find("only one of") != std::string::npos ||
                  message.find("applies only where") != std::string::npos ||
                  message.find("is missing") != std::string::npos)
          << text << "\n"
          << message;
    }
  }
}

TEST(Keys, AreDocumentedEachOnce) {
  const std::string text = scene_documentation();
  std::map<std::string_view, int> groups;
  std::string_view last = "none yet";
  for (const KeyRow& row : key_rows()) {
    EXPECT_NE(text.find("| `" + std::string(row.key) + "` |"), std::string::npos) << row.key;
    EXPECT_FALSE(row.meaning.empty()) << row.key;
    const bool begins = row.table != last;
    last = row.table;
    EXPECT_EQ(groups[row.table] += begins, 1) << row.table << " is split";
    EXPECT_EQ(find_row({row.table}, row.key), &row) << "twice: " << row.key;
    for (const std::string_view group : row.holds)
      EXPECT_FALSE(keys_of({group}).empty()) << group;
  }
}

TEST(Documentation, HoldsASceneThatRuns) {
  const std::string text = scene_documentation();
  const std::size_t begin = text.find("```toml\n") + 8;
  const Scene scene = parse(text.substr(begin, text.find("```", begin) - begin));
  EXPECT_EQ(prepare<3>(scene).model.bodies.size(), 2u);
}

}  // namespace
}  // namespace voussoir
