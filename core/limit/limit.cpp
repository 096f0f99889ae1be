#include "core/limit/limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/limit/follow_envelope.hpp"
#include "core/limit/self_stress.hpp"
#include "core/limit/shortfall.hpp"
#include "core/limit/strength.hpp"

namespace voussoir {
namespace {

constexpr double most_of_weight = 1e6;  // a structure that supports more supports any load
constexpr double newton_doubt = 0.15;   // times the square of a step: how far its end may be from the root
constexpr double farther = 4;           // from a predicted root at every trial that stands
constexpr double force_of_jams = 1e4;   // of the lighter body's weight: forces that no load alone requires
constexpr double doubt_of_jams = 10;    // tolerances: nearer to the critical strength their forces exceed all digits
constexpr double stronger = 1.01;       // of the strength: where self-stress is sought

template <int Dim>
bool nothing_free(const CornerAssembly<Dim>& assembly) {
  return std::ranges::none_of(assembly.bodies, &CornerBody<Dim>::moves);
}

// The bracket is closed by Newton's method on what is missing, from the collapsing side: to either side of the root
// that it predicts, by halves where that leads out of the bracket or gains too little.
template <int Dim>
CriticalStrength<Dim> bracket_strength(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                       const Strength<Dim>& strength) {
  CriticalStrength<Dim> result;
  if (nothing_free(assembly)) return result.status = LimitStatus::nothing_free, result;
  if (std::ranges::all_of(loads, [](const Load<Dim>& load) { return load.force.isZero(0) && load.moment.isZero(0); }))
    return result.status = LimitStatus::no_load, result;

  CornerAssembly<Dim> trial = assembly;
  const auto at = [&](double measure) {
    strength.weaken(measure, trial);
    ++result.evidence.programs;
    return shortfall(trial, corner_program(trial, loads));
  };
  double doubt = 0, pressing = 0;  // of the last trial that stood
  const auto keep_standing = [&](double measure, const Shortfall& found) {
    result.stands = measure;
    doubt = found.doubt;
    pressing = found.answer.x.size() ? found.answer.x.maxCoeff() : 0;
    result.state.forces = corner_forces(trial, found.answer.x);
    result.state.tensions = tensions(trial, found.answer.x);
    result.evidence.out_of_balance = out_of_balance<Dim>(corner_program(trial, loads), found.answer.x);
  };
  double root = 0, slope = 0;  // where Newton's method expects it, from the last trial that collapsed
  const auto keep_collapsing = [&](double measure, const Shortfall& found) {
    result.collapses = measure;
    result.missing = found.answer.bound;
    result.state.velocities = mechanism_of(trial, found.answer.y);
    result.evidence.gap = std::abs(found.answer.value - found.answer.bound);
    result.evidence.inadmissible = found.answer.inadmissible;
    slope = strength.slope(measure, sensitivity_of(trial, found.answer));
    root = slope < 0 ? measure - found.answer.bound / slope : measure;
  };

  const Shortfall weak = at(0);
  if (weak.failed()) return result.status = LimitStatus::solver_failed, result;
  if (weak.stands()) {
    keep_standing(0, weak);
    return result.status = LimitStatus::carries_any, result;
  }
  keep_collapsing(0, weak);
  const double first_root = root;
  const Shortfall strong = at(strength.strongest);
  if (strong.failed()) return result.status = LimitStatus::solver_failed, result;
  if (!strong.stands()) {
    keep_collapsing(strength.strongest, strong);
    return result.status = LimitStatus::carries_nothing, result;
  }
  keep_standing(strength.strongest, strong);
  root = first_root;

  int stood = 0;  // trials, since one collapsed: the root is then lower than predicted
  bool asked = false;
  const auto is_jammed = [&] {
    if (asked) return false;
    asked = true;
    strength.weaken(0, trial);
    return carried_by_any_friction(trial, loads, strength.chosen);
  };
  while (result.stands - result.collapses > strength.tolerance) {
    if (pressing > force_of_jams && is_jammed()) return result.status = LimitStatus::not_attained, result;
    const double step = root - result.collapses, aside = 0.3 * strength.tolerance + newton_doubt * step * step;
    double next = stood == 0 ? root + aside : root - std::pow(farther, stood - 1) * aside;
    if (!(next > result.collapses && next < result.stands)) next = 0.5 * (result.collapses + result.stands);
    const Shortfall found = at(next);
    if (found.failed()) {  // near the critical strength of jammed blocks
      if (is_jammed()) return result.status = LimitStatus::not_attained, result;
      if (result.stands > stronger * result.collapses) result.status = LimitStatus::solver_failed;
      break;
    }
    if (found.stands()) {
      ++stood;
      keep_standing(next, found);
    } else {
      stood = 0;
      keep_collapsing(next, found);
    }
  }
  // a force too small to be told from rounding may be missing there
  if (slope < 0) result.stands = std::min(strength.strongest, result.stands - doubt / slope);
  return result;
}

template <int Dim>
LoadFactor<Dim> find_straight_load_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead,
                                          const Loads<Dim>& live) {
  LoadFactor<Dim> result;
  if (nothing_free(assembly)) return result.status = LimitStatus::nothing_free, result;
  CornerProgram<Dim> program = corner_program(assembly, dead, live);
  const double largest = program.live.cwiseAbs().maxCoeff();  // of a body's weight
  if (largest == 0) return result.status = LimitStatus::no_load, result;
  program.live /= largest;

  // the dead load first: if it is not supported there is no factor
  if (!program.right_side.isZero(0)) {
    const Shortfall found = shortfall(assembly, corner_program(assembly, dead));
    ++result.evidence.programs;
    if (found.failed()) return result.status = LimitStatus::solver_failed, result;
    if (!found.stands()) {
      result.status = LimitStatus::carries_nothing;
      result.state.velocities = mechanism_of(assembly, found.answer.y);
      return result;
    }
  }
  // Without dead load and cohesion forces and load grow together: all multiples are supported, or none.
  const bool grows =
      program.right_side.isZero(0) && assembly.ties.empty() &&
      std::ranges::none_of(assembly.faces, [](const CornerFace<Dim>& face) { return face.cohesion > 0; });
  const Shortfall lacking = grows ? shortfall(assembly, corner_program(assembly, live)) : Shortfall{solve(program)};
  const ConeProgramAnswer& answer = lacking.answer;
  ++result.evidence.programs;
  if (answer.status == ConeStatus::stalled || answer.status == ConeStatus::infeasible)
    return result.status = LimitStatus::solver_failed, result;
  const bool nothing = grows && !lacking.stands();
  if (!nothing && (grows || answer.status == ConeStatus::unbounded || answer.factor >= most_of_weight))
    result.status = LimitStatus::carries_any;
  else if (!nothing)
    result.factor = std::max(0.0, answer.factor / largest);
  if (!nothing) {
    result.state.forces = corner_forces(assembly, answer.x);
    result.state.tensions = tensions(assembly, answer.x);
  }
  if (result.status == LimitStatus::found) result.state.velocities = mechanism_of(assembly, answer.y);
  result.state.velocities.resize(assembly.bodies.size());
  if (result.status != LimitStatus::found) return result;
  result.evidence.gap = answer.gap;
  result.evidence.out_of_balance = out_of_balance<Dim>(program, answer.x, answer.factor);
  result.evidence.inadmissible = answer.inadmissible;
  if (nothing) return result;
  constexpr double nearly = 0.99;  // of the factor
  Loads<Dim> loads = dead;
  for (std::size_t b = 0; b < loads.size(); ++b) {
    loads[b].force += nearly * result.factor * live[b].force;
    loads[b].moment += nearly * result.factor * live[b].moment;
  }
  result.self_stress = may_rest_on_self_stress(assembly, loads, result.state.velocities);
  return result;
}

// and whether it depends on self-stress
template <int Dim>
CriticalStrength<Dim> find_strength(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                    const Strength<Dim>& strength) {
  CriticalStrength<Dim> found = bracket_strength(assembly, loads, strength);
  if (found.status != LimitStatus::found && found.status != LimitStatus::carries_any) return found;
  CornerAssembly<Dim> trial = assembly;
  strength.weaken(std::min(strength.strongest, stronger * found.stands), trial);
  found.self_stress = may_rest_on_self_stress(trial, loads, found.state.velocities);
  if (!found.self_stress.empty()) found.collapses = std::max(0.0, found.collapses - doubt_of_jams * strength.tolerance);
  return found;
}

template <int Dim>
CriticalStrength<Dim> find_straight_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                           const std::vector<bool>& chosen) {
  CriticalStrength<Dim> found = find_strength(assembly, loads, remaining_strength(assembly, chosen));
  found.collapses = factor_at(found.collapses);
  found.stands = factor_at(found.stands);
  return found;
}

// for FollowEnvelope
template <int Dim>
struct RoughCorners {
  const CornerAssembly<Dim>& assembly;
  const std::vector<CornerFace<Dim>>& faces = assembly.faces;
  const std::vector<JointProperties>& properties = assembly.properties;

  double weight_on(const CornerFace<Dim>& face) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int body : {face.body_a, face.body_b})
      if (assembly.bodies[body].moves()) least = std::min(least, assembly.bodies[body].weight);
    return least;
  }
  static double area_of(const CornerFace<Dim>& face) { return face.area(); }

  FaceResultant force_on(const CornerForces<Dim>& forces, std::size_t f) const {
    FaceResultant sum;
    for (const Vector<Dim>& force : forces[f]) {
      const double normal = force.dot(faces[f].normal);
      sum.normal += normal;
      sum.shear += (force - normal * faces[f].normal).norm();
    }
    return sum;
  }
  static CornerForces<Dim> mix(CornerForces<Dim> a, const CornerForces<Dim>& b, double share) {
    for (std::size_t f = 0; f < a.size(); ++f)
      for (std::size_t k = 0; k < a[f].size(); ++k)
        a[f][k] += share * (b[f][k] - a[f][k]);
    return a;
  }

  // `find` of an assembly, for its faces
  auto on_faces(const auto& find) const {
    return [this, find](const std::vector<CornerFace<Dim>>& straight) {
      CornerAssembly<Dim> trial = assembly;
      trial.faces = straight;
      return find(trial);
    };
  }
};

}  // namespace

template <int Dim>
Loads<Dim> loads_of_acceleration(const Model<Dim>& model, const Vector<Dim>& acceleration) {
  Loads<Dim> loads(model.bodies.size());
  for (std::size_t b = 0; b < loads.size(); ++b)
    if (model.bodies[b].present) loads[b].force = model.bodies[b].mass * acceleration;
  return loads;
}

template <int Dim>
Loads<Dim> loads_of_applied_forces(const Model<Dim>& model, const std::vector<AppliedForce<Dim>>& forces) {
  Loads<Dim> loads(model.bodies.size());
  for (const AppliedForce<Dim>& f : forces)
    loads[f.body] += load_of<Dim>({f.place, f.force}, Matrix<Dim>::Identity());
  return loads;
}

template <int Dim>
double acceleration_of(const Model<Dim>& model, const Loads<Dim>& loads) {
  double largest = 0;
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    largest =
        std::max({largest, loads[b].force.norm() / body.mass, loads[b].moment.norm() / (body.mass * body.radius)});
  }
  return largest;
}

template <int Dim>
LoadFactor<Dim> find_load_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live) {
  const RoughCorners<Dim> rough{assembly};
  return FollowEnvelope(rough).repeat(
      rough.on_faces([&](const CornerAssembly<Dim>& trial) { return find_straight_load_factor(trial, dead, live); }),
      [](const LoadFactor<Dim>& found) { return found.factor; });
}

template <int Dim>
CriticalStrength<Dim> find_critical_friction(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                             const std::vector<bool>& chosen) {
  const Strength<Dim> strength = friction_of<Dim>(chosen);
  const RoughCorners<Dim> rough{assembly};
  return FollowEnvelope(rough).repeat(
      rough.on_faces([&](const CornerAssembly<Dim>& trial) { return find_strength(trial, loads, strength); }),
      [](const CriticalStrength<Dim>& found) { return found.stands; });
}

template <int Dim>
CriticalStrength<Dim> find_factor_of_safety(const CornerAssembly<Dim>& assembly, const Loads<Dim>& loads,
                                            const std::vector<bool>& chosen) {
  const RoughCorners<Dim> rough{assembly};
  return FollowEnvelope(rough).factor(
      rough.on_faces([&](const CornerAssembly<Dim>& trial) { return find_straight_factor(trial, loads, chosen); }),
      chosen);
}

template <int Dim>
std::vector<bool> faces_of(const CornerAssembly<Dim>& assembly, const std::vector<std::string>& properties) {
  std::vector<bool> named(assembly.properties.size(), properties.empty()), chosen;
  for (const std::string& name : properties) {
    const auto at = std::ranges::find(assembly.properties, name, &JointProperties::name);
    if (at == assembly.properties.end()) throw std::out_of_range(name);
    named[at - assembly.properties.begin()] = true;
  }
  for (const CornerFace<Dim>& face : assembly.faces)
    chosen.push_back(properties.empty() || named[face.properties]);
  return chosen;
}

template Loads<2> loads_of_acceleration(const Model<2>&, const Vector<2>&);
template Loads<2> loads_of_applied_forces(const Model<2>&, const std::vector<AppliedForce<2>>&);
template double acceleration_of(const Model<2>&, const Loads<2>&);
template LoadFactor<2> find_load_factor(const CornerAssembly<2>&, const Loads<2>&, const Loads<2>&);
template CriticalStrength<2> find_critical_friction(const CornerAssembly<2>&, const Loads<2>&,
                                                    const std::vector<bool>&);
template CriticalStrength<2> find_factor_of_safety(const CornerAssembly<2>&, const Loads<2>&, const std::vector<bool>&);
template std::vector<bool> faces_of(const CornerAssembly<2>&, const std::vector<std::string>&);
template Loads<3> loads_of_acceleration(const Model<3>&, const Vector<3>&);
template Loads<3> loads_of_applied_forces(const Model<3>&, const std::vector<AppliedForce<3>>&);
template double acceleration_of(const Model<3>&, const Loads<3>&);
template LoadFactor<3> find_load_factor(const CornerAssembly<3>&, const Loads<3>&, const Loads<3>&);
template CriticalStrength<3> find_critical_friction(const CornerAssembly<3>&, const Loads<3>&,
                                                    const std::vector<bool>&);
template CriticalStrength<3> find_factor_of_safety(const CornerAssembly<3>&, const Loads<3>&, const std::vector<bool>&);
template std::vector<bool> faces_of(const CornerAssembly<3>&, const std::vector<std::string>&);

}  // namespace voussoir
