#include "app/limit/limit_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/bad_input.hpp"
#include "core/limit/follow_envelope.hpp"
#include "core/model/body_title.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

const char* const without_bound = ", by unbounded normal forces, which need not exist; confirm it with 'voussoir run'";

template <int Dim>
std::string block_name(const Model<Dim>& model, int body) {
  const std::string title = title_of(model, body);
  return model.bodies[body].name.empty() ? fmt::format("block {} ({})", body, title) : fmt::format("block '{}'", title);
}

Value bracketed(double low, double high, const std::string& unit, const std::string& rule) {
  return {0.5 * (low + high), unit, 0.5 * (high - low), rule};
}

void tell_strength(const LimitRequest& request, const StrengthBracket& found, const char* sought, LimitAnswer& answer) {
  answer.sought = sought;
  answer.sought += request.properties.empty() ? "all joints" : fmt::format("{}", fmt::join(request.properties, ", "));
  answer.status = found.status;
  answer.evidence = found.evidence;
}

}  // namespace

template <int Dim>
void refuse_what_limit_leaves_out(const Prepared<Dim>& prepared) {
  if (prepared.model.particles)
    throw BadInput(
        "the scene has potential particles: limit analysis has blocks of half-spaces only; leave out shape = "
        "\"potential\", or use 'voussoir run' with a stage of kind = \"reduce\"");
  if (!prepared.model.linings.empty())
    throw BadInput(
        "the scene has linings: limit analysis has blocks and joints only; remove [[linings]] and install for the "
        "unsupported opening, or use 'voussoir run' with a stage of kind = \"reduce\"");
}

template void refuse_what_limit_leaves_out<2>(const Prepared<2>&);
template void refuse_what_limit_leaves_out<3>(const Prepared<3>&);

template <int Dim>
void warn_of_unsupported(const Model<Dim>& model, const std::vector<bool>& touched,
                         std::vector<std::string>& warnings) {
  for (std::size_t b = 0; b < touched.size(); ++b)
    if (model.bodies[b].present && !model.bodies[b].fixed && !touched[b])
      warnings.push_back(fmt::format(
          "no face of {} is in contact with a face of another block; a corner on a face transfers no force here",
          block_name(model, static_cast<int>(b))));
}

template void warn_of_unsupported<2>(const Model<2>&, const std::vector<bool>&, std::vector<std::string>&);
template void warn_of_unsupported<3>(const Model<3>&, const std::vector<bool>&, std::vector<std::string>&);

void warn_of_strengths(const std::vector<JointProperties>& properties, const std::vector<bool>& cohesive,
                       std::vector<std::string>& warnings) {
  for (std::size_t k = 0; k < properties.size(); ++k) {
    const JointProperties& p = properties[k];
    const bool counts = cohesive[k];
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
          fmt::format("joint_properties '{}' dilate by {}; limit analysis does not count that: its joints "
                      "dilate by {}",
                      p.name,
                      p.follows_barton_bandis()
                          ? fmt::format("{:.3g} of their mobilised roughness angle", p.barton_bandis.dilation_share)
                          : fmt::format("{:.4g} degrees", to_degrees(p.dilation)),
                      p.follows_barton_bandis() ? "the slope of their envelope" : "their friction angle"));
    if (p.laws.friction == FrictionLaw::softening)
      warnings.push_back(
          fmt::format("joint_properties '{}' soften; limit analysis takes their friction before any slip", p.name));
  }
}

const StagePlan* stage_of_forces(const std::vector<StagePlan>& stages, const LimitRequest& request) {
  if (!request.load || request.load->kind != LimitLoad::Kind::applied) return nullptr;
  const auto stage = std::ranges::find_if(stages, [](const StagePlan& s) { return !s.change.force.empty(); });
  if (stage == stages.end())
    throw BadInput(
        "--load applied: no stage applies a force; add [[stage.force]] with name, bodies and force, or state another "
        "--load, such as gravity");
  return &*stage;
}

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

void refuse_unknown_properties(const LimitRequest& request, const std::vector<JointProperties>& properties) {
  std::vector<std::string> names;
  for (const JointProperties& p : properties)
    names.push_back(p.name);
  for (const std::string& name : request.properties)
    if (std::ranges::find(names, name) == names.end())
      throw BadInput(fmt::format("{} {}: no joint_properties of this name; there are: {}",
                                 request.factor ? "--joint" : "--friction", name, fmt::join(names, ", ")));
  if (request.factor) return;
  for (const JointProperties& p : properties)
    if (p.follows_barton_bandis() &&
        (request.properties.empty() || std::ranges::find(request.properties, p.name) != request.properties.end()))
      throw BadInput(fmt::format(
          "joint_properties '{}': Barton and Bandis' friction angle depends on the normal stress, so none is "
          "critical; seek the factor of safety by --factor, or name other joints by --friction",
          p.name));
}

void tell_factor_of_safety(const LimitRequest& request, const StrengthBracket& found, bool cohesive,
                           const std::string& rule, LimitAnswer& answer) {
  tell_strength(request, found, "factor of safety of ", answer);
  if (found.status == LimitStatus::found && std::isfinite(found.collapses)) {
    answer.values.emplace_back("factor_of_safety_upper_bound", bracketed(found.stands, found.collapses, "1", rule));
    answer.values.back().second.divides = divided_by_factor(request.properties, cohesive);
    answer.values.emplace_back("force_missing_beyond", Value{found.missing, "weight of a block", {}, ""});
  } else if (found.status == LimitStatus::found) {
    answer.message = fmt::format(
        "the blocks are stable with 1/{:.1g} of the strength of these joints: no factor up to it is critical",
        found.stands);
  }
  if (found.status == LimitStatus::not_attained)
    answer.message = fmt::format("stable at any strength above 0{}", without_bound);
  if (found.status == LimitStatus::carries_any)
    answer.message = "the blocks are stable without any strength of these joints: no factor is critical";
  if (found.status == LimitStatus::carries_nothing) {
    answer.values.emplace_back("factor_not_enough",
                               Value{found.collapses, "1", {}, "fails at the smallest factor tried"});
    answer.values.emplace_back("force_missing", Value{found.missing, "weight of a block", {}, "at that factor"});
    answer.message =
        "not even a thousand times the strength is enough: the mechanism overturns blocks or leaves them without "
        "support; see the figure; fix blocks that should support, or restrain rotations that should not count";
  }
}

void tell_friction(const LimitRequest& request, const StrengthBracket& found, const std::string& rule,
                   LimitAnswer& answer) {
  tell_strength(request, found, "critical friction angle of ", answer);
  if (found.status == LimitStatus::found) {
    answer.values.emplace_back("critical_friction_lower_bound",
                               bracketed(to_degrees(found.collapses), to_degrees(found.stands), "deg", rule));
    answer.values.emplace_back("force_missing_below", Value{found.missing, "weight of a block", {}, ""});
  }
  if (found.status == LimitStatus::not_attained)
    answer.message = fmt::format("stable at any friction above 0{}", without_bound);
  if (found.status == LimitStatus::carries_any) {
    answer.message = "the blocks are stable without friction in these joints: no angle is critical";
    answer.values.emplace_back("critical_friction", Value{to_degrees(found.stands), "deg", {}, "stable at this angle"});
  }
  if (found.status == LimitStatus::carries_nothing) {
    answer.values.emplace_back("friction_not_enough",
                               Value{to_degrees(found.collapses), "deg", {}, "fails at the largest angle tried"});
    answer.values.emplace_back("force_missing", Value{found.missing, "weight of a block", {}, "at that angle"});
    answer.message =
        "no friction up to 89 degrees is enough: the mechanism overturns blocks or leaves them without support; see "
        "the figure; fix blocks that should support, or restrain rotations that should not count";
  }
}

void tell_load_factor(LimitStatus status, double factor, const std::string& rule, const std::string& if_any,
                      LimitAnswer& answer) {
  answer.status = status;
  if (status == LimitStatus::found)
    answer.values.emplace_back("collapse_factor_upper_bound", Value{factor, "1", {}, rule});
  if (status == LimitStatus::carries_any)
    answer.message = "carried up to a million times the blocks' weight: this load causes no collapse; " + if_any;
  if (status == LimitStatus::carries_nothing)
    answer.message =
        "the blocks collapse under gravity alone, so no further load can be sought; leave out --load to find the "
        "friction that they need";
}

void tell_envelope(LimitAnswer& answer) {
  const Evidence& evidence = answer.evidence;
  if (evidence.rounds_of_tangents == 0) return;
  const std::string rounds = fmt::format(
      "joints after Barton and Bandis have their peak envelope, by its tangent at the mean normal stress of each face: "
      "{} rounds",
      evidence.rounds_of_tangents);
  const bool enclosed =
      std::ranges::any_of(answer.values, [](const auto& value) { return !value.second.divides.empty(); });
  if (evidence.tangents_agree)
    answer.caveats.push_back(fmt::format("{} until {} agree to {:g}", rounds,
                                         enclosed ? "the bounds from forces and from mechanisms" : "the answers of two",
                                         envelope_agreement));
  else if (enclosed)
    answer.caveats.push_back(rounds +
                             " did not close the bounds from forces and from mechanisms, which the error bar spans");
  else
    answer.caveats.push_back(
        fmt::format("{} did not agree to {:g}; the blocks carry no more than this, and may carry less: confirm it with "
                    "'voussoir run'",
                    rounds, envelope_agreement));
}

const char* const any_gravity =
    "without cohesion or bolts a multiple of gravity changes nothing: seek the critical friction, or state another "
    "--load, such "
    "as an acceleration";
const char* const any_applied = "they press the blocks against fixed ones, or wedge them there";
const char* const sought_of_gravity = "multiple of gravity at collapse";

std::string sought_of_applied(const StagePlan& stage) {
  return fmt::format("multiple of the applied forces of stage '{}' at collapse, in addition to gravity", stage.name);
}

void refuse_empty(const LimitAnswer& answer, bool weightless, const StagePlan* analysed) {
  if (answer.status == LimitStatus::nothing_free)
    throw BadInput("no block is free to move, so nothing can collapse; choose fewer blocks to fix or restrain");
  if (answer.status != LimitStatus::no_load) return;
  if (analysed)
    throw BadInput(
        fmt::format("--load applied: the forces of stage '{}' are zero, cancel, or act on no block that is free to "
                    "follow them; state forces on free blocks",
                    analysed->name));
  if (weightless)
    throw BadInput(
        "gravity = 0: limit analysis needs a load; write for example gravity = [0, -9.81], in space [0, 0, -9.81]");
  throw BadInput(
      "the load acts on no block that is free to follow it; choose another --load, or restrain fewer blocks");
}

}  // namespace voussoir
