#include "core/probability/nearest_point.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace voussoir {
namespace {

// of unit directions: below, they count as dependent
constexpr double dependent_pivot = 1e-9;

// by which a half-space may be missed, relative to its distance; a rounding
constexpr double missed = 1e-9;

// Gauss's elimination of a small positive definite matrix; none: it is singular
std::optional<std::vector<double>> solve_gram(std::vector<std::vector<double>> matrix, std::vector<double> right) {
  const std::size_t n = right.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (matrix[k][k] < dependent_pivot) return std::nullopt;
    for (std::size_t row = k + 1; row < n; ++row) {
      const double factor = matrix[row][k] / matrix[k][k];
      for (std::size_t column = k; column < n; ++column)
        matrix[row][column] -= factor * matrix[k][column];
      right[row] -= factor * right[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t column = k + 1; column < n; ++column)
      right[k] -= matrix[k][column] * right[column];
    right[k] /= matrix[k][k];
  }
  return right;
}

// the nearest point on the planes of these; none: not determined, or one of them pushes
std::optional<NearestFailed> on_planes(const std::vector<FailedHalfSpace>& half_spaces,
                                       const std::vector<std::size_t>& active) {
  std::vector<std::vector<double>> gram;
  std::vector<double> distances;
  for (const std::size_t row : active) {
    gram.emplace_back();
    for (const std::size_t column : active)
      gram.back().push_back(dot(half_spaces[row].direction, half_spaces[column].direction));
    distances.push_back(half_spaces[row].distance);
  }
  const auto pulls = solve_gram(std::move(gram), std::move(distances));
  if (!pulls || std::ranges::any_of(*pulls, [](double pull) { return pull < 0; })) return std::nullopt;
  NearestFailed point{StandardPoint(half_spaces.front().direction.size(), 0),
                      std::vector<double>(half_spaces.size(), 0)};
  for (std::size_t k = 0; k < active.size(); ++k) {
    point.pulls[active[k]] = (*pulls)[k];
    for (std::size_t key = 0; key < point.u.size(); ++key)
      point.u[key] += (*pulls)[k] * half_spaces[active[k]].direction[key];
  }
  return point;
}

}  // namespace

double dot(const StandardPoint& a, const StandardPoint& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += a[k] * b[k];
  return sum;
}

double length(const StandardPoint& a) {
  return std::sqrt(dot(a, a));
}

double distance(const StandardPoint& a, const StandardPoint& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

std::optional<NearestFailed> nearest_failed(const std::vector<FailedHalfSpace>& half_spaces) {
  std::optional<NearestFailed> best;
  for (std::size_t set = 1; set < std::size_t{1} << half_spaces.size(); ++set) {
    std::vector<std::size_t> active;
    for (std::size_t k = 0; k < half_spaces.size(); ++k)
      if (set >> k & 1) active.push_back(k);
    std::optional<NearestFailed> point = on_planes(half_spaces, active);
    if (!point || (best && length(point->u) >= length(best->u))) continue;
    const bool failed = std::ranges::all_of(half_spaces, [&](const FailedHalfSpace& one) {
      return dot(one.direction, point->u) >= one.distance - missed * std::max(1.0, std::abs(one.distance));
    });
    if (failed) best = std::move(point);
  }
  return best;
}

}  // namespace voussoir
