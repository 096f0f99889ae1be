#include "core/probability/normal.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/joint_sets/portable_math.hpp"
#include "core/probability/quadrature.hpp"

namespace voussoir {
namespace {

constexpr double one_over_root_of_two_pi = 0x1.9884533d43651p-2, log_root_of_two_pi = 0x1.d67f1c864beb5p-1;

// φ is 0 from here on
constexpr double no_density = 38.6;

// Rational approximations of Φ by Cody (1969): below the first bound, below the second, a continued fraction beyond.
constexpr double near = 0.66291, middle = 5.65;
constexpr double near_over[] = {6.5682337918207449113e-2, 2.2352520354606839287, 161.02823106855587881,
                                1067.6894854603709582, 18154.981253343561249};
constexpr double near_under[] = {1, 47.20258190468824187, 976.09855173777669322, 10260.932208618978205,
                                 45507.789335026729956};
constexpr double middle_over[] = {1.0765576773720192317e-8, .39894151208813466764, 8.8831497943883759412,
                                  93.506656132177855979,    597.27027639480026226, 2494.5375852903726711,
                                  6848.1904505362823326,    11602.651437647350124, 9842.7148383839780218};
constexpr double middle_under[] = {1,
                                   22.266688044328115691,
                                   235.38790178262499861,
                                   1519.377599407554805,
                                   6485.558298266760755,
                                   18615.571640885098091,
                                   34900.952721145977266,
                                   38912.003286093271411,
                                   19685.429676859990727};
constexpr int fraction_terms = 40;  // at `middle` the next would not be seen

// Φ^-1 by Acklam: relative error 1.15e-9; in the tail of √(-2 log p), else of p - 1/2
constexpr double tail = 0.02425;
constexpr double tail_over[] = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                                -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
constexpr double tail_under[] = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                                 3.754408661907416e+00, 1};
constexpr double body_over[] = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                                1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
constexpr double body_under[] = {-5.447609879822406e+01, 1.615858368580409e+02,  -1.556989798598866e+02,
                                 6.680131188771972e+01,  -1.328068155288572e+01, 1};

template <std::size_t Terms>
double polynomial(const double (&coefficients)[Terms], double x) {
  double sum = 0;
  for (const double c : coefficients)
    sum = sum * x + c;
  return sum;
}

// exp(-t²/2) without the rounding of t², which t = 37 would show in the thirteenth digit
double bell(double t) {
  const double whole = std::floor(16 * t) / 16;
  const double root = portable::exp(-whole * whole / 4);  // twice, so that the argument stays in range
  return root * root * portable::exp(-(t - whole) * (t + whole) / 2);
}

// Φ(-t)/φ(t) for t >= near
double mills_ratio(double t) {
  if (t < middle) return polynomial(middle_over, t) / polynomial(middle_under, t) / one_over_root_of_two_pi;
  double below = t;
  for (int k = fraction_terms; k > 0; --k)
    below = t + k / below;
  return 1 / below;
}

}  // namespace

double normal_density(double z) {
  const double t = std::abs(z);
  return t < no_density ? one_over_root_of_two_pi * bell(t) : 0;
}

double normal_probability(double z) {
  const double t = std::abs(z);
  if (t < near) return 0.5 + z * polynomial(near_over, z * z) / polynomial(near_under, z * z);
  const double lower = t < no_density ? normal_density(t) * mills_ratio(t) : 0;
  return z < 0 ? lower : 1 - lower;
}

double log_normal_probability(double z) {
  if (z > -near) return z < near ? portable::log(normal_probability(z)) : log_of_one_less(normal_probability(-z));
  return -z * z / 2 - log_root_of_two_pi + portable::log(mills_ratio(-z));
}

double normal_quantile(double p) {
  assert(p > 0 && p < 1);
  if (p > 0.5) return -normal_quantile(1 - p);
  double z = 0;
  if (p < tail) {
    const double q = std::sqrt(-2 * portable::log(p));
    z = polynomial(tail_over, q) / polynomial(tail_under, q);
  } else {
    const double q = p - 0.5;
    z = q * polynomial(body_over, q * q) / polynomial(body_under, q * q);
  }
  // one Newton step on log Φ
  const double probability = normal_probability(z), density = normal_density(z);
  return density > 0 ? z - portable::log(probability / p) * (probability / density) : z;
}

}  // namespace voussoir
