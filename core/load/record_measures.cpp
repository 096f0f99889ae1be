#include "core/load/record_measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/load/response_spectrum.hpp"

namespace voussoir {
namespace {

double peak_of(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values)
    most = std::max(most, std::abs(value));
  return most;
}

// ∫ a² over the first part of an interval, of length t
double square_until(const LinearPiece& piece, double t) {
  const double a = piece.begin, b = piece.begin + (piece.end - piece.begin) * (t / piece.length);
  return t * (a * a + a * b + b * b) / 3;
}

double magnitude_over(const LinearPiece& piece) {
  const double a = std::abs(piece.begin), b = std::abs(piece.end);
  const bool changes_sign = (piece.begin < 0) != (piece.end < 0) && a > 0 && b > 0;
  return changes_sign ? 0.5 * piece.length * (a * a + b * b) / (a + b) : 0.5 * piece.length * (a + b);
}

// s: time at which ∫ a² dt has reached this value
double time_of(const std::vector<LinearPiece>& pieces, double wanted) {
  constexpr int halvings = 60;  // to the last bit of an interval
  double sum = 0, time = 0;
  for (const LinearPiece& piece : pieces) {
    const double whole = square_until(piece, piece.length);
    if (sum + whole >= wanted) {
      double low = 0, high = piece.length;
      for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (low + high);
        (sum + square_until(piece, middle) < wanted ? low : high) = middle;
      }
      return time + high;
    }
    sum += whole;
    time += piece.length;
  }
  return time;
}

// Cooley and Tukey's transform in place; the number of values is a power of two
void transform(std::vector<std::complex<double>>& values) {
  const std::size_t n = values.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n / 2;
    for (; j & bit; bit /= 2)
      j ^= bit;
    j ^= bit;
    if (i < j) std::swap(values[i], values[j]);
  }
  std::vector<std::complex<double>> roots(n / 2);
  for (std::size_t k = 0; k < roots.size(); ++k)
    roots[k] = std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
  for (std::size_t length = 2; length <= n; length *= 2)
    for (std::size_t start = 0; start < n; start += length)
      for (std::size_t k = 0; k < length / 2; ++k) {
        std::complex<double>&low = values[start + k], &high = values[start + k + length / 2];
        const std::complex<double> turned = high * roots[k * (n / length)];
        high = low - turned;
        low += turned;
      }
}

AccelerationMeasures acceleration_measures(const GroundMotion& motion) {
  const std::vector<LinearPiece> pieces = acceleration_pieces(motion);
  AccelerationMeasures measures;
  double squares = 0;
  for (const LinearPiece& piece : pieces) {
    measures.peak = std::max({measures.peak, std::abs(piece.begin), std::abs(piece.end)});
    squares += square_until(piece, piece.length);
    measures.cav += magnitude_over(piece);
  }
  measures.arias = std::numbers::pi / (2 * standard_gravity) * squares;
  measures.significant_from = time_of(pieces, 0.05 * squares);
  measures.significant = time_of(pieces, 0.95 * squares) - measures.significant_from;
  const FourierSpectrum spectrum = fourier_spectrum(motion);
  const auto largest = std::max_element(spectrum.squares.begin(), spectrum.squares.end());
  measures.peak_frequency = spectrum.step * static_cast<double>(largest - spectrum.squares.begin());
  return measures;
}

}  // namespace

FourierSpectrum fourier_spectrum(const GroundMotion& motion) {
  // of accelerations that are constant in between, one a piece; zeros make the spectrum four times as dense
  std::vector<std::complex<double>> values;
  if (motion.quantity == MotionQuantity::acceleration)
    values.assign(motion.acceleration.begin(), motion.acceleration.end());
  else
    for (const LinearPiece& piece : acceleration_pieces(motion))
      values.emplace_back(piece.begin);
  std::size_t size = 1;
  while (size < 4 * values.size())
    size *= 2;
  values.resize(size);
  transform(values);
  FourierSpectrum spectrum{1 / (motion.interval * static_cast<double>(size)), {}};
  for (std::size_t k = 0; k <= size / 2; ++k)
    spectrum.squares.push_back(std::norm(values[k]));
  return spectrum;
}

double share_above(const FourierSpectrum& spectrum, double frequency) {
  double all = 0, above = 0;
  for (std::size_t k = 0; k < spectrum.squares.size(); ++k) {
    const bool single = k == 0 || k + 1 == spectrum.squares.size();  // the others have a conjugate
    const double energy = (single ? 1 : 2) * spectrum.squares[k];
    all += energy;
    if (spectrum.step * static_cast<double>(k) > frequency) above += energy;
  }
  return all > 0 ? above / all : 0;
}

RecordMeasures measures_of(const GroundMotion& motion) {
  RecordMeasures measures{
      .count = motion.displacement.size(), .interval = motion.interval, .duration = motion.duration()};
  if (motion.quantity != MotionQuantity::displacement) {
    measures.acceleration = acceleration_measures(motion);
    measures.peak_velocity = peak_of(motion.velocity);
    measures.end_velocity = motion.velocity.back();
  }
  measures.peak_displacement = peak_of(motion.displacement);
  measures.end_displacement = motion.displacement.back();
  measures.taken_off = motion.stated_peak > 0 ? motion.taken_off / motion.stated_peak : 0;
  return measures;
}

}  // namespace voussoir
