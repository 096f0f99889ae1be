#include "core/joint_sets/random_stream.hpp"

#include <cmath>

#include "core/joint_sets/portable_math.hpp"

namespace voussoir {
namespace {

// FNV-1a over the name, started from the seed; then SplitMix64's finaliser, so that near seeds are far apart
std::uint64_t mixed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325 ^ seed;
  for (const char character : name)
    hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111eb;
  return hash ^ (hash >> 31);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name) : engine_(mixed(seed, name)) {}

double RandomStream::uniform() {
  // an odd number of 54 bits is rounded above 1/2, and the highest to 1: 52 bits and the half are exact
  return (static_cast<double>(engine_() >> 12) + 0.5) * 0x1p-52;
}

double RandomStream::exponential() {
  return -portable::log(uniform());
}

double RandomStream::normal() {
  while (true) {
    const double x = 2 * uniform() - 1, y = 2 * uniform() - 1, square = x * x + y * y;
    if (square < 1 && square > 0) return x * std::sqrt(-2 * portable::log(square) / square);
  }
}

long long RandomStream::poisson(double mean) {
  long long count = 0;
  for (double at = exponential(); at < mean; at += exponential())
    ++count;
  return count;
}

template <int Dim>
Vector<Dim> RandomStream::in_ball() {
  while (true) {
    Vector<Dim> point;
    for (int k = 0; k < Dim; ++k)
      point[k] = 2 * uniform() - 1;
    if (point.squaredNorm() < 1) return point;
  }
}

Vector<2> RandomStream::on_circle() {
  while (true) {
    const Vector<2> point = in_ball<2>();
    const double length = point.norm();
    if (length > 0) return point / length;
  }
}

template Vector<2> RandomStream::in_ball<2>();
template Vector<3> RandomStream::in_ball<3>();

}  // namespace voussoir
