#include <gsl/gsl_sf_ellint.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/small/small.hpp"

namespace voussoir::reference {
namespace {

// nearer to balance the modulus rounds to one, and the time to infinity
constexpr double least_lean = 1e-6;

}  // namespace

double fall_over_time(const FallOver& block, double lean) {
  if (!(block.mass > 0 && block.inertia > 0 && block.arm > 0 && block.gravity > 0))
    throw std::invalid_argument("fall_over_time: mass, inertia, arm and gravity must be positive");
  if (!(block.start >= least_lean && block.start < std::numbers::pi && lean >= block.start && lean <= std::numbers::pi))
    throw std::invalid_argument("fall_over_time: 1e-6 <= start < pi, start <= lean <= pi");
  const double rate = std::sqrt(block.mass * block.gravity * block.arm / block.inertia);
  const double modulus = std::cos(block.start / 2);
  const double amplitude = std::asin(std::min(1.0, std::cos(lean / 2) / modulus));
  return (gsl_sf_ellint_Kcomp(modulus, GSL_PREC_DOUBLE) - gsl_sf_ellint_F(amplitude, modulus, GSL_PREC_DOUBLE)) / rate;
}

}  // namespace voussoir::reference
