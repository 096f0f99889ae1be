// Measures of a ground motion by which records are compared, and its Fourier spectrum.
#pragma once

#include <optional>
#include <vector>

#include "core/base/ground_motion.hpp"

namespace voussoir {

// m/s²: "g" in a record's unit and in Arias' intensity, whatever the gravity of a scene
inline constexpr double standard_gravity = 9.80665;

// Those of acceleration: of recorded accelerations, or of velocities, whose accelerations are constant in between.
struct AccelerationMeasures {
  double peak = 0;              // PGA, m/s², largest of the values
  double arias = 0;             // m/s: π/(2 g) ∫ a² dt
  double cav = 0;               // m/s: ∫ |a| dt
  double significant = 0;       // s, from 5 to 95 % of Arias' intensity
  double significant_from = 0;  // s after the first value
  double peak_frequency = 0;    // Hz, of the largest Fourier amplitude
};

// Integrals are exact for values that are linear in between; peaks are the largest of the values, as is usual.
struct RecordMeasures {
  std::size_t count = 0;
  double interval = 0, duration = 0;                   // s
  std::optional<AccelerationMeasures> acceleration{};  // none of recorded displacements
  std::optional<double> peak_velocity{};               // PGV, m/s
  double peak_displacement = 0;                        // PGD, m
  double end_velocity = 0, end_displacement = 0;       // m/s, m
  double taken_off = 0;                                // by the baseline's correction, over the peak before it
};
RecordMeasures measures_of(const GroundMotion& motion);

// Squared magnitude of the discrete Fourier transform of the acceleration, behind which zeros follow, from 0 Hz on.
struct FourierSpectrum {
  double step = 0;  // Hz
  std::vector<double> squares;
};
FourierSpectrum fourier_spectrum(const GroundMotion& motion);

// part of ∫ a² dt at frequencies above this one, Hz (Parseval)
double share_above(const FourierSpectrum& spectrum, double frequency);

}  // namespace voussoir
