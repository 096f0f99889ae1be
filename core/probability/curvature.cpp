#include "core/probability/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/probability/nearest_point.hpp"
#include "core/probability/normal.hpp"

namespace voussoir {
namespace {

using Plane = std::vector<StandardPoint>;

constexpr int most_sweeps = 50;
constexpr double rounding_of_eigenvalues = 1e-30;  // squares beside the diagonal, of all squares

// Orthonormal directions across u: the columns of Householder's reflection that takes u to a key's axis, but for that
// axis, the key with the largest part of u.
Plane plane_across(const StandardPoint& u) {
  std::size_t largest = 0;
  for (std::size_t key = 1; key < u.size(); ++key)
    if (std::abs(u[key]) > std::abs(u[largest])) largest = key;
  StandardPoint mirror = u;
  mirror[largest] += u[largest] < 0 ? -length(u) : length(u);
  const double square = dot(mirror, mirror);
  Plane plane;
  for (std::size_t key = 0; key < u.size(); ++key) {
    if (key == largest) continue;
    StandardPoint column(u.size(), 0);
    column[key] = 1;
    for (std::size_t k = 0; k < u.size(); ++k)
      column[k] -= 2 * mirror[key] * mirror[k] / square;
    plane.push_back(std::move(column));
  }
  return plane;
}

StandardPoint moved(StandardPoint u, const StandardPoint& direction, double by) {
  for (std::size_t k = 0; k < u.size(); ++k)
    u[k] += by * direction[k];
  return u;
}

// In this order: the point, two along u, two along each direction of the plane, four along each pair of them.
std::vector<StandardPoint> points_of_hessian(const StandardPoint& u, const Plane& plane, double step) {
  StandardPoint along = u;
  for (double& part : along)
    part /= length(u);
  std::vector<StandardPoint> points{u};
  for (const double side : {step, -step})
    points.push_back(moved(u, along, side));
  for (std::size_t i = 0; i < plane.size(); ++i) {
    for (const double side : {step, -step})
      points.push_back(moved(u, plane[i], side));
    for (std::size_t j = 0; j < i; ++j)
      for (const double a : {step, -step})
        for (const double b : {step, -step})
          points.push_back(moved(moved(u, plane[i], a), plane[j], b));
  }
  return points;
}

using SquareMatrix = std::vector<std::vector<double>>;

// ascending, by Jacobi's rotations; symmetric
std::vector<double> eigenvalues_of(SquareMatrix m) {
  const std::size_t size = m.size();
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double beside = 0, all = 0;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        all += m[i][j] * m[i][j];
        if (i != j) beside += m[i][j] * m[i][j];
      }
    if (beside <= rounding_of_eigenvalues * all) break;
    for (std::size_t p = 0; p < size; ++p)
      for (std::size_t q = p + 1; q < size; ++q) {
        if (m[p][q] == 0) continue;
        const double half = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = (half < 0 ? -1 : 1) / (std::abs(half) + std::sqrt(half * half + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (std::size_t k = 0; k < size; ++k) {
          const double kp = m[k][p], kq = m[k][q];
          m[k][p] = c * kp - s * kq;
          m[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < size; ++k) {
          const double pk = m[p][k], qk = m[q][k];
          m[p][k] = c * pk - s * qk;
          m[q][k] = s * pk + c * qk;
        }
      }
  }
  std::vector<double> values(size);
  for (std::size_t k = 0; k < size; ++k)
    values[k] = m[k][k];
  std::ranges::sort(values);
  return values;
}

// none if g does not fall along u*
std::optional<std::vector<double>> curvatures_of(const std::vector<StateAnswer>& answers, std::size_t size,
                                                 double step) {
  const auto g = [&](std::size_t k) { return *answers[k].g; };
  const double slope = (g(2) - g(1)) / (2 * step), square = step * step;
  if (!(slope > 0)) return std::nullopt;
  SquareMatrix hessian(size, std::vector<double>(size, 0.0));
  std::size_t at = 3;
  for (std::size_t i = 0; i < size; ++i) {
    hessian[i][i] = (g(at) + g(at + 1) - 2 * g(0)) / square / slope;
    at += 2;
    for (std::size_t j = 0; j < i; ++j, at += 4)
      hessian[i][j] = hessian[j][i] = (g(at) - g(at + 1) - g(at + 2) + g(at + 3)) / (4 * square) / slope;
  }
  return eigenvalues_of(std::move(hessian));
}

// Π (1 + factor κ)^(-1/2); none: a bracket is not positive
std::optional<double> correction(const std::vector<double>& curvatures, double factor) {
  double product = 1;
  for (const double curvature : curvatures) {
    const double bracket = 1 + factor * curvature;
    if (bracket <= 0) return std::nullopt;
    product *= bracket;
  }
  return 1 / std::sqrt(product);
}

}  // namespace

std::optional<SecondOrder> second_order(const LimitFunction& limit, const DesignPoint& point, double step) {
  const double beta = length(point.u), probability = normal_probability(-beta);
  if (point.pieces.size() > 1 || beta == 0 || probability == 0) return std::nullopt;
  const Plane plane = plane_across(point.u);
  const std::vector<StandardPoint> points = points_of_hessian(point.u, plane, step);
  const std::vector<StateAnswer> answers = limit(points);
  if (std::ranges::any_of(answers, [](const StateAnswer& answer) { return !answer.g; })) return std::nullopt;
  SecondOrder found;
  found.evaluations = static_cast<int>(points.size());
  const std::optional<std::vector<double>> curvatures = curvatures_of(answers, plane.size(), step);
  if (!curvatures) return std::nullopt;
  found.curvatures = *curvatures;
  const auto breitung = correction(found.curvatures, beta);
  const auto hohenbichler = correction(found.curvatures, normal_density(beta) / probability);
  if (!breitung || !hohenbichler) return std::nullopt;
  found.breitung = probability * *breitung;
  found.hohenbichler = probability * *hohenbichler;
  return found;
}

}  // namespace voussoir
