#include "reference/small/overhang.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace voussoir::reference {
namespace {

// tilts of the joints, and by how much they move the weights outwards
std::vector<double> tilts(const OverhangStack& stack, const std::vector<double>& distance) {
  std::vector<double> tilt;
  for (int j = 1; j <= stack.blocks; ++j)
    tilt.push_back(2 * j * stack.weight / (stack.normal_stiffness * std::pow(3 * distance[j - 1], 2)));
  return tilt;
}

double moved(const OverhangStack& stack, const std::vector<double>& tilt, int j) {
  double sum = 0;
  for (int i = 1; i <= stack.blocks; ++i)
    sum += std::pow(std::min(i, j), 2) * tilt[i - 1];
  return 0.5 * stack.height / j * sum;
}

// The distances at which weights `inside` the edges come to rest; empty when they do not. From the untilted stack the
// distances fall towards the largest solution, if there is one, without ever passing it.
std::vector<double> rest(const OverhangStack& stack, double inside) {
  constexpr int limit = 1'000'000;
  constexpr double still = 1e-14;
  std::vector<double> distance(stack.blocks, inside);
  for (int i = 0; i < limit; ++i) {
    const std::vector<double> tilt = tilts(stack, distance);
    double change = 0;
    for (int j = 1; j <= stack.blocks; ++j) {
      const double next = inside - moved(stack, tilt, j);
      if (!(next > 0)) return {};
      change = std::max(change, std::abs(next - distance[j - 1]));
      distance[j - 1] = next;
    }
    if (change < still * inside) return distance;
  }
  return {};
}

}  // namespace

std::vector<double> harmonic_overhangs(const OverhangStack& stack, double share) {
  std::vector<double> overhangs;
  for (int j = 1; j <= stack.blocks; ++j)
    overhangs.push_back(share * stack.length / (2 * j));
  return overhangs;
}

double harmonic_overhang(const OverhangStack& stack) {
  double sum = 0;
  for (const double overhang : harmonic_overhangs(stack))
    sum += overhang;
  return sum;
}

OverhangLimit elastic_overhang(const OverhangStack& stack) {
  constexpr double width = 1e-8;  // of the bracket, relative to the block
  double low = 0, high = 0.25 * stack.length;
  std::vector<double> distance = rest(stack, high);
  if (distance.empty()) throw std::invalid_argument("elastic_overhang: the joints are too soft");
  while (high - low > width * stack.length) {
    const double middle = 0.5 * (low + high);
    if (std::vector<double> found = rest(stack, middle); !found.empty()) {
      high = middle;
      distance = std::move(found);
    } else {
      low = middle;
    }
  }
  OverhangLimit limit{1 - 2 * high / stack.length, distance, tilts(stack, distance)};
  const std::vector<double> overhangs = harmonic_overhangs(stack, limit.share);
  for (int j = 0; j < stack.blocks; ++j)
    if (6 * distance[j] > stack.length - overhangs[j])
      throw std::invalid_argument("elastic_overhang: a joint is pressed along its whole length");
  return limit;
}

}  // namespace voussoir::reference
