#include "core/probability/linearisations.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace voussoir {
namespace {

// all sets of them are tried in the search of the nearest point
constexpr std::size_t most_kept = 8;

// radius of curvature, at a change of direction of one radian, from which on a limit state is taken for smooth
constexpr double kink_radius = 1.0 / 3;

bool is_afar(const Linearisation& one, const Linearisation& newest, double within) {
  const double turn = distance(one.half_space.direction, newest.half_space.direction);
  return distance(one.at, newest.at) > std::max(kink_radius * turn, within);
}

std::vector<FailedHalfSpace> half_spaces_of(const std::vector<Linearisation>& kept) {
  std::vector<FailedHalfSpace> half_spaces;
  for (const Linearisation& one : kept)
    half_spaces.push_back(one.half_space);
  return half_spaces;
}

}  // namespace

double Linearisation::g_at(const StandardPoint& u) const {
  return slope * (half_space.distance - dot(half_space.direction, u));
}

void Linearisations::add(const LocalAnswer& local, double parallel, double allowance) {
  const double slope = length(local.gradient);
  Linearisation newest{{local.gradient, 0}, slope, local.u};
  for (double& part : newest.half_space.direction)
    part /= -slope;
  newest.half_space.distance = dot(newest.half_space.direction, local.u) + local.g / slope;
  std::erase_if(kept, [&](const Linearisation& old) {
    return dot(old.half_space.direction, newest.half_space.direction) > parallel ||
           old.g_at(local.u) > local.g + allowance;
  });
  if (kept.size() == most_kept) {
    // the oldest that does not pull
    const auto idle = std::ranges::find_if(kept, [](const Linearisation& old) { return old.pull <= 0; });
    kept.erase(idle == kept.end() ? kept.begin() : idle);
  }
  kept.push_back(std::move(newest));
}

void Linearisations::keep_newest() {
  kept.erase(kept.begin(), kept.end() - 1);
}

bool Linearisations::is_pulled_from_afar(double within) const {
  return std::ranges::any_of(
      kept, [&](const Linearisation& one) { return one.pull > 0 && is_afar(one, kept.back(), within); });
}

void Linearisations::forget_afar(double within) {
  const Linearisation newest = kept.back();
  std::erase_if(kept, [&](const Linearisation& one) { return is_afar(one, newest, within); });
}

StandardPoint Linearisations::next() {
  while (kept.size() > 1) {
    if (const auto nearest = nearest_failed(half_spaces_of(kept))) {
      for (std::size_t k = 0; k < kept.size(); ++k)
        kept[k].pull = nearest->pulls[k];
      return nearest->u;
    }
    kept.erase(kept.begin());
  }
  Linearisation& newest = kept.back();
  newest.pull = newest.half_space.distance;
  StandardPoint foot = newest.half_space.direction;
  for (double& part : foot)
    part *= newest.half_space.distance;
  return foot;
}

double Linearisations::alignment(const StandardPoint& u) const {
  const double away = length(u);
  return away > 0 ? dot(kept.back().half_space.direction, u) / away : 1;
}

std::vector<FailedHalfSpace> Linearisations::pieces(const StandardPoint& u, double tolerance) const {
  std::vector<FailedHalfSpace> held = half_spaces_of(kept);
  for (std::size_t k = held.size(); k-- > 0 && held.size() > 1;) {
    std::vector<FailedHalfSpace> fewer = held;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (const auto nearest = nearest_failed(fewer); nearest && distance(nearest->u, u) <= tolerance)
      held = std::move(fewer);
  }
  return held;
}

}  // namespace voussoir
