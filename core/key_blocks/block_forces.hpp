// Forces on a block: the least that gives a required factor, the worst earthquake, the water that it can bear. Each is
// judged again by projection, so that a change of mode is not missed.
#pragma once

#include <optional>

#include "core/key_blocks/verdict.hpp"

namespace voussoir {

// a force that is part of the load, as that of a tightened bolt
template <int Dim>
struct RequiredForce {
  Vector<Dim> force = Vector<Dim>::Zero();  // N; zero: the block has the factor without it
  bool least = true;                        // false: other faces carry load, so that it is sufficient, not least
};

// The least force for a factor: along g - F v/|v|, g the change of the resistance with a force, of size
// (F S - Q)/|g - F v/|v||. If other faces carry load under it, the size for the factor along its direction is found by
// bisection. For a block that falls or lifts it is F |R| against R, less its resistance. None if no force of a thousand
// times the load is enough, and for a block that does not move.
template <int Dim>
std::optional<RequiredForce<Dim>> least_force(const Block<Dim>& block, const BoltedVerdict<Dim>& bolted, double factor,
                                              const Vector<Dim>& gravity);

// N: the least force along a unit direction for the factor; none as above
template <int Dim>
std::optional<double> force_along(const Block<Dim>& block, const BoltedVerdict<Dim>& bolted, double factor,
                                  const Vector<Dim>& direction, const Vector<Dim>& gravity);

// a force k W on the block; the ground's acceleration points the other way
template <int Dim>
struct WorstDirection {
  Vector<Dim> direction = Vector<Dim>::Zero();  // unit, horizontal
  std::optional<double> factor;                 // none: the block does not move in any direction
};

// The horizontal direction of a force of this size (N) in which the factor is least: the best of 24 trends (2-D: of the
// two), then improved by the gradient of the factor until it falls no more. `load`: without it.
template <int Dim>
WorstDirection<Dim> worst_direction(const Block<Dim>& block, const Vector<Dim>& load, double size,
                                    const Vector<Dim>& gravity);

// k_y: the least horizontal force over the weight with which the factor is 1, up to `most`; 0 if it is below 1 without
// one. Along a direction, or the worst one if it is zero.
template <int Dim>
std::optional<double> critical_coefficient(const Block<Dim>& block, const Vector<Dim>& load,
                                           const Vector<Dim>& direction, const Vector<Dim>& gravity, double most = 4);

// the factor on all water pressures at which the block's factor is 1, up to `most`; none if no such factor is found
template <int Dim>
std::optional<double> critical_water(const Block<Dim>& block, const Vector<Dim>& load_without_water,
                                     const Vector<Dim>& gravity, double most = 1000);

// m, an elevation of the scene: the lowest to which the assembly's one level of water can rise before the block's
// factor falls below 1. Four levels between the heights of every two corners are tried, then levels up to `most` times
// the block's height. None without such a level, if the block fails without water, and if none of these levels fails.
template <int Dim>
std::optional<double> critical_level(const Assembly<Dim>& assembly, const Block<Dim>& block,
                                     const Vector<Dim>& load_without_water, double most = 1000);

}  // namespace voussoir
