// Times at which output is due: the multiples of an interval.
#pragma once

#include <cmath>

namespace voussoir {

// Of an interval: a time is reached if rounding alone keeps it short.
constexpr double rounding_of_interval = 1e-6;

inline bool is_reached(double time, double due, double interval) {
  return time >= due - rounding_of_interval * interval;
}

// the first multiple after a time
inline double next_multiple(double time, double interval) {
  return (std::floor(time / interval + rounding_of_interval) + 1) * interval;
}

}  // namespace voussoir
