#include "core/key_blocks/block_survey.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/bad_input.hpp"
#include "core/key_blocks/elastic_shear.hpp"
#include "core/key_blocks/pressure_eccentricity.hpp"
#include "core/model/water_surfaces.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

template <int Dim>
void refuse_other_models(const Model<Dim>& model) {
  if (model.particles)
    throw BadInput(
        "the scene has potential particles: block theory has blocks of half-spaces only; leave out shape = "
        "\"potential\", or use 'voussoir run'");
  for (const JointProperties& joint : model.properties)
    if (joint.laws.friction == FrictionLaw::hardening)
      throw BadInput(
          fmt::format("joint_properties '{}': friction that hardens with slip is zero at the start, where block theory "
                      "judges; state "
                      "friction_deg without hardening, or use 'voussoir run'",
                      joint.name));
  const auto is_free = [](const Body<Dim>& body) { return body.present && !body.fixed && !body.parts.empty(); };
  if (std::none_of(model.bodies.begin(), model.bodies.end(), is_free))
    throw BadInput("every block is fixed, so there is nothing to judge; choose fewer blocks in fix");
}

int place_of_stage(const std::vector<StagePlan>& stages, const std::string& name, const char* option) {
  std::string names;
  for (std::size_t s = 0; s < stages.size(); ++s) {
    if (stages[s].name == name) return static_cast<int>(s);
    names += (s ? ", " : "") + stages[s].name;
  }
  throw BadInput(fmt::format("{} {}: no stage has this name; there are: {}", option, name,
                             names.empty() ? "none, the scene has no stage" : names));
}

// the first search of a factor; a search of the friction itself states no strength
int stage_of_search(const std::vector<StagePlan>& stages) {
  for (std::size_t s = 0; s < stages.size(); ++s) {
    const auto* plan = std::get_if<ReducePlan>(&stages[s].plan);
    if (plan && plan->searched == Searched::factor) return static_cast<int>(s);
  }
  return -1;
}

}  // namespace

void refuse_out_of_range(const SurveyRequest& request) {
  const auto check = [](const char* what, double number, double low, double high, double unit) {
    if (std::isfinite(number) && number >= low * unit && number <= high * unit) return;
    // the library that formats compares, which raises a floating-point exception if it is no number
    const std::string stated = std::isfinite(number) ? fmt::format("{:g}", number / unit) : std::to_string(number);
    throw BadInput(fmt::format("{} {} is not from {:g} to {:g}", what, stated, low, high));
  };
  check("the required factor of safety", request.required, least_required, most_required, 1);
  if (request.seismic) {
    check("the seismic coefficient", request.seismic->coefficient, 0, 10, 1);
    check("the vertical seismic coefficient", request.seismic->vertical, 0, 10, 1);
    if (request.seismic->trend) check("the seismic trend (deg)", *request.seismic->trend, 0, 360, degree);
  }
  if (!request.bolt) return;
  check("the plunge of the bolt (deg)", request.bolt->first, -90, 90, degree);
  check("the trend of the bolt (deg)", request.bolt->second, 0, 360, degree);
}

namespace {

template <int Dim>
std::vector<std::string> notes_on(const Prepared<Dim>& prepared, const Model<Dim>& model) {
  std::vector<std::string> notes;
  bool stressed = !model.boundary.empty();
  for (const StagePlan& stage : prepared.stages)
    stressed |= !stage.change.boundary.empty();
  if (stressed)
    notes.push_back(
        "in-situ stress is not counted: roof and wall blocks are judged as if the rock around were unstressed");
  if (!model.linings.empty()) notes.push_back("linings are not counted");
  for (std::size_t p = 0; p < model.properties.size(); ++p)
    if (model.properties[p].cohesion < prepared.model.properties[p].cohesion)
      notes.push_back(fmt::format(
          "the cohesion of '{}' is not counted: its bonds are made by a stage (bond = true), and none up to "
          "this one makes them; a run would not have it either",
          model.properties[p].name));
  bool several = false, restrained = false, softens = false, fixed = false;
  for (const Body<Dim>& body : model.bodies) {
    if (!body.present) continue;
    fixed |= body.fixed;
    if (body.fixed) continue;
    several |= body.parts.size() > 1;
    for (const bool free : body.free_translation)
      restrained |= !free;
  }
  bool dilates = false, rough = false;
  for (const JointProperties& joint : model.properties) {
    softens |= joint.laws.friction == FrictionLaw::softening;
    dilates |= joint.dilates();
    rough |= joint.follows_barton_bandis();
  }
  if (rough)
    notes.push_back(
        "friction of Barton and Bandis is their peak envelope at the mean normal stress of each loaded face");
  if (dilates) notes.push_back("dilation of joints is not counted: blocks are judged before any slip");
  if (restrained) notes.push_back("restrained translations are not counted: such a block is judged as if it were free");
  if (softens) notes.push_back("friction that softens with slip is that before any slip");
  if (!fixed)
    notes.push_back("no block is fixed: each is judged with its neighbours held; the mass as a whole is not judged");
  if (several)
    notes.push_back(
        "blocks of several convex parts are judged as one by their outer faces, for the first motion: "
        "they "
        "hold only while no part breaks off");
  if (Dim == 2) notes.push_back("in the plane 'voussoir limit' judges the complete assembly, with rotation");
  return notes;
}

struct Stages {
  int strength = -1, loads = -1, geometry = -1;  // -1: before the first
};

Stages choose_stages(const std::vector<StagePlan>& stages, const SurveyRequest& request) {
  Stages chosen;
  chosen.strength = request.strength_of.empty() ? stage_of_search(stages)
                                                : place_of_stage(stages, request.strength_of, "--strength-of");
  if (!request.after.empty()) chosen.geometry = place_of_stage(stages, request.after, "--after");
  chosen.loads = chosen.geometry >= 0   ? chosen.geometry
                 : chosen.strength >= 0 ? chosen.strength
                                        : static_cast<int>(stages.size()) - 1;
  return chosen;
}

// with the friction at a stage
template <int Dim>
std::vector<JointProperties> properties_at(const Prepared<Dim>& prepared, int stage) {
  std::vector<JointProperties> properties = prepared.model.properties;
  for (int s = 0; s <= stage; ++s)
    set_friction(prepared.stages[s].change, properties);
  return properties;
}

// Until a stage bonds, a cohesion that only a stage bonds does not act, as in a run.
void leave_out_unbonded(const std::vector<StagePlan>& stages, int last, std::vector<JointProperties>& properties) {
  const auto bonds = [](const StagePlan& stage) { return stage.change.bond; };
  if (std::any_of(stages.begin(), stages.begin() + last + 1, bonds)) return;
  for (JointProperties& joint : properties)
    if (joint.bonds == BondsMade::by_stage) joint.cohesion = 0;
}

template <int Dim>
Assembly<Dim> assembly_at(const Prepared<Dim>& prepared, const Stages& stages) {
  Model<Dim> model = prepared.model;
  model.properties = properties_at(prepared, stages.strength);
  WaterValues water = initial_water(model);
  std::set<std::string> installed;
  for (int s = 0; s < static_cast<int>(prepared.stages.size()); ++s) {
    const StagePlan& stage = prepared.stages[s];
    Change change;
    if (s <= stages.geometry) {
      change.fix = stage.change.fix;
      change.release = stage.change.release;
      change.remove = stage.change.remove;
      change.excavate = stage.change.excavate;
    }
    if (s <= stages.loads) {
      change.force = stage.change.force;
      for (const WaterPlan& plan : stage.water)
        water[plan.water] = plan.to;
      installed.insert(stage.change.install.begin(), stage.change.install.end());
    }
    model = apply(std::move(model), change);
  }
  leave_out_unbonded(prepared.stages, stages.loads, model.properties);
  std::vector<bool> bolts;
  for (const Bolt<Dim>& bolt : model.bolts)
    bolts.push_back(installed.contains(model.bolt_properties[bolt.properties].name));
  return make_assembly(std::move(model), water, bolts);
}

template <int Dim>
Assembly<Dim> judged_assembly(const Prepared<Dim>& prepared, const Stages& stages) {
  refuse_other_models(prepared.model);
  Assembly<Dim> assembly = assembly_at(prepared, stages);
  refuse_other_models(assembly.model);
  return assembly;
}

template <int Dim>
Vector<Dim> horizontal(double trend) {
  if constexpr (Dim == 2)
    return {std::sin(trend) < 0 ? -1.0 : 1.0, 0};
  else
    return {std::sin(trend), std::cos(trend), 0};
}

template <int Dim>
FurtherLoad<Dim> further_load(const SurveyRequest& request, const Vector<Dim>& gravity) {
  if (!request.seismic || !(request.seismic->trend || request.seismic->vertical > 0)) return {};
  const SeismicRequest seismic = *request.seismic;
  return [seismic, gravity](const Block<Dim>& block) {
    Vector<Dim> force = Vector<Dim>::Zero();
    if (seismic.trend) force = seismic.coefficient * block.weight * horizontal<Dim>(*seismic.trend);
    if (!(seismic.vertical > 0)) return force;
    const Vector<Dim> up = seismic.vertical * block.weight * Vector<Dim>::Unit(Dim - 1), raised = force + up,
                      lowered = force - up;
    const auto factor = [&](const Vector<Dim>& more) {
      return judge_bolted(block, more, gravity).factor.value_or(std::numeric_limits<double>::infinity());
    };
    return factor(raised) < factor(lowered) ? raised : lowered;
  };
}

template <int Dim>
void add_seismic(const SurveyRequest& request, const Block<Dim>& block, const Vector<Dim>& gravity,
                 SurveyRow<Dim>& row) {
  if (!request.seismic || request.seismic->trend || row.kind() == BlockKind::tapered) return;
  const double size = request.seismic->coefficient * block.weight;
  row.worst = worst_direction<Dim>(block, row.bolted.load, size, gravity);
  row.critical_coefficient = critical_coefficient<Dim>(block, row.bolted.load, Vector<Dim>::Zero(), gravity);
  Vector<Dim> own = row.bolted.verdict.motion;
  own[Dim - 1] = 0;
  if (!moves(row.kind()) || !(own.norm() > 0)) return;
  own.normalize();
  row.factor_own_trend = judge<Dim>(block, row.bolted.load + size * own, gravity).factor();
  row.critical_own_trend = critical_coefficient<Dim>(block, row.bolted.load, own, gravity);
}

template <int Dim>
Vector<Dim> direction_of(double plunge, double trend) {
  Vector<Dim> direction = std::cos(plunge) * horizontal<Dim>(trend);
  direction[Dim - 1] = -std::sin(plunge);
  return direction;
}

template <int Dim>
SurveyRow<Dim> describe(const Survey<Dim>& survey, const std::vector<int>& bodies, const BoltedVerdict<Dim>& bolted,
                        Block<Dim>& block) {
  const Assembly<Dim>& assembly = survey.assembly;
  const Vector<Dim>& gravity = assembly.model.gravity;
  const SurveyRequest& request = survey.request;
  gather<Dim>(assembly, bodies, {}, block);
  SurveyRow<Dim> row;
  row.bodies = bodies;
  row.volume = block.volume;
  row.weight = block.weight;
  row.contact_area = block.contact_area;
  row.surface = block.surface;
  row.free_area = block.enclosed() ? 0 : block.surface - block.contact_area;
  row.bolted = bolted;
  if (row.kind() == BlockKind::enclosed) return row;
  row.faces = block.faces;
  if (request.factors_only) {
    add_seismic(request, block, gravity, row);
    return row;
  }
  for (const BlockBolt<Dim>& bolt : block.bolts) {
    const Bolt<Dim>& stated = assembly.model.bolts[bolt.bolt];
    row.bolts.push_back(fmt::format("{}-{}", assembly.model.bolt_properties[stated.properties].name, stated.number));
  }
  if (!moves(row.kind())) row.removability = find_removability(block.normals);
  if (row.kind() == BlockKind::tapered) row.taper = find_taper(block.normals);
  add_seismic(request, block, gravity, row);
  const Vector<Dim> dry = bolted.load - block.water.force;
  row.critical_water = critical_water<Dim>(block, dry, gravity);
  row.critical_level = critical_level<Dim>(assembly, block, dry);
  if (!moves(row.kind())) return row;
  row.force = least_force(block, bolted, request.required, gravity);
  if (request.bolt)
    row.bolt_force = force_along<Dim>(block, bolted, request.required,
                                      direction_of<Dim>(request.bolt->first, request.bolt->second), gravity);
  const Opening opening = opening_angle(block, bolted.verdict);
  if (opening.face >= 0) row.opening = opening.angle;
  row.opening_face = opening.face;
  row.closed_faces = closed_by_elastic_shear(assembly, block, bolted);
  row.eccentricity = pressure_eccentricity(assembly, block, bolted);
  return row;
}

}  // namespace

template <int Dim>
std::string Survey<Dim>::joint_name(const RockFace<Dim>& face) const {
  return face.joint == no_joint ? "(no joint)" : assembly.model.joints[face.joint].name;
}

template <int Dim>
std::string Survey<Dim>::body_names(const SurveyRow<Dim>& row) const {
  return fmt::format("{}", fmt::join(row.bodies, "+"));
}

template <int Dim>
std::optional<Assembly<Dim>> assembly_of_stage(const Prepared<Dim>& prepared, int stage) {
  try {
    return judged_assembly(prepared, Stages{.strength = stage, .loads = stage, .geometry = stage});
  } catch (const BadInput&) {
    return {};
  }
}

template <int Dim>
std::vector<JointProperties> properties_of_request(const Prepared<Dim>& prepared, const SurveyRequest& request) {
  return properties_at(prepared, choose_stages(prepared.stages, request).strength);
}

template <int Dim>
Survey<Dim> survey_blocks(const Prepared<Dim>& prepared, const SurveyRequest& request) {
  const Stages stages = choose_stages(prepared.stages, request);
  Survey<Dim> survey;
  survey.request = request;
  survey.assembly = judged_assembly(prepared, stages);
  const Model<Dim>& model = survey.assembly.model;
  survey.sets = prepared.joint_sets;
  survey.strength =
      stages.strength < 0 ? "joint_properties" : fmt::format("stage \"{}\"", prepared.stages[stages.strength].name);
  survey.loads = stages.loads < 0 ? "the scene" : fmt::format("stage \"{}\"", prepared.stages[stages.loads].name);
  if (!request.factors_only) survey.notes = notes_on(prepared, model);
  for (const Body<Dim>& body : model.bodies)
    survey.fixed += body.present && body.fixed;

  const FurtherLoad<Dim> more = further_load<Dim>(request, model.gravity);
  const std::vector<BoltedVerdict<Dim>> single = judge_all(survey.assembly, more);
  Block<Dim> block;
  for (int b = 0; b < static_cast<int>(single.size()); ++b)
    if (survey.assembly.free[b]) survey.rows.push_back(describe(survey, {b}, single[b], block));
  ClusterSearch<Dim> clusters = find_clusters(survey.assembly, single, more);
  survey.pairs = clusters.pairs;
  survey.moving_pairs = clusters.moving_pairs;
  survey.largest_cluster = clusters.largest;
  for (const Cluster<Dim>& cluster : clusters.lower) {
    survey.clusters.push_back(describe(survey, cluster.bodies, cluster.verdict, block));
    survey.clusters.back().cluster = static_cast<int>(survey.clusters.size());
  }
  survey.below_one = fail_in_rounds(survey.assembly, FailureRule::below_factor, 1, more);
  if (request.frictionless) survey.frictionless = fail_in_rounds(survey.assembly, FailureRule::moves, 1, more);
  return survey;
}

const char* word_of(BlockKind kind) {
  switch (kind) {
    case BlockKind::enclosed:
      return "enclosed";
    case BlockKind::tapered:
      return "tapered";
    case BlockKind::no_load:
      return "no load";
    case BlockKind::stable:
      return "stable";
    case BlockKind::slides:
      return "slides";
    case BlockKind::falls:
      return "falls";
    case BlockKind::lifts:
      return "lifts";
    case BlockKind::undecided:
      break;
  }
  return "undecided";
}

template <int Dim>
const char* type_of(const SurveyRow<Dim>& row, double required) {
  if (row.kind() == BlockKind::tapered) return "IV";
  if (row.kind() == BlockKind::stable) return "III";
  if (!moves(row.kind())) return "";
  return *row.bolted.factor < required ? "I" : "II";
}

template <int Dim>
const char* motion_of(const SurveyRow<Dim>& row) {
  if (!row.eccentricity) return row.kind() == BlockKind::slides ? "slides" : "";
  if (*row.eccentricity <= 1) return "slides";
  return *row.bolted.factor < 1 ? "slides and turns" : "turns";
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                               \
  template struct Survey<Dim>;                                                                                  \
  template Survey<Dim> survey_blocks<Dim>(const Prepared<Dim>&, const SurveyRequest&);                          \
  template std::vector<JointProperties> properties_of_request<Dim>(const Prepared<Dim>&, const SurveyRequest&); \
  template std::optional<Assembly<Dim>> assembly_of_stage<Dim>(const Prepared<Dim>&, int);                      \
  template const char* type_of<Dim>(const SurveyRow<Dim>&, double);                                             \
  template const char* motion_of<Dim>(const SurveyRow<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
