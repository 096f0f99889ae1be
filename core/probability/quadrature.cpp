#include "core/probability/quadrature.hpp"

#include <cmath>
#include <cstddef>

#include "core/joint_sets/portable_math.hpp"

namespace voussoir {
namespace {

constexpr double pi = 0x1.921fb54442d18p+1;
constexpr int newton_steps = 8;

}  // namespace

// Kahan: the rounding of 1 - x is in both factors and cancels
double log_of_one_less(double x) {
  const double y = 1 - x;
  return y == 1 ? -x : portable::log(y) * (x / (1 - y));
}

double one_less_exp(double x) {
  const double y = portable::exp(-x);
  return y == 1 ? x : y > 0.5 && y < 2 ? (1 - y) * (x / -portable::log(y)) : 1 - y;
}

GaussLegendreRule gauss_legendre(int points) {
  GaussLegendreRule rule;
  for (int k = points; k > 0; --k) {
    double x = portable::cosine(pi * (k - 0.25) / (points + 0.5)), slope = 0;
    for (int step = 0; step < newton_steps; ++step) {
      double before = 1, p = x;  // Legendre polynomials of degree 0 and 1, then up
      for (int degree = 2; degree <= points; ++degree) {
        const double next = ((2 * degree - 1) * x * p - (degree - 1) * before) / degree;
        before = p;
        p = next;
      }
      slope = points * (before - x * p) / (1 - x * x);
      x -= p / slope;
    }
    rule.nodes.push_back(x);
    rule.weights.push_back(2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

}  // namespace voussoir
