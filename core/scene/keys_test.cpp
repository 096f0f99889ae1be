// The key table: its defaults, examples and documentation agree with the reader.
#include "core/scene/keys.hpp"

#include <gtest/gtest.h>

#include <map>
#include <sstream>

#include "core/scene/effective_scene.hpp"
#include "core/scene/scene.hpp"
#include "core/testing/every_key.hpp"

namespace voussoir::keys_test {
namespace {

using every_key::address;
using every_key::everything;
using every_key::scene_of;

// with the default of every key
Scene parse(const std::string& text, std::vector<std::string> overrides = {}) {
  overrides.insert(overrides.begin(), "preset=thesis");
  return parse_scene(text, "scene.toml", overrides);
}

// The values that rows of the key table have read into a struct, by table and key as TOML: one value after the other if
// a scene has several such structs.
using Values = std::map<std::string, std::string>;

template <class Owner>
void add(Values& values, std::string_view table, const Owner& owner) {
  for (const KeyRow& row : key_rows(table))
    for (const KeyMember& member : row.members)
      if (*member.owner == typeid(Owner) && row.type != KeyType::table)
        values[key_path(std::string(table), row.key)] += member.text(&owner) + '\n';
}

void add_region(Values& values, const RegionSpec& region) {
  if (region.box) add(values, "box", *region.box);
  if (region.cylinder) add(values, "cylinder", *region.cylinder);
}

void add_stage(Values& values, const StageSpec& spec) {
  const StagePlan& stage = spec.plan;
  add(values, "stage", stage);
  if (const auto* settle = std::get_if<SettlePlan>(&stage.plan)) {
    add(values, "stage", *settle);
    add(values, "stage", settle->gravity);
  }
  if (const auto* run = std::get_if<RunPlan>(&stage.plan)) {
    add(values, "stage", *run);
    add(values, "stage", run->gravity);
  }
  if (const auto* reduce = std::get_if<ReducePlan>(&stage.plan)) {
    add(values, "stage", *reduce);
    add(values, "stage", reduce->factor);
  }
  if (stage.damping) add(values, "damping", *stage.damping);
  if (stage.statics) add(values, "stage", *stage.statics);
  add(values, "stage", stage.change);
  if (stage.excavation_forces) add(values, "excavation_forces", *stage.excavation_forces);
  for (const FrictionPlan& friction : stage.change.friction_of)
    add(values, "friction", friction);
  for (const MovePlan& move : stage.change.move) {
    add(values, "move", move);
    add(values, "factor", move.factor);
  }
  for (const RecordSpec& record : spec.records) {
    add(values, "record", record);
    add(values, "record", record.treatment);
    add(values, "samples", record.samples);
  }
  for (const BoundaryPlan& boundary : stage.change.boundary) {
    add(values, "boundary", boundary);
    if (boundary.in_situ) add(values, "in_situ", *boundary.in_situ);
    if (boundary.free_field) add(values, "medium", *boundary.free_field);
    if (!boundary.quiet) continue;
    add(values, "medium", boundary.quiet->medium);
    add(values, "factor", boundary.quiet->factor);
  }
  for (const ForcePlan& force : stage.change.force) {
    add(values, "force", force);
    add(values, "factor", force.factor);
  }
}

// the structs of a scene into which keys are read
Values values_of(const Scene& s) {
  Values values;
  add(values, "", s);
  add(values, "", s.settings.statics);
  add(values, "contact", s.settings.contact);
  add(values, "damping", s.settings.damping);
  add(values, "time", s.settings.time);
  add(values, "equilibrium", s.settings.equilibrium);
  add(values, "slicing", s.slicing);
  add(values, "output", s.output);
  if (s.domain && s.domain->box) add(values, "box", *s.domain->box);
  if (s.domain)
    for (const DomainPlaneSpec& plane : s.domain->planes) {
      add(values, "domain.planes", plane);
      add(values, "domain.planes", plane.plane);
    }
  for (const JointSpec& joint : s.joints) {
    add(values, "joints", joint);
    add(values, "joints", joint.plane);
    add(values, "joints", joint.outline);
  }
  for (const JointSetSpec& spec : s.joint_sets) {
    add(values, "joint_sets", spec);
    add(values, "joint_sets", spec.set);
    add(values, "joint_sets", PlaneSpec{spec.set.dip, spec.set.dip_direction, {}, {}});
  }
  for (const ExcavationSpec& excavation : s.excavations) {
    add(values, "excavations", excavation);
    add_region(values, excavation.region);
  }
  for (const PropertiesSpec& spec : s.properties) {
    add(values, "joint_properties", spec.properties);
    add(values, "joint_properties", spec.properties.laws);
    add(values, "joint_properties", spec.properties.barton_bandis);
  }
  for (const BlockSpec& block : s.blocks) {
    add(values, "blocks", block);
    add(values, "blocks", block.motion);
    add(values, "blocks", block.particle);
    for (const BlockPlaneSpec& plane : block.planes)
      add(values, "blocks.planes", plane);
  }
  for (const WaterSpec& water : s.waters) {
    add(values, "water", water);
    add(values, "water_surface", water.surface);
    if (water.surface.plane) add(values, "water_table", *water.surface.plane);
  }
  for (const BoltSpec& bolt : s.bolts) {
    add(values, "bolts", bolt);
    add(values, "bolts", bolt.properties);
    if (bolt.fan) add(values, "fan", *bolt.fan);
    for (const RepeatSpec& repeat : bolt.repeat)
      add(values, "repeat", repeat);
  }
  for (const LiningSpec& lining : s.linings) {
    add(values, "linings", lining);
    add(values, "linings", lining.properties);
  }
  for (const SelectorSpec& spec : s.fix)
    add(values, "selector", spec.selector);
  for (const RestrainSpec& spec : s.restrain)
    add(values, "restrain", spec);
  for (const InitialVelocitySpec& spec : s.initial_velocity)
    add(values, "motion", spec.motion);
  for (const StageSpec& stage : s.stages)
    add_stage(values, stage);
  for (const StageSpec& stage : s.stages)
    for (const WaterChangeSpec& change : stage.water) {
      add(values, "water_change", change);
      add(values, "water_surface", change.surface);
    }
  for (const MonitorSpec& monitor : s.monitors)
    add(values, "monitors", monitor);
  return values;
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
    EXPECT_EQ(p.state.bodies.motions[b].velocity[0], p.model.bodies[b].name == "by planes" ? 1 : 0);
}

TEST(Keys, HaveTheDefaultsThatTheyShow) {
  for (const KeyRow& row : key_rows()) {
    for (const KeyMember& member : row.members)
      EXPECT_EQ(member.default_value, row.members.front().default_value) << row.key;
    // stated in the scene, because without it the tunnel excavates no block
    if (row.default_value.empty() || (row.table == "excavations" && row.key == "outline")) continue;
    const every_key::Home& home = every_key::home(row, row.default_value);
    const std::string text = home.address + "=" + row.default_value;
    EXPECT_EQ(values_of(parse(*home.scene, {text})), values_of(parse(*home.scene))) << text;
  }
}

// A stated value reaches only its own member, and reads back from the scene's text. The examples of some keys need
// other keys, and are refused.
TEST(Keys, AreReadIntoTheirMembers) {
  int read = 0;
  for (const KeyRow& row : key_rows()) {
    const Scene plain = parse(scene_of(row));
    const Values before = values_of(plain);
    if (row.members.empty() || row.type == KeyType::table || row.example == row.default_value) continue;
    if (row.table == "copies") continue;  // a scene that has been read has only the copies (repeat_test.cpp)
    const std::string key = key_path(std::string(row.table), row.key);
    const std::string text = address(row) + "=" + std::string(row.example);
    ASSERT_TRUE(before.contains(key)) << text;
    try {
      const Scene scene = parse(scene_of(row), {text});
      ++read;
      EXPECT_EQ(canonical_text(parse(toml_text(*scene.tree))), canonical_text(scene)) << text;
      if (canonical_text(scene) == canonical_text(plain)) {  // the scene states this value already
        EXPECT_NE(before.at(key).find(row.example), std::string::npos) << text << "\n" << before.at(key);
        continue;
      }
      const Values after = values_of(scene);
      for (const auto& [other, value] : before)
        EXPECT_EQ(after.at(other) == value, other != key) << text << " and " << other;
    } catch (const SceneError&) {
    }
  }
  EXPECT_GT(read, 220);
}

TEST(Keys, HaveExamplesThatAreAccepted) {
  for (const KeyRow& row : key_rows()) {
    if (row.type == KeyType::table || row.type == KeyType::tables || row.key == "base" || row.key.ends_with("_file"))
      continue;
    ASSERT_FALSE(row.example.empty()) << row.key;
    const std::string text = address(row) + "=" + std::string(row.example);
    // consistency is checked after types and ranges, with its own messages
    try {
      parse(scene_of(row), {text});
    } catch (const SceneError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.find("must exceed min") != std::string::npos ||
                  message.find("is stated ") != std::string::npos || message.find("only one of") != std::string::npos ||
                  message.find("applies only if") != std::string::npos ||
                  message.find("is missing") != std::string::npos || message.find("no such file") != std::string::npos)
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

TEST(Documentation, ContainsASceneThatRuns) {
  const std::string text = scene_documentation();
  const std::size_t begin = text.find("```toml\n") + 8;
  const Scene scene = parse(text.substr(begin, text.find("```", begin) - begin));
  EXPECT_EQ(prepare<3>(scene).model.bodies.size(), 2u);
}

}  // namespace
}  // namespace voussoir::keys_test
