#include "core/limit/limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace voussoir {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr double largest_factor = 1e6;                // what carries more, carries any
constexpr double least_friction = 0;                  // of the bisection
constexpr double largest_friction = 89 * degree;      // beyond it a cone is a half-plane
constexpr double friction_tolerance = 1e-6 * degree;  // width of the bracket
constexpr double balanced = 1e-10;  // share of the weight: ten times what the solver's tolerance may leave

// rows of the program: the equilibrium of every free freedom, as shares of the weight; moments by the body's radius
struct Rows {
  std::vector<std::array<int, 3>> of_body;  // x, y, moment; -1: held
  std::vector<double> lever;                // by body: its radius, m
  int count = 0;
};

Rows number_rows(const Model<2>& model) {
  Rows rows;
  for (const Body<2>& body : model.bodies) {
    std::array<int, 3> of{-1, -1, -1};
    if (body.present && !body.fixed) {
      for (int k = 0; k < 2; ++k)
        if (body.free_translation[k]) of[k] = rows.count++;
      if (body.free_rotation[0]) of[2] = rows.count++;
    }
    rows.of_body.push_back(of);
    rows.lever.push_back(body.radius);
  }
  return rows;
}

double free_mass(const Model<2>& model) {
  double mass = 0;
  for (const Body<2>& body : model.bodies)
    if (body.present && !body.fixed) mass += body.mass;
  return mass;
}

void add_entry(ProgramColumn& column, int row, double value) {
  if (row >= 0 && value != 0) column.entries.emplace_back(row, value);
}

// a force at a point: on body_b, and its opposite on body_a
void add_force(const Model<2>& model, const Rows& rows, const Interface& face, const Vector<2>& point,
               const Vector<2>& force, ProgramColumn& column) {
  for (const int body : {face.body_a, face.body_b}) {
    const Vector<2> on_body = body == face.body_b ? force : Vector<2>(-force);
    const std::array<int, 3>& row = rows.of_body[body];
    add_entry(column, row[0], on_body[0]);
    add_entry(column, row[1], on_body[1]);
    const Vector<2> arm = point - model.bodies[body].reference;
    add_entry(column, row[2], moment(arm, on_body)[0] / rows.lever[body]);
  }
}

Vector<2> tangent_of(const Interface& face) {
  return {-face.normal[1], face.normal[0]};
}

// Three columns for every end of every interface: the two sides of the cone, and what cohesion adds to the shear. The
// sides are unit forces, so that a friction angle near 90 degrees is an angle like any other.
constexpr std::size_t columns_of_an_end = 3;

void add_ends(const Model<2>& model, const Rows& rows, const std::vector<Interface>& interfaces, double force_unit,
              LinearProgram& program) {
  for (const Interface& face : interfaces) {
    const Vector<2> tangent = tangent_of(face);
    const double c = std::cos(face.friction), s = std::sin(face.friction);
    const double adhesion = 0.5 * face.cohesion * face.length() / force_unit;
    for (const Vector<2>& end : face.ends) {
      ProgramColumn left{0, 0, infinity, {}}, right{0, 0, infinity, {}}, cohesive{0, -adhesion, adhesion, {}};
      add_force(model, rows, face, end, c * face.normal + s * tangent, left);
      add_force(model, rows, face, end, c * face.normal - s * tangent, right);
      add_force(model, rows, face, end, tangent, cohesive);
      program.columns.insert(program.columns.end(), {left, right, cohesive});
    }
  }
}

// the force of an acceleration on every body, a share of the weight
void for_each_load(const Model<2>& model, const Rows& rows, const Vector<2>& acceleration, double force_unit,
                   const auto& use) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    for (int k = 0; k < 2; ++k)
      if (rows.of_body[b][k] >= 0) use(rows.of_body[b][k], model.bodies[b].mass * acceleration[k] / force_unit);
}

std::vector<std::array<EndForce, 2>> read_forces(const std::vector<Interface>& interfaces, const std::vector<double>& x,
                                                 double force_unit) {
  std::vector<std::array<EndForce, 2>> forces(interfaces.size());
  auto value = x.begin();
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    for (EndForce& end : forces[i]) {
      const double left = value[0] * force_unit, right = value[1] * force_unit, cohesive = value[2] * force_unit;
      end.normal = std::cos(interfaces[i].friction) * (left + right);
      end.shear = std::sin(interfaces[i].friction) * (left - right) + cohesive;
      value += columns_of_an_end;
    }
  return forces;
}

// The multipliers as velocities: a column that may grow has no negative reduced cost, that is, no force within its cone
// takes power from an opening joint; so the velocities are the multipliers' opposite.
std::vector<BodyVelocity> read_velocities(const Model<2>& model, const Rows& rows, const std::vector<double>& y) {
  std::vector<BodyVelocity> velocities(model.bodies.size());
  double fastest = 0;
  for (std::size_t b = 0; b < velocities.size(); ++b) {
    const std::array<int, 3>& row = rows.of_body[b];
    const auto of = [&](int k) { return row[k] >= 0 ? -y[row[k]] : 0.0; };
    velocities[b] = {{of(0), of(1)}, of(2) / rows.lever[b]};
    fastest = std::max(fastest, velocities[b].velocity.norm() + std::abs(of(2)));
  }
  if (fastest > 0)
    for (BodyVelocity& v : velocities)
      v = {v.velocity / fastest, v.spin / fastest};
  return velocities;
}

// the equilibrium of all bodies under a dead acceleration
LinearProgram equilibrium(const Model<2>& model, const Rows& rows, const std::vector<Interface>& interfaces,
                          const Vector<2>& dead, double force_unit) {
  LinearProgram program;
  program.right_side.assign(rows.count, 0);
  add_ends(model, rows, interfaces, force_unit, program);
  for_each_load(model, rows, dead, force_unit, [&](int row, double force) { program.right_side[row] = -force; });
  return program;
}

// the least sum of forces that must be added for equilibrium, as shares of the weight
struct Margin {
  ProgramSolution solution;
  Certificate certificate;
};

Margin find_margin(const Model<2>& model, const Rows& rows, const std::vector<Interface>& interfaces,
                   const Vector<2>& dead, double force_unit) {
  LinearProgram program = equilibrium(model, rows, interfaces, dead, force_unit);
  for (int row = 0; row < rows.count; ++row)
    for (const double sign : {1.0, -1.0})
      program.columns.push_back({1, 0, infinity, {{row, sign}}});
  Margin margin{solve(program), {}};
  if (margin.solution.status == ProgramStatus::optimal) margin.certificate = judge(program, margin.solution);
  return margin;
}

bool stands(const Margin& margin) {
  return margin.certificate.primal <= balanced;
}

void set_friction(std::vector<Interface>& interfaces, const std::vector<bool>& chosen, double friction) {
  for (Interface& face : interfaces)
    if (chosen[face.properties]) face.friction = friction;
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

}  // namespace

LoadFactor find_load_factor(const Model<2>& model, const std::vector<Interface>& interfaces, const Vector<2>& dead,
                            const Vector<2>& live) {
  LoadFactor result;
  const Rows rows = number_rows(model);
  const double force_unit = free_mass(model) * std::max(dead.norm(), live.norm());
  if (rows.count == 0) return result.status = LimitStatus::nothing_free, result;
  if (live.norm() == 0 || force_unit == 0) return result.status = LimitStatus::no_load, result;

  // the dead load first: without it there is no factor to look for
  if (dead.norm() > 0) {
    const Margin margin = find_margin(model, rows, interfaces, dead, force_unit);
    ++result.evidence.programs;
    if (margin.solution.status != ProgramStatus::optimal) return result.status = LimitStatus::solver_failed, result;
    if (!stands(margin)) {
      result.status = LimitStatus::carries_nothing;
      result.state = {read_forces(interfaces, margin.solution.x, force_unit),
                      read_velocities(model, rows, margin.solution.y)};
      return result;
    }
  }

  LinearProgram program = equilibrium(model, rows, interfaces, dead, force_unit);
  ProgramColumn factor{-1, 0, largest_factor, {}};
  for_each_load(model, rows, live, force_unit, [&](int row, double force) { add_entry(factor, row, force); });
  program.columns.push_back(factor);
  const ProgramSolution solution = solve(program);
  ++result.evidence.programs;
  if (solution.status != ProgramStatus::optimal) return result.status = LimitStatus::solver_failed, result;

  const Certificate certificate = judge(program, solution);
  result.factor = solution.x.back();
  if (result.factor >= largest_factor) result.status = LimitStatus::carries_any;
  result.state = {read_forces(interfaces, solution.x, force_unit), read_velocities(model, rows, solution.y)};
  result.evidence.gap = std::abs(certificate.primal - certificate.dual) / std::max(1.0, std::abs(certificate.primal));
  result.evidence.out_of_balance = certificate.primal_violation;
  result.evidence.inadmissible = certificate.dual_violation;
  return result;
}

CriticalFriction find_critical_friction(const Model<2>& model, const std::vector<Interface>& interfaces,
                                        const std::vector<std::string>& properties) {
  CriticalFriction result;
  const std::vector<bool> chosen = choose(model, properties);
  const Rows rows = number_rows(model);
  const double force_unit = free_mass(model) * model.gravity.norm();
  if (rows.count == 0) return result.status = LimitStatus::nothing_free, result;
  if (force_unit == 0) return result.status = LimitStatus::no_load, result;

  std::vector<Interface> trial = interfaces;
  const auto at = [&](double friction) {
    set_friction(trial, chosen, friction);
    ++result.evidence.programs;
    return find_margin(model, rows, trial, model.gravity, force_unit);
  };
  const auto keep_standing = [&](double friction, const Margin& margin) {
    result.stands = friction;
    result.state.forces = read_forces(trial, margin.solution.x, force_unit);
    result.evidence.out_of_balance = std::max(margin.certificate.primal, margin.certificate.primal_violation);
  };
  const auto keep_collapsing = [&](double friction, const Margin& margin) {
    result.collapses = friction;
    result.missing = margin.certificate.dual;
    result.state.velocities = read_velocities(model, rows, margin.solution.y);
    result.evidence.gap = std::abs(margin.certificate.primal - margin.certificate.dual);
    result.evidence.inadmissible = margin.certificate.dual_violation;
  };
  const auto failed = [&](const Margin& margin) { return margin.solution.status != ProgramStatus::optimal; };

  // the ends of the range
  const Margin slippery = at(least_friction);
  if (failed(slippery)) return result.status = LimitStatus::solver_failed, result;
  if (stands(slippery)) {
    keep_standing(least_friction, slippery);
    return result.status = LimitStatus::carries_any, result;
  }
  keep_collapsing(least_friction, slippery);
  const Margin rough = at(largest_friction);
  if (failed(rough)) return result.status = LimitStatus::solver_failed, result;
  if (!stands(rough)) {
    keep_collapsing(largest_friction, rough);
    return result.status = LimitStatus::carries_nothing, result;
  }
  keep_standing(largest_friction, rough);

  while (result.stands - result.collapses > friction_tolerance) {
    const double middle = 0.5 * (result.collapses + result.stands);
    const Margin margin = at(middle);
    if (failed(margin)) return result.status = LimitStatus::solver_failed, result;
    stands(margin) ? keep_standing(middle, margin) : keep_collapsing(middle, margin);
  }
  return result;
}

}  // namespace voussoir
