#include "reference/small/block_on_joint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "reference/ode.hpp"

namespace voussoir::reference {
namespace {

double mass_of(const BlockOnJoint& block) {
  return block.density * block.breadth * block.height;
}

// m of the centroid above the plane at which the joint has this force
double height_that_carries(const BlockOnJoint& block, double turn, double force) {
  const double b = block.breadth, h = block.height;
  double high = 0.5 * (b * std::sin(turn) + h * std::cos(turn)), low = 0.5 * high;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (press_on_joint(block, middle, turn).force > force ? low : high) = middle;
  }
  return low;
}

// the slope that this turn balances
double slope_balanced(const BlockOnJoint& block, double turn) {
  const double weight = mass_of(block) * block.gravity;
  double slope = std::atan(block.breadth / block.height);
  for (int i = 0; i < 20; ++i) {
    const JointPress p = press_on_joint(block, height_that_carries(block, turn, weight * std::cos(slope)), turn);
    slope = std::atan2(-p.moment, -p.centre.y * p.force);
  }
  return slope;
}

// `sheared` elastically
enum Entry { above_, rising_, along_, sliding_, turn_, spin_, sheared_, entries_ };

// Time between two returns of shear to Coulomb's limit, in periods of the block on its joint. A fifth of it changes the
// slip of a foot by less than 1 in 10 000. Most such times are one step of the integration.
constexpr double settled_each = 0.07;

}  // namespace

JointPress press_on_joint(const BlockOnJoint& block, double above, double turn) {
  const double b = block.breadth, h = block.height;
  const bool back = turn < 0;  // the mirror image
  const double s = std::sin(std::abs(turn)), c = std::cos(turn), half = std::cos(0.5 * turn);
  // both corners, their depths, and the depth's derivative by the turn
  const JointPress::Place low{0.5 * (b * c - h * s), -0.5 * (b * s + h * c)}, high{low.x - b * c, low.y + b * s};
  const double d = -low.y - above, e = -high.y - above;
  JointPress p;
  p.corner = back ? JointPress::Place{-high.x, high.y} : low;
  if (!(d > 0)) return p;

  // E = k f/(6 cos^7(t/2))
  double f, by_depth, by_turn;
  JointPress::Place end;  // the other end of the length in contact
  const double up = 0.5 / (half * half);
  if (e > 0) {
    f = b * (d * d + d * e + e * e);
    by_depth = 3 * b * (d + e);
    by_turn = b * ((2 * d + e) * low.x + (d + 2 * e) * high.x);
    end = {high.x + e * up * s, high.y + e * up * c};
    p.length = b / half;
  } else {
    f = d * d * d / s;
    by_depth = 3 * d * d / s;
    by_turn = 3 * d * d * low.x / s - f * c / s;
    end = {low.x - d * c / s, low.y + d};
    p.length = d / (s * half);
  }
  const double scale = block.normal_stiffness / (6 * std::pow(half, 7));
  p.energy = scale * f;
  p.force = scale * by_depth;
  p.moment = -scale * (by_turn + 3.5 * std::tan(0.5 * std::abs(turn)) * f);
  p.centre = {0.5 * (low.x + d * up * s + end.x), 0.5 * (low.y + d * up * c + end.y)};
  if (back) {
    p.moment = -p.moment;
    p.centre.x = -p.centre.x;
  }
  return p;
}

double greatest_resting_slope(const BlockOnJoint& block) {
  const double b = block.breadth, h = block.height, k = block.normal_stiffness, weight = mass_of(block) * block.gravity;
  if (!(b > 0 && h > 0 && k > 0 && weight > 0))
    throw std::invalid_argument("greatest_resting_slope: all must be positive");
  // golden section in the logarithm of the turn, from about the turn at which an end of the face lifts off
  double low = std::log(2 * weight / (k * b * b)), high = std::log(0.25 * b / h);
  if (!(low < high)) throw std::invalid_argument("greatest_resting_slope: the joint is too soft");
  constexpr double golden = 0.61803398874989485;
  for (int i = 0; i < 60; ++i) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (slope_balanced(block, std::exp(left)) > slope_balanced(block, std::exp(right)))
      high = right;
    else
      low = left;
  }
  return slope_balanced(block, std::exp(low));
}

JointStart start_on_joint(const BlockOnJoint& block, double turn, double time) {
  const double mass = mass_of(block), b = block.breadth, h = block.height;
  const double inertia = mass * (b * b + h * h) / 12, friction = std::tan(block.friction_angle);
  const double along = block.gravity * std::sin(block.slope), into = block.gravity * std::cos(block.slope);

  // with the dashpot, which acts half way along the length in contact
  const auto normal_force = [&](const JointPress& p, const double* s) {
    const double dashpot = 2 * block.dashpot_ratio * std::sqrt(block.normal_stiffness * p.length * mass);
    return std::max(p.force - dashpot * (s[rising_] - s[spin_] * p.centre.x), 0.0);
  };
  const OdeRight right = [&](double t, const double* s, double* slope) {
    const double grown = block.ramp > 0 ? std::min(t / block.ramp, 1.0) : 1;
    const JointPress p = press_on_joint(block, s[above_], s[turn_]);
    const double normal = normal_force(p, s), limit = friction * normal;
    const double shear = std::clamp(block.shear_stiffness * p.length * s[sheared_], -limit, limit);
    slope[above_] = s[rising_];
    slope[rising_] = normal / mass - grown * into;
    slope[along_] = s[sliding_];
    slope[sliding_] = grown * along - shear / mass;
    slope[turn_] = s[spin_];
    slope[spin_] = (p.moment - (normal - p.force) * p.centre.x - shear * p.centre.y) / inertia;
    slope[sheared_] = s[sliding_] + s[spin_] * p.centre.y;
  };

  const double interval = settled_each * 2 * std::numbers::pi * std::sqrt(mass / (block.normal_stiffness * b));
  std::vector<double> state(entries_, 0.0);
  state[above_] = 0.5 * h;
  JointStart start;
  double length = 0;
  while (start.time < time && start.turn < turn) {
    state = integrate_ode(right, state, start.time, start.time + interval, 1e-8, 1);
    start.time += interval;
    start.turn = state[turn_];
    const JointPress p = press_on_joint(block, state[above_], state[turn_]);
    start.slip = state[along_] + p.corner.x - 0.5 * b;
    // length newly in contact is not sheared yet, and shear beyond Coulomb's limit is slip
    if (p.length > length && length > 0) state[sheared_] *= length / p.length;
    length = p.length;
    const double most = length > 0 ? friction * normal_force(p, state.data()) / (block.shear_stiffness * length) : 0;
    state[sheared_] = std::clamp(state[sheared_], -most, most);
  }
  return start;
}

}  // namespace voussoir::reference
