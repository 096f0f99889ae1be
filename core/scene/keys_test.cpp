// The key table: its defaults, its examples and its documentation agree with what is read.
#include "core/scene/keys.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "core/scene/scene.hpp"
#include "core/testing/every_key.hpp"

namespace voussoir {
namespace {

using every_key::address;
using every_key::everything;

Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "scene.toml", overrides);
}

// all numbers that a scene's defaults may touch, as text
std::string dump(const Scene& s) {
  std::ostringstream out;
  out.precision(17);
  const ContactSettings& c = s.settings.contact;
  out << static_cast<int>(c.lp) << ' ' << static_cast<int>(c.centre) << ' ' << static_cast<int>(c.point) << ' '
      << static_cast<int>(c.normal) << ' ' << static_cast<int>(c.overlap) << ' ' << c.tolerance << ' '
      << c.potential_radius << ' ' << c.smoothing << ' ' << c.newton_tolerance << ' ' << c.newton_limit << ' ' << c.skin
      << '\n'
      << static_cast<int>(s.settings.damping.statics) << ' ' << s.settings.damping.local << ' '
      << s.settings.damping.viscous_ratio << ' ' << s.settings.time.fraction << ' ' << s.settings.equilibrium.unbalanced
      << ' ' << s.settings.equilibrium.window << ' ' << s.smallest_inscribed_radius << ' '
      << s.slicing.largest_aspect_ratio << ' ' << s.slicing.most_blocks << ' ' << static_cast<int>(s.slicing.order)
      << ' ' << static_cast<int>(s.slicing.ends) << '\n'
      << s.output.history_interval << ' ' << s.output.frame_interval << ' ' << s.output.frames << '\n';
  for (const JointSpec& joint : s.joints)
    out << static_cast<int>(joint.kind) << ' ' << static_cast<int>(joint.outline.shape) << '\n';
  for (const ExcavationSpec& e : s.excavations)
    out << (e.region.cylinder ? e.region.cylinder->sides : 0) << '\n';
  for (const SelectorSpec& spec : s.fix)
    out << spec.selector.all << '\n';
  for (const PropertiesSpec& spec : s.properties) {
    const JointProperties& p = spec.properties;
    out << p.constant_stiffness << ' ' << p.sub_contacts << ' ' << static_cast<int>(p.laws.normal) << ' '
        << static_cast<int>(p.laws.shear) << ' ' << static_cast<int>(p.laws.friction) << ' ' << p.hardening_exponent
        << ' ' << p.tension << ' ' << p.cohesion << '\n';
  }
  for (const JointSetSpec& spec : s.joint_sets) {
    const JointSet& set = spec.set;
    out << static_cast<int>(set.scatter) << ' ' << static_cast<int>(set.size_law) << ' ' << static_cast<int>(set.shape)
        << ' ' << static_cast<int>(set.arrangement) << ' ' << set.dip_direction_deviation << ' ' << set.elongation
        << ' ' << set.persistence << ' ' << set.seed << '\n';
  }
  for (const BlockSpec& b : s.blocks)
    out << b.fixed << '\n';
  for (const StageSpec& stage : s.stages) {
    out << stage.plan.change.bond << '\n';
    if (const auto* settle = std::get_if<SettlePlan>(&stage.plan.plan))
      out << settle->gravity.ramp << ' ' << settle->time_limit << ' ' << settle->step_limit << '\n';
    if (const auto* run = std::get_if<RunPlan>(&stage.plan.plan))
      out << run->gravity.ramp << ' ' << run->duration << '\n';
    if (const auto* reduce = std::get_if<ReducePlan>(&stage.plan.plan))
      out << static_cast<int>(reduce->method) << ' ' << reduce->failure_displacement << ' ' << reduce->ramp_steps << ' '
          << reduce->step_limit << '\n';
    for (const MovePlan& move : stage.plan.change.move)
      out << move.translation[0] << move.translation[1] << move.translation[2] << ' ' << move.factor.phase << '\n';
    for (const ForcePlan& force : stage.plan.change.force)
      out << force.turns_with_body << '\n';
    if (stage.plan.damping)
      out << static_cast<int>(stage.plan.damping->statics) << ' ' << stage.plan.damping->local << ' '
          << stage.plan.damping->viscous_ratio << '\n';
  }
  return out.str();
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
  EXPECT_EQ(find_row({"excavations"}, "outline")->default_value, ExcavationSpec{}.outline ? "true" : "false");
  EXPECT_TRUE(dump(parse(everything)).starts_with(dump(Scene{})));
  for (const KeyRow& row : key_rows()) {
    if (row.default_value.empty()) continue;
    const std::string text = address(row) + "=" + std::string(row.default_value);
    EXPECT_EQ(dump(parse(everything, {text})), dump(parse(everything))) << text;
  }
}

// The test above sees only what the dump holds: of every key with a default, a value that is not the default shows in
// it. A choice may need other keys beside it, and is then refused.
TEST(Keys, WithADefaultShowInTheDump) {
  for (const KeyRow& row : key_rows()) {
    if (row.default_value.empty() || row.example == row.default_value) continue;
    // stated in the scene, for without it the tunnel takes out no block
    if (row.table == "excavations" && row.key == "outline") continue;
    const std::string text = address(row) + "=" + std::string(row.example);
    try {
      EXPECT_NE(dump(parse(everything, {text})), dump(parse(everything))) << text;
    } catch (const SceneError& error) {
      EXPECT_EQ(row.type, KeyType::choice) << text << ": " << error.what();
    }
  }
}

TEST(Keys, HaveExamplesThatAreAccepted) {
  for (const KeyRow& row : key_rows()) {
    if (row.type == KeyType::table || row.type == KeyType::tables || row.key == "base" || row.key.ends_with("_file"))
      continue;
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
