#pragma once

#include <algorithm>

namespace voussoir::reference {

// The greatest value of a function with one peak, and its place: by golden section of the interval, so many times. The
// place is accurate to the square root of rounding at best, since a peak is flat; the value to rounding.
struct Peak {
  double at = 0, value = 0;
};
template <class Function>
Peak peak(const Function& f, double low, double high, int sections) {
  constexpr double golden = 0.6180339887498949;
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = f(a), at_b = f(b);
  for (int i = 0; i < sections; ++i) {
    if (at_a < at_b) {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = f(b);
    } else {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = f(a);
    }
  }
  return {0.5 * (low + high), std::max(at_a, at_b)};
}

}  // namespace voussoir::reference
