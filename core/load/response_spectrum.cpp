#include "core/load/response_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voussoir {
namespace {

// the exact response to a linear acceleration; factors of one length of step are kept
struct Oscillator {
  double frequency, damping;  // rad/s, of critical
  double damped = frequency * std::sqrt(1 - damping * damping);

  struct Factors {
    double time, decay, cosine, sine;
  };
  Factors factors(double time) const {
    return {time, std::exp(-damping * frequency * time), std::cos(damped * time), std::sin(damped * time)};
  }

  // Nigam & Jennings 1969: a particular solution, linear in time, and a free vibration
  OscillatorState after(const LinearPiece& piece, const Factors& f, const OscillatorState& before) const {
    const double rise = (piece.end - piece.begin) / piece.length, square = frequency * frequency;
    const double slope = -rise / square;
    const double at_begin = -piece.begin / square + 2 * damping * rise / (square * frequency);
    const double a = before.displacement - at_begin;
    const double b = (before.velocity - slope + damping * frequency * a) / damped;
    const double free = f.decay * (a * f.cosine + b * f.sine);
    const double free_velocity = f.decay * damped * (b * f.cosine - a * f.sine) - damping * frequency * free;
    return {at_begin + slope * f.time + free, slope + free_velocity};
  }
};

// largest magnitude within a step at whose ends the velocity has opposite signs
double peak_within(const Oscillator& oscillator, const LinearPiece& piece, double length,
                   const OscillatorState& before) {
  constexpr int halvings = 40;  // the displacement is flat there: half of the digits of time are enough
  double low = 0, high = length;
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (low + high);
    const double velocity = oscillator.after(piece, oscillator.factors(middle), before).velocity;
    ((velocity < 0) == (before.velocity < 0) ? low : high) = middle;
  }
  return std::abs(oscillator.after(piece, oscillator.factors(low), before).displacement);
}

double largest_displacement(const std::vector<LinearPiece>& pieces, double period, double damping) {
  constexpr double steps_per_period = 20;  // the velocity then has at most one sign change in a step
  const Oscillator oscillator{2 * std::numbers::pi / period, damping};
  OscillatorState state;
  double most = 0;
  const auto follow = [&](const LinearPiece& piece) {
    const int steps = std::max(1, static_cast<int>(std::ceil(piece.length * steps_per_period / period)));
    const double length = piece.length / steps, rise = (piece.end - piece.begin) / steps;
    const Oscillator::Factors factors = oscillator.factors(length);
    for (int k = 0; k < steps; ++k) {
      const LinearPiece part{length, piece.begin + k * rise, piece.begin + (k + 1) * rise};
      const OscillatorState after = oscillator.after(part, factors, state);
      most = std::max(most, std::abs(after.displacement));
      // a peak between exceeds its ends by less than their velocities take it in half of the step
      const double reach = std::max(std::abs(state.displacement), std::abs(after.displacement)) +
                           length * std::max(std::abs(state.velocity), std::abs(after.velocity));
      if ((state.velocity < 0) != (after.velocity < 0) && reach > most)
        most = std::max(most, peak_within(oscillator, part, length, state));
      state = after;
    }
  };
  std::for_each(pieces.begin(), pieces.end(), follow);
  follow({period, 0, 0});  // the free vibration that is left has its peak within half a period
  return most;
}

}  // namespace

std::vector<LinearPiece> acceleration_pieces(const GroundMotion& motion) {
  std::vector<LinearPiece> pieces;
  const double h = motion.interval;
  for (std::size_t i = 1; i < motion.acceleration.size(); ++i)
    pieces.push_back({h, motion.acceleration[i - 1], motion.acceleration[i]});
  if (motion.quantity == MotionQuantity::velocity)
    for (std::size_t i = 1; i < motion.velocity.size(); ++i) {
      const double constant = (motion.velocity[i] - motion.velocity[i - 1]) / h;
      pieces.push_back({h, constant, constant});
    }
  return pieces;
}

OscillatorState oscillator_after(const LinearPiece& piece, double time, double angular_frequency, double damping,
                                 const OscillatorState& before) {
  const Oscillator oscillator{angular_frequency, damping};
  return oscillator.after(piece, oscillator.factors(time), before);
}

std::vector<double> usual_periods(double interval) {
  constexpr int decades = 3, each = 20;
  std::vector<double> periods;
  for (int k = 0; k <= decades * each; ++k)
    if (const double period = 0.01 * std::pow(10.0, static_cast<double>(k) / each); period >= 2 * interval)
      periods.push_back(period);
  return periods;
}

std::vector<ResponseOrdinate> response_spectrum(const std::vector<LinearPiece>& pieces,
                                                const std::vector<double>& periods, double damping) {
  std::vector<ResponseOrdinate> ordinates;
  if (pieces.empty()) return ordinates;
  for (const double period : periods) {
    const double frequency = 2 * std::numbers::pi / period;
    const double displacement = largest_displacement(pieces, period, damping);
    ordinates.push_back({period, displacement, frequency * displacement, frequency * frequency * displacement});
  }
  return ordinates;
}

}  // namespace voussoir
