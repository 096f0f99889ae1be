#include "app/limit/limit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/limit/limit_words.hpp"
#include "core/base/bad_input.hpp"
#include "core/model/water_surfaces.hpp"

namespace voussoir {

namespace {

const char* const associated_flow_caveat =
    "associated flow: joints dilate as they slip, so this is an upper bound on strength; if blocks topple it may be "
    "several degrees unsafe (Goodman & Bray's slope: 33.4 for 38.15); confirm it with 'voussoir run'";
const char* const self_stress_caveat =
    "this result may depend on self-stress, normal forces between walls that the loads do not cause: blocks that fall "
    "in a run may be far from failure here; confirm it with 'voussoir run'";
const char* const by_linear_programs = "bisection over linear programs";

bool has_cohesion(const Interface& face) {
  return face.cohesion > 0;
}

using FindStrength = CriticalStrength (*)(const Model<2>&, const std::vector<Interface>&,
                                          const std::vector<std::string>&, const Loads&);

CriticalStrength seek_strength(const LimitRequest& request, FindStrength find, LimitAnalysis& analysis) {
  refuse_unknown_properties(request, analysis.model.properties);
  const CriticalStrength found = find(analysis.model, analysis.interfaces, request.properties, analysis.water);
  analysis.state = found.state;
  if (found.self_stress) analysis.caveats.push_back(self_stress_caveat);
  return found;
}

void seek_factor_of_safety(const LimitRequest& request, LimitAnalysis& analysis) {
  tell_factor_of_safety(request, seek_strength(request, find_factor_of_safety, analysis),
                        std::ranges::any_of(analysis.interfaces, has_cohesion), by_linear_programs, analysis);
}

void seek_friction(const LimitRequest& request, LimitAnalysis& analysis) {
  tell_friction(request, seek_strength(request, find_critical_friction, analysis), by_linear_programs, analysis);
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
  return {sought_of_applied(stage), any_applied, loads_of_applied_forces(apply(model, forces))};
}

LiveLoad live_load(LimitLoad load, const Model<2>& model, const StagePlan* analysed) {
  if (load == LimitLoad::left) return pushed(model, -1, "left");
  if (load == LimitLoad::right) return pushed(model, 1, "right");
  if (load == LimitLoad::applied) return applied(model, *analysed);
  if (load == LimitLoad::gravity) return {sought_of_gravity, any_gravity, {}, false};
  throw BadInput(fmt::format("--load {}: the scene has dimension = 2; state gravity, left, right or applied",
                             limit_loads[static_cast<std::size_t>(load)]));
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
  analysis.state = found.state;
  analysis.evidence = found.evidence;
  if (found.self_stress) analysis.caveats.push_back(self_stress_caveat);
  tell_load_factor(found.status, found.factor, "linear program", live.if_any, analysis);
}

}  // namespace

LimitAnalysis analyse_limit(const LoadedScene& scene, const LimitRequest& request) {
  const Prepared<2>& prepared = std::get<Prepared<2>>(scene.prepared);
  refuse_what_limit_leaves_out(prepared);
  if (request.without_dilation)
    throw BadInput(
        "--without-dilation: the scene has dimension = 2, and only analysis in space answers for joints that do not "
        "dilate; state dimension = 3, or use 'voussoir run'");
  LimitAnalysis analysis;
  analysis.caveats = {associated_flow_caveat};
  analysis.title = scene.title;
  analysis.input_hash = scene.hash;
  analysis.model = prepared.model;
  analysis.interfaces = find_interfaces(analysis.model, request.cohesion);
  if (!analysis.model.waters.empty()) analysis.water = water_loads_at_reference<2>(analysis.model);
  std::vector<bool> touched(analysis.model.bodies.size()), cohesive(analysis.model.properties.size());
  for (const Interface& face : analysis.interfaces) {
    touched[face.body_a] = touched[face.body_b] = true;
    if (has_cohesion(face)) cohesive[face.properties] = true;
  }
  warn_of_unsupported(analysis.model, touched, analysis.warnings);
  warn_of_strengths(analysis.model.properties, cohesive, analysis.warnings);
  const StagePlan* analysed = stage_of_forces(prepared.stages, request);
  warn_of_changes(prepared.stages, analysed, analysis.warnings);

  if (request.load)
    seek_factor(live_load(*request.load, analysis.model, analysed), analysis);
  else
    request.factor ? seek_factor_of_safety(request, analysis) : seek_friction(request, analysis);
  tell_envelope(analysis);
  refuse_empty(analysis, analysis.model.gravity.isZero(0), analysed);
  if (analysis.status == LimitStatus::solver_failed)
    analysis.message = "GLPK did not solve a linear program; blocks of very different size are the usual cause";
  analysis.answered =
      analysis.status == LimitStatus::found || (!request.load && analysis.status == LimitStatus::carries_any);
  analysis.mechanism = describe_mechanism(analysis.model, analysis.state.velocities);
  return analysis;
}

}  // namespace voussoir
