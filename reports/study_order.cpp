#include "reports/study_order.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir::reports {
namespace {

// below it the error has levelled off
constexpr double smallest_local_order = 0.25;

// a line through two points says nothing about itself
constexpr std::size_t fewest_settings = 3;

ObservedOrder fit(const KnobError* first, std::size_t count) {
  const auto n = static_cast<double>(count);
  double x = 0.0, y = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    x += std::log(first[k].value) / n;
    y += std::log(first[k].error) / n;
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const double dx = std::log(first[k].value) - x, dy = std::log(first[k].error) - y;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  ObservedOrder order;
  order.order = xy / xx;
  const double residual = std::max(0.0, yy - xy * xy / xx);
  order.uncertainty = 2.0 * std::sqrt(residual / (n - 2.0) / xx);
  order.count = static_cast<int>(count);
  order.coarsest = first[0].value;
  order.finest = first[count - 1].value;
  return order;
}

}  // namespace

std::optional<ObservedOrder> observed_order(std::vector<KnobError> settings) {
  if (settings.size() < fewest_settings) return std::nullopt;
  // from coarse to fine
  std::sort(settings.begin(), settings.end(), [](const auto& a, const auto& b) { return a.value > b.value; });
  if (settings.back().error > settings.front().error) std::reverse(settings.begin(), settings.end());

  std::size_t best = 0, best_count = 0;
  for (std::size_t first = 0, k = 1; k <= settings.size(); ++k) {
    const bool converges = k < settings.size() && settings[k].value != settings[k - 1].value &&
                           std::log(settings[k - 1].error / settings[k].error) >=
                               smallest_local_order * std::abs(std::log(settings[k - 1].value / settings[k].value));
    if (converges) continue;
    if (k - first > best_count) {
      best = first;
      best_count = k - first;
    }
    first = k;
  }
  if (best_count < fewest_settings) return std::nullopt;
  return fit(&settings[best], best_count);
}

}  // namespace voussoir::reports
