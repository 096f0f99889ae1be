#include "app/limit/limit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "app/bad_input.hpp"

namespace voussoir {

const char* const associated_flow_caveat =
    "associated flow: joints open as they slip, so this is an upper bound on strength; where blocks topple it may be "
    "several degrees unsafe (Goodman & Bray's slope: 33.4 for 38.15); confirm it with 'voussoir run'";

namespace {

constexpr double degrees = 180 / std::numbers::pi;

std::string block_name(const Model<2>& model, int body) {
  const std::string& name = model.bodies[body].name;
  return name.empty() ? fmt::format("block {}", body) : fmt::format("block '{}'", name);
}

// what cannot be carried by any face, however rough
std::vector<std::string> unsupported(const LimitAnalysis& analysis) {
  std::vector<bool> touched(analysis.model.bodies.size(), false);
  for (const Interface& face : analysis.interfaces)
    touched[face.body_a] = touched[face.body_b] = true;
  std::vector<std::string> warnings;
  for (std::size_t b = 0; b < touched.size(); ++b)
    if (analysis.model.bodies[b].present && !analysis.model.bodies[b].fixed && !touched[b])
      warnings.push_back(fmt::format("{} lies face on face with no other; corners on faces carry nothing here",
                                     block_name(analysis.model, static_cast<int>(b))));
  return warnings;
}

// strength beside friction has no place in the linear programs
void warn_of_strengths(const std::vector<JointProperties>& properties, std::vector<std::string>& warnings) {
  for (const JointProperties& p : properties)
    if (p.laws.bond)
      warnings.push_back(
          fmt::format("joint_properties '{}' state tension {:.4g} Pa and cohesion {:.4g} Pa; limit analysis "
                      "leaves both out: its joints have friction alone",
                      p.name, p.tension, p.cohesion));
}

// what a stage would change is not looked at
void warn_of_changes(const std::vector<StagePlan>& stages, std::vector<std::string>& warnings) {
  for (const StagePlan& stage : stages) {
    const Change& change = stage.change;
    if (!change.fix.empty() || !change.release.empty() || !change.remove.empty() || change.friction ||
        !change.boundary.empty())
      warnings.push_back(
          fmt::format("stage '{}' changes blocks, loads or friction; limit analysis takes the scene as it is before "
                      "its first stage",
                      stage.name));
  }
}

Value bracketed(double low, double high, const std::string& rule) {
  return {0.5 * (low + high) * degrees, "deg", 0.5 * (high - low) * degrees, rule};
}

void seek_friction(const std::vector<std::string>& properties, LimitAnalysis& analysis) {
  analysis.sought = "critical friction angle of " +
                    (properties.empty() ? "all joints" : fmt::format("{}", fmt::join(properties, ", ")));
  CriticalFriction found;
  try {
    found = find_critical_friction(analysis.model, analysis.interfaces, properties);
  } catch (const std::out_of_range& unknown) {
    std::vector<std::string> names;
    for (const JointProperties& p : analysis.model.properties)
      names.push_back(p.name);
    throw BadInput(fmt::format("--friction {}: no joint_properties of this name; there are: {}", unknown.what(),
                               fmt::join(names, ", ")));
  }
  analysis.status = found.status;
  analysis.state = found.state;
  analysis.evidence = found.evidence;
  if (found.status == LimitStatus::found) {
    analysis.values.emplace_back("critical_friction",
                                 bracketed(found.collapses, found.stands, "bisection over linear programs"));
    analysis.values.emplace_back("force_missing_below", Value{found.missing, "weight of a block", {}, ""});
  }
  if (found.status == LimitStatus::carries_any) {
    analysis.message = "the blocks stand without friction in these joints: no angle is critical";
    analysis.values.emplace_back("critical_friction", Value{found.stands * degrees, "deg", {}, "stands at this angle"});
  }
  if (found.status == LimitStatus::carries_nothing) {
    analysis.values.emplace_back("friction_not_enough",
                                 Value{found.collapses * degrees, "deg", {}, "fails at the largest angle tried"});
    analysis.values.emplace_back("force_missing", Value{found.missing, "weight of a block", {}, "at that angle"});
    analysis.message =
        "no friction up to 89 degrees is enough: the mechanism overturns blocks or leaves them without support; look "
        "at the figure, fix what should hold, or restrain the rotation that should not count";
  }
}

void seek_factor(LimitLoad load, LimitAnalysis& analysis) {
  const Vector<2>& gravity = analysis.model.gravity;
  const Vector<2> none = Vector<2>::Zero();
  const Vector<2> push(load == LimitLoad::left ? -gravity.norm() : gravity.norm(), 0);
  const bool pushed = load != LimitLoad::gravity;
  analysis.sought = pushed ? fmt::format("horizontal acceleration to the {} at collapse, as a share of gravity",
                                         load == LimitLoad::left ? "left" : "right")
                           : "multiple of gravity at collapse";
  const LoadFactor found =
      find_load_factor(analysis.model, analysis.interfaces, pushed ? gravity : none, pushed ? push : gravity);
  analysis.status = found.status;
  analysis.state = found.state;
  analysis.evidence = found.evidence;
  if (found.status == LimitStatus::found)
    analysis.values.emplace_back("collapse_factor", Value{found.factor, "1", {}, "linear program"});
  if (found.status == LimitStatus::carries_any)
    analysis.message = "carried up to a million times: this load brings nothing to collapse; " +
                       std::string(pushed ? "it presses the blocks against what is fixed, or wedges them there"
                                          : "without cohesion any multiple of gravity is as good as another: ask for "
                                            "the critical friction, or --load left or right");
  if (found.status == LimitStatus::carries_nothing)
    analysis.message =
        "gravity alone is not carried, so there is no further load to look for; leave out --load to learn which "
        "friction carries it";
}

void refuse_empty(LimitStatus status) {
  if (status == LimitStatus::nothing_free)
    throw BadInput("no block is free to move, so nothing can collapse; choose fewer blocks to fix or restrain");
  if (status == LimitStatus::no_load)
    throw BadInput("gravity = 0: limit analysis needs a load; write for example gravity = [0, -9.81]");
}

}  // namespace

LimitAnalysis analyse_limit(const LoadedScene& scene, const LimitRequest& request) {
  const auto* prepared = std::get_if<Prepared<2>>(&scene.prepared);
  if (!prepared)
    throw BadInput(
        "dimension = 3: limit analysis knows scenes in the plane only; state a section with dimension = 2, or use "
        "'voussoir run' with a stage of kind = \"reduce\"");
  LimitAnalysis analysis;
  analysis.title = scene.title;
  analysis.input_hash = scene.hash;
  analysis.model = prepared->model;
  analysis.interfaces = find_interfaces(analysis.model);
  analysis.warnings = unsupported(analysis);
  warn_of_strengths(analysis.model.properties, analysis.warnings);
  warn_of_changes(prepared->stages, analysis.warnings);

  request.load ? seek_factor(*request.load, analysis) : seek_friction(request.properties, analysis);
  refuse_empty(analysis.status);
  if (analysis.status == LimitStatus::solver_failed)
    analysis.message = "GLPK found no answer to a linear program; blocks of very different size are the usual cause";
  analysis.answered =
      analysis.status == LimitStatus::found || (!request.load && analysis.status == LimitStatus::carries_any);
  analysis.mechanism = describe_mechanism(analysis.model, analysis.state.velocities);
  return analysis;
}

}  // namespace voussoir
