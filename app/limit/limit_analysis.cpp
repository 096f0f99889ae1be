#include "app/limit/limit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/bad_input.hpp"
#include "core/model/body_title.hpp"
#include "core/model/water_surfaces.hpp"
#include "text/angle.hpp"

namespace voussoir {

namespace {

const char* const associated_flow_caveat =
    "associated flow: joints dilate as they slip, so this is an upper bound on strength; if blocks topple it may be "
    "several degrees unsafe (Goodman & Bray's slope: 33.4 for 38.15); confirm it with 'voussoir run'";
const char* const self_stress_caveat =
    "this result may depend on self-stress, normal forces between walls that the loads do not cause: blocks that fall "
    "in a run may be far from failure here; confirm it with 'voussoir run'";
const char* const without_bound = ", by unbounded normal forces, which need not exist; confirm it with 'voussoir run'";

std::string block_name(const Model<2>& model, int body) {
  const std::string title = title_of(model, body);
  return model.bodies[body].name.empty() ? fmt::format("block {} ({})", body, title) : fmt::format("block '{}'", title);
}

// blocks that no face can support, however rough
std::vector<std::string> unsupported(const LimitAnalysis& analysis) {
  std::vector<bool> touched(analysis.model.bodies.size(), false);
  for (const Interface& face : analysis.interfaces)
    touched[face.body_a] = touched[face.body_b] = true;
  std::vector<std::string> warnings;
  for (std::size_t b = 0; b < touched.size(); ++b)
    if (analysis.model.bodies[b].present && !analysis.model.bodies[b].fixed && !touched[b])
      warnings.push_back(fmt::format(
          "no face of {} is in contact with a face of another block; a corner on a face transfers no force here",
          block_name(analysis.model, static_cast<int>(b))));
  return warnings;
}

bool has_cohesion(const Interface& face) {
  return face.cohesion > 0;
}

// strengths other than friction that are left out
void warn_of_strengths(const LimitAnalysis& analysis, std::vector<std::string>& warnings) {
  const std::vector<JointProperties>& properties = analysis.model.properties;
  for (std::size_t k = 0; k < properties.size(); ++k) {
    const JointProperties& p = properties[k];
    const auto is_cohesive = [&](const Interface& face) {
      return face.properties == static_cast<int>(k) && has_cohesion(face);
    };
    const bool counts = std::ranges::any_of(analysis.interfaces, is_cohesive);
    if (p.laws.bond && !counts)
      warnings.push_back(fmt::format(
          "joint_properties '{}' state tension {:.4g} Pa and cohesion {:.4g} Pa; limit analysis "
          "leaves both out: its joints have friction alone ('--cohesion' counts the cohesion{})",
          p.name, p.tension, p.cohesion,
          p.bonds == BondsMade::as_sliced ? "; by itself it acts between faces of one joint, and blocks given "
                                            "directly have none"
                                          : ", bonds = \"as_sliced\" in the scene too"));
    if (counts && p.cohesion > 0 && p.cohesion_law != CohesionLaw::plastic)
      warnings.push_back(fmt::format(
          "joint_properties '{}' have cohesion {:.4g} Pa that slip takes; limit analysis counts it as plastic, "
          "which is unsafe where several joints share the load",
          p.name, p.cohesion));
    if (counts && p.tension > 0)
      warnings.push_back(fmt::format(
          "joint_properties '{}' state tension {:.4g} Pa, which limit analysis leaves out: its joints open freely",
          p.name, p.tension));
    if (p.dilates())
      warnings.push_back(
          fmt::format("joint_properties '{}' dilate by {:.4g} degrees; limit analysis does not count that: its flow is "
                      "the one that it "
                      "states",
                      p.name, to_degrees(p.dilation)));
    if (p.laws.friction == FrictionLaw::softening)
      warnings.push_back(
          fmt::format("joint_properties '{}' soften; limit analysis takes their friction before any slip", p.name));
  }
}

// The stage whose applied forces are analysed: the first that states any.
const StagePlan* stage_of_forces(const std::vector<StagePlan>& stages) {
  const auto stage = std::ranges::find_if(stages, [](const StagePlan& s) { return !s.change.force.empty(); });
  return stage == stages.end() ? nullptr : &*stage;
}

// changes by stages are left out, except the forces of the stage `analysed`, if any
void warn_of_changes(const std::vector<StagePlan>& stages, const StagePlan* analysed,
                     std::vector<std::string>& warnings) {
  for (const StagePlan& stage : stages) {
    const Change& change = stage.change;
    if (!change.fix.empty() || !change.release.empty() || !change.remove.empty() || !change.excavate.empty() ||
        change.friction || !change.friction_of.empty() || !change.boundary.empty() || !stage.water.empty())
      warnings.push_back(fmt::format(
          "stage '{}' changes blocks, loads, water or friction; limit analysis takes the scene as it is before "
          "its first stage",
          stage.name));
    if (!change.force.empty() && &stage != analysed)
      warnings.push_back(fmt::format("the applied forces of stage '{}' are left out{}", stage.name,
                                     analysed ? fmt::format("; those of stage '{}' are analysed", analysed->name)
                                              : ": '--load applied' finds their factor"));
  }
  for (const ForcePlan& plan : analysed ? analysed->change.force : std::vector<ForcePlan>())
    if (!plan.factor.times.empty() || plan.factor.frequency > 0)
      warnings.push_back(fmt::format("force '{}' has a factor of time, which is taken as 1", plan.name));
}

Value bracketed(double low, double high, const std::string& unit) {
  return {0.5 * (low + high), unit, 0.5 * (high - low), "bisection over linear programs"};
}

// the common part of both searches of strength; `option` names the properties on the command line
template <class Find>
CriticalStrength seek_strength(const LimitRequest& request, const Find& find, const char* option,
                               LimitAnalysis& analysis) {
  CriticalStrength found;
  try {
    found = find(analysis.model, analysis.interfaces, request.properties, analysis.water);
  } catch (const std::out_of_range& unknown) {
    std::vector<std::string> names;
    for (const JointProperties& p : analysis.model.properties)
      names.push_back(p.name);
    throw BadInput(fmt::format("{} {}: no joint_properties of this name; there are: {}", option, unknown.what(),
                               fmt::join(names, ", ")));
  }
  analysis.sought += request.properties.empty() ? "all joints" : fmt::format("{}", fmt::join(request.properties, ", "));
  analysis.status = found.status;
  analysis.state = found.state;
  analysis.evidence = found.evidence;
  if (found.self_stress) analysis.caveats.push_back(self_stress_caveat);
  return found;
}

void seek_factor_of_safety(const LimitRequest& request, LimitAnalysis& analysis) {
  analysis.sought = "factor of safety of ";
  const CriticalStrength found = seek_strength(request, find_factor_of_safety, "--joint", analysis);
  if (found.status == LimitStatus::found && std::isfinite(found.collapses)) {
    analysis.values.emplace_back("factor_of_safety", bracketed(found.stands, found.collapses, "1"));
    analysis.values.back().second.divides =
        divided_by_factor(request.properties, std::ranges::any_of(analysis.interfaces, has_cohesion));
    analysis.values.emplace_back("force_missing_beyond", Value{found.missing, "weight of a block", {}, ""});
  } else if (found.status == LimitStatus::found) {
    analysis.message = fmt::format(
        "the blocks are stable with 1/{:.1g} of the strength of these joints: no factor up to it is critical",
        found.stands);
  }
  if (found.status == LimitStatus::not_attained)
    analysis.message = fmt::format("stable at any strength above 0{}", without_bound);
  if (found.status == LimitStatus::carries_any)
    analysis.message = "the blocks are stable without any strength of these joints: no factor is critical";
  if (found.status == LimitStatus::carries_nothing) {
    analysis.values.emplace_back("factor_not_enough",
                                 Value{found.collapses, "1", {}, "fails at the smallest factor tried"});
    analysis.values.emplace_back("force_missing", Value{found.missing, "weight of a block", {}, "at that factor"});
    analysis.message =
        "not even a thousand times the strength is enough: the mechanism overturns blocks or leaves them without "
        "support; see the figure; fix blocks that should support, or restrain rotations that should not count";
  }
}

void seek_friction(const LimitRequest& request, LimitAnalysis& analysis) {
  analysis.sought = "critical friction angle of ";
  const CriticalStrength found = seek_strength(request, find_critical_friction, "--friction", analysis);
  if (found.status == LimitStatus::found) {
    analysis.values.emplace_back("critical_friction",
                                 bracketed(to_degrees(found.collapses), to_degrees(found.stands), "deg"));
    analysis.values.emplace_back("force_missing_below", Value{found.missing, "weight of a block", {}, ""});
  }
  if (found.status == LimitStatus::not_attained)
    analysis.message = fmt::format("stable at any friction above 0{}", without_bound);
  if (found.status == LimitStatus::carries_any) {
    analysis.message = "the blocks are stable without friction in these joints: no angle is critical";
    analysis.values.emplace_back("critical_friction",
                                 Value{to_degrees(found.stands), "deg", {}, "stable at this angle"});
  }
  if (found.status == LimitStatus::carries_nothing) {
    analysis.values.emplace_back("friction_not_enough",
                                 Value{to_degrees(found.collapses), "deg", {}, "fails at the largest angle tried"});
    analysis.values.emplace_back("force_missing", Value{found.missing, "weight of a block", {}, "at that angle"});
    analysis.message =
        "no friction up to 89 degrees is enough: the mechanism overturns blocks or leaves them without support; see "
        "the figure; fix blocks that should support, or restrain rotations that should not count";
  }
}

// the load whose factor is sought, in addition to gravity or instead of it
struct LiveLoad {
  std::string sought, if_any;  // if_any: the reason, or the repair, if any factor is carried
  Loads loads;                 // none: gravity itself is sought
  bool beside_gravity = true;
};

LiveLoad pushed(const Model<2>& model, double direction, const char* side) {
  return {fmt::format("horizontal acceleration to the {} at collapse, as a fraction of gravity", side),
          "it presses the blocks against fixed ones, or wedges them there",
          loads_of_acceleration(model, {direction * model.gravity.norm(), 0})};
}

LiveLoad applied(const Model<2>& model, const StagePlan& stage) {
  Change forces;
  forces.force = stage.change.force;
  return {fmt::format("multiple of the applied forces of stage '{}' at collapse, in addition to gravity", stage.name),
          "they press the blocks against fixed ones, or wedge them there",
          loads_of_applied_forces(apply(model, forces))};
}

LiveLoad live_load(LimitLoad load, const Model<2>& model, const StagePlan* analysed) {
  if (load == LimitLoad::left) return pushed(model, -1, "left");
  if (load == LimitLoad::right) return pushed(model, 1, "right");
  if (load == LimitLoad::applied) return applied(model, *analysed);
  return {"multiple of gravity at collapse",
          "without cohesion a multiple of gravity changes nothing: seek the critical friction, or state --load "
          "left, right or applied",
          {},
          false};
}

Loads with_water(const LimitAnalysis& analysis, Loads loads) {
  for (std::size_t b = 0; b < analysis.water.size(); ++b)
    loads[b] += analysis.water[b];
  return loads;
}

// Water grows with the factor of gravity, as in a run.
void seek_factor(const LiveLoad& live, LimitAnalysis& analysis) {
  analysis.sought = live.sought;
  const Model<2>& model = analysis.model;
  const Loads gravity = with_water(analysis, loads_of_acceleration(model, model.gravity)),
              nothing = loads_of_acceleration(model, Vector<2>::Zero());
  const LoadFactor found = live.beside_gravity ? find_load_factor(model, analysis.interfaces, gravity, live.loads)
                                               : find_load_factor(model, analysis.interfaces, nothing, gravity);
  analysis.status = found.status;
  analysis.state = found.state;
  analysis.evidence = found.evidence;
  if (found.self_stress) analysis.caveats.push_back(self_stress_caveat);
  if (found.status == LimitStatus::found)
    analysis.values.emplace_back("collapse_factor", Value{found.factor, "1", {}, "linear program"});
  if (found.status == LimitStatus::carries_any)
    analysis.message = "carried up to a million times the blocks' weight: this load causes no collapse; " + live.if_any;
  if (found.status == LimitStatus::carries_nothing)
    analysis.message =
        "the blocks collapse under gravity alone, so no further load can be sought; leave out --load to find the "
        "friction that they need";
}

void refuse_empty(const LimitAnalysis& analysis, const StagePlan* analysed) {
  if (analysis.status == LimitStatus::nothing_free)
    throw BadInput("no block is free to move, so nothing can collapse; choose fewer blocks to fix or restrain");
  if (analysis.status != LimitStatus::no_load) return;
  if (analysed)
    throw BadInput(
        fmt::format("--load applied: the forces of stage '{}' are zero, cancel, or act on no block that is free to "
                    "follow them; state forces on free blocks",
                    analysed->name));
  if (analysis.model.gravity.isZero(0))
    throw BadInput("gravity = 0: limit analysis needs a load; write for example gravity = [0, -9.81]");
  throw BadInput(
      "the load acts on no block that is free to follow it; choose another --load, or restrain fewer blocks");
}

}  // namespace

LimitAnalysis analyse_limit(const LoadedScene& scene, const LimitRequest& request) {
  const auto* prepared = std::get_if<Prepared<2>>(&scene.prepared);
  if (!prepared)
    throw BadInput(
        "dimension = 3: limit analysis needs a scene in the plane; state a section with dimension = 2, or use "
        "'voussoir run' with a stage of kind = \"reduce\"");
  if (prepared->model.particles)
    throw BadInput(
        "the scene has potential particles: limit analysis has blocks of half-spaces only; leave out shape = "
        "\"potential\", or use 'voussoir run' with a stage of kind = \"reduce\"");
  if (!prepared->model.bolts.empty())
    throw BadInput(
        "the scene has bolts: limit analysis has blocks and joints only; remove [[bolts]] and install for the "
        "unsupported slope, or use 'voussoir run' with a stage of kind = \"reduce\"");
  if (!prepared->model.linings.empty())
    throw BadInput(
        "the scene has linings: limit analysis has blocks and joints only; remove [[linings]] and install for the "
        "unsupported opening, or use 'voussoir run' with a stage of kind = \"reduce\"");
  LimitAnalysis analysis;
  analysis.caveats = {associated_flow_caveat};
  analysis.title = scene.title;
  analysis.input_hash = scene.hash;
  analysis.model = prepared->model;
  analysis.interfaces = find_interfaces(analysis.model, request.cohesion);
  if (!analysis.model.waters.empty()) analysis.water = water_loads_at_reference<2>(analysis.model);
  analysis.warnings = unsupported(analysis);
  warn_of_strengths(analysis, analysis.warnings);
  const StagePlan* analysed = request.load == LimitLoad::applied ? stage_of_forces(prepared->stages) : nullptr;
  if (request.load == LimitLoad::applied && !analysed)
    throw BadInput(
        "--load applied: no stage applies a force; add [[stage.force]] with name, bodies and force, or state --load "
        "gravity, left or right");
  warn_of_changes(prepared->stages, analysed, analysis.warnings);

  if (request.load)
    seek_factor(live_load(*request.load, analysis.model, analysed), analysis);
  else
    request.factor ? seek_factor_of_safety(request, analysis) : seek_friction(request, analysis);
  refuse_empty(analysis, analysed);
  if (analysis.status == LimitStatus::solver_failed)
    analysis.message = "GLPK did not solve a linear program; blocks of very different size are the usual cause";
  analysis.answered =
      analysis.status == LimitStatus::found || (!request.load && analysis.status == LimitStatus::carries_any);
  analysis.mechanism = describe_mechanism(analysis.model, analysis.state.velocities);
  return analysis;
}

}  // namespace voussoir
