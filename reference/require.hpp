#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

namespace voussoir::reference {

// Refuses input for which a closed form does not hold: `constexpr Require require{"wedge: "};`, then
// `require(height > 0, "height must be positive")`.
struct Require {
  const char* subject;

  void operator()(bool holds, const std::string& message) const {
    if (!holds) throw std::invalid_argument(subject + message);
  }
};

inline bool positive(double value) {
  return std::isfinite(value) && value > 0;
}

}  // namespace voussoir::reference
