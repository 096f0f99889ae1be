// Numbers of 106 bits as unevaluated sums of two doubles, for the few results that 53 bits do not decide. Correct to
// some 2^-102 of the result; every step is an addition or a product in double that rounds by IEEE 754, without fused
// multiply-adds, so that the bits are the same everywhere. After Dekker (1971) and Li et al. (2002), the QD library.
#pragma once

namespace voussoir {

struct DoubleDouble {
  double high = 0, low = 0;  // |low| <= half an ulp of high

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double x) : high(x) {}
  constexpr DoubleDouble(double h, double l) : high(h), low(l) {}
  explicit operator double() const { return high; }
};

// a + b without an error, |a| >= |b|
inline DoubleDouble sum_of_ordered(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// the same of any two numbers (Knuth)
inline DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

// a b without an error (Dekker), as long as neither is beyond 1e300 nor the product's last bit below the smallest
// number
inline DoubleDouble exact_product(double a, double b) {
  constexpr double splitter = (1 << 27) + 1;
  const double a_big = splitter * a, b_big = splitter * b;
  const double a_high = a_big - (a_big - a), b_high = b_big - (b_big - b);
  const double a_low = a - a_high, b_low = b - b_high, product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.high, -a.low};
}
inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = exact_sum(a.high, b.high), low = exact_sum(a.low, b.low);
  const DoubleDouble sum = sum_of_ordered(high.high, high.low + low.high);
  return sum_of_ordered(sum.high, sum.low + low.low);
}
inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}
inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = exact_product(a.high, b.high);
  return sum_of_ordered(product.high, product.low + (a.high * b.low + a.low * b.high));
}
inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - first * b;
  const double second = rest.high / b.high;
  const double third = (rest - second * b).high / b.high;
  return sum_of_ordered(first, second) + third;
}
inline bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}
inline bool operator>(const DoubleDouble& a, const DoubleDouble& b) {
  return b < a;
}
inline DoubleDouble abs(const DoubleDouble& a) {
  return a.high < 0 ? -a : a;
}

}  // namespace voussoir
