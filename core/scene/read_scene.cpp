// From a checked tree to plain structs: units and what one table must state together.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/scene/accuracy_level.hpp"
#include "core/scene/base_scene.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/overrides.hpp"
#include "core/scene/read_joint_sets.hpp"
#include "core/scene/read_slicing.hpp"
#include "core/scene/read_stages.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_text.hpp"
#include "core/scene/toml_text.hpp"
#include "core/scene/values.hpp"

namespace voussoir {
namespace {

void read_laws(const Subject& item, JointProperties& p) {
  const std::map<std::string, StiffnessLaw> stiffness_words = {
      {"constant", StiffnessLaw::constant}, {"linear", StiffnessLaw::linear}, {"power", StiffnessLaw::power}};
  const std::map<std::string, FrictionLaw> friction_words = {{"constant", FrictionLaw::constant},
                                                             {"hardening", FrictionLaw::hardening},
                                                             {"softening", FrictionLaw::softening}};
  if (const Node* node = item.node->find("normal_law")) p.laws.normal = stiffness_words.at(node->text);
  if (const Node* node = item.node->find("shear_law")) p.laws.shear = stiffness_words.at(node->text);
  if (const Node* node = item.node->find("friction_law")) p.laws.friction = friction_words.at(node->text);
  read(item, "normal_growth", p.normal_growth);
  read(item, "normal_exponent", p.normal_exponent);
  read(item, "shear_growth", p.shear_growth);
  read(item, "shear_exponent", p.shear_exponent);
  read(item, "hardening_slip_m", p.hardening_slip);
  read(item, "hardening_exponent", p.hardening_exponent);
  read(item, "softening_drop", p.softening_drop);
  read(item, "softening_slip_m", p.softening_slip);
  read(item, "tension", p.tension);
  read(item, "cohesion", p.cohesion);
  p.laws.bond = p.tension > 0 || p.cohesion > 0;

  if (p.constant_stiffness && !p.laws.is_plain())
    refuse(
        item, "constant_stiffness",
        "knows no stress, on which every other law depends; remove it and give the stiffness per area, or remove the "
        "laws, tension and cohesion");
  if (p.laws.normal == StiffnessLaw::power && p.tension > 0)
    refuse(item, "tension", "a power law has no stiffness without stress; use the linear or the constant law");
  if (p.laws.friction == FrictionLaw::softening && p.softening_drop > std::tan(p.friction))
    refuse(item, "softening_drop",
           fmt::format("exceeds the friction coefficient tan(friction_deg) = {:.4g} that there is to lose",
                       std::tan(p.friction)));
}

std::vector<PropertiesSpec> read_properties(const Subject& scene) {
  std::vector<PropertiesSpec> all;
  for (const Subject& item : children(scene, "joint_properties")) {
    JointProperties p;
    read(item, "name", p.name);
    read(item, "normal_stiffness", p.normal_stiffness);
    read(item, "shear_stiffness", p.shear_stiffness);
    read_degrees(item, "friction_deg", p.friction);
    read(item, "constant_stiffness", p.constant_stiffness);
    read(item, "sub_contacts", p.sub_contacts);
    read_laws(item, p);
    all.push_back({item, p});
  }
  return all;
}

MotionSpec read_motion(const Subject& subject) {
  MotionSpec motion;
  read(subject, "velocity", motion.velocity);
  read(subject, "angular_velocity", motion.angular_velocity);
  return motion;
}

BlockPlaneSpec read_block_plane(const Subject& subject) {
  BlockPlaneSpec plane{subject, {}, {}, {}};
  read(subject, "normal", plane.normal);
  read(subject, "offset", plane.offset);
  read(subject, "point", plane.point);
  double square = 0;
  for (const double x : plane.normal)
    square += x * x;
  constexpr double least_square = 1e-24;  // shorter ones are a slip of the pen, and their inverse would overflow
  if (!(square > least_square))
    refuse(subject, "normal", "must not be zero; give the direction that points out of the block");
  if (plane.offset && plane.point)
    refuse(subject, "offset", "stands beside point; a plane needs only one of the two, remove one");
  if (!plane.offset && !plane.point)
    refuse(subject, "offset", "a plane needs an offset or a point; write for example offset = 1 or point = [0, 0, 1]");
  return plane;
}

std::vector<BlockSpec> read_blocks(const Subject& scene) {
  std::vector<BlockSpec> blocks;
  for (const Subject& item : children(scene, "blocks")) {
    BlockSpec block;
    block.subject = item;
    read(item, "name", block.name);
    read(item, "vertices", block.vertices);
    for (const Subject& plane : children(item, "planes"))
      block.planes.push_back(read_block_plane(plane));
    if (const auto box = child(item, "box")) block.box = read_box(*box);
    const int shapes = !!item.node->find("vertices") + !!item.node->find("planes") + !!item.node->find("box");
    if (shapes == 0)
      refuse(
          item, "vertices",
          "a block needs its shape: one of vertices, planes or box; write for example box = { min = […], max = […] }");
    if (shapes > 1)
      for (const char* key : {"vertices", "planes"})
        if (item.node->find(key))
          refuse(item, key, "a block takes only one of vertices, planes and box; remove the others");
    read(item, "part_of", block.part_of);
    if (!block.part_of.empty())
      for (const char* key : {"density", "velocity", "angular_velocity", "fixed"})
        if (item.node->find(key)) refuse(item, key, "belongs to the block that this one is part_of; state it there");
    read(item, "density", block.density);
    read(item, "fixed", block.fixed);
    block.motion = read_motion(item);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::vector<RestrainSpec> read_restrain(const Subject& scene) {
  std::vector<RestrainSpec> all;
  for (const Subject& item : children(scene, "restrain")) {
    RestrainSpec spec{read_selector(item), {}, {}};
    read_axes(item, "translation", spec.translation);
    read_axes(item, "rotation", spec.rotation);
    if (!item.node->find("translation") && !item.node->find("rotation"))
      refuse(item, "rotation", "nothing is restrained; write rotation = true or for example translation = [\"x\"]");
    all.push_back(spec);
  }
  return all;
}

std::vector<InitialVelocitySpec> read_initial_velocity(const Subject& scene) {
  std::vector<InitialVelocitySpec> all;
  for (const Subject& item : children(scene, "initial_velocity")) {
    InitialVelocitySpec spec{read_selector(item), read_motion(item)};
    if (!spec.motion.velocity && !spec.motion.angular_velocity)
      refuse(item, "velocity", "an initial_velocity needs velocity, angular_velocity or both");
    all.push_back(spec);
  }
  return all;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, const std::vector<std::string>& overrides) {
  const auto source = std::make_shared<const std::string>(one_line(name, 1000));
  // the tree: parsed, laid over its base, overridden, held against the key table
  Scene scene;
  const auto tree = std::make_shared<Node>(
      with_base(parse_toml(text, source), std::filesystem::path(name).parent_path(), scene.files));
  for (const std::string& text_of_override : overrides)
    apply_override(*tree, text_of_override, *source);
  const std::vector<std::string> from_level = apply_accuracy_level(*tree);
  check_keys(*tree);

  // from here on every value has the right type and lies in its range
  scene.file = *source;
  scene.tree = tree;
  scene.from_level = from_level;
  scene.dimension = scene_dimension(*tree);
  const Subject top{tree.get(), ""};
  read(top, "title", scene.title);
  read(top, "gravity", scene.gravity);
  read(top, "density", scene.density);
  scene.domain = read_domain(top, scene.dimension);
  scene.joints = read_joints(top, scene.dimension);
  scene.joint_sets = read_joint_sets(top, scene.dimension);
  scene.properties = read_properties(top);
  scene.blocks = read_blocks(top);
  scene.fix = read_selectors(top, "fix");
  scene.restrain = read_restrain(top);
  scene.initial_velocity = read_initial_velocity(top);
  scene.settings = read_settings(top);
  if (const auto slicing = child(top, "slicing")) {
    read(*slicing, "smallest_inscribed_radius", scene.smallest_inscribed_radius);
    scene.slicing = read_slicing(*slicing);
  }
  scene.excavations = read_excavations(top, scene.dimension);
  scene.stages = read_stages(top, scene.settings.damping);
  scene.monitors = read_monitors(top);
  scene.output = read_output(top);
  return scene;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene = parse_scene(file_text(file), file.string(), overrides);
  scene.files.insert(scene.files.begin(), file);
  return scene;
}

}  // namespace voussoir
