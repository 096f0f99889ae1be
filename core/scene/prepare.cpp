// A scene made ready to run, in the order of its data: properties, joints, blocks, supports, motion, stages, monitors.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>

#include "core/model/body_title.hpp"
#include "core/model/water_surfaces.hpp"
#include "core/potential/particle.hpp"
#include "core/scene/beside_particles.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/domain_blocks.hpp"
#include "core/scene/draw_joint_sets.hpp"
#include "core/scene/keys.hpp"
#include "core/scene/particles.hpp"
#include "core/scene/read_open_side.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/stage_excavations.hpp"
#include "core/scene/stated_bodies.hpp"
#include "core/scene/support_table.hpp"
#include "core/scene/wall_points.hpp"
#include "core/scene/wet_faces.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

Subject top_of(const Scene& scene) {
  return {scene.tree.get(), ""};
}

std::vector<std::string> property_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const PropertiesSpec& p : scene.properties)
    names.push_back(p.properties.name);
  return names;
}

// index of a name, or -1
int index_of(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

// the properties that a joint states; else the only table, or the one named default
int properties_of(const Scene& scene, const JointSpec& joint) {
  const std::vector<std::string> names = property_names(scene);
  if (names.empty())
    refuse(joint.subject, "properties",
           "the joint has no properties because the scene states none; add [[joint_properties]] "
           "with name, normal_stiffness, shear_stiffness and friction_deg");
  if (joint.properties) {
    const int index = index_of(names, *joint.properties);
    if (index < 0)
      refuse(joint.subject, "properties", "no joint_properties of this name; " + suggestion(*joint.properties, names));
    return index;
  }
  if (names.size() == 1) return 0;
  const int standard = index_of(names, "default");
  if (standard < 0 && joint.kind == JointKind::construction) return 0;  // its sides are one body
  if (standard < 0)
    refuse(joint.subject, "properties",
           "the joint has no properties and the scene states several; write for example properties = \"" +
               one_line(names.front(), 60) + "\"; there are: " + listed(names));
  return standard;
}

template <int Dim>
void add_joints(const Scene& scene, Model<Dim>& model) {
  for (const PropertiesSpec& p : scene.properties)
    model.properties.push_back(p.properties);
  model.default_properties = std::max(0, index_of(property_names(scene), "default"));
  for (const JointSpec& joint : scene.joints)
    model.joints.push_back({joint.name, to_half_space<Dim>(joint.plane, model.origin), properties_of(scene, joint),
                            joint.kind == JointKind::construction});
}

// numbered as the joints first name them
JointSets joint_sets_of(const Scene& scene) {
  JointSets sets;
  std::map<std::string, int> numbers;
  for (const JointSpec& joint : scene.joints) {
    int number = -1;
    if (!joint.set.empty()) {
      const auto [found, first] = numbers.try_emplace(joint.set, static_cast<int>(sets.names.size()));
      if (first) sets.names.push_back(joint.set);
      number = found->second;
    }
    sets.of_joint.push_back(number);
  }
  return sets;
}

double density_of(const Scene& scene, const std::optional<double>& own) {
  if (own) return *own;
  if (!scene.density)
    refuse(top_of(scene), "density",
           "blocks need their mass; write for example density = 2600 (kg/m³) at the top of the file");
  return *scene.density;
}

template <int Dim>
void add_domain(const Scene& scene, Model<Dim>& model) {
  if (!scene.domain) return;
  const double density = density_of(scene, {});
  for (DomainBody<Dim>& body : cut_domain<Dim>(scene, model)) {
    model.bodies.push_back(make_body<Dim>(std::move(body.parts), density));
    model.bodies.back().fixed = body.fixed;
  }
}

template <int Dim>
void add_blocks(const Scene& scene, Model<Dim>& model) {
  for (StatedBody<Dim>& stated : stated_bodies<Dim>(scene, model.origin)) {
    const BlockSpec& block = *stated.block;
    model.bodies.push_back(make_body<Dim>(std::move(stated.parts), density_of(scene, block.density)));
    model.bodies.back().name = block.name;
    model.bodies.back().fixed = block.fixed;
  }
}

template <int Dim>
void check_blocks(const Scene& scene, const Model<Dim>& model) {
  if (model.bodies.empty())
    refuse(top_of(scene), "domain", "the scene has no block; add a [domain] for joints to cut, or [[blocks]]");
  if (model.bodies.size() > 1 && model.properties.empty())
    refuse(top_of(scene), "joint_properties",
           "blocks that may touch need the properties of their contacts; add "
           "[[joint_properties]] with name, normal_stiffness, shear_stiffness and friction_deg");
}

// The bodies that a selector of the scene names, its names checked first.
template <int Dim>
std::vector<int> chosen(const Model<Dim>& model, const SelectorSpec& spec) {
  std::vector<std::string> joints, bodies;
  for (const Joint<Dim>& joint : model.joints)
    joints.push_back(joint.name);
  for (const Body<Dim>& body : model.bodies)
    if (!body.name.empty()) bodies.push_back(body.name);
  const auto check = [&](const char* key, const std::vector<std::string>& words, const std::vector<std::string>& known,
                         const char* what) {
    for (const std::string& word : words)
      if (index_of(known, word) < 0)
        refuse(spec.subject, key,
               "no " + std::string(what) + " is named '" + one_line(word, 60) + "'; " + suggestion(word, known));
  };
  check("above", spec.selector.above, joints, "joint");
  check("below", spec.selector.below, joints, "joint");
  check("bodies", spec.selector.names, bodies, "block");
  check("side", spec.selector.sides, side_names<Dim>(), "side of the model");
  return select<Dim>(model, spec.selector);
}

template <int Dim>
std::vector<int> chosen_some(const Scene& scene, const Model<Dim>& model, const SelectorSpec& spec) {
  std::vector<int> bodies = chosen<Dim>(model, spec);
  if (bodies.empty())
    refuse(
        *spec.subject.node, spec.subject.path,
        "chooses no block (of " + std::to_string(model.bodies.size()) +
            "); check the sides of the joints and the extent of domain.box or the blocks, or choose by a point inside" +
            (scene.slicing.smallest_inscribed_radius > 0 ? ", or lower slicing.smallest_inscribed_radius" : ""));
  return bodies;
}

// a body that is fixed now may later be released or moved, or line an opening
bool loosens(const Scene& scene) {
  return !scene.linings.empty() || std::any_of(scene.stages.begin(), scene.stages.end(), [](const StageSpec& s) {
    return !s.plan.change.release.empty() || !s.plan.change.move.empty();
  });
}

template <int Dim>
void add_supports(const Scene& scene, Model<Dim>& model) {
  for (const SelectorSpec& fix : scene.fix)
    for (const int b : chosen_some<Dim>(scene, model, fix))
      model.bodies[b].fixed = true;
  for (const RestrainSpec& restrain : scene.restrain)
    for (const int b : chosen_some<Dim>(scene, model, restrain.bodies)) {
      Body<Dim>& body = model.bodies[b];
      for (int k = 0; k < Dim; ++k)
        body.free_translation[k] = body.free_translation[k] && !restrain.translation[k];
      for (int k = 0; k < spin_freedoms<Dim>; ++k)
        body.free_rotation[k] = body.free_rotation[k] && !restrain.rotation[k];
    }
  const bool all_fixed =
      std::all_of(model.bodies.begin(), model.bodies.end(), [](const Body<Dim>& body) { return body.fixed; });
  if (!all_fixed || loosens(scene)) return;
  const std::string rule = "no block is free to move, all " + std::to_string(model.bodies.size()) + " are fixed; ";
  if (scene.fix.empty() && scene.blocks.empty())
    refuse(top_of(scene), "joints", rule + "leave a side of the boundary joints free");
  if (scene.fix.empty()) refuse(scene.blocks.front().subject, "fixed", rule + "leave one block free");
  refuse(*scene.fix.back().subject.node, scene.fix.back().subject.path,
         rule + "choose fewer blocks, or check that the joints cut the domain");
}

// a velocity needs degrees of freedom
template <int Dim>
void set_motion(const Subject& subject, const MotionSpec& spec, const Body<Dim>& body, Motion<Dim>& motion) {
  const auto check = [&](const char* key, const std::vector<double>& numbers, const auto& free) {
    for (std::size_t k = 0; k < numbers.size(); ++k)
      if (numbers[k] != 0 && (body.fixed || !free[k]))
        refuse(subject, key,
               body.fixed ? "the block is fixed and cannot move; remove the velocity or leave the block free"
                          : "the block is restrained there; remove the velocity or the restraint");
  };
  if (spec.velocity) {
    check("velocity", *spec.velocity, body.free_translation);
    motion.velocity = to_vector<Dim>(*spec.velocity);
  }
  if (spec.angular_velocity) {
    check("angular_velocity", *spec.angular_velocity, body.free_rotation);
    const Spin<Dim> spin = Eigen::Map<const Spin<Dim>>(spec.angular_velocity->data());
    motion.angular_momentum = angular_momentum<Dim>(body, motion.rotation, spin);
  }
}

template <int Dim>
State<Dim> moving_state(const Scene& scene, const Model<Dim>& model) {
  State<Dim> state = initial_state<Dim>(model);
  for (const BlockSpec& block : scene.blocks)
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (model.bodies[b].name == block.name)
        set_motion<Dim>(block.subject, block.motion, model.bodies[b], state.bodies.motions[b]);
  for (const InitialVelocitySpec& spec : scene.initial_velocity)
    for (const int b : chosen_some<Dim>(scene, model, spec.bodies))
      set_motion<Dim>(spec.bodies.subject, spec.motion, model.bodies[b], state.bodies.motions[b]);
  return state;
}

// m: lower bound of the distance of a point (model coordinates) from a body; at most 0 inside
template <int Dim>
double outside_by(const Body<Dim>& body, const Vector<Dim>& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Polytope<Dim>& part : body.parts) {
    double most = -std::numeric_limits<double>::infinity();
    for (const HalfSpace<Dim>& face : part.faces)
      most = std::max(most, signed_distance<Dim>(face, point - body.reference));
    if (is_particle(part)) most = std::max(most, outside_by<Dim>(part, point - body.reference));
    least = std::min(least, most);
  }
  return least;
}

// the point of a force must be in or on its block
template <int Dim>
void check_point(const Subject& force, const Model<Dim>& model, const std::vector<int>& bodies) {
  constexpr double on_face = 1e-6;  // of the block's size: coordinates are written with this many digits
  ForcePlan plan;
  read_keys(*force.node, "force", plan);
  if (plan.point.empty()) return;
  for (const int b : bodies) {
    const Body<Dim>& body = model.bodies[b];
    const double outside = outside_by<Dim>(body, Eigen::Map<const Vector<Dim>>(plan.point.data()) - model.origin);
    if (outside > on_face * body.radius)
      refuse(force, "point",
             fmt::format("is at least {:.3g} m outside of {}, on which the force acts; move the point into the block, "
                         "choose the block that "
                         "contains it (for example inside = the point), or leave it out for the centroid",
                         outside,
                         body.name.empty() ? fmt::format("block {} ({})", b, title_of(model, static_cast<int>(b)))
                                           : "block '" + body.name + "'"));
  }
}

template <int Dim>
std::vector<StagePlan> checked_stages(const Scene& scene, const Model<Dim>& model) {
  std::vector<StagePlan> plans;
  const std::vector<std::string> names = property_names(scene);
  for (const StageSpec& stage : scene.stages) {
    for (const auto& [key, list] : stage.chosen)
      for (const SelectorSpec& spec : list)
        chosen_some<Dim>(scene, model, spec);
    std::vector<bool> moved(model.bodies.size(), false);
    for (const SelectorSpec& move : stage.chosen_by("move"))
      for (const int b : chosen_some<Dim>(scene, model, move)) {
        if (moved[b])
          refuse(*move.subject.node, move.subject.path,
                 "moves a block that another move of this stage already moves; choose each block once");
        moved[b] = true;
      }
    for (const SelectorSpec& spec : stage.chosen_by("force"))
      check_point<Dim>(spec.subject, model, chosen<Dim>(model, spec));
    for (const Subject& item : children(stage.subject, "friction"))
      if (const std::string& name = item.node->find("name")->text; index_of(names, name) < 0)
        refuse(item, "name",
               names.empty()
                   ? "there are no joint_properties that could have a friction angle; add [[joint_properties]]"
                   : "no joint_properties of this name; " + suggestion(name, names));
    if (const auto* reduce = std::get_if<ReducePlan>(&stage.plan.plan)) {
      if (names.empty())
        refuse(*stage.subject.node, stage.subject.path, "there is no strength to reduce; add [[joint_properties]]");
      for (const std::string& name : reduce->properties)
        if (index_of(names, name) < 0)
          refuse(stage.subject, "joint_properties",
                 "no joint_properties named '" + one_line(name, 60) + "'; " + suggestion(name, names));
    }
    plans.push_back(stage.plan);
    for (WaterPlan& plan : plans.back().water)
      plan = in_model(std::move(plan), model);
  }
  return plans;
}

template <int Dim>
int joint_of(const Model<Dim>& model, const MonitorSpec& spec) {
  std::vector<std::string> names;
  for (const Joint<Dim>& joint : model.joints)
    names.push_back(joint.name);
  const int index = index_of(names, spec.joint);
  if (index < 0) refuse(spec.body.subject, "joint", "no joint of this name; " + suggestion(spec.joint, names));
  for (const Body<Dim>& body : model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      if (std::find(part.joints.begin(), part.joints.end(), index) != part.joints.end()) return index;
  refuse(spec.body.subject, "joint",
         "the joint cuts no block and has no contacts to monitor; move it into the domain or remove the monitor");
}

int water_of(const Scene& scene, const MonitorSpec& spec) {
  std::vector<std::string> names;
  for (const WaterSpec& water : scene.waters)
    names.push_back(water.name);
  const int index = index_of(names, spec.water);
  if (index < 0) refuse(spec.body.subject, "water", "no water of this name; " + suggestion(spec.water, names));
  return index;
}

int bolts_of(const MonitorSpec& spec, const std::vector<BoltProperties>& all) {
  std::vector<std::string> names;
  for (const BoltProperties& p : all)
    names.push_back(p.name);
  const int index = index_of(names, spec.bolts);
  if (index < 0) refuse(spec.body.subject, "bolts", "no bolts of this name; " + suggestion(spec.bolts, names));
  return index;
}

template <int Dim>
int lining_of(const MonitorSpec& spec, const Model<Dim>& model) {
  std::vector<std::string> names;
  for (const Lining& lining : model.linings)
    names.push_back(lining.properties.name);
  const int index = index_of(names, spec.lining);
  if (index < 0) refuse(spec.body.subject, "lining", "no lining of this name; " + suggestion(spec.lining, names));
  return index;
}

// of the nodes nearest to the stated angles, or of all
template <int Dim>
void add_lining_monitors(const MonitorSpec& spec, const Model<Dim>& model, std::vector<Monitor>& monitors) {
  Monitor monitor{spec.name, spec.quantities.front(), lining_of(spec, model)};
  if (spec.angles.empty()) monitors.push_back(monitor);
  for (std::size_t k = 0; k < spec.angles.size(); ++k) {
    if (spec.angles.size() > 1) monitor.name = fmt::format("{}_{}", spec.name, k + 1);
    monitor.node = nearest_node(model.linings[monitor.subject], spec.angles[k] * degree);
    monitors.push_back(monitor);
  }
}

// the blocks of a monitor
template <int Dim>
std::vector<int> bodies_of(const Scene& scene, const Model<Dim>& model, const MonitorSpec& spec) {
  const std::vector<int> bodies = chosen_some<Dim>(scene, model, spec.body);
  if (bodies.size() != 1 && spec.over == Aggregate::one)
    refuse(*spec.body.subject.node, spec.body.subject.path,
           "chooses " + std::to_string(bodies.size()) +
               " blocks but must choose exactly one; add sides of more joints or a point inside, or write over = "
               "\"sum\" or "
               "\"mean\"");
  return bodies;
}

// The stage from whose end a monitor measures; -1: from the start of the run. The start of a stage is the end of the
// one before it.
int since_of(const Scene& scene, const MonitorSpec& spec) {
  if (spec.since.empty() && spec.since_start.empty()) return -1;
  std::vector<std::string> names;
  for (const StageSpec& stage : scene.stages)
    names.push_back(stage.plan.name);
  const bool from_start = spec.since.empty();
  const char* const key = from_start ? "since_start" : "since";
  const std::string& stage = from_start ? spec.since_start : spec.since;
  const int index = index_of(names, stage);
  if (index < 0) refuse(spec.body.subject, key, "no stage of this name; " + suggestion(stage, names));
  if (from_start) return index - 1;
  if (index + 1 == static_cast<int>(names.size()))
    refuse(spec.body.subject, key,
           "is the last stage, and nothing moves after its end; name an earlier one, or write since_start instead");
  return index;
}

template <int Dim>
std::vector<Monitor> find_monitors(const Scene& scene, const Prepared<Dim>& prepared) {
  const Model<Dim>& model = prepared.model;
  std::vector<Monitor> monitors;
  for (const MonitorSpec& spec : scene.monitors) {
    const int since = since_of(scene, spec);
    if (!spec.excavation.empty()) {
      monitors.push_back(
          {spec.name, spec.quantities.front(), 0, 0, spec.over, {}, since, wall_points<Dim>(scene, prepared, spec)});
      continue;
    }
    const int subject = !spec.joint.empty()   ? joint_of<Dim>(model, spec)
                        : !spec.water.empty() ? water_of(scene, spec)
                        : !spec.bolts.empty() ? bolts_of(spec, model.bolt_properties)
                                              : -1;
    if (!spec.lining.empty()) {
      add_lining_monitors(spec, model, monitors);
      continue;
    }
    const std::vector<int> bodies = subject < 0 ? bodies_of<Dim>(scene, model, spec) : std::vector<int>();
    for (const Monitored& followed : spec.quantities)
      monitors.push_back({spec.name, followed, subject < 0 ? bodies.front() : subject,
                          followed.quantity == Quantity::level ? levels_of<Dim>(model.waters[subject]) : 0, spec.over,
                          spec.over == Aggregate::one ? std::vector<int>() : bodies, since});
  }
  return monitors;
}

}  // namespace

template <int Dim>
Prepared<Dim> prepare(const Scene& scene) {
  assert(scene.dimension == Dim);
  if (!scene.joint_sets.empty()) return prepare<Dim>(with_drawn_joints<Dim>(scene));
  Prepared<Dim> prepared;
  Model<Dim>& model = prepared.model;
  prepared.title = scene.title;
  if (const Node* accuracy = scene.tree->find("accuracy"))
    if (const Node* level = accuracy->find("level")) prepared.accuracy_level = level->text;
  prepared.settings = scene.settings;
  prepared.output = scene.output;
  prepared.joint_sets = joint_sets_of(scene);

  // the solids, in an order that does not depend on that of the statements
  model.origin = find_origin<Dim>(scene);
  if (scene.gravity) model.gravity = to_vector<Dim>(*scene.gravity);
  add_joints<Dim>(scene, model);
  check_excavations(scene);
  check_installs(scene);
  add_domain<Dim>(scene, model);
  add_blocks<Dim>(scene, model);
  check_blocks<Dim>(scene, model);
  number_bodies<Dim>(model);
  check_beside_particles<Dim>(scene, model);
  add_inner_particles<Dim>(scene.settings.contact, model);

  // statements about them by selectors, and the water on them
  add_waters<Dim>(scene, model);
  for (const SceneSupport& row : scene_supports)
    row.add_to(scene, model);
  add_supports<Dim>(scene, model);
  prepared.state = moving_state<Dim>(scene, model);
  prepared.stages = checked_stages<Dim>(scene, model);
  check_open_sides<Dim>(scene.stages, model);
  prepared.monitors = find_monitors<Dim>(scene, prepared);
  return prepared;
}

template Prepared<2> prepare<2>(const Scene&);
template Prepared<3> prepare<3>(const Scene&);

}  // namespace voussoir
