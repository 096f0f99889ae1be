// Algebra of one cone: products, steps to the boundary, Nesterov and Todd's scaling. A second-order cone x0 >= |(x1,
// …)| of three numbers and more; one of two numbers is the quarter-plane of its edges, ((x0 + x1)/√2, (x0 - x1)/√2) >=
// 0, so that no digits of the smaller one are lost.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/types.hpp"

namespace voussoir {

// W with W s = W⁻¹ x, for x and s inside; x = W² s
template <int Width>
struct ConeScaling {
  Matrix<Width> scale, inverse, square;  // W, W⁻¹, W²
};

template <int Width>
struct ConeAlgebra {
  using Numbers = Vector<Width>;
  static constexpr int degree = 1;

  static Numbers identity() { return Numbers::Unit(0); }
  static Numbers head() { return Numbers::Unit(0); }     // x0 is head·x
  static Numbers own(const Numbers& x) { return x; }     // of x0, x1, …
  static Numbers stated(const Numbers& x) { return x; }  // x0, x1, … of own numbers
  static bool inside(const Numbers& x) { return determinant(x) > 0; }

  static Numbers product(const Numbers& x, const Numbers& y) {
    Numbers product;
    product[0] = x.dot(y);
    product.template tail<Width - 1>() = x[0] * y.template tail<Width - 1>() + y[0] * x.template tail<Width - 1>();
    return product;
  }

  // y of x ∘ y = product
  static Numbers quotient(const Numbers& product, const Numbers& x) {
    const auto side = x.template tail<Width - 1>();
    Numbers y;
    y[0] = (x[0] * product[0] - side.dot(product.template tail<Width - 1>())) / determinant(x);
    y.template tail<Width - 1>() = (product.template tail<Width - 1>() - y[0] * side) / x[0];
    return y;
  }

  // how many times `step` can be added to x, which is inside
  static double steps_to_boundary(const Numbers& x, const Numbers& step) {
    const auto side = x.template tail<Width - 1>(), of_step = step.template tail<Width - 1>();
    const double square = determinant(step), half = x[0] * step[0] - side.dot(of_step), rest = determinant(x),
                 under_root = half * half - square * rest;
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

  static ConeScaling<Width> scaling(const Numbers& x, const Numbers& s) {
    constexpr double tiny = 1e-300;
    ConeScaling<Width> scaling;
    const double of_x = std::sqrt(std::fmax(determinant(x), tiny)), of_s = std::sqrt(std::fmax(determinant(s), tiny));
    const Numbers unit_x = x / of_x, unit_s = s / of_s;
    const double both = std::sqrt(0.5 * (1 + unit_x.dot(unit_s)));
    Numbers w = unit_x / (2 * both);
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
    scaling.scale = size * turned;
    scaling.square = scaling.scale * scaling.scale;
    turned.template block<1, Width - 1>(0, 1) *= -1;
    turned.template block<Width - 1, 1>(1, 0) *= -1;
    scaling.inverse = turned / size;
    return scaling;
  }

 private:
  // x0² - |(x1, …)|², without cancellation
  static double determinant(const Numbers& x) {
    const double side = x.template tail<Width - 1>().norm();
    return (x[0] - side) * (x[0] + side);
  }
};

template <>
struct ConeAlgebra<2> {
  using Numbers = Vector<2>;
  static constexpr int degree = 2;

  static Numbers identity() { return {1, 1}; }
  static Numbers head() { return Numbers::Constant(1 / std::numbers::sqrt2); }
  static Numbers own(const Numbers& x) { return Numbers(x[0] + x[1], x[0] - x[1]) / std::numbers::sqrt2; }
  static Numbers stated(const Numbers& x) { return own(x); }
  static bool inside(const Numbers& x) { return x[0] > 0 && x[1] > 0; }
  static Numbers product(const Numbers& x, const Numbers& y) { return x.cwiseProduct(y); }
  static Numbers quotient(const Numbers& product, const Numbers& x) { return product.cwiseQuotient(x); }

  static double steps_to_boundary(const Numbers& x, const Numbers& step) {
    double most = std::numeric_limits<double>::max();
    for (int k = 0; k < 2; ++k)
      if (step[k] < 0) most = std::fmin(most, x[k] / -step[k]);
    return most;
  }

  static ConeScaling<2> scaling(const Numbers& x, const Numbers& s) {
    const Numbers square = x.cwiseQuotient(s), scale = square.cwiseSqrt();
    return {scale.asDiagonal(), scale.cwiseInverse().asDiagonal(), square.asDiagonal()};
  }
};

}  // namespace voussoir
