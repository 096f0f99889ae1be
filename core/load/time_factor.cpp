#include "core/load/time_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {

namespace {

double of_table(const TimeFactor& factor, double time) {
  if (factor.times.empty()) return 1;
  const auto later = std::upper_bound(factor.times.begin(), factor.times.end(), time);
  const auto i = later - factor.times.begin();
  if (later == factor.times.begin()) return factor.factors.front();
  if (later == factor.times.end()) return factor.factors.back();
  return factor.factors[i - 1] + (factor.factors[i] - factor.factors[i - 1]) *
                                     ((time - factor.times[i - 1]) / (factor.times[i] - factor.times[i - 1]));
}

// (sin x)/x and (sin x - x cos x)/x²
double sinc(double x) {
  constexpr double small = 1e-4;
  return std::abs(x) < small ? 1 - x * x / 6 : std::sin(x) / x;
}
double skewed_sinc(double x) {
  constexpr double small = 1e-2;
  const double x2 = x * x;
  return std::abs(x) < small ? x * (1.0 / 3 - x2 * (1.0 / 30 - x2 / 840)) : (std::sin(x) - x * std::cos(x)) / x2;
}

// the integral of m + s (t - middle), times the sine if there is one, over a piece of the table
double integral_of_piece(const TimeFactor& factor, double from, double to) {
  const double length = to - from, middle = 0.5 * (from + to);
  const double first = of_table(factor, from), last = of_table(factor, std::nextafter(to, from));
  const double mean = 0.5 * (first + last), rise = last - first;
  if (!(factor.frequency > 0)) return length * mean;
  const double omega = 2 * std::numbers::pi * factor.frequency, x = 0.5 * omega * length,
               at = omega * middle + factor.phase;
  return length * (mean * std::sin(at) * sinc(x) + 0.5 * rise * std::cos(at) * skewed_sinc(x));
}

}  // namespace

double value_at(const TimeFactor& factor, double time) {
  const double value = of_table(factor, time);
  return factor.frequency > 0 ? value * std::sin(2 * std::numbers::pi * factor.frequency * time + factor.phase) : value;
}

double mean_of(const TimeFactor& factor, double from, double to) {
  double sum = 0, at = from;
  for (auto next = std::upper_bound(factor.times.begin(), factor.times.end(), from);
       next != factor.times.end() && *next < to; ++next) {
    sum += integral_of_piece(factor, at, *next);
    at = *next;
  }
  return (sum + integral_of_piece(factor, at, to)) / (to - from);
}

}  // namespace voussoir
