#include "reference/small/rocking.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "reference/ode.hpp"

namespace voussoir::reference {
namespace {

double half_diagonal(const RockingBlock& block) {
  return 0.5 * std::hypot(block.breadth, block.height);
}

double mass_of(const RockingBlock& block) {
  return block.density * block.breadth * block.height;
}

void require_lean(const RockingBlock& block, double lean) {
  if (!(lean > 0 && lean < slenderness(block))) throw std::invalid_argument("rocking block: 0 < lean < slenderness");
}

// x to the side the block leans to, y up from the base; turns clockwise
enum RockingEntry { lean_, lean_rate_, x_, speed_x_, y_, speed_y_, shear_, rocking_entries_ };

}  // namespace

double slenderness(const RockingBlock& block) {
  return std::atan(block.breadth / block.height);
}

double rocking_frequency(const RockingBlock& block) {
  return std::sqrt(0.75 * block.gravity / half_diagonal(block));
}

double housner_quarter_period(const RockingBlock& block, double lean) {
  require_lean(block, lean);
  return std::acosh(1 / (1 - lean / slenderness(block))) / rocking_frequency(block);
}

double rigid_quarter_period(const RockingBlock& block, double lean) {
  require_lean(block, lean);
  // lean (1 - u^2) makes the integrand smooth; the midpoint rule is right to 1e-9 with these
  constexpr int steps = 20'000;
  const double alpha = slenderness(block), p = rocking_frequency(block);
  double time = 0;
  for (int i = 0; i < steps; ++i) {
    const double u = (i + 0.5) / steps, now = lean * (1 - u * u);
    // cos(alpha - lean) - cos(alpha - now) without cancellation
    const double fallen = 2 * std::sin(alpha - 0.5 * (lean + now)) * std::sin(0.5 * (lean - now));
    time += 2 * lean * u / steps / (p * std::sqrt(2 * fallen));
  }
  return time;
}

namespace {

// Newton's laws of the block on its elastic base
OdeRight on_elastic_base(const RockingBlock& block, double normal_stiffness, double shear_stiffness) {
  const double radius = half_diagonal(block), alpha = slenderness(block), mass = mass_of(block);
  const double inertia = mass * radius * radius / 3, gravity = block.gravity;
  return [=](double, const double* s, double* slope) {
    const double turn = s[lean_], half = 0.5 * turn;
    const double beside = radius * std::sin(alpha - turn), above = radius * std::cos(alpha - turn);
    const double length = std::max(above - s[y_], 0.0) / std::sin(turn) / std::cos(half);  // of the pressed wedge
    const double pressure = normal_stiffness * std::tan(half) * length * length;
    // its point of action, from the centroid: two thirds of the wedge from its tip, which is on the base
    const double tip = beside - (above - s[y_]) / std::tan(turn);
    const double rx = tip + 2.0 / 3 * length * std::cos(half), ry = -s[y_] - 2.0 / 3 * length * std::sin(half);
    const double slip =
        (s[speed_x_] + s[lean_rate_] * ry) * std::cos(half) - (s[speed_y_] - s[lean_rate_] * rx) * std::sin(half);
    const double fx = pressure * std::sin(half) + s[shear_] * std::cos(half),
                 fy = pressure * std::cos(half) - s[shear_] * std::sin(half);
    slope[lean_] = s[lean_rate_];
    slope[lean_rate_] = -(rx * fy - ry * fx) / inertia;
    slope[x_] = s[speed_x_];
    slope[speed_x_] = fx / mass;
    slope[y_] = s[speed_y_];
    slope[speed_y_] = fy / mass - gravity;
    slope[shear_] = -shear_stiffness * length * slip;
  };
}

// without motion the weight is supported upright: pressure and shear are its components
std::vector<double> held(const RockingBlock& block, double lean, double normal_stiffness) {
  const double weight = mass_of(block) * block.gravity;
  const double length = std::sqrt(weight * std::cos(0.5 * lean) / (normal_stiffness * std::tan(0.5 * lean)));
  std::vector<double> state(rocking_entries_, 0.0);
  state[lean_] = lean;
  state[y_] =
      half_diagonal(block) * std::cos(slenderness(block) - lean) - length * std::cos(0.5 * lean) * std::sin(lean);
  state[shear_] = -weight * std::sin(0.5 * lean);
  return state;
}

}  // namespace

double elastic_turn(const RockingBlock& block, double lean, double normal_stiffness, double shear_stiffness,
                    double time) {
  require_lean(block, lean);
  return lean - integrate_ode(on_elastic_base(block, normal_stiffness, shear_stiffness),
                              held(block, lean, normal_stiffness), 0, time, 1e-10)[lean_];
}

double elastic_quarter_period(const RockingBlock& block, double lean, double normal_stiffness, double shear_stiffness) {
  require_lean(block, lean);
  const OdeRight right = on_elastic_base(block, normal_stiffness, shear_stiffness);
  std::vector<double> state = held(block, lean, normal_stiffness);

  // the last part, in which the wedge grows to the whole face, at constant speed
  const double upright = 1e-3 * lean, step = 1e-3 / rocking_frequency(block);
  double time = 0;
  while (true) {
    const std::vector<double> next = integrate_ode(right, state, time, time + step, 1e-10);
    if (next[lean_] < upright) break;
    state = next;
    time += step;
    if (time > 1e3 * housner_quarter_period(block, lean))
      throw std::runtime_error("rocking block: it does not return to upright");
  }
  return time - state[lean_] / state[lean_rate_];
}

double housner_restitution(const RockingBlock& block) {
  const double s = std::sin(slenderness(block));
  return 1 - 1.5 * s * s;
}

double base_moment(const RockingBlock& block, double lean, double normal_stiffness) {
  const double b = block.breadth, weight = mass_of(block) * block.gravity;
  if (lean * normal_stiffness * b * b <= 2 * weight) return normal_stiffness * b * b * b / 12 * lean;
  return weight * (0.5 * b - std::sqrt(2 * weight / (normal_stiffness * lean)) / 3);
}

}  // namespace voussoir::reference
