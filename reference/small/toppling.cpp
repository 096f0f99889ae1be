#include "reference/small/toppling.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

bool leans_over(const InclinedBlock& block) {
  return std::tan(block.slope) > block.breadth / block.height;
}

}  // namespace

const char* name_of(BlockMode mode) {
  switch (mode) {
    case BlockMode::stays:
      return "stays";
    case BlockMode::slides:
      return "slides";
    case BlockMode::topples:
      return "topples";
    case BlockMode::slides_and_topples:
      return "slides and topples";
  }
  return "";
}

BlockMode block_mode_of_statics(const InclinedBlock& block) {
  const bool slides = block.slope > block.friction_angle, topples = leans_over(block);
  if (slides) return topples ? BlockMode::slides_and_topples : BlockMode::slides;
  return topples ? BlockMode::topples : BlockMode::stays;
}

BlockMode block_mode(const InclinedBlock& block) {
  if (!leans_over(block)) return block.slope > block.friction_angle ? BlockMode::slides : BlockMode::stays;
  if (std::tan(block.friction_angle) <= block.breadth / block.height) return BlockMode::slides;
  return block.friction_angle < least_toppling_friction(block) ? BlockMode::slides_and_topples : BlockMode::topples;
}

double least_toppling_friction(const InclinedBlock& block) {
  if (!leans_over(block)) throw std::invalid_argument("least_toppling_friction: the block does not topple");
  const double b = block.breadth, h = block.height, s = std::sin(block.slope), c = std::cos(block.slope);
  const double turn = 1.5 * (h * s - b * c) / (b * b + h * h);  // over g
  return std::atan((s - 0.5 * turn * h) / (c + 0.5 * turn * b));
}

double overturning_angle(double breadth, double height, double normal_force, double normal_stiffness) {
  if (!(breadth > 0 && height > 0 && normal_force > 0 && normal_stiffness > 0))
    throw std::invalid_argument("overturning_angle: all must be positive");
  double tangent = breadth / height;
  for (int i = 0; i < 50; ++i) {
    const double inside = std::cbrt(2 * normal_force * height * (1 + tangent * tangent) / (9 * normal_stiffness));
    tangent = (breadth - 3 * inside) / height;
    if (6 * inside > breadth) throw std::invalid_argument("overturning_angle: the joint is too soft");
  }
  return std::atan(tangent);
}

double SteppedColumns::height(int column) const {
  const double at_crest = crest * (shortening_below - step);
  return column <= crest ? column * (shortening_below - step) : at_crest - (column - crest) * (shortening_above + step);
}

double stepped_columns_friction(const SteppedColumns& slope) {
  // the force that the lowest column still needs at its foot, in units of weight per area
  const auto toe_force = [&](double friction) {
    const double mu = std::tan(friction), s = std::sin(slope.base_dip), c = std::cos(slope.base_dip);
    double push = 0;
    for (int n = slope.columns; n >= 1; --n) {
      const double h = slope.height(n), weight = h * slope.thickness;
      const double from_above = n < slope.crest ? h : h - slope.shortening_above;
      const double to_below = n <= slope.crest ? h - slope.shortening_below : h;
      const double slides = push - weight * (c * mu - s) / (1 - mu * mu);
      const double topples =
          n > 1 ? (push * (from_above - slope.thickness * mu) + weight / 2 * (h * s - slope.thickness * c)) / to_below
                : 0;
      push = std::max({0.0, topples, slides});
    }
    return push;
  };
  double fails = slope.base_dip, stands = 0.78;  // 1 - mu^2 stays positive
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (fails + stands);
    (toe_force(middle) > 0 ? fails : stands) = middle;
  }
  return stands;
}

}  // namespace voussoir::reference
