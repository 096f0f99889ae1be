// Algebra of one second-order cone, x0 >= |(x1, …)|: Nesterov and Todd's scaling, products, steps to the boundary.
#pragma once

#include <cmath>
#include <limits>

#include "core/geometry/types.hpp"

namespace voussoir {

// x0² - |(x1, …)|², without cancellation
template <int Width>
double cone_determinant(const Vector<Width>& x) {
  const double side = x.template tail<Width - 1>().norm();
  return (x[0] - side) * (x[0] + side);
}

template <int Width>
Vector<Width> cone_product(const Vector<Width>& x, const Vector<Width>& y) {
  Vector<Width> product;
  product[0] = x.dot(y);
  product.template tail<Width - 1>() = x[0] * y.template tail<Width - 1>() + y[0] * x.template tail<Width - 1>();
  return product;
}

// y of x ∘ y = product
template <int Width>
Vector<Width> cone_quotient(const Vector<Width>& product, const Vector<Width>& x) {
  if constexpr (Width == 2) {  // by its rays
    const double first = (product[0] + product[1]) / (x[0] + x[1]), second = (product[0] - product[1]) / (x[0] - x[1]);
    return {0.5 * (first + second), 0.5 * (first - second)};
  }
  const auto side = x.template tail<Width - 1>();
  Vector<Width> y;
  y[0] = (x[0] * product[0] - side.dot(product.template tail<Width - 1>())) / cone_determinant<Width>(x);
  y.template tail<Width - 1>() = (product.template tail<Width - 1>() - y[0] * side) / x[0];
  return y;
}

// how many times `step` can be added to x, which is inside
template <int Width>
double step_to_boundary(const Vector<Width>& x, const Vector<Width>& step) {
  if constexpr (Width == 2) {  // two rays
    const auto to_ray = [](double at, double change) {
      return change < 0 ? at / -change : std::numeric_limits<double>::max();
    };
    return std::fmin(to_ray(x[0] - x[1], step[0] - step[1]), to_ray(x[0] + x[1], step[0] + step[1]));
  }
  const auto side = x.template tail<Width - 1>(), of_step = step.template tail<Width - 1>();
  const double square = cone_determinant<Width>(step), half = x[0] * step[0] - side.dot(of_step),
               rest = cone_determinant<Width>(x), under_root = half * half - square * rest;
  double most = std::numeric_limits<double>::max();
  if (step[0] < 0) most = x[0] / -step[0];
  if (under_root < 0) return most;
  const double root = std::sqrt(under_root);
  if (half < 0)
    most = std::fmin(most, rest / (root - half));
  else if (square < 0)
    most = std::fmin(most, (half + root) / -square);
  return most;
}

// W with W s = W⁻¹ x, for x and s inside; x = W² s
template <int Width>
struct ConeScaling {
  Matrix<Width> scale, inverse, square;  // W, W⁻¹, W²

  ConeScaling() = default;
  ConeScaling(const Vector<Width>& x, const Vector<Width>& s) {
    constexpr double tiny = 1e-300;
    if constexpr (Width == 2) {  // each ray by itself
      const auto turned = [](double first, double second) {
        Matrix<2> matrix;
        matrix << first + second, first - second, first - second, first + second;
        return Matrix<2>(0.5 * matrix);
      };
      const double first = std::fmax(x[0] + x[1], tiny) / std::fmax(s[0] + s[1], tiny),
                   second = std::fmax(x[0] - x[1], tiny) / std::fmax(s[0] - s[1], tiny);
      square = turned(first, second);
      scale = turned(std::sqrt(first), std::sqrt(second));
      inverse = turned(1 / std::sqrt(first), 1 / std::sqrt(second));
      return;
    }
    const double of_x = std::sqrt(std::fmax(cone_determinant<Width>(x), tiny)),
                 of_s = std::sqrt(std::fmax(cone_determinant<Width>(s), tiny));
    const Vector<Width> unit_x = x / of_x, unit_s = s / of_s;
    const double both = std::sqrt(0.5 * (1 + unit_x.dot(unit_s)));
    Vector<Width> w = unit_x / (2 * both);
    w[0] += unit_s[0] / (2 * both);
    w.template tail<Width - 1>() -= unit_s.template tail<Width - 1>() / (2 * both);
    const auto side = w.template tail<Width - 1>();
    Matrix<Width> turned;
    turned(0, 0) = w[0];
    turned.template block<1, Width - 1>(0, 1) = side.transpose();
    turned.template block<Width - 1, 1>(1, 0) = side;
    turned.template block<Width - 1, Width - 1>(1, 1) =
        Matrix<Width - 1>::Identity() + side * side.transpose() / (1 + w[0]);
    const double size = std::sqrt(of_x / of_s);
    scale = size * turned;
    square = scale * scale;
    turned.template block<1, Width - 1>(0, 1) *= -1;
    turned.template block<Width - 1, 1>(1, 0) *= -1;
    inverse = turned / size;
  }
};

}  // namespace voussoir
