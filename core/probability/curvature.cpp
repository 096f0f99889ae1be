#include "core/probability/curvature.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/probability/nearest_point.hpp"
#include "core/probability/normal.hpp"

namespace voussoir {
namespace {

using Plane = std::vector<StandardPoint>;

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

Eigen::VectorXd curvatures_of(const std::vector<StateAnswer>& answers, Eigen::Index size, double step) {
  const auto g = [&](std::size_t k) { return *answers[k].g; };
  const double slope = (g(2) - g(1)) / (2 * step), square = step * step;
  if (!(slope > 0)) return {};
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(size, size);
  std::size_t at = 3;
  for (Eigen::Index i = 0; i < size; ++i) {
    hessian(i, i) = (g(at) + g(at + 1) - 2 * g(0)) / square / slope;
    at += 2;
    for (Eigen::Index j = 0; j < i; ++j, at += 4)
      hessian(i, j) = hessian(j, i) = (g(at) - g(at + 1) - g(at + 2) + g(at + 3)) / (4 * square) / slope;
  }
  if (size == 0) return {};
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(hessian, Eigen::EigenvaluesOnly).eigenvalues();
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
  const Eigen::VectorXd curvatures = curvatures_of(answers, static_cast<Eigen::Index>(plane.size()), step);
  if (curvatures.size() != static_cast<Eigen::Index>(plane.size())) return std::nullopt;
  found.curvatures.assign(curvatures.begin(), curvatures.end());
  const auto breitung = correction(found.curvatures, beta);
  const auto hohenbichler = correction(found.curvatures, normal_density(beta) / probability);
  if (!breitung || !hohenbichler) return std::nullopt;
  found.breitung = probability * *breitung;
  found.hohenbichler = probability * *hohenbichler;
  return found;
}

}  // namespace voussoir
