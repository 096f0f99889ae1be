#include "reference/small/overhang.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

struct Place {
  double x = 0, y = 0;
};

Place moved(const Place& from, double along, double up, double turn) {
  return {from.x + along * std::cos(turn) + up * std::sin(turn), from.y - along * std::sin(turn) + up * std::cos(turn)};
}

std::vector<double> tilts_at(const OverhangStack& stack, const std::vector<double>& distance) {
  std::vector<double> tilt;
  for (int j = 1; j <= stack.blocks; ++j)
    tilt.push_back(2 * j * stack.weight / (stack.normal_stiffness * std::pow(3 * distance[j - 1], 2)));
  return tilt;
}

// Positions of the weights when the joints deform under forces at `distance`: blocks are put on each other from the
// ground up. Rotations are clockwise, the edge of the ground is the origin.
std::vector<double> distances_after(const OverhangStack& stack, const std::vector<double>& overhangs,
                                    const std::vector<double>& distance) {
  const int n = stack.blocks;
  const std::vector<double> tilt = tilts_at(stack, distance);
  std::vector<Place> edge(n + 1), centre(n);  // edge[j]: upper right corner of the block below joint j + 1
  std::vector<double> turn(n + 1);            // of the same
  for (int j = n - 1; j >= 0; --j) {
    const double pressed = 3 * distance[j];
    turn[j] = turn[j + 1] + tilt[j];
    const double sideways = (j + 1) * stack.weight * std::sin(turn[j + 1] + 0.5 * tilt[j]);
    const Place pivot = moved(edge[j + 1], sideways / (stack.shear_stiffness * pressed) - pressed, 0, turn[j + 1]);
    const Place corner = moved(pivot, pressed + overhangs[j], 0, turn[j]);
    centre[j] = moved(corner, -0.5 * stack.length, 0.5 * stack.height, turn[j]);
    edge[j] = moved(corner, 0, stack.height, turn[j]);
  }
  std::vector<double> after;
  double sum = 0;
  for (int j = 0; j < n; ++j) {
    sum += centre[j].x;
    after.push_back((edge[j + 1].x - sum / (j + 1)) / std::cos(turn[j + 1]));
  }
  return after;
}

// The stack in equilibrium; no distances when it falls. From the untilted stack the distances fall towards the largest
// solution, if there is one, without ever passing it.
OverhangState rest(const OverhangStack& stack, double fraction) {
  constexpr int limit = 1'000'000;
  constexpr double still = 1e-14;
  const std::vector<double> overhangs = harmonic_overhangs(stack, fraction);
  OverhangState state{fraction, std::vector<double>(stack.blocks, 0.5 * (1 - fraction) * stack.length), {}, 0};
  for (int i = 0; i < limit; ++i) {
    const std::vector<double> next = distances_after(stack, overhangs, state.distance);
    double change = 0;
    for (int j = 0; j < stack.blocks; ++j) {
      if (!(next[j] > 0)) return {fraction, {}, {}, 0};
      change = std::max(change, std::abs(next[j] - state.distance[j]));
    }
    state.distance = next;
    if (change > still * stack.length) continue;
    state.tilt = tilts_at(stack, state.distance);
    for (const double tilt : state.tilt)
      state.turn += tilt;
    for (int j = 0; j < stack.blocks; ++j)
      if (6 * state.distance[j] > stack.length - overhangs[j])
        throw std::invalid_argument("elastic_overhang: a joint is pressed along its whole length");
    return state;
  }
  return {fraction, {}, {}, 0};
}

}  // namespace

std::vector<double> harmonic_overhangs(const OverhangStack& stack, double fraction) {
  std::vector<double> overhangs;
  for (int j = 1; j <= stack.blocks; ++j)
    overhangs.push_back(fraction * stack.length / (2 * j));
  return overhangs;
}

double harmonic_overhang(const OverhangStack& stack) {
  double sum = 0;
  for (const double overhang : harmonic_overhangs(stack))
    sum += overhang;
  return sum;
}

OverhangState elastic_overhang_limit(const OverhangStack& stack) {
  constexpr double width = 1e-8;  // of the bracket
  double stands = 0.8, falls = 1;
  OverhangState limit = rest(stack, stands);
  if (limit.distance.empty()) throw std::invalid_argument("elastic_overhang_limit: the joints are too soft");
  while (falls - stands > width) {
    const double middle = 0.5 * (stands + falls);
    OverhangState found = rest(stack, middle);
    if (found.distance.empty()) {
      falls = middle;
    } else {
      stands = middle;
      limit = std::move(found);
    }
  }
  return limit;
}

OverhangState elastic_overhang(const OverhangStack& stack, double fraction) {
  OverhangState found = rest(stack, fraction);
  if (found.distance.empty()) throw std::invalid_argument("elastic_overhang: beyond the limit");
  return found;
}

}  // namespace voussoir::reference
