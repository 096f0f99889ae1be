// Random numbers that are the same on every platform: Boost's Mersenne twister (its sequence is defined bit by bit),
// and transformations that use IEEE arithmetic and `portable_math` only. No distribution of a library is used: no
// standard fixes their algorithms.
#pragma once

#include <boost/random/mersenne_twister.hpp>
#include <cstdint>
#include <string_view>

#include "core/geometry/types.hpp"

namespace voussoir {

class RandomStream {
 public:
  // Streams of different names are independent although their seed is one.
  RandomStream(std::uint64_t seed, std::string_view name);

  // the middle of one of 2^52 equal cells of (0, 1): never 0, never 1
  double uniform();

  // mean 1: -log u
  double exponential();

  // mean 0, deviation 1: the first of a pair by Marsaglia's polar method; the second is thrown away, so that the next
  // number never depends on how many were drawn before
  double normal();

  // The number of points of a Poisson process in an interval of this length, by its exponential gaps: exact at any
  // mean, in time that grows with it.
  long long poisson(double mean);

  // uniform in the unit ball, on the unit circle; by rejection
  template <int Dim>
  Vector<Dim> in_ball();
  Vector<2> on_circle();

 private:
  boost::random::mt19937_64 engine_;
};

}  // namespace voussoir
