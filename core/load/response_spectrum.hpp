// Response spectrum of a ground motion: the largest displacement of a damped oscillator on the ground, by period.
#pragma once

#include <vector>

#include "core/base/ground_motion.hpp"

namespace voussoir {

// an acceleration that is linear over some time
struct LinearPiece {
  double length = 0;          // s
  double begin = 0, end = 0;  // m/s²
};

// the acceleration of the ground, one piece an interval; none if displacements were recorded
std::vector<LinearPiece> acceleration_pieces(const GroundMotion& motion);

struct OscillatorState {
  double displacement = 0, velocity = 0;  // m, m/s, relative to the ground
};

// u'' + 2 ζ ω u' + ω² u = -a(t) after a time of at most the piece's length, exact (Nigam & Jennings 1969); ω in rad/s
OscillatorState oscillator_after(const LinearPiece& piece, double time, double angular_frequency, double damping,
                                 const OscillatorState& before);

struct ResponseOrdinate {
  double period = 0;               // s
  double displacement = 0;         // m, largest relative to the ground, during the motion and after it
  double pseudo_velocity = 0;      // m/s, times ω
  double pseudo_acceleration = 0;  // m/s², times ω²
};

inline constexpr double usual_damping = 0.05;

// s: twenty a decade, from 0.01 to 10, but for those below two intervals of the values, of which these say nothing
std::vector<double> usual_periods(double interval);

// The largest displacement is that of the motion in time, not of its values: it is found within the steps. Empty
// without pieces.
std::vector<ResponseOrdinate> response_spectrum(const std::vector<LinearPiece>& pieces,
                                                const std::vector<double>& periods, double damping = usual_damping);
inline std::vector<ResponseOrdinate> response_spectrum(const GroundMotion& motion, const std::vector<double>& periods,
                                                       double damping = usual_damping) {
  return response_spectrum(acceleration_pieces(motion), periods, damping);
}

}  // namespace voussoir
