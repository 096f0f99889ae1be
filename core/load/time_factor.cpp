#include "core/load/time_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {

double value_at(const TimeFactor& factor, double time) {
  double value = 1;
  if (!factor.times.empty()) {
    const auto later = std::upper_bound(factor.times.begin(), factor.times.end(), time);
    const auto i = later - factor.times.begin();
    if (later == factor.times.begin())
      value = factor.factors.front();
    else if (later == factor.times.end())
      value = factor.factors.back();
    else
      value = factor.factors[i - 1] + (factor.factors[i] - factor.factors[i - 1]) *
                                          ((time - factor.times[i - 1]) / (factor.times[i] - factor.times[i - 1]));
  }
  if (factor.frequency > 0) value *= std::sin(2 * std::numbers::pi * factor.frequency * time + factor.phase);
  return value;
}

}  // namespace voussoir
