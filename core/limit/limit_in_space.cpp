#include "core/limit/limit_in_space.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/limit/follow_envelope.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double most_of_weight = 1e6;             // a structure that supports more supports any load
constexpr double roughest = 89 * degree;           // beyond it a cone is a half-space
constexpr double angle_tolerance = 3e-6 * degree;  // width of the bracket
constexpr double most_strength = 1000.0 / 1001;    // of s/(1 + s), s the part of the strength that is left
constexpr double strength_tolerance = 5e-8;
constexpr double newton_doubt = 0.15;   // times the square of a step: how far its end may be from the root
constexpr double farther = 4;           // from a predicted root at every trial that stands
constexpr double noise = 3;             // times the program's errors: below it nothing is missing
constexpr double least_missing = 3e-9;  // of a body's weight
constexpr double nothing_left =
    100;  // tolerances: strength that is as good as none, as forces grow without bound towards it

struct Shortfall {
  ConeProgramAnswer answer;
  bool failed() const { return answer.status != ConeStatus::optimal; }
  bool stands() const { return !(answer.bound > least_missing + noise * answer.error()); }
};

Shortfall shortfall(const CornerAssembly& assembly, const std::vector<Load<3>>& loads) {
  CornerProgram program = corner_program(assembly, loads);
  add_missing_forces(assembly, program);
  return {solve(program)};
}

bool nothing_free(const CornerAssembly& assembly) {
  return std::ranges::none_of(assembly.bodies, [](const CornerBody& body) {
    return std::ranges::any_of(body.free, [](bool free) { return free; });
  });
}

// a measure of strength from 0 up, and its use by faces
struct Strength {
  double strongest, tolerance;
  std::function<void(double at, CornerAssembly& trial)> weaken;
  // the change of what is missing with the measure
  std::function<double(double at, const std::vector<Sensitivity>& of_faces)> slope;
};

// The bracket is closed by Newton's method on what is missing, from the collapsing side: to either side of the root
// that it predicts, by halves where that leads out of the bracket or gains too little.
CriticalStrengthInSpace find_strength_in_space(const CornerAssembly& assembly, const std::vector<Load<3>>& loads,
                                               const Strength& strength) {
  CriticalStrengthInSpace result;
  if (nothing_free(assembly)) return result.status = LimitStatus::nothing_free, result;
  if (std::ranges::all_of(loads, [](const Load<3>& load) { return load.force.isZero(0) && load.moment.isZero(0); }))
    return result.status = LimitStatus::no_load, result;

  CornerAssembly trial = assembly;
  const auto at = [&](double measure) {
    strength.weaken(measure, trial);
    ++result.evidence.programs;
    return shortfall(trial, loads);
  };
  const auto keep_standing = [&](double measure, const Shortfall& found) {
    result.stands = measure;
    result.state.forces = corner_forces(trial, found.answer.x);
    result.evidence.out_of_balance = found.answer.out_of_balance;
  };
  double root = 0;  // where Newton's method expects it
  const auto keep_collapsing = [&](double measure, const Shortfall& found) {
    result.collapses = measure;
    result.missing = found.answer.bound;
    result.state.velocities = mechanism_of(trial, found.answer.y);
    result.evidence.gap = std::abs(found.answer.value - found.answer.bound);
    result.evidence.inadmissible = found.answer.inadmissible;
    const double slope = strength.slope(measure, sensitivity_of(trial, found.answer));
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
  while (result.stands - result.collapses > strength.tolerance) {
    const double step = root - result.collapses, aside = 0.3 * strength.tolerance + newton_doubt * step * step;
    double next = stood == 0 ? root + aside : root - std::pow(farther, stood - 1) * aside;
    if (!(next > result.collapses && next < result.stands)) next = 0.5 * (result.collapses + result.stands);
    const Shortfall found = at(next);
    if (found.failed()) return result.status = LimitStatus::solver_failed, result;
    if (found.stands()) {
      ++stood;
      keep_standing(next, found);
    } else {
      stood = 0;
      keep_collapsing(next, found);
    }
  }
  if (result.stands < nothing_left * strength.tolerance) result.status = LimitStatus::not_attained;
  return result;
}

LoadFactorInSpace find_straight_load_factor(const CornerAssembly& assembly, const std::vector<Load<3>>& dead,
                                            const std::vector<Load<3>>& live) {
  LoadFactorInSpace result;
  if (nothing_free(assembly)) return result.status = LimitStatus::nothing_free, result;
  CornerProgram program = corner_program(assembly, dead, live);
  const double largest = program.live.cwiseAbs().maxCoeff();  // of a body's weight
  if (largest == 0) return result.status = LimitStatus::no_load, result;
  program.live /= largest;

  // the dead load first: if it is not supported there is no factor
  if (!program.right_side.isZero(0)) {
    const Shortfall found = shortfall(assembly, dead);
    ++result.evidence.programs;
    if (found.failed()) return result.status = LimitStatus::solver_failed, result;
    if (!found.stands()) {
      result.status = LimitStatus::carries_nothing;
      result.state.velocities = mechanism_of(assembly, found.answer.y);
      return result;
    }
  }
  // Without dead load and cohesion forces and load grow together: all multiples are supported, or none.
  const bool grows = program.right_side.isZero(0) &&
                     std::ranges::none_of(assembly.faces, [](const CornerFace& face) { return face.cohesion > 0; });
  const ConeProgramAnswer answer = grows ? shortfall(assembly, live).answer : solve(program);
  ++result.evidence.programs;
  if (answer.status == ConeStatus::stalled || answer.status == ConeStatus::infeasible)
    return result.status = LimitStatus::solver_failed, result;
  const bool nothing = grows && !Shortfall{answer}.stands();
  if (nothing)
    result.status = LimitStatus::carries_nothing;
  else if (grows || answer.status == ConeStatus::unbounded || answer.factor >= most_of_weight)
    result.status = LimitStatus::carries_any;
  else
    result.factor = std::max(0.0, answer.factor / largest);
  if (!nothing) result.state.forces = corner_forces(assembly, answer.x);
  if (nothing || result.status == LimitStatus::found) result.state.velocities = mechanism_of(assembly, answer.y);
  result.state.velocities.resize(assembly.bodies.size());
  if (result.status != LimitStatus::found) return result;
  result.evidence.gap = answer.gap;
  result.evidence.out_of_balance = answer.out_of_balance;
  result.evidence.inadmissible = answer.inadmissible;
  return result;
}

CriticalStrengthInSpace find_straight_factor(const CornerAssembly& assembly, const std::vector<Load<3>>& loads,
                                             const std::vector<bool>& chosen) {
  Strength strength{most_strength, strength_tolerance, {}, {}};
  strength.weaken = [&](double fraction, CornerAssembly& trial) {
    const double left = fraction / (1 - fraction);
    for (std::size_t f = 0; f < trial.faces.size(); ++f) {
      if (!chosen[f]) continue;
      trial.faces[f].friction = std::atan(left * std::tan(assembly.faces[f].friction));
      trial.faces[f].cohesion = left * assembly.faces[f].cohesion;
    }
  };
  strength.slope = [&](double fraction, const std::vector<Sensitivity>& of_faces) {
    const double left = fraction / (1 - fraction);
    double sum = 0;
    for (std::size_t f = 0; f < of_faces.size(); ++f) {
      if (!chosen[f]) continue;
      const double tangent = std::tan(assembly.faces[f].friction), weaker = left * tangent;
      sum += of_faces[f].friction * tangent / (1 + weaker * weaker);
      if (left > 0) sum += of_faces[f].cohesion / left;
    }
    return sum / ((1 - fraction) * (1 - fraction));
  };
  CriticalStrengthInSpace found = find_strength_in_space(assembly, loads, strength);
  for (double* end : {&found.collapses, &found.stands})
    *end = *end > 0 ? (1 - *end) / *end : std::numeric_limits<double>::infinity();
  return found;
}

// for FollowEnvelope
struct RoughCorners {
  const CornerAssembly& assembly;
  const std::vector<CornerFace>& faces = assembly.faces;
  const std::vector<JointProperties>& properties = assembly.properties;

  double weight_on(const CornerFace& face) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int body : {face.body_a, face.body_b})
      if (std::ranges::any_of(assembly.bodies[body].free, std::identity{}))
        least = std::min(least, assembly.bodies[body].weight);
    return least;
  }
  static double area_of(const CornerFace& face) { return face.area(); }

  FaceResultant force_on(const CornerForces& forces, std::size_t f) const {
    FaceResultant sum;
    for (const Vector<3>& force : forces[f]) {
      const double normal = force.dot(faces[f].normal);
      sum.normal += normal;
      sum.shear += (force - normal * faces[f].normal).norm();
    }
    return sum;
  }
  static CornerForces mix(CornerForces a, const CornerForces& b, double share) {
    for (std::size_t f = 0; f < a.size(); ++f)
      for (std::size_t k = 0; k < a[f].size(); ++k)
        a[f][k] += share * (b[f][k] - a[f][k]);
    return a;
  }

  // `find` of an assembly, for its faces
  auto on_faces(const auto& find) const {
    return [this, find](const std::vector<CornerFace>& straight) {
      CornerAssembly trial = assembly;
      trial.faces = straight;
      return find(trial);
    };
  }
};

}  // namespace

double acceleration_of(const Model<3>& model, const std::vector<Load<3>>& loads) {
  double largest = 0;
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const Body<3>& body = model.bodies[b];
    largest =
        std::max({largest, loads[b].force.norm() / body.mass, loads[b].moment.norm() / (body.mass * body.radius)});
  }
  return largest;
}

LoadFactorInSpace find_load_factor(const CornerAssembly& assembly, const std::vector<Load<3>>& dead,
                                   const std::vector<Load<3>>& live) {
  const RoughCorners rough{assembly};
  return FollowEnvelope(rough).repeat(
      rough.on_faces([&](const CornerAssembly& trial) { return find_straight_load_factor(trial, dead, live); }),
      [](const LoadFactorInSpace& found) { return found.factor; });
}

CriticalStrengthInSpace find_critical_friction(const CornerAssembly& assembly, const std::vector<Load<3>>& loads,
                                               const std::vector<bool>& chosen) {
  Strength strength{roughest, angle_tolerance, {}, {}};
  strength.weaken = [&](double friction, CornerAssembly& trial) {
    for (std::size_t f = 0; f < trial.faces.size(); ++f)
      if (chosen[f]) trial.faces[f].friction = friction;
  };
  strength.slope = [&](double, const std::vector<Sensitivity>& of_faces) {
    double sum = 0;
    for (std::size_t f = 0; f < of_faces.size(); ++f)
      if (chosen[f]) sum += of_faces[f].friction;
    return sum;
  };
  const RoughCorners rough{assembly};
  return FollowEnvelope(rough).repeat(
      rough.on_faces([&](const CornerAssembly& trial) { return find_strength_in_space(trial, loads, strength); }),
      [](const CriticalStrengthInSpace& found) { return found.stands; });
}

CriticalStrengthInSpace find_factor_of_safety(const CornerAssembly& assembly, const std::vector<Load<3>>& loads,
                                              const std::vector<bool>& chosen) {
  const RoughCorners rough{assembly};
  return FollowEnvelope(rough).factor(
      rough.on_faces([&](const CornerAssembly& trial) { return find_straight_factor(trial, loads, chosen); }), chosen);
}

}  // namespace voussoir
