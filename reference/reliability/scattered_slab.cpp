#include "reference/reliability/scattered_slab.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir::reference {
namespace {

constexpr double farthest = 12;  // standard normals beyond which nothing is left

double cohesion_at(const ScatteredSlab& slab, double z) {
  const double ratio = slab.cohesion_deviation / slab.cohesion_mean, variance = std::log1p(ratio * ratio);
  return slab.cohesion_mean * std::exp(std::sqrt(variance) * z - variance / 2);
}

// the standard normal of friction at which the slab just stands
double friction_normal(const ScatteredSlab& slab, double z) {
  return (critical_friction(slab, cohesion_at(slab, z)) - slab.friction_mean) / slab.friction_deviation;
}

}  // namespace

double critical_friction(const ScatteredSlab& slab, double cohesion) {
  return std::atan((slab.weight * std::sin(slab.dip) - cohesion * slab.length) / (slab.weight * std::cos(slab.dip)));
}

double probability_of_index(double beta) {
  return 0.5 * std::erfc(beta / std::numbers::sqrt2);
}

double failure_probability(const ScatteredSlab& slab, int intervals) {
  const double width = 2 * farthest / intervals;
  double sum = 0;
  for (int k = 1; k < intervals; ++k) {
    const double z = -farthest + k * width;
    sum += std::exp(-z * z / 2) * probability_of_index(-friction_normal(slab, z));
  }
  return sum * width / std::sqrt(2 * std::numbers::pi);
}

double reliability_index(const ScatteredSlab& slab) {
  const auto distance = [&](double z) { return std::hypot(z, friction_normal(slab, z)); };
  double best = -farthest;
  for (double z = -farthest; z <= farthest; z += 0.01)
    if (distance(z) < distance(best)) best = z;
  double low = best - 0.01, high = best + 0.01;
  while (high - low > 1e-9) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
  }
  return distance(0.5 * (low + high));
}

}  // namespace voussoir::reference
