#include "core/joint_sets/portable_math.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace voussoir::portable {
namespace {

// sums of two doubles; whole numbers up to 2^20 times the first are exact
constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;
constexpr double half_pi_high = 0x1.921fb544p+0, half_pi_low = 0x1.0b4611a626331p-34;
constexpr double one_over_ln2 = 0x1.71547652b82fep+0, two_over_pi = 0x1.45f306dc9c883p-1;
constexpr double root_of_half = 0x1.6a09e667f3bcdp-1;

// terms until the next would be below half an ulp for the arguments that reduction leaves
constexpr int log_terms = 12, exp_terms = 15, circle_terms = 9;

// sine and cosine for |r| <= pi/4, by nested Taylor series
double small_sine(double r) {
  double sum = 1;
  for (int k = circle_terms; k > 0; --k)
    sum = 1 - r * r / (2 * k * (2 * k + 1)) * sum;
  return r * sum;
}

double small_cosine(double r) {
  double sum = 1;
  for (int k = circle_terms; k > 0; --k)
    sum = 1 - r * r / (2 * k * (2 * k - 1)) * sum;
  return sum;
}

// the quadrant's part of sin(x + quadrants pi/2)
double circle(double x, int quadrants) {
  assert(std::abs(x) <= 100);
  const double turns = std::floor(x * two_over_pi + 0.5);
  const double r = (x - turns * half_pi_high) - turns * half_pi_low;
  const int quadrant = (static_cast<int>(turns) + quadrants) & 3;
  const double value = quadrant & 1 ? small_cosine(r) : small_sine(r);
  return quadrant & 2 ? -value : value;
}

}  // namespace

double log(double x) {
  assert(x > 0 && std::isfinite(x));
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < root_of_half) {
    m *= 2;
    --exponent;
  }
  // log m = 2 artanh s
  const double s = (m - 1) / (m + 1);
  double sum = 0;
  for (int k = log_terms; k >= 0; --k)
    sum = sum * (s * s) + 1.0 / (2 * k + 1);
  return exponent * ln2_high + (2 * s * sum + exponent * ln2_low);
}

double exp(double x) {
  assert(std::abs(x) <= 700);
  const double power = std::floor(x * one_over_ln2 + 0.5);
  const double r = (x - power * ln2_high) - power * ln2_low;
  double sum = 1;
  for (int k = exp_terms; k > 0; --k)
    sum = 1 + r / k * sum;
  return std::ldexp(sum, static_cast<int>(power));
}

double sine(double x) {
  return circle(x, 0);
}

double cosine(double x) {
  return circle(x, 1);
}

double angle(double x, double y) {
  const double size = std::sqrt(x * x + y * y), c = x / size, s = y / size;
  // the start is within 0.08; each step leaves a sixth of the error's cube
  const double quarter = 1 - (std::abs(c) - std::abs(s)) / (std::abs(c) + std::abs(s));
  double a = std::numbers::pi / 4 * quarter;
  if (c < 0) a = std::numbers::pi - a;
  if (s < 0) a = -a;
  for (int k = 0; k < 4; ++k)
    a += s * cosine(a) - c * sine(a);
  return a;
}

}  // namespace voussoir::portable
