#include "reference/water/wet_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

constexpr double right_angle = std::numbers::pi / 2;

constexpr Require slope_requires{"water: "};

// along a joint of this dip: the driving force, and the normal force less the water's
struct Balance {
  double driving = 0, effective = 0;
};

Balance balance(const PlaneFailure& slope) {
  const PlaneFailureForces f = forces_of(slope);
  const double c = std::cos(slope.joint), s = std::sin(slope.joint);
  return {f.weight * s + f.thrust * c, f.weight * c - f.uplift - f.thrust * s};
}

}  // namespace

double submerged_acceleration(double incline, double friction_angle, double density_ratio, double gravity) {
  slope_requires(incline >= 0 && incline <= right_angle, "an incline must be between 0 and pi/2 radians");
  slope_requires(friction_angle >= 0 && friction_angle < right_angle,
                 "a friction angle must be between 0 and pi/2 radians");
  slope_requires(std::isfinite(density_ratio) && density_ratio > 1, "the block must be denser than water");
  slope_requires(positive(gravity), "gravity must be positive");
  const double slides = std::sin(incline) - std::cos(incline) * std::tan(friction_angle);
  return (1 - 1 / density_ratio) * gravity * std::max(0.0, slides);
}

PlaneFailureForces forces_of(const PlaneFailure& slope) {
  slope_requires(positive(slope.height) && positive(slope.unit_weight), "height and unit weight must be positive");
  slope_requires(slope.joint > 0 && slope.joint < slope.face && slope.face <= right_angle,
                 "the joint must dip less than the face, and the face no more than pi/2 radians");
  slope_requires(slope.crack_distance >= 0, "the crack must be behind the crest");
  slope_requires(slope.cohesion >= 0 && slope.friction_angle >= 0 && slope.friction_angle < right_angle,
                 "cohesion must not be negative, and a friction angle must be between 0 and pi/2 radians");
  const double crest = slope.height / std::tan(slope.face), crack = crest + slope.crack_distance;
  const double rise = crack * std::tan(slope.joint);
  PlaneFailureForces f;
  f.joint_length = crack / std::cos(slope.joint);
  f.crack_depth = slope.height - rise;
  slope_requires(f.crack_depth >= 0, "at the crack the joint must be below the top");
  slope_requires(slope.water_in_crack >= 0 && slope.water_in_crack <= f.crack_depth,
                 "the crack does not hold so much water");
  // under the face and the top, less the part below the joint
  f.weight =
      slope.unit_weight * (0.5 * crest * slope.height + slope.crack_distance * slope.height - 0.5 * crack * rise);
  f.uplift = 0.5 * water_unit_weight * slope.water_in_crack * f.joint_length;
  f.thrust = 0.5 * water_unit_weight * slope.water_in_crack * slope.water_in_crack;
  return f;
}

double factor_of_safety(const PlaneFailure& slope) {
  const auto [driving, effective] = balance(slope);
  if (effective <= 0) return 0;
  return (slope.cohesion * forces_of(slope).joint_length + effective * std::tan(slope.friction_angle)) / driving;
}

double critical_friction(const PlaneFailure& slope) {
  const auto [driving, effective] = balance(slope);
  slope_requires(effective > 0, "the water lifts the block; no friction angle holds it");
  return std::atan2(driving, effective);
}

double critical_friction(const GravityBlock& block) {
  slope_requires(positive(block.width) && positive(block.height) && positive(block.unit_weight),
                 "width, height and unit weight must be positive");
  slope_requires(block.water >= 0 && block.water <= block.height, "the water must not be above the block");
  const double thrust = 0.5 * water_unit_weight * block.water * block.water;
  const double effective =
      block.unit_weight * block.width * block.height - 0.5 * water_unit_weight * block.water * block.width;
  slope_requires(effective > 0, "the water lifts the block; no friction angle holds it");
  return std::atan2(thrust, effective);
}

double tipping_water(const GravityBlock& block) {
  GravityBlock dry = block;
  dry.water = 0;
  critical_friction(dry);  // checks the values
  const double holds = 0.5 * block.unit_weight * block.height * block.width * block.width;
  const auto overturns = [&](double h) { return water_unit_weight * h * (h * h / 6 + block.width * block.width / 3); };
  double low = 0, high = block.height;
  slope_requires(overturns(high) >= holds, "it does not tip before the water flows over it");
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (overturns(middle) < holds ? low : high) = middle;
  return high;
}

double highest_corner(const DrawnDownBlock& block) {
  slope_requires(positive(block.length) && positive(block.height) && positive(block.unit_weight),
                 "length, height and unit weight must be positive");
  slope_requires(block.incline >= 0 && block.incline < right_angle, "an incline must be between 0 and pi/2 radians");
  return block.length * std::sin(block.incline) + block.height * std::cos(block.incline);
}

double critical_friction(const DrawnDownBlock& block) {
  highest_corner(block);  // checks the values
  const double rise = block.length * std::sin(block.incline);
  slope_requires(block.level >= rise, "the joint must be full over its whole length");
  const double weight = block.unit_weight * block.length * block.height;
  const double uplift = water_unit_weight * block.length * (block.level - 0.5 * rise);
  const double effective = weight * std::cos(block.incline) - uplift;
  slope_requires(effective > 0, "the water lifts the block; no friction angle holds it");
  return std::atan2(weight * std::sin(block.incline), effective);
}

}  // namespace voussoir::reference
