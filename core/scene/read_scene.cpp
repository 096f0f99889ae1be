// From a checked tree to plain structs: units, and keys that one table must state together.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/integrable.hpp"
#include "core/joint_laws/barton_bandis.hpp"
#include "core/scene/accuracy_level.hpp"
#include "core/scene/accuracy_target.hpp"
#include "core/scene/base_scene.hpp"
#include "core/scene/divided_strength.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/overrides.hpp"
#include "core/scene/particles.hpp"
#include "core/scene/preset.hpp"
#include "core/scene/read_joint_sets.hpp"
#include "core/scene/read_records.hpp"
#include "core/scene/read_slicing.hpp"
#include "core/scene/read_motion.hpp"
#include "core/scene/read_stages.hpp"
#include "core/scene/read_water.hpp"
#include "core/scene/repeat.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_text.hpp"
#include "core/scene/support_table.hpp"
#include "core/scene/toml_text.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// Barton and Bandis' law has its own dilation, and its mobilisation needs the slip at the peak.
void check_barton_bandis(const Subject& item, const JointProperties& p) {
  if (!p.states_barton_bandis()) return;
  const BartonBandis& law = p.barton_bandis;
  if (p.friction >= largest_friction_angle)
    refuse(item, "friction_deg",
           "must be below 70 degrees, above which Barton and Bandis' law has no angle: it is that of the joint without "
           "its roughness, 20 to 35 degrees usually");
  if (p.laws.dilation != DilationLaw::none)
    refuse(item, "dilation_law",
           "is stated beside friction_law = \"barton_bandis\", which dilates by dilation_share of its roughness angle; "
           "remove dilation_law");
  if (law.mobilisation == Mobilisation::table && !(law.block_length > 0))
    refuse(item, "block_length_m",
           "is needed for mobilisation = \"table\": the slip at the peak strength follows from it; state the length of "
           "the blocks along the joint, or write mobilisation = \"none\"");
  if (law.sample_length > 0 && !(law.block_length > 0))
    refuse(item, "sample_length_m",
           "is stated without block_length_m, to which JRC and JCS are corrected; state both or neither");
  if (law.sample_length > law.block_length)
    refuse(item, "sample_length_m",
           fmt::format("exceeds block_length_m = {:g}: the correction is that of a sample to a longer block; leave "
                       "sample_length_m out if jrc and jcs are those of the blocks",
                       law.block_length));
}

// A dilation above the friction would give back more energy than slip takes: its heat would be negative.
void check_dilation(const Subject& item, const JointProperties& p) {
  if (p.laws.dilation == DilationLaw::none) return;
  if (p.laws.friction == FrictionLaw::hardening)
    refuse(item, "dilation_law",
           "friction that hardens is zero before any slip, less than any dilation, and slip would make energy; use "
           "constant or softening friction");
  const bool softens = p.laws.friction == FrictionLaw::softening;
  const double left = std::tan(p.friction) - (softens ? p.softening_drop : 0);
  if (std::tan(p.dilation) > left && p.softening_drop <= std::tan(p.friction))
    refuse(
        item, "dilation_deg",
        fmt::format("exceeds the friction angle{}, {:.4g} degrees: slip would make energy; friction_deg is the total "
                    "peak angle, dilation included, so give a dilation of at most that",
                    softens ? " that softening leaves" : "", to_degrees(std::atan(left))));
}

void check_laws(const Subject& item, const JointProperties& p) {
  if (p.constant_stiffness && !p.laws.is_plain())
    refuse(item, "constant_stiffness",
           "has no stress, on which all other laws depend; remove it and give the stiffness per area, or remove the "
           "laws, tension and "
           "cohesion");
  if (p.laws.normal == StiffnessLaw::power && p.tension > 0)
    refuse(item, "tension", "a power law has no stiffness without stress; use the linear or the constant law");
  if (p.laws.normal == StiffnessLaw::hyperbolic && p.tension > 0)
    refuse(item, "tension", "a hyperbolic law has no tension; use the linear or the constant law");
  check_barton_bandis(item, p);
  check_dilation(item, p);
  if (p.residual_cohesion > p.cohesion)
    refuse(item, "residual_cohesion",
           fmt::format("exceeds cohesion = {:.4g} Pa, of which it is the part that slip leaves", p.cohesion));
  if (p.laws.friction == FrictionLaw::softening && p.softening_drop > std::tan(p.friction))
    refuse(item, "softening_drop",
           fmt::format("exceeds the friction coefficient tan(friction_deg) = {:.4g}, which is all that can be lost",
                       std::tan(p.friction)));
}

// why a joint of these properties cannot have an integrated face contact
std::string why_by_points(const JointProperties& p) {
  if (p.constant_stiffness) return "has constant_stiffness, which is independent of the area";
  if (p.laws.bond) return "has tension or cohesion, which is lost point by point";
  if (p.states_barton_bandis()) return "follows Barton and Bandis' law, whose friction varies over the face";
  if (p.dilates()) return "dilates, by a rise that varies over the face";
  return "has a law that depends on stress or slip, which vary over the face";
}

// contact.face = "integrated" against the rest of the scene
void check_face(const Subject& scene, const ContactSettings& contact, const std::vector<PropertiesSpec>& properties) {
  if (contact.face != ContactFace::integrated) return;
  const Subject table = *child(scene, "contact");
  const auto by_points = [](const PropertiesSpec& p) { return !can_be_integrated(p.properties); };
  if (!properties.empty() && std::ranges::all_of(properties, by_points))
    refuse(table, "face",
           fmt::format("would change nothing: {} {}; give a joint constant stiffnesses in Pa/m without strength, or "
                       "leave face out",
                       properties.front().subject.path, why_by_points(properties.front().properties)));
  if (std::ranges::any_of(properties, by_points)) return;  // the keys below apply to those
  const auto unused = [&](bool stated, const char* key, const char* what) {
    if (stated)
      refuse(
          table, key,
          fmt::format(
              "chooses {} of contacts that act at a point; with face = \"integrated\" every joint of this scene has an "
              "integrated face contact, leave one of the two out",
              what));
  };
  const ContactSettings usual;
  unused(contact.normal != usual.normal, "normal", "normal and overlap");
  unused(contact.point != usual.point, "point", "the contact point");
  unused(contact.overlap != usual.overlap, "overlap", "the search for the overlap");
}

std::vector<PropertiesSpec> read_properties(const Subject& scene) {
  std::vector<PropertiesSpec> all;
  for (const Subject& item : children(scene, "joint_properties")) {
    JointProperties p;
    read_keys(*item.node, "joint_properties", p);
    read_keys(*item.node, "joint_properties", p.laws);
    read_keys(*item.node, "joint_properties", p.barton_bandis);
    scale_to_blocks(p.barton_bandis);
    p.stated_friction = p.friction;
    p.laws.bond = p.tension > 0 || p.cohesion > 0;
    check_laws(item, p);
    all.push_back({item, p});
  }
  return all;
}

BlockPlaneSpec read_block_plane(const Subject& subject) {
  BlockPlaneSpec plane{subject, {}, {}, {}};
  read_keys(*subject.node, "blocks.planes", plane);
  double square = 0;
  for (const double x : plane.normal)
    square += x * x;
  constexpr double least_square = 1e-24;  // shorter ones are mistakes, and their inverse would overflow
  if (!(square > least_square))
    refuse(subject, "normal", "must not be zero; give the direction that points out of the block");
  if (plane.offset && plane.point)
    refuse(subject, "offset", "is stated together with point; a plane needs only one of the two, remove one");
  if (!plane.offset && !plane.point)
    refuse(subject, "offset", "a plane needs an offset or a point; write for example offset = 1 or point = [0, 0, 1]");
  return plane;
}

std::vector<BlockSpec> read_blocks(const Subject& scene) {
  std::vector<BlockSpec> blocks;
  for (const Subject& item : children(scene, "blocks")) {
    BlockSpec block;
    block.subject = item;
    read_keys(*item.node, "blocks", block);
    read_keys(*item.node, "blocks", block.motion);
    read_keys(*item.node, "blocks", block.particle);
    for (const Subject& plane : children(item, "planes"))
      block.planes.push_back(read_block_plane(plane));
    if (const auto box = child(item, "box")) block.box = read_box(*box);
    const int shapes = !!item.node->find("vertices") + !!item.node->find("planes") + !!item.node->find("box");
    check_particle_keys(block);
    if (shapes == 0 && block.shape == BlockShape::half_spaces)
      refuse(
          item, "vertices",
          "a block needs its shape: one of vertices, planes or box; write for example box = { min = […], max = […] }");
    if (shapes > 1)
      for (const char* key : {"vertices", "planes"})
        if (item.node->find(key))
          refuse(item, key, "a block takes only one of vertices, planes and box; remove the others");
    if (!block.part_of.empty())
      for (const char* key : {"density", "velocity", "angular_velocity", "fixed"})
        if (item.node->find(key)) refuse(item, key, "is a property of the block that part_of names; state it there");
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::vector<RestrainSpec> read_restrain(const Subject& scene) {
  std::vector<RestrainSpec> all;
  for (const Subject& item : children(scene, "restrain")) {
    RestrainSpec spec{read_selector(item), {}, {}};
    read_keys(*item.node, "restrain", spec);
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

// Overrides of [[repeat]] come first, since they determine the copies, and those of copies once these are made.
void override_and_repeat(Node& tree, const std::vector<std::string>& overrides, const std::string& source,
                         std::vector<std::string>& renamed) {
  std::vector<std::string> of_tables, of_copies;
  for (const std::string& text : overrides)
    if (text.starts_with("repeat"))
      apply_override(tree, text, source, renamed);
    else
      of_tables.push_back(text);
  for (const std::string& text : of_tables)
    if (addresses_copy(tree, text))
      of_copies.push_back(text);
    else
      apply_override(tree, text, source, renamed);
  repeat_tables(tree);
  for (const std::string& text : of_copies)
    apply_override(tree, text, source, renamed);
}

}  // namespace

Scene read_tree(Node stated, const std::string& name, const std::vector<std::string>& overrides) {
  const std::string file = one_line(name, 1000);
  // the tree: merged over its base, overridden, copies made, checked against the key table
  Scene scene;
  FilesRead read;
  const auto tree =
      std::make_shared<Node>(with_base(std::move(stated), std::filesystem::path(name).parent_path(), read));
  list_records(*tree);
  override_and_repeat(*tree, overrides, file, read.renamed);
  list_records(*tree);  // those of overrides
  read_record_files(*tree, name, read);
  const std::vector<std::string> from_level = apply_accuracy_level(*tree);
  check_keys(*tree);
  accuracy_target(*tree);
  scene.from_preset = apply_preset(*tree, read_properties({tree.get(), ""}));

  // from here on every value has the right type and is in its range
  scene.file = file;
  scene.files = std::move(read.files);
  scene.remarks = std::move(read.remarks);
  scene.renamed = std::move(read.renamed);
  scene.tree = tree;
  scene.from_level = from_level;
  const Subject top{tree.get(), ""};
  read_keys(*tree, "", scene);
  scene.domain = read_domain(top, scene.dimension);
  scene.joints = read_joints(top, scene.dimension);
  scene.joint_sets = read_joint_sets(top, scene.dimension);
  scene.properties = read_properties(top);
  scene.blocks = read_blocks(top);
  scene.fix = read_selectors(top, "fix");
  scene.restrain = read_restrain(top);
  scene.initial_velocity = read_initial_velocity(top);
  scene.settings = read_settings(top);
  check_face(top, scene.settings.contact, scene.properties);
  scene.excavations = read_excavations(top, scene.dimension);
  const double rock_weight = scene.density && scene.gravity ? *scene.density * std::abs(scene.gravity->back()) : 0;
  scene.stages = read_stages(top, scene.dimension, scene.settings, rock_weight);
  check_divided_strength(scene.properties, scene.stages);
  scene.waters = read_waters(top, scene.dimension);
  read_water_changes(scene.waters, scene.stages, scene.dimension);
  for (const SceneSupport& row : scene_supports)
    if (row.read) row.read(top, scene);
  scene.monitors = read_monitors(top);
  return scene;
}

Scene parse_scene(std::string_view text, const std::string& name, const std::vector<std::string>& overrides) {
  const auto source = std::make_shared<const std::string>(one_line(name, 1000));
  return read_tree(parse_toml(text, source), name, overrides);
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene = parse_scene(file_text(file), file.string(), overrides);
  scene.files.insert(scene.files.begin(), file);
  return scene;
}

}  // namespace voussoir
