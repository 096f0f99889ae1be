#include "app/limit/limit_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/limit/decide.hpp"
#include "app/limit/limit_proof.hpp"
#include "app/limit/limit_words.hpp"
#include "app/limit/without_dilation_words.hpp"
#include "core/base/bad_input.hpp"
#include "core/limit/bolt_ties.hpp"
#include "core/limit/without_dilation.hpp"
#include "core/model/water_surfaces.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

const char* const dilating_caveat =
    "associated flow: forces and mechanism enclose the strength of joints that dilate as they slip; of joints that do "
    "not it is an upper bound, often several degrees or tens of percent unsafe (Goodman & Bray's slope: 33.4 for 38.15 "
    "degrees), without bound where blocks are held by their sides; confirm it with 'voussoir run'";
const char* const history_caveat =
    "rigid blocks without history: what stress the joints were put in with is not known, and a run on elastic joints "
    "may fall earlier, or stand longer where blocks slip on each other as they turn";
const char* const pressed_caveat =
    "carried by self-stress, normal forces between blocks that the loads do not ask for: without dilation nothing "
    "says that they are there; confirm it with 'voussoir run'";

constexpr double still = 1e-6;   // of the fastest block
constexpr double twists = 1e-3;  // turning about a face's normal over its slip

// the load whose factor is sought
template <int Dim>
struct LiveLoad {
  std::string sought, if_any;  // if_any: the reason, or the repair, if any factor is carried
  LoadParts<Dim> load;
  bool beside_gravity = true;  // else gravity itself is sought
};

template <int Dim>
LiveLoad<Dim> live_load(const LimitLoad& load, const Model<Dim>& model, const LoadParts<Dim>& gravity,
                        const StagePlan* analysed) {
  if (load.kind == LimitLoad::Kind::gravity) return {sought_of_gravity, any_gravity, gravity, false};
  if (load.kind == LimitLoad::Kind::applied) {
    Change forces;
    forces.force = analysed->change.force;
    return {sought_of_applied(*analysed), any_applied, {Vector<Dim>::Zero(), apply(model, forces).applied, {}}};
  }
  if (load.direction.size() != Dim)
    throw BadInput(
        fmt::format("--load {}: the scene has dimension = {}; state gravity, applied, {}", load.name, Dim,
                    Dim == 2 ? "left, right or two numbers" : "east, west, north, south, up, down or three numbers"));
  const Vector<Dim> towards = Eigen::Map<const Vector<Dim>>(load.direction.data());
  const bool upright = load.name == "up" || load.name == "down", numbers = load.name.find(',') != std::string::npos;
  return {fmt::format("{} at collapse, as a fraction of gravity",
                      numbers   ? fmt::format("acceleration along ({})", load.name)
                      : upright ? "acceleration " + load.name
                                : "horizontal acceleration to the " + load.name),
          "it presses the blocks against fixed ones, or wedges them there",
          {towards * model.gravity.norm(), {}, {}}};
}

// "faces of blocks 3 and 4, 5 and 8, and 7 more"
template <int Dim>
std::string names_of_faces(const LimitAnalysis<Dim>& analysis, const std::vector<int>& faces) {
  constexpr std::size_t most = 3;
  std::string list = "faces of blocks ";
  for (std::size_t k = 0; k < std::min(faces.size(), most); ++k) {
    const CornerFace<Dim>& face = analysis.assembly.faces[faces[k]];
    list += fmt::format("{}{} and {}", k == 0 ? "" : ", ", face.body_a, face.body_b);
  }
  if (faces.size() > most) list += fmt::format(", and {} more", faces.size() - most);
  return list;
}

template <int Dim>
void warn_of_self_stress(const std::vector<int>& faces, LimitAnalysis<Dim>& analysis) {
  if (faces.empty()) return;
  analysis.caveats.push_back(fmt::format(
      "this result may depend on self-stress, normal forces that the loads do not cause, between {}: blocks "
      "that fall in a run may be far from failure here; confirm it with 'voussoir run'",
      names_of_faces(analysis, faces)));
}

bool follows_envelopes(const std::vector<JointProperties>& properties) {
  return std::ranges::any_of(properties, &JointProperties::follows_barton_bandis);
}

template <int Dim>
void keep_mechanism(LimitState<Dim> state, LimitAnalysis<Dim>& analysis) {
  if (state.forces.empty()) return;
  analysis.state = std::move(state);
  analysis.flow = "without dilation";
}

// of an acceleration, on every body that may follow it
template <int Dim>
std::vector<ForcePlan> forces_of(const Model<Dim>& model, const Vector<Dim>& acceleration) {
  std::vector<ForcePlan> forces;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (!body.present || body.fixed) continue;
    const Vector<Dim> place = model.origin + body.reference, force = body.mass * acceleration;
    ForcePlan plan;
    plan.name = fmt::format("load {}", b);
    plan.bodies.inside = std::vector<double>(place.begin(), place.end());
    plan.force = std::vector<double>(force.begin(), force.end());
    forces.push_back(std::move(plan));
  }
  return forces;
}

// what a decision's runs begin with, from the values of the answer; none: nothing to decide between
std::optional<std::pair<double, double>> between(const LimitAnswer& answer, const char* least, const char* most) {
  std::optional<double> from, to;
  for (const auto& [name, value] : answer.values) {
    if (name.ends_with(least)) from = value.value;
    if (name.ends_with(most)) to = value.value;
  }
  if (!from) return {};
  return std::pair(*from, to.value_or(*from + std::max(1.0, std::abs(*from))));
}

template <int Dim>
void decide(const Prepared<Dim>& scene, const LimitRequest& request, const LiveLoad<Dim>* live,
            const StagePlan* analysed, LimitAnalysis<Dim>& analysis) {
  Decision found;
  if (live) {
    const auto ends = between(analysis, "_least", "_upper_bound");
    if (!ends) return;
    const bool of_gravity = request.load->kind == LimitLoad::Kind::gravity;
    const std::vector<ForcePlan> forces = of_gravity ? std::vector<ForcePlan>()
                                          : analysed ? analysed->change.force
                                                     : forces_of(analysis.model, live->load.acceleration);
    found = decide_factor(scene, request, forces, ends->first, ends->second);
  } else {
    const auto ends =
        request.factor ? between(analysis, "_least", "_upper_bound") : between(analysis, "_largest", "_lower_bound");
    if (!ends) return;
    const double unit = request.factor ? 1 : degree;
    found = decide_strength(scene, request, unit * ends->first, unit * ends->second);
  }
  tell_decision(request, found, analysis);
}

bool dilates_only(const LimitRequest& request, const std::vector<JointProperties>& properties) {
  return request.with_dilation || follows_envelopes(properties);
}

template <int Dim>
void seek_factor_without_dilation(const LimitRequest& request, const LiveLoad<Dim>& live, const Loads<Dim>& dead,
                                  LimitAnalysis<Dim>& analysis) {
  FactorWithoutDilation<Dim> found =
      find_factor_without_dilation(analysis.assembly, dead, loads_of(analysis.model, live.load), request.after_round);
  tell_factor_ends(found, analysis);
  keep_mechanism(std::move(found.state), analysis);
}

template <int Dim>
void seek_factor(const LimitRequest& request, const LiveLoad<Dim>& live, const LoadParts<Dim>& gravity,
                 LimitAnalysis<Dim>& analysis) {
  analysis.sought = live.sought;
  const LoadParts<Dim> dead = live.beside_gravity ? gravity : LoadParts<Dim>{};
  LoadFactor<Dim> found =
      find_load_factor(analysis.assembly, loads_of(analysis.model, dead), loads_of(analysis.model, live.load));
  if (request.proof) analysis.proof = prove_bounds(analysis.model, analysis.assembly, dead, live.load, found);
  analysis.state = std::move(found.state);
  analysis.evidence = found.evidence;
  tell_load_factor(found.status, found.factor, "cone program", live.if_any, analysis);
  analysis.answered = found.status == LimitStatus::found;
  if (found.status == LimitStatus::carries_any && live.beside_gravity) analysis.caveats.push_back(pressed_caveat);
  if (dilates_only(request, analysis.model.properties)) return warn_of_self_stress(found.self_stress, analysis);
  if (found.status == LimitStatus::found || found.status == LimitStatus::carries_any)
    seek_factor_without_dilation(request, live, loads_of(analysis.model, dead), analysis);
}

template <int Dim>
void seek_strength(const LimitRequest& request, const Loads<Dim>& gravity, LimitAnalysis<Dim>& analysis) {
  const char* const rule = "bracket by cone programs";
  refuse_unknown_properties(request, analysis.model.properties);
  const std::vector<bool> chosen = faces_of(analysis.assembly, request.properties);
  const CriticalStrength<Dim> dilating = request.factor ? find_factor_of_safety(analysis.assembly, gravity, chosen)
                                                        : find_critical_friction(analysis.assembly, gravity, chosen);
  analysis.state = dilating.state;
  const bool cohesive =
      std::ranges::any_of(analysis.assembly.faces, [](const CornerFace<Dim>& face) { return face.cohesion > 0; });
  request.factor ? tell_factor_of_safety(request, dilating, cohesive, rule, analysis)
                 : tell_friction(request, dilating, rule, analysis);
  analysis.answered = dilating.status == LimitStatus::found || dilating.status == LimitStatus::carries_any;
  if (dilates_only(request, analysis.model.properties)) return warn_of_self_stress(dilating.self_stress, analysis);
  const bool sought = dilating.status == LimitStatus::found && std::isfinite(dilating.collapses);
  if (!sought && dilating.status != LimitStatus::not_attained) return;
  StrengthWithoutDilation<Dim> found =
      request.factor
          ? find_factor_of_safety_without_dilation(analysis.assembly, gravity, chosen, dilating, request.after_round)
          : find_critical_friction_without_dilation(analysis.assembly, gravity, chosen, dilating, request.after_round);
  tell_strength_ends(request, found, analysis);
  keep_mechanism(std::move(found.state), analysis);
}

// Forces at corners resist a turn about a face's normal at its largest radius; a spread pressure resists it less.
void warn_of_twist(LimitAnalysis<3>& analysis) {
  if (analysis.state.velocities.empty()) return;
  int count = 0;
  std::string first;
  for (const CornerFace<3>& face : analysis.assembly.faces) {
    Vector<3> mean = Vector<3>::Zero();
    for (const Vector<3>& corner : face.corners)
      mean += corner / static_cast<double>(face.corners.size());
    double radius = 0, slip = 0;
    for (const Vector<3>& corner : face.corners) {
      radius = std::max(radius, (corner - mean).norm());
      slip = std::max(slip, opening_at(analysis.assembly, face, corner, analysis.state.velocities).norm());
    }
    const double turn =
        std::abs((analysis.state.velocities[face.body_b].spin - analysis.state.velocities[face.body_a].spin)
                     .dot(face.normal)) *
        radius;
    if (slip <= still || turn <= twists * slip) continue;
    if (count++ == 0) first = fmt::format("{} and {}", face.body_a, face.body_b);
  }
  if (count > 0)
    analysis.caveats.push_back(
        fmt::format("{} in the mechanism (the first: of blocks {}): the pressure on such a face is not determined, and "
                    "forces at its corners carry up to 1.85 times what a uniform one does",
                    count == 1 ? "a face twists" : fmt::format("{} faces twist", count), first));
}

void warn_of_twist(const LimitAnalysis<2>&) {}

template <int Dim>
void tie_bolts(const LimitRequest& request, LimitAnalysis<Dim>& analysis) {
  std::vector<CornerTie<Dim>>& ties = analysis.assembly.ties;
  ties = ties_of(analysis.model);
  if (analysis.model.bolts.empty()) return;
  if (request.proof)
    throw BadInput(
        "--proof: the scene has bolts, whose forces are not part of a proof; leave out --proof, or [[bolts]] and "
        "install");
  if (ties.empty()) {
    analysis.warnings.push_back("none of the scene's bolts crosses a joint between blocks: they are left out");
    return;
  }
  analysis.caveats.push_back(
      "bolts act up to their yield, however far they stretch, from the beginning, whichever stage installs them");
  const auto endless = [](const BoltProperties& p) { return p.dowel_stiffness > 0 && !p.dowel_strength; };
  if (std::ranges::any_of(analysis.model.bolt_properties, endless))
    analysis.warnings.push_back("bolts without dowel_strength resist no shear here");
}

// water grows with the factor of gravity, as in a run
template <int Dim>
LoadParts<Dim> gravity_and_water(const Model<Dim>& model) {
  LoadParts<Dim> parts{model.gravity, {}, {}};
  if (!model.waters.empty()) parts.waters = water_loads_at_reference<Dim>(model);
  return parts;
}

}  // namespace

template <int Dim>
LimitAnalysis<Dim> analyse_limit(const LoadedScene& scene, const LimitRequest& request) {
  const Prepared<Dim>& prepared = std::get<Prepared<Dim>>(scene.prepared);
  refuse_what_limit_leaves_out(prepared);
  LimitAnalysis<Dim> analysis;
  analysis.title = scene.title;
  analysis.input_hash = scene.hash;
  analysis.model = prepared.model;
  const Model<Dim>& model = analysis.model;
  analysis.caveats = {dilates_only(request, model.properties) ? dilating_caveat : history_caveat};
  if (!request.with_dilation && follows_envelopes(model.properties))
    analysis.warnings.push_back(
        "joints after Barton and Bandis: their envelope is followed for joints that dilate by its slope only; the "
        "result is a bound on the unsafe side");
  const StagePlan* analysed = stage_of_forces(prepared.stages, request);
  analysis.bound = request.load || request.factor
                       ? "the upper bound is of joints that dilate as they slip, by their friction angle: joints that "
                         "do not carry no more, and may carry far less"
                       : "the lower bound is of joints that dilate as they slip, by their friction angle: joints that "
                         "do not need as much friction or more";
  const LoadParts<Dim> parts_of_gravity = gravity_and_water(model);
  const Loads<Dim> gravity = loads_of(model, parts_of_gravity);
  std::optional<LiveLoad<Dim>> live;
  if (request.load) live = live_load(*request.load, model, parts_of_gravity, analysed);
  double acceleration = acceleration_of(model, gravity);
  if (acceleration == 0 && live) acceleration = acceleration_of(model, loads_of(model, live->load));
  analysis.assembly = corner_assembly(model, acceleration > 0 ? acceleration : 1, request.cohesion);

  tie_bolts(request, analysis);

  std::vector<bool> touched(model.bodies.size()), cohesive(model.properties.size());
  for (const CornerFace<Dim>& face : analysis.assembly.faces) {
    touched[face.body_a] = touched[face.body_b] = true;
    if (face.cohesion > 0) cohesive[face.properties] = true;
  }
  warn_of_unsupported(model, touched, analysis.warnings);
  warn_of_strengths(model.properties, cohesive, analysis.warnings);
  warn_of_changes(prepared.stages, analysed, analysis.warnings);

  try {
    if (live)
      seek_factor(request, *live, parts_of_gravity, analysis);
    else
      seek_strength(request, gravity, analysis);
    if (request.decide) decide(prepared, request, live ? &*live : nullptr, analysed, analysis);
  } catch (const StopRounds&) {
    analysis.answered = false;
    analysis.caveats = {dilating_caveat, "interrupted: the answer without dilation was not found"};
  }
  tell_envelope(analysis);
  refuse_empty(analysis, model.gravity.isZero(0), analysed);
  if (analysis.status == LimitStatus::solver_failed)
    analysis.message =
        "a cone program lost its digits before its bounds met; blocks of very different size are the "
        "usual cause";
  analysis.mechanism = describe_mechanism(model, analysis.state.velocities);
  warn_of_twist(analysis);
  return analysis;
}

template LimitAnalysis<2> analyse_limit(const LoadedScene&, const LimitRequest&);
template LimitAnalysis<3> analyse_limit(const LoadedScene&, const LimitRequest&);

}  // namespace voussoir
