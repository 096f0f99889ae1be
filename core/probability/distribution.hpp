// Laws of scattering numbers. A value belongs to a standard normal z by x = F^-1(Φ(z)), F the law's distribution
// function; both tails keep their digits.
#pragma once

#include <limits>
#include <optional>

#include "core/joint_sets/random_stream.hpp"

namespace voussoir {

// seed: a whole number, 0 <= x < 1e15, each as likely; it has no order
enum class Law { normal, lognormal, uniform, triangular, exponential, seed };

// Mean and deviation are those of the law before it is cut to least..most; the exponential law begins at 0 and has a
// mean alone. Uniform and triangular laws have least, most and mode only.
struct Distribution {
  Law law = Law::normal;
  double mean = 0, deviation = 0, mode = 0;
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();

  // an end takes values away from the law
  bool is_cut() const;
};

// the value of a standard normal, from the nearer tail of the cut law: F = (F₀ - F₀(least))/(F₀(most) - F₀(least))
double value_at(const Distribution& distribution, double z);

// its inverse; least < x < most
double standard_at(const Distribution& distribution, double x);

// A value drawn from the stream, again until it lies from least to most, at most 10,000 times; none: it hardly ever
// does. The same law as value_at's, but other numbers than F^-1(Φ(z)).
std::optional<double> draw(const Distribution& distribution, RandomStream& stream);

// of the cut law
struct TwoMoments {
  double mean = 0, deviation = 0;
};
TwoMoments moments_of_cut(const Distribution& distribution);

}  // namespace voussoir
