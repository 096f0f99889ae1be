#include "app/limit/limit_space.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/limit/limit_words.hpp"
#include "core/base/bad_input.hpp"
#include "core/limit/without_dilation.hpp"
#include "core/model/water_surfaces.hpp"

namespace voussoir {
namespace {

using LoadsInSpace = std::vector<Load<3>>;

const char* const dilating_caveat =
    "associated flow: forces and mechanism enclose the strength of joints that dilate as they slip; of joints that do "
    "not it is an upper bound, often several degrees or tens of percent unsafe, without bound where blocks are held by "
    "their sides; confirm it with 'voussoir run'";
const char* const pressed_caveat =
    "carried by self-stress, normal forces between blocks that the loads do not ask for: without dilation nothing "
    "says that they are there; confirm it with 'voussoir run'";

constexpr double still = 1e-6;   // of the fastest block
constexpr double twists = 1e-3;  // turning about a face's normal over its slip

LoadsInSpace of_acceleration(const Model<3>& model, const Vector<3>& acceleration) {
  LoadsInSpace loads(model.bodies.size());
  for (std::size_t b = 0; b < loads.size(); ++b)
    if (model.bodies[b].present) loads[b].force = model.bodies[b].mass * acceleration;
  return loads;
}

LoadsInSpace of_applied_forces(const Model<3>& model) {
  LoadsInSpace loads(model.bodies.size());
  for (const AppliedForce<3>& f : model.applied)
    loads[f.body] += load_of<3>({f.place, f.force}, Matrix<3>::Identity());
  return loads;
}

// the load whose factor is sought
struct LiveLoadInSpace {
  std::string sought, if_any;
  LoadsInSpace loads;
  bool beside_gravity = true;
};

LiveLoadInSpace live_load_in_space(LimitLoad load, const Model<3>& model, const LoadsInSpace& gravity,
                                   const StagePlan* analysed) {
  const std::string& name = limit_loads[static_cast<std::size_t>(load)];
  if (load == LimitLoad::gravity) return {sought_of_gravity, any_gravity, gravity, false};
  if (load == LimitLoad::applied) {
    Change forces;
    forces.force = analysed->change.force;
    return {sought_of_applied(*analysed), any_applied, of_applied_forces(apply(model, forces)), true};
  }
  if (load == LimitLoad::left || load == LimitLoad::right)
    throw BadInput(fmt::format(
        "--load {}: the scene has dimension = 3; state gravity, applied, east, west, north, south, up or down", name));
  const Vector<3> towards = load == LimitLoad::east    ? Vector<3>(1, 0, 0)
                            : load == LimitLoad::west  ? Vector<3>(-1, 0, 0)
                            : load == LimitLoad::north ? Vector<3>(0, 1, 0)
                            : load == LimitLoad::south ? Vector<3>(0, -1, 0)
                            : load == LimitLoad::up    ? Vector<3>(0, 0, 1)
                                                       : Vector<3>(0, 0, -1);
  const bool upright = load == LimitLoad::up || load == LimitLoad::down;
  return {fmt::format("{} at collapse, as a fraction of gravity",
                      upright ? "acceleration " + name : "horizontal acceleration to the " + name),
          "it presses the blocks against fixed ones, or wedges them there",
          of_acceleration(model, towards * model.gravity.norm()), true};
}

void seek_factor_in_space(const LiveLoadInSpace& live, const LoadsInSpace& gravity, LimitAnalysisInSpace& analysis) {
  analysis.sought = live.sought;
  LoadFactorInSpace found =
      find_load_factor(analysis.assembly, live.beside_gravity ? gravity : LoadsInSpace(gravity.size()), live.loads);
  analysis.state = std::move(found.state);
  analysis.evidence = found.evidence;
  tell_load_factor(found.status, found.factor, "cone program", live.if_any, analysis);
  if (found.status == LimitStatus::carries_any && live.beside_gravity) analysis.caveats.push_back(pressed_caveat);
}

void refuse_envelopes(const Model<3>& model) {
  for (const JointProperties& p : model.properties)
    if (p.follows_barton_bandis())
      throw BadInput(
          fmt::format("--without-dilation: joint_properties '{}' follow Barton and Bandis' envelope, which is followed "
                      "with dilation only; leave out --without-dilation",
                      p.name));
}

// of the same load: what forces that agree with a mechanism without dilation carry
void seek_factor_without_dilation(const LiveLoadInSpace& live, const LoadsInSpace& gravity,
                                  LimitAnalysisInSpace& analysis) {
  const FactorWithoutDilation found = find_factor_without_dilation(
      analysis.assembly, live.beside_gravity ? gravity : LoadsInSpace(gravity.size()), live.loads);
  analysis.evidence.programs += found.programs;
  if (found.status == LimitStatus::carries_any)
    return analysis.caveats.push_back("without dilation: normal forces alone, without friction, carry any factor");
  if (found.status != LimitStatus::found)
    return analysis.caveats.push_back("without dilation: no mechanism was found, as forces grow without bound");
  const auto add = [&](const char* name, const EndOfFactor& end) {
    const std::optional<double> bar = found.settled ? std::optional(end.error) : std::nullopt;
    analysis.values.emplace_back(name, Value{end.factor, "1", bar, "joints that slip without opening"});
  };
  add("collapse_factor_least", found.least);
  if (!found.unbounded) add("collapse_factor_largest", found.largest);
  analysis.caveats.push_back(fmt::format(
      "without dilation: of the lowest mechanism that was found, in {} rounds from loose joints; nothing proves that "
      "there is no lower one{}",
      found.rounds, found.settled ? "" : ", and its slips did not settle: take the numbers as estimates"));
  if (found.unbounded)
    analysis.caveats.push_back(
        "without dilation: no factor is the largest, as normal forces between blocks that the loads do not ask for may "
        "hold any load");
  else if (found.largest.factor - found.least.factor > found.largest.error + found.least.error)
    analysis.caveats.push_back(
        "without dilation: from the least to the largest factor blocks are held by forces that the loads do not ask "
        "for. Of columns held by their sides the least was right, of toppling slopes the largest; confirm it with "
        "'voussoir run'");
  if (found.least.factor < 0)
    analysis.caveats.push_back(
        "without dilation: a negative factor means that gravity alone brings blocks down, unless such forces hold "
        "them");
}

void seek_strength_in_space(const LimitRequest& request, const LoadsInSpace& gravity, LimitAnalysisInSpace& analysis) {
  const char* const rule = "bracket by cone programs";
  refuse_unknown_properties(request, analysis.model.properties);
  std::vector<bool> chosen;
  for (const CornerFace& face : analysis.assembly.faces)
    chosen.push_back(request.properties.empty() ||
                     std::ranges::find(request.properties, analysis.model.properties[face.properties].name) !=
                         request.properties.end());
  CriticalStrengthInSpace found = request.factor ? find_factor_of_safety(analysis.assembly, gravity, chosen)
                                                 : find_critical_friction(analysis.assembly, gravity, chosen);
  analysis.state = std::move(found.state);
  if (request.factor)
    tell_factor_of_safety(
        request, found,
        std::ranges::any_of(analysis.assembly.faces, [](const CornerFace& f) { return f.cohesion > 0; }), rule,
        analysis);
  else
    tell_friction(request, found, rule, analysis);
}

void describe_motion(LimitAnalysisInSpace& analysis) {
  for (std::size_t b = 0; b < analysis.state.velocities.size(); ++b) {
    const MotionInSpace& motion = analysis.state.velocities[b];
    const BlockMotionInSpace of{static_cast<int>(b), motion.velocity.norm(),
                                analysis.assembly.bodies[b].radius * motion.spin.norm()};
    if (of.speed + of.turning <= still) continue;
    analysis.moving.push_back(of);
    analysis.turning += of.turning > still * (of.speed + of.turning);
  }
}

// Forces at corners resist a turn about a face's normal at its largest radius; a spread pressure resists it less.
void warn_of_twist(LimitAnalysisInSpace& analysis) {
  if (analysis.state.velocities.empty()) return;
  int count = 0;
  std::string first;
  for (const CornerFace& face : analysis.assembly.faces) {
    const auto speed_at = [&](int body, const Vector<3>& place) -> Vector<3> {
      const MotionInSpace& motion = analysis.state.velocities[body];
      return motion.velocity + motion.spin.cross(place - analysis.assembly.bodies[body].centroid);
    };
    Vector<3> mean = Vector<3>::Zero();
    for (const Vector<3>& corner : face.corners)
      mean += corner / static_cast<double>(face.corners.size());
    double radius = 0, slip = 0;
    for (const Vector<3>& corner : face.corners) {
      radius = std::max(radius, (corner - mean).norm());
      slip = std::max(slip, (speed_at(face.body_b, corner) - speed_at(face.body_a, corner)).norm());
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

}  // namespace

LimitAnalysisInSpace analyse_limit_in_space(const LoadedScene& scene, const LimitRequest& request) {
  const Prepared<3>& prepared = std::get<Prepared<3>>(scene.prepared);
  refuse_what_limit_leaves_out(prepared);
  LimitAnalysisInSpace analysis;
  analysis.caveats = {dilating_caveat};
  analysis.title = scene.title;
  analysis.input_hash = scene.hash;
  analysis.model = prepared.model;
  const Model<3>& model = analysis.model;
  if (request.without_dilation) refuse_envelopes(model);
  const StagePlan* analysed = stage_of_forces(prepared.stages, request);

  // water grows with the factor of gravity, as in a run
  LoadsInSpace gravity = of_acceleration(model, model.gravity);
  if (!model.waters.empty()) {
    const LoadsInSpace water = water_loads_at_reference<3>(model);
    for (std::size_t b = 0; b < gravity.size(); ++b)
      gravity[b] += water[b];
  }
  analysis.bound = request.load || request.factor
                       ? "upper bound: joints that do not dilate as they slip carry no more, and may carry far less"
                       : "lower bound: joints that do not dilate as they slip need as much friction or more";
  std::optional<LiveLoadInSpace> live;
  if (request.load) live = live_load_in_space(*request.load, model, gravity, analysed);
  double acceleration = acceleration_of(model, gravity);
  if (acceleration == 0 && live) acceleration = acceleration_of(model, live->loads);
  analysis.assembly = corner_assembly(model, acceleration > 0 ? acceleration : 1, request.cohesion);

  std::vector<bool> touched(model.bodies.size()), cohesive(model.properties.size());
  for (const CornerFace& face : analysis.assembly.faces) {
    touched[face.body_a] = touched[face.body_b] = true;
    if (face.cohesion > 0) cohesive[face.properties] = true;
  }
  warn_of_unsupported(model, touched, analysis.warnings);
  warn_of_strengths(model.properties, cohesive, analysis.warnings);
  warn_of_changes(prepared.stages, analysed, analysis.warnings);

  if (live)
    seek_factor_in_space(*live, gravity, analysis);
  else
    seek_strength_in_space(request, gravity, analysis);
  const bool empty = analysis.status == LimitStatus::nothing_free || analysis.status == LimitStatus::no_load;
  if (request.without_dilation && !empty) seek_factor_without_dilation(*live, gravity, analysis);
  tell_envelope(analysis);
  refuse_empty(analysis, model.gravity.isZero(0), analysed);
  if (analysis.status == LimitStatus::solver_failed)
    analysis.message =
        "a cone program lost its digits before its bounds met; blocks of very different size are the "
        "usual cause";
  analysis.answered =
      analysis.status == LimitStatus::found || (!request.load && analysis.status == LimitStatus::carries_any);
  describe_motion(analysis);
  warn_of_twist(analysis);
  return analysis;
}

}  // namespace voussoir
