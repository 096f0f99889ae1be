#include "core/run/stable_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/run/bonds_as_sliced.hpp"
#include "core/step/joint_forces.hpp"

namespace voussoir {
namespace {

// number of joints named in a line; results.json has all
constexpr std::size_t most_named = 4;

// of its force: less water than this that a block has left is not worth a line
constexpr double least_water_lost = 0.001;

template <int Dim>
std::string name_of_joint(const Prepared<Dim>& scene, const Model<Dim>& model, int joint) {
  if (joint == no_joint) return "";
  const int set = scene.joint_sets.set_of(joint);
  return set >= 0 ? scene.joint_sets.names[set] : model.joints[joint].name;
}

// joints of a set together
template <int Dim>
std::optional<WholeBonds> whole_bonds_of(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state,
                                         const BondedContacts& bonded) {
  const Bonds now = bonds_of(state.contacts);
  WholeBonds bonds{
      .whole = now.whole, .slipped = now.slipped, .made = state.ledger.bonds.made - state.ledger.bonds.removed};
  if (bonds.made == 0) return std::nullopt;
  std::map<std::string, JointBonds> by_name;
  for (const JointBonds& joint : bonds_by_joint(model, state, bonded)) {
    JointBonds& sum = by_name[name_of_joint(scene, model, joint.joint)];
    sum.whole += joint.whole;
    sum.slipped += joint.slipped;
    sum.made += joint.made;
    sum.held_area += joint.held_area;
    sum.made_area += joint.made_area;
  }
  for (const auto& [name, joint] : by_name)
    bonds.by_joint.push_back(
        {name, joint.whole, joint.slipped, joint.made, joint.made_area > 0 ? joint.held_area / joint.made_area : 0.0});
  return bonds;
}

}  // namespace

std::string cohesion_text(const JointProperties& p) {
  const std::string stated = fmt::format("cohesion of {}: {:.4g} Pa, ", p.name, p.cohesion);
  const std::string acts = p.bonds == BondsMade::as_sliced
                               ? "; it acts once, between faces of one joint that are opposite each other when sliced"
                               : "; it acts where a stage bonds";
  switch (p.cohesion_law) {
    case CohesionLaw::plastic:
      return stated + "plastic (slip leaves it, opening takes it; unsafe if the joint is brittle)" + acts;
    case CohesionLaw::softening:
      return stated +
             fmt::format("softening (slip takes it to {:.4g} Pa, 63 % within {:.3g} m; opening takes it)",
                         p.residual_cohesion, p.cohesion_slip) +
             acts;
    case CohesionLaw::brittle:
      break;
  }
  return stated + "brittle (the first slip takes it)" + acts;
}

std::string moment_text(const StableState& at) {
  if (!at.level) return "in equilibrium";
  return at.unit == "1" ? fmt::format("at the last stable state, a factor of {:.6g}", *at.level)
                        : fmt::format("at the last stable state, {:.6g} {}", *at.level, at.unit);
}

template <int Dim>
void note_stable_state(const Prepared<Dim>& scene, const Model<Dim>& model, const State<Dim>& state,
                       const BondedContacts& bonded, const StableState& at, std::vector<StableState>& noted) {
  StableState now = at;
  const auto is_of_stage = [&](const StableState& before) { return before.stage == at.stage; };
  if (const auto before = std::ranges::find_if(noted, is_of_stage); before != noted.end()) now.failed = before->failed;
  std::erase_if(noted, is_of_stage);
  now.bonds = whole_bonds_of(scene, model, state, bonded);
  if (now.bonds || now.trial) noted.push_back(std::move(now));
}

std::vector<std::string> doubts_about(const std::vector<StableState>& noted, const std::string& stage) {
  std::vector<std::string> doubts;
  for (const StableState& at : noted)
    if (at.stage == stage && at.bonds && at.bonds->whole + at.bonds->slipped == 0)
      doubts.push_back(fmt::format(
          "stage {}: {}: none of {} bonds is intact, so that cohesion and tensile strength have no effect there",
          at.stage, moment_text(at), at.bonds->made));
  return doubts;
}

template <int Dim>
void count_all_bonds(const Prepared<Dim>& scene, const State<Dim>& state, Results& results) {
  const bool by_stage = std::ranges::any_of(scene.stages, [](const StagePlan& stage) { return stage.change.bond; });
  if (!by_stage && !has_bonds_as_sliced(scene.model)) return;
  results.bonds = count_bonds(state.contacts, state.ledger.bonds);
  if (results.bonds->made == 0)
    results.warnings.push_back(
        by_stage ? "stage.bond has made no bond: no joint with tension or cohesion was closed and compressed"
                 : "tension and cohesion have no effect: no two faces of a joint that states them are opposite each "
                   "other and compressed; blocks given directly have no joint: write bond = true in the stage from "
                   "which it should act");
  for (const JointProperties& p : scene.model.properties)
    if (p.cohesion > 0 && (by_stage || p.bonds == BondsMade::as_sliced)) results.cohesion.push_back(cohesion_text(p));
}

std::string bonds_text(const WholeBonds& bonds) {
  std::string joints;
  for (std::size_t k = 0; k < std::min(bonds.by_joint.size(), most_named); ++k) {
    const BondsOfJoint& joint = bonds.by_joint[k];
    joints += fmt::format("{}{}: {} of {}, {:.3g} % of the bonded area", k > 0 ? "; " : "",
                          joint.joint.empty() ? "faces that no joint made" : joint.joint, joint.whole + joint.slipped,
                          joint.made, 100 * joint.area_share);
  }
  if (bonds.by_joint.size() > most_named) joints += fmt::format("; {} more", bonds.by_joint.size() - most_named);
  const std::string slipped =
      bonds.slipped > 0 ? fmt::format(", {} slipped with the cohesion that slip leaves", bonds.slipped) : "";
  return fmt::format("{} of {} bonds intact{} ({})", bonds.whole, bonds.made, slipped, joints);
}

std::vector<std::string> search_text(const StableState& at) {
  std::vector<std::string> lines;
  if (!at.trial || !at.failed) return lines;
  const TrialRow &stable = *at.trial, &failed = *at.failed;
  const auto level_text = [&](double level) {
    return fmt::format("{:.6g}{}", level, at.unit == "1" ? "" : " " + at.unit);
  };
  if (failed.body >= 0)
    lines.push_back(fmt::format(
        "failed at {}: body {}{} had moved by {:.3g} m{}, and by {:.3g} m in the last stable trial",
        level_text(failed.level), failed.body, failed.name.empty() ? "" : " (" + failed.name + ")", failed.displacement,
        failed.elastic_displacements ? fmt::format(", {:.3g} elastic displacements", *failed.elastic_displacements)
                                     : "",
        stable.displacement));
  if (const std::string sentence = sentence_of(failed.mechanism); !sentence.empty()) lines.push_back(sentence);
  if (at.followed)
    lines.push_back(at.followed->rests
                        ? fmt::format("followed beyond its failure, it comes to rest after {:.3g} m "
                                      "(without inertia, in {} steps)",
                                      at.followed->displacement, at.followed->steps)
                        : fmt::format("followed beyond its failure for {} steps, it has moved by {:.3g} "
                                      "m and not come to rest: {}",
                                      at.followed->steps, at.followed->displacement, at.followed->ended));
  if (at.taken_out)
    lines.push_back(fmt::format("the extrapolation to no displacement takes out {:.2g}{}", *at.taken_out,
                                at.unit == "1" ? "" : " " + at.unit));
  if (!at.bracket_because.empty()) lines.push_back("the result is the middle of the bracket: " + at.bracket_because);
  if (stable.bolts_turned && at.unit == "1")
    lines.push_back("on joint strength; bolts not divided: " +
                    (stable.bolts_use
                         ? fmt::format("their largest force is {:.3g} % of their capacity", 100 * *stable.bolts_use)
                         : "they have no yield"));
  if (stable.bolts_turned && failed.bolts_turned)
    lines.push_back(fmt::format("bolts had turned by up to {:.2g} deg, in the failed trial by {:.2g} deg",
                                *stable.bolts_turned, *failed.bolts_turned));
  const double lost = std::max(std::abs(stable.water_lost.value_or(0)), std::abs(failed.water_lost.value_or(0)));
  if (lost >= least_water_lost)
    lines.push_back(fmt::format("the water's force on it had fallen by {:.2g} %, in the failed trial by {:.2g} %",
                                100 * stable.water_lost.value_or(0), 100 * failed.water_lost.value_or(0)));
  return lines;
}

template void note_stable_state<2>(const Prepared<2>&, const Model<2>&, const State<2>&, const BondedContacts&,
                                   const StableState&, std::vector<StableState>&);
template void note_stable_state<3>(const Prepared<3>&, const Model<3>&, const State<3>&, const BondedContacts&,
                                   const StableState&, std::vector<StableState>&);

template void count_all_bonds<2>(const Prepared<2>&, const State<2>&, Results&);
template void count_all_bonds<3>(const Prepared<3>&, const State<3>&, Results&);

}  // namespace voussoir
