#include "reports/study_order.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir::reports {
namespace {

// errors within this factor of the finest setting's have levelled off
constexpr double levelled_off = 2.0;

// a line through two points has no error estimate
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

  // the worst error of each setting and all finer ones: a lucky hit on the way does not count
  std::vector<double> worst(settings.size());
  for (std::size_t k = settings.size(); k-- > 0;)
    worst[k] = std::max(settings[k].error, k + 1 < settings.size() ? worst[k + 1] : 0.0);
  const auto falling =
      std::count_if(worst.begin(), worst.end(), [&](double error) { return error > levelled_off * worst.back(); });
  const std::size_t count = std::min(settings.size(), static_cast<std::size_t>(falling) + 1);
  if (count < fewest_settings) return std::nullopt;
  const ObservedOrder order = fit(settings.data(), count);
  return std::abs(order.order) > order.uncertainty ? std::optional(order) : std::nullopt;
}

}  // namespace voussoir::reports
