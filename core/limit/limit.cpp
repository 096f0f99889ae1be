#include "core/limit/limit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "core/limit/follow_envelope.hpp"
#include "core/limit/self_stress.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr double largest_factor = 1e6;                // of weights: a structure that supports more supports any load
constexpr double least_friction = 0;                  // of the bisection
constexpr double largest_friction = 89 * degree;      // beyond it a cone is a half-plane
constexpr double friction_tolerance = 1e-6 * degree;  // width of the bracket
// A factor F is bisected as 1/(1 + F), which maps all factors to a finite range: for that variable
constexpr double least_left = 0, most_left = 1000.0 / 1001;
constexpr double left_tolerance = 2e-8;  // below it the solver does not separate missing force from rounding
// If the solver gives up within this many tolerances of the end, feasibility is decided by rounding: the bracket stays
// wider.
constexpr double near_enough = 100;
constexpr double balanced = 1e-10;  // of a body's weight: ten times the residual that the solver's tolerance allows

// The rows of the program are the equilibrium of every degree of freedom, each divided by its body's own weight
// (moments by its radius too), so that a small falling block is detected like a large one.
struct Rows {
  std::vector<std::array<int, 3>> of_body;  // x, y, moment; -1: held
  std::vector<double> weight, lever;        // by body: N, m
  int count = 0;
};

// m/s², the unit of the weights: the largest load over its body's mass, a moment divided by the body's radius too
double acceleration_of(const Model<2>& model, const Loads& loads) {
  double largest = 0;
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const Body<2>& body = model.bodies[b];
    largest = std::max(
        {largest, loads[b].force.norm() / body.mass, std::abs(loads[b].moment[0]) / (body.mass * body.radius)});
  }
  return largest;
}

Rows number_rows(const Model<2>& model, double acceleration) {
  Rows rows;
  for (const Body<2>& body : model.bodies) {
    std::array<int, 3> of{-1, -1, -1};
    if (body.present && !body.fixed) {
      for (int k = 0; k < 2; ++k)
        if (body.free_translation[k]) of[k] = rows.count++;
      if (body.free_rotation[0]) of[2] = rows.count++;
    }
    rows.of_body.push_back(of);
    rows.weight.push_back(body.fixed ? infinity : body.mass * acceleration);
    rows.lever.push_back(body.radius);
  }
  return rows;
}

// Forces between two bodies are in units of the lighter one's weight, N: no coefficient of the program exceeds 1.
double force_unit(const Rows& rows, const Interface& face) {
  return std::min(rows.weight[face.body_a], rows.weight[face.body_b]);
}

void add_entry(ProgramColumn& column, int row, double value) {
  if (row >= 0 && value != 0) column.entries.emplace_back(row, value);
}

// a force at a point: on body_b, and its opposite on body_a
void add_force(const Model<2>& model, const Rows& rows, const Interface& face, const Vector<2>& point,
               const Vector<2>& force, ProgramColumn& column) {
  for (const int body : {face.body_a, face.body_b}) {
    if (model.bodies[body].fixed) continue;
    const Vector<2> on_body = body == face.body_b ? force : Vector<2>(-force);
    const std::array<int, 3>& row = rows.of_body[body];
    const double fraction = force_unit(rows, face) / rows.weight[body];
    add_entry(column, row[0], fraction * on_body[0]);
    add_entry(column, row[1], fraction * on_body[1]);
    const Vector<2> arm = point - model.bodies[body].reference;
    add_entry(column, row[2], fraction * moment(arm, on_body)[0] / rows.lever[body]);
  }
}

Vector<2> tangent_of(const Interface& face) {
  return {-face.normal[1], face.normal[0]};
}

// Three columns for every end of every interface: the two sides of the cone, and the shear by cohesion. The
// sides are unit forces, so that a friction angle near 90 degrees needs no special treatment.
constexpr std::size_t columns_of_an_end = 3;

void add_ends(const Model<2>& model, const Rows& rows, const std::vector<Interface>& interfaces,
              LinearProgram& program) {
  for (const Interface& face : interfaces) {
    const Vector<2> tangent = tangent_of(face);
    const double c = std::cos(face.friction), s = std::sin(face.friction);
    const double adhesion = 0.5 * face.cohesion * face.length() / force_unit(rows, face);
    for (const Vector<2>& end : face.ends) {
      ProgramColumn left{0, 0, infinity, {}}, right{0, 0, infinity, {}}, cohesive{0, -adhesion, adhesion, {}};
      add_force(model, rows, face, end, c * face.normal + s * tangent, left);
      add_force(model, rows, face, end, c * face.normal - s * tangent, right);
      add_force(model, rows, face, end, tangent, cohesive);
      program.columns.insert(program.columns.end(), {left, right, cohesive});
    }
  }
}

// components of the loads along the degrees of freedom, as fractions of each body's weight
void for_each_load(const Rows& rows, const Loads& loads, const auto& use) {
  for (std::size_t b = 0; b < loads.size(); ++b) {
    const std::array<int, 3>& row = rows.of_body[b];
    for (int k = 0; k < 2; ++k)
      if (row[k] >= 0) use(row[k], loads[b].force[k] / rows.weight[b]);
    if (row[2] >= 0) use(row[2], loads[b].moment[0] / (rows.weight[b] * rows.lever[b]));
  }
}

std::vector<std::array<EndForce, 2>> read_forces(const Rows& rows, const std::vector<Interface>& interfaces,
                                                 const std::vector<double>& x) {
  std::vector<std::array<EndForce, 2>> forces(interfaces.size());
  auto value = x.begin();
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    for (EndForce& end : forces[i]) {
      const double unit = force_unit(rows, interfaces[i]), friction = interfaces[i].friction;
      end.normal = unit * std::cos(friction) * (value[0] + value[1]);
      end.shear = unit * (std::sin(friction) * (value[0] - value[1]) + value[2]);
      value += columns_of_an_end;
    }
  return forces;
}

// The multipliers as velocities: a column that may grow has no negative reduced cost, that is, no force within its cone
// does negative work at an opening joint; so the velocities are the multipliers' opposite, by each row's weight.
std::vector<BodyVelocity> read_velocities(const Rows& rows, const std::vector<double>& y) {
  std::vector<BodyVelocity> velocities(rows.of_body.size());
  double fastest = 0;
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    const std::array<int, 3>& row = rows.of_body[b];
    const auto of = [&](int k) { return row[k] >= 0 ? -y[row[k]] / rows.weight[b] : 0.0; };
    velocities[b] = {{of(0), of(1)}, of(2) / rows.lever[b]};
    fastest = std::max(fastest, velocities[b].velocity.norm() + std::abs(of(2)));
  }
  if (fastest > 0)
    for (BodyVelocity& v : velocities)
      v = {v.velocity / fastest, v.spin / fastest};
  return velocities;
}

// the velocity of body_b relative to body_a at a point
Vector<2> opening_at(const Model<2>& model, const Interface& face, const Vector<2>& point,
                     const std::vector<BodyVelocity>& velocities) {
  const auto velocity = [&](int body) {
    const BodyVelocity& v = velocities[body];
    return Vector<2>(v.velocity + cross(Spin<2>(v.spin), point - model.bodies[body].reference));
  };
  return velocity(face.body_b) - velocity(face.body_a);
}

// the largest inadmissible velocity at an end of an interface, against a side of its cone
double find_inadmissible(const Model<2>& model, const std::vector<Interface>& interfaces,
                         const std::vector<BodyVelocity>& velocities) {
  double largest = 0;
  for (const Interface& face : interfaces)
    for (const Vector<2>& end : face.ends) {
      const Vector<2> opening = opening_at(model, face, end, velocities);
      const double slip = std::abs(opening.dot(tangent_of(face)));
      largest = std::max(largest, std::sin(face.friction) * slip - std::cos(face.friction) * opening.dot(face.normal));
    }
  return largest;
}

// the equilibrium of all bodies under dead loads
LinearProgram equilibrium(const Model<2>& model, const Rows& rows, const std::vector<Interface>& interfaces,
                          const Loads& dead) {
  LinearProgram program;
  program.right_side.assign(rows.count, 0);
  add_ends(model, rows, interfaces, program);
  for_each_load(rows, dead, [&](int row, double fraction) { program.right_side[row] = -fraction; });
  return program;
}

// the least sum of forces that must be added for equilibrium, each as a fraction of its body's weight
struct Margin {
  ProgramSolution solution;
  Certificate certificate;
};

Margin find_margin(LinearProgram program) {
  for (std::size_t row = 0; row < program.right_side.size(); ++row)
    for (const double sign : {1.0, -1.0})
      program.columns.push_back({1, 0, infinity, {{static_cast<int>(row), sign}}});
  Margin margin{solve(program), {}};
  if (margin.solution.status == ProgramStatus::optimal) margin.certificate = judge(program, margin.solution);
  return margin;
}

bool stands(const Margin& margin) {
  return margin.solution.status == ProgramStatus::optimal && margin.certificate.primal <= balanced;
}

// Whether loads that are not supported at the weakest strength, whose program this is, are supported at any higher one:
// by unbounded forces, because joints with self-stress take any shear as soon as they have friction. Such joints may in
// turn make self-stress in others possible. `gains`: interfaces whose friction grows.
bool carried_beyond(LinearProgram program, const std::vector<bool>& gains) {
  for (bool grown = true; grown;) {
    const std::vector<bool> unbounded = unbounded_columns(program);
    grown = false;
    for (std::size_t end = 0; end < 2 * gains.size(); ++end) {
      ProgramColumn* const of_end = &program.columns[columns_of_an_end * end];
      for (int side = 0; side < 2; ++side) {
        if (!unbounded[columns_of_an_end * end + side]) continue;
        grown = true;
        of_end[side].low = -infinity;
        if (gains[end / 2]) of_end[2].low = -infinity, of_end[2].high = infinity;
      }
    }
  }
  return stands(find_margin(program));
}

// Whether joints with possible self-stress move in the mechanism, and the loads are not supported without them. No
// mechanism: all joints count.
bool may_rest_on_self_stress(const Model<2>& model, const std::vector<Interface>& interfaces, LinearProgram program,
                             const std::vector<BodyVelocity>& mechanism) {
  constexpr double still = 1e-6;  // of the fastest body: far above the rounding of multipliers
  const std::vector<bool> unbounded = unbounded_columns(program);
  bool moves = false;
  for (std::size_t end = 0; end < 2 * interfaces.size(); ++end)
    for (int side = 0; side < 2; ++side) {
      if (!unbounded[columns_of_an_end * end + side]) continue;
      program.columns[columns_of_an_end * end + side].high = 0;
      const Interface& face = interfaces[end / 2];
      moves = moves || mechanism.empty() || opening_at(model, face, face.ends[end % 2], mechanism).norm() > still;
    }
  return moves && !stands(find_margin(program));
}

std::vector<bool> choose(const Model<2>& model, const std::vector<std::string>& names) {
  std::vector<bool> chosen(model.properties.size(), names.empty());
  for (const std::string& name : names) {
    const auto at = std::find_if(model.properties.begin(), model.properties.end(),
                                 [&](const JointProperties& p) { return p.name == name; });
    if (at == model.properties.end()) throw std::out_of_range(name);
    chosen[at - model.properties.begin()] = true;
  }
  return chosen;
}

// a measure of strength, its range from weak to strong, and its use by interfaces
struct StrengthRange {
  double weakest, strongest, tolerance;
  std::function<void(double strength, std::vector<Interface>& interfaces)> weaken;
};

// the two strengths between which loads are just supported
CriticalStrength bisect(const Model<2>& model, const Rows& rows, const std::vector<Interface>& interfaces,
                        const Loads& dead, const StrengthRange& range) {
  CriticalStrength result;
  if (rows.count == 0) return result.status = LimitStatus::nothing_free, result;
  if (model.gravity.isZero(0)) return result.status = LimitStatus::no_load, result;

  std::vector<Interface> trial = interfaces;
  const auto at = [&](double strength) {
    range.weaken(strength, trial);
    ++result.evidence.programs;
    return find_margin(equilibrium(model, rows, trial, dead));
  };
  const auto keep_standing = [&](double strength, const Margin& margin) {
    result.stands = strength;
    result.state.forces = read_forces(rows, trial, margin.solution.x);
    result.evidence.out_of_balance = std::max(margin.certificate.primal, margin.certificate.primal_violation);
  };
  const auto keep_collapsing = [&](double strength, const Margin& margin) {
    result.collapses = strength;
    result.missing = margin.certificate.dual;
    result.state.velocities = read_velocities(rows, margin.solution.y);
    result.evidence.gap = std::abs(margin.certificate.primal - margin.certificate.dual);
    result.evidence.inadmissible = find_inadmissible(model, trial, result.state.velocities);
  };
  const auto failed = [&](const Margin& margin) { return margin.solution.status != ProgramStatus::optimal; };

  // the ends of the range
  const Margin weak = at(range.weakest);
  if (failed(weak)) return result.status = LimitStatus::solver_failed, result;
  if (stands(weak)) {
    keep_standing(range.weakest, weak);
    return result.status = LimitStatus::carries_any, result;
  }
  keep_collapsing(range.weakest, weak);
  const Margin strong = at(range.strongest);
  if (failed(strong)) return result.status = LimitStatus::solver_failed, result;
  if (!stands(strong)) {
    keep_collapsing(range.strongest, strong);
    return result.status = LimitStatus::carries_nothing, result;
  }
  keep_standing(range.strongest, strong);

  while (result.stands - result.collapses > range.tolerance) {
    const double middle = 0.5 * (result.collapses + result.stands);
    const Margin margin = at(middle);
    if (failed(margin)) {
      if (result.stands - result.collapses > near_enough * range.tolerance) result.status = LimitStatus::solver_failed;
      break;
    }
    stands(margin) ? keep_standing(middle, margin) : keep_collapsing(middle, margin);
  }
  return result;
}

// The strength at which gravity and further loads are just supported, and whether it depends on self-stress.
CriticalStrength find_strength(const Model<2>& model, const std::vector<Interface>& interfaces, const Loads& besides,
                               const StrengthRange& range) {
  constexpr double margin = 1.01;  // joints with self-stress at this much more strength count
  Loads dead = loads_of_acceleration(model, model.gravity);
  for (std::size_t b = 0; b < besides.size(); ++b)
    dead[b] += besides[b];
  const Rows rows = number_rows(model, model.gravity.norm());
  CriticalStrength found = bisect(model, rows, interfaces, dead, range);

  const auto joints_at = [&](double strength) {
    std::vector<Interface> joints = interfaces;
    range.weaken(strength, joints);
    return joints;
  };
  const bool sought = found.status == LimitStatus::found || found.status == LimitStatus::solver_failed;
  if (sought && found.missing > 0 && found.collapses == range.weakest) {
    const std::vector<Interface> weakest = joints_at(range.weakest), strongest = joints_at(range.strongest);
    std::vector<bool> gains;
    for (std::size_t i = 0; i < weakest.size(); ++i)
      gains.push_back(strongest[i].friction > weakest[i].friction);
    if (carried_beyond(equilibrium(model, rows, weakest, dead), gains)) found.status = LimitStatus::not_attained;
  }
  // Near the critical strength of jammed blocks forces grow without bound, and the solver gives up sooner:
  // the bracket then stays wider.
  const bool wide =
      found.status == LimitStatus::solver_failed && found.missing > 0 && found.stands <= margin * found.collapses;
  if (wide || found.status == LimitStatus::found || found.status == LimitStatus::carries_any) {
    const std::vector<Interface> joints = joints_at(std::min(range.strongest, margin * found.stands));
    found.self_stress =
        may_rest_on_self_stress(model, joints, equilibrium(model, rows, joints, dead), found.state.velocities);
    if (wide && found.self_stress) found.status = LimitStatus::found;
  }
  return found;
}

LoadFactor find_straight_load_factor(const Model<2>& model, const std::vector<Interface>& interfaces, const Loads& dead,
                                     const Loads& live) {
  LoadFactor result;
  const double of_dead = acceleration_of(model, dead),
               acceleration = of_dead > 0 ? of_dead : acceleration_of(model, live);
  const Rows rows = number_rows(model, acceleration);
  if (rows.count == 0) return result.status = LimitStatus::nothing_free, result;
  double largest_fraction = 0;  // of a weight, the live load's: the program's factor is that of the load divided by it
  if (acceleration > 0)
    for_each_load(rows, live,
                  [&](int, double fraction) { largest_fraction = std::max(largest_fraction, std::abs(fraction)); });
  if (largest_fraction == 0) return result.status = LimitStatus::no_load, result;

  // the dead load first: if it is not supported there is no factor
  if (of_dead > 0) {
    const Margin margin = find_margin(equilibrium(model, rows, interfaces, dead));
    ++result.evidence.programs;
    if (margin.solution.status != ProgramStatus::optimal) return result.status = LimitStatus::solver_failed, result;
    if (!stands(margin)) {
      result.status = LimitStatus::carries_nothing;
      result.state.velocities = read_velocities(rows, margin.solution.y);
      return result;
    }
  }

  LinearProgram program = equilibrium(model, rows, interfaces, dead);
  ProgramColumn factor{-1, 0, largest_factor, {}};
  for_each_load(rows, live, [&](int row, double fraction) { add_entry(factor, row, fraction / largest_fraction); });
  program.columns.push_back(factor);
  const ProgramSolution solution = solve(program);
  ++result.evidence.programs;
  if (solution.status != ProgramStatus::optimal) return result.status = LimitStatus::solver_failed, result;

  const Certificate certificate = judge(program, solution);
  result.factor = solution.x.back() / largest_fraction;
  if (solution.x.back() >= largest_factor) result.status = LimitStatus::carries_any;
  result.state = {read_forces(rows, interfaces, solution.x), read_velocities(rows, solution.y)};
  result.evidence.gap = std::abs(certificate.primal - certificate.dual) / std::max(1.0, std::abs(certificate.primal));
  result.evidence.out_of_balance = certificate.primal_violation;
  result.evidence.inadmissible = find_inadmissible(model, interfaces, result.state.velocities);
  if (result.status == LimitStatus::found) {
    constexpr double nearly = 0.99;  // of the factor
    for (const auto& [row, fraction] : program.columns.back().entries)
      program.right_side[row] -= nearly * solution.x.back() * fraction;
    program.columns.pop_back();
    result.self_stress = may_rest_on_self_stress(model, interfaces, program, result.state.velocities);
  }
  return result;
}

// for FollowEnvelope
struct RoughAssembly {
  const Model<2>& model;
  std::vector<Interface> faces;
  const std::vector<JointProperties>& properties = model.properties;

  double weight_on(const Interface& face) const {
    double least = infinity;
    for (const int body : {face.body_a, face.body_b})
      if (!model.bodies[body].fixed) least = std::min(least, model.bodies[body].mass * model.gravity.norm());
    return least;
  }
  static double area_of(const Interface& face) { return face.length(); }

  using Forces = std::vector<std::array<EndForce, 2>>;
  static FaceResultant force_on(const Forces& forces, std::size_t f) {
    const auto& [a, b] = forces[f];
    return {a.normal + b.normal, std::abs(a.shear) + std::abs(b.shear)};
  }
  static Forces mix(Forces a, const Forces& b, double share) {
    for (std::size_t f = 0; f < a.size(); ++f)
      for (std::size_t end = 0; end < 2; ++end) {
        a[f][end].normal += share * (b[f][end].normal - a[f][end].normal);
        a[f][end].shear += share * (b[f][end].shear - a[f][end].shear);
      }
    return a;
  }
};

}  // namespace

Loads loads_of_acceleration(const Model<2>& model, const Vector<2>& acceleration) {
  Loads loads(model.bodies.size());
  for (std::size_t b = 0; b < loads.size(); ++b)
    if (model.bodies[b].present) loads[b].force = model.bodies[b].mass * acceleration;
  return loads;
}

Loads loads_of_applied_forces(const Model<2>& model) {
  Loads loads(model.bodies.size());
  for (const AppliedForce<2>& f : model.applied)
    loads[f.body] += load_of<2>({f.place, f.force}, Matrix<2>::Identity());
  return loads;
}

LoadFactor find_load_factor(const Model<2>& model, const std::vector<Interface>& interfaces, const Loads& dead,
                            const Loads& live) {
  const RoughAssembly rough{model, interfaces};
  return FollowEnvelope(rough).repeat(
      [&](const std::vector<Interface>& straight) { return find_straight_load_factor(model, straight, dead, live); },
      [](const LoadFactor& found) { return found.factor; });
}

CriticalStrength find_critical_friction(const Model<2>& model, const std::vector<Interface>& interfaces,
                                        const std::vector<std::string>& properties, const Loads& besides) {
  const std::vector<bool> chosen = choose(model, properties);
  const auto weaken = [&](double friction, std::vector<Interface>& trial) {
    for (Interface& face : trial)
      if (chosen[face.properties]) face.friction = friction;
  };
  const StrengthRange range{least_friction, largest_friction, friction_tolerance, weaken};
  const RoughAssembly rough{model, interfaces};
  return FollowEnvelope(rough).repeat(
      [&](const std::vector<Interface>& straight) { return find_strength(model, straight, besides, range); },
      [](const CriticalStrength& found) { return found.stands; });
}

CriticalStrength find_factor_of_safety(const Model<2>& model, const std::vector<Interface>& interfaces,
                                       const std::vector<std::string>& properties, const Loads& besides) {
  const std::vector<bool> chosen = choose(model, properties);
  const auto find = [&](const std::vector<Interface>& straight) {
    // the remaining fraction of the stated strength: 1/F
    const auto weaken = [&](double fraction, std::vector<Interface>& trial) {
      const double left = fraction / (1 - fraction);
      for (std::size_t i = 0; i < trial.size(); ++i) {
        if (!chosen[trial[i].properties]) continue;
        trial[i].friction = std::atan(left * std::tan(straight[i].friction));
        trial[i].cohesion = left * straight[i].cohesion;
      }
    };
    CriticalStrength found = find_strength(model, straight, besides, {least_left, most_left, left_tolerance, weaken});
    for (double* end : {&found.collapses, &found.stands})
      *end = *end > 0 ? (1 - *end) / *end : infinity;
    return found;
  };
  std::vector<bool> of_faces;
  for (const Interface& face : interfaces)
    of_faces.push_back(chosen[face.properties]);
  const RoughAssembly rough{model, interfaces};
  return FollowEnvelope(rough).factor(find, of_faces);
}

}  // namespace voussoir
