#include "core/run/block_theory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/plunge_trend.hpp"
#include "core/key_blocks/block_survey.hpp"
#include "core/key_blocks/elastic_shear.hpp"
#include "core/key_blocks/pressure_eccentricity.hpp"
#include "core/key_blocks/survey.hpp"
#include "core/run/brittle_factor.hpp"
#include "core/run/failure_watch.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

// the force that a sentence states is for this factor of safety
constexpr double usual_factor = 1.3;

constexpr int halvings = 60;  // of the angle: beyond rounding

template <int Dim>
struct JudgedSet {
  Assembly<Dim> assembly;
  Block<Dim> block;
  BoltedVerdict<Dim> bolted;
};

// deg: the friction of these properties at which the factor is 1; none if it is not between 0 and 89 deg
template <int Dim>
std::optional<double> critical_angle(const JudgedSet<Dim>& set, const std::vector<int>& properties,
                                     const Vector<Dim>& gravity) {
  Block<Dim> block = set.block;
  const auto stands_at = [&](double angle) {
    for (RockFace<Dim>& face : block.faces)
      if (std::ranges::find(properties, face.properties) != properties.end()) face.tan_friction = std::tan(angle);
    return judge_bolted<Dim>(block, Vector<Dim>::Zero(), gravity).factor.value_or(0) >= 1;
  };
  double low = 0, high = 89 * degree;
  if (stands_at(low) || !stands_at(high)) return {};
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    (stands_at(middle) ? high : low) = middle;
  }
  return to_degrees(high);
}

int stage_named(const std::vector<StagePlan>& stages, const std::string& name) {
  const auto found = std::ranges::find(stages, name, &StagePlan::name);
  return found == stages.end() ? -1 : static_cast<int>(found - stages.begin());
}

// the value of the search of this stage
const Value* value_of_search(const Results& results, const std::string& stage, Searched searched) {
  const std::string name = searched == Searched::factor ? "factor_of_safety" : "critical_friction";
  const Value* own = results.find(stage + "_" + name);
  return own ? own : results.find(name);
}

template <int Dim>
bool slip_takes_cohesion(const JudgedSet<Dim>& set) {
  return std::ranges::any_of(set.block.faces, [&](const RockFace<Dim>& face) {
    return face.cohesion > 0 && set.assembly.model.properties[face.properties].cohesion_law != CohesionLaw::plastic;
  });
}

// whether this holds for the properties of any face
template <int Dim>
bool has(const JudgedSet<Dim>& set, bool (JointProperties::*property)() const) {
  return std::ranges::any_of(set.block.faces, [&](const RockFace<Dim>& face) {
    return (set.assembly.model.properties[face.properties].*property)();
  });
}

template <int Dim>
std::string name_of_face(const JudgedSet<Dim>& set, int face) {
  const int joint = set.block.faces[face].joint;
  return joint == no_joint ? "a face that no joint made" : set.assembly.model.joints[joint].name;
}

template <int Dim>
std::vector<std::string> reasons_of(const JudgedSet<Dim>& set, const FailureMechanism& mechanism) {
  std::vector<std::string> reasons;
  if (const std::optional<double> eccentricity = pressure_eccentricity(set.assembly, set.block, set.bolted);
      eccentricity && *eccentricity > 1)
    reasons.push_back(fmt::format("the blocks must turn: pressure eccentricity {:.3g}", *eccentricity));
  std::vector<std::string> closed;
  for (const int face : closed_by_elastic_shear(set.assembly, set.block, set.bolted))
    closed.push_back(name_of_face(set, face));
  if (!closed.empty()) reasons.push_back(fmt::format("elastic shear closes {}", fmt::join(closed, ", ")));
  if (mechanism.clusters.size() > 1)
    reasons.push_back(
        fmt::format("the blocks move in {} parts, which it judges as one body", mechanism.clusters.size()));
  return reasons;
}

// Stress of the rock around is not counted: with it roof and wall blocks would seem to fall.
template <int Dim>
bool is_stressed(const Prepared<Dim>& prepared, int place) {
  const auto loaded = [](const StagePlan& stage) { return !stage.change.boundary.empty(); };
  return !prepared.model.boundary.empty() ||
         std::any_of(prepared.stages.begin(), prepared.stages.begin() + place + 1, loaded);
}

// the single block that slides at the lowest factor
template <int Dim>
void find_lowest(const Assembly<Dim>& assembly, BlockTheory& theory) {
  const std::vector<BoltedVerdict<Dim>> single = judge_all<Dim>(assembly, {});
  for (std::size_t b = 0; b < single.size(); ++b) {
    const Verdict<Dim>& verdict = single[b].verdict;
    if (!moves(verdict.kind) || verdict.loaded == 0 || !single[b].factor) continue;
    if (theory.lower_block >= 0 && *single[b].factor >= theory.lower) continue;
    theory.lower_block = static_cast<int>(b);
    theory.lower = *single[b].factor;
  }
}

template <int Dim>
std::optional<BlockTheory> judge_moving(const Prepared<Dim>& prepared, int place, const FailureMechanism& mechanism) {
  const ReducePlan& plan = std::get<ReducePlan>(prepared.stages[place].plan);
  std::optional<Assembly<Dim>> assembly = assembly_of_stage(prepared, place);
  if (!assembly) return {};
  JudgedSet<Dim> set;
  set.assembly = std::move(*assembly);
  const Vector<Dim>& gravity = set.assembly.model.gravity;
  gather<Dim>(set.assembly, mechanism.bodies(), {}, set.block);
  set.bolted = judge_bolted<Dim>(set.block, Vector<Dim>::Zero(), gravity);
  const Verdict<Dim>& verdict = set.bolted.verdict;
  BlockTheory theory;
  theory.kind = word_of(verdict.kind);
  for (int k = 0; k < verdict.loaded; ++k)
    theory.joints.push_back(name_of_face(set, verdict.faces[k]));
  if (moves(verdict.kind) && plan.searched == Searched::factor) {
    theory.critical = set.bolted.factor;
    if (verdict.cohesion > 0) {
      if (set.block.bolts.empty()) theory.friction_only = verdict.factor_friction_only();
      theory.brittle = brittle_factor(set.assembly, set.block, set.bolted, chosen_properties(set.assembly.model, plan));
    }
    if (!is_stressed(prepared, place)) find_lowest(set.assembly, theory);
    const auto force = least_force(set.block, set.bolted, usual_factor, gravity);
    if (force && force->force.norm() > 0) {
      theory.required = usual_factor;
      theory.force = force->force.norm();
      std::tie(theory.force_plunge, theory.force_trend) = plunge_and_trend<Dim>(force->force);
    }
  } else if (moves(verdict.kind)) {
    theory.critical = critical_angle(set, chosen_properties(set.assembly.model, plan), gravity);
  }
  theory.reasons = reasons_of(set, mechanism);
  if (!theory.brittle && slip_takes_cohesion(set))
    theory.reasons.push_back("it counts cohesion that slip takes as plastic");
  if (has(set, &JointProperties::dilates)) theory.reasons.push_back("joints dilate, which it does not count");
  if (has(set, &JointProperties::follows_barton_bandis))
    theory.reasons.push_back(
        "Barton and Bandis' friction is that of a face's mean pressure here, and of each point's there");
  return theory;
}

}  // namespace

template <int Dim>
void add_block_theory(const Prepared<Dim>& prepared, Results& results) {
  for (StableState& at : results.at_last_stable_state) {
    const int place = stage_named(prepared.stages, at.stage);
    if (place < 0 || !at.failed || !at.failed->mechanism.known()) continue;
    const auto* plan = std::get_if<ReducePlan>(&prepared.stages[place].plan);
    const Value* value = plan ? value_of_search(results, at.stage, plan->searched) : nullptr;
    if (!value || !value->error_bar) continue;
    at.block_theory = judge_moving(prepared, place, at.failed->mechanism);
    if (!at.block_theory) continue;
    BlockTheory& theory = *at.block_theory;
    const std::optional<double> expected = theory.brittle ? theory.brittle : theory.critical;
    theory.differs = expected && std::abs(*expected - value->value) > *value->error_bar;
    if (theory.brittle && value->value > *theory.brittle)
      theory.reasons.push_back("one joint carries what another loses");
    if (value->covers == "bracket") theory.reasons.push_back("the bar is that of the search alone");
    if (!theory.differs) theory.reasons.clear();
    if (theory.lower > value->value - *value->error_bar) theory.lower_block = -1;
  }
}

std::string text_of(const BlockTheory& theory, const std::string& unit) {
  std::string text = "block theory: ";
  if (theory.brittle) text += fmt::format("{:.5g} brittle, ", *theory.brittle);
  if (theory.critical)
    text +=
        fmt::format("{:.5g}{}{} for the same blocks", *theory.critical, unit == "1" ? "" : " " + unit,
                    theory.friction_only ? fmt::format(" plastic, {:.5g} friction only,", *theory.friction_only) : "");
  else
    text += fmt::format("{}; it knows the translation of one body only", theory.kind);
  if (theory.force)
    text += fmt::format("; {:.3g} kN ({:.1f}/{:05.1f}) would give {:g}", *theory.force / 1000, theory.force_plunge,
                        theory.force_trend, theory.required);
  if (theory.differs)
    text +=
        fmt::format("; it differs by more than the error bar: {}",
                    theory.reasons.empty() ? "no reason is known" : fmt::format("{}", fmt::join(theory.reasons, "; ")));
  if (theory.lower_block >= 0)
    text += fmt::format("; less, {:.5g}, for block {} alone, if the blocks around it do not give way", theory.lower,
                        theory.lower_block);
  return text;
}

template void add_block_theory<2>(const Prepared<2>&, Results&);
template void add_block_theory<3>(const Prepared<3>&, Results&);

}  // namespace voussoir
