#include "core/run/search_estimates.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace voussoir {
namespace {

// of the failure displacement: bodies that have moved less have not turned on a face yet
constexpr double least_turned = 0.003;

struct Line {
  double critical, b;
};

// s0 and b of the least squares
Line fit_of(std::span<const StableTrial> trials) {
  const double scale = trials.back().displacement;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const StableTrial& t : trials) {
    const double u = t.displacement / scale;
    const Eigen::Vector3d row(1, 1 / std::sqrt(u), -u);
    normal += row * row.transpose();
    right += t.level * row;
  }
  const Eigen::Vector3d x = normal.inverse() * right;
  return {x[0], x[1]};
}

}  // namespace

std::optional<StableFit> fit_stable(const std::vector<StableTrial>& trials) {
  std::vector<StableTrial> turned;
  std::ranges::copy_if(trials, std::back_inserter(turned),
                       [](const StableTrial& t) { return t.of_failure > least_turned; });
  std::ranges::sort(turned, {}, &StableTrial::displacement);
  turned.erase(std::unique(turned.begin(), turned.end(),
                           [](const StableTrial& a, const StableTrial& b) { return a.displacement == b.displacement; }),
               turned.end());
  if (turned.size() < 3) return {};
  const Line all = fit_of(turned);
  if (turned.size() == 3)
    return all.b > 0 && std::isfinite(all.critical) ? std::optional(StableFit{all.critical, 0, true}) : std::nullopt;
  const Line fewer = fit_of(std::span(turned).subspan(1));
  if (!(fewer.b > 0) || !std::isfinite(fewer.critical)) return {};
  return StableFit{fewer.critical, std::abs(fewer.critical - all.critical), false};
}

}  // namespace voussoir
