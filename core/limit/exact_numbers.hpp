// Numbers without rounding, for proofs: integers, and sums and products of doubles, which are integers times powers of
// two. Vectors of either in the plane and in space.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include "core/geometry/types.hpp"

namespace voussoir {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

// integer · 2^exponent; of a double the integer is odd or zero
struct Dyadic {
  Integer integer;
  int exponent = 0;

  Dyadic() = default;
  Dyadic(Integer of_integer, int of_exponent) : integer(std::move(of_integer)), exponent(of_exponent) {}
  explicit Dyadic(double number) {
    if (number == 0) return;
    int binary = 0;
    constexpr int digits = 53;
    const auto all = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &binary), digits));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(all));
    integer = all / (std::int64_t(1) << zeros);
    exponent = binary - digits + zeros;
  }
  // in units of 2^exponent, of which it must be a multiple
  Integer in_units(int unit) const { return integer.is_zero() ? integer : Integer(integer << (exponent - unit)); }
  int sign() const { return integer.sign(); }

  friend Dyadic operator*(const Dyadic& a, const Dyadic& b) { return {a.integer * b.integer, a.exponent + b.exponent}; }
  friend Dyadic operator+(const Dyadic& a, const Dyadic& b) {
    if (a.integer.is_zero()) return b;
    if (b.integer.is_zero()) return a;
    const int unit = std::min(a.exponent, b.exponent);
    return {a.in_units(unit) + b.in_units(unit), unit};
  }
  friend Dyadic operator-(const Dyadic& a, const Dyadic& b) { return a + Dyadic(-b.integer, b.exponent); }
  friend bool operator<=(const Dyadic& a, const Dyadic& b) { return (a - b).sign() <= 0; }
};

template <class Number, std::size_t Size>
using Numbers = std::array<Number, Size>;

template <int Size>
Numbers<Dyadic, Size> exact_of(const FixedMatrix<Size, 1>& of) {
  Numbers<Dyadic, Size> all;
  for (int k = 0; k < Size; ++k)
    all[k] = Dyadic(of[k]);
  return all;
}

template <class Number, std::size_t Size>
Numbers<Number, Size> operator+(Numbers<Number, Size> a, const Numbers<Number, Size>& b) {
  for (std::size_t k = 0; k < Size; ++k)
    a[k] = a[k] + b[k];
  return a;
}

template <class Number, std::size_t Size>
Numbers<Number, Size> operator-(Numbers<Number, Size> a, const Numbers<Number, Size>& b) {
  for (std::size_t k = 0; k < Size; ++k)
    a[k] = a[k] - b[k];
  return a;
}

template <class Number, std::size_t Size>
Numbers<Number, Size> operator*(const Number& factor, Numbers<Number, Size> a) {
  for (Number& number : a)
    number = factor * number;
  return a;
}

template <class Number, std::size_t Size>
Number product(const Numbers<Number, Size>& a, const Numbers<Number, Size>& b) {
  Number sum = a[0] * b[0];
  for (std::size_t k = 1; k < Size; ++k)
    sum = sum + a[k] * b[k];
  return sum;
}

template <class Number>
Numbers<Number, 3> outer(const Numbers<Number, 3>& a, const Numbers<Number, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// r × f
template <class Number>
Numbers<Number, 1> moment(const Numbers<Number, 2>& r, const Numbers<Number, 2>& f) {
  return {r[0] * f[1] - r[1] * f[0]};
}
template <class Number>
Numbers<Number, 3> moment(const Numbers<Number, 3>& r, const Numbers<Number, 3>& f) {
  return outer(r, f);
}

// w × r
template <class Number>
Numbers<Number, 2> turning(const Numbers<Number, 1>& w, const Numbers<Number, 2>& r) {
  return {Number() - w[0] * r[1], w[0] * r[0]};
}
template <class Number>
Numbers<Number, 3> turning(const Numbers<Number, 3>& w, const Numbers<Number, 3>& r) {
  return outer(w, r);
}

// the exponent of the last binary digit of a number; 0 has none
inline int last_digit(double number) {
  return Dyadic(number).exponent;
}

}  // namespace voussoir
