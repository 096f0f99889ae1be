#include "reference/tunnel/ring_moment.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/require.hpp"

namespace voussoir::reference {
namespace {

using std::numbers::pi;

constexpr Require ring_requires{"ring: "};

void check(double pressure, double radius) {
  ring_requires(std::isfinite(pressure), "pressure must be finite, in Pa");
  ring_requires(std::isfinite(radius) && radius > 0, "radius must be positive, in m");
}

}  // namespace

MemberForces ring_under_vertical_pressure(double pressure, double radius, double angle_from_crown) {
  check(pressure, radius);
  const double sine = std::sin(angle_from_crown);
  return {pressure * radius * radius / 4 * std::cos(2 * angle_from_crown), pressure * radius * sine * sine};
}

MemberForces polygon_under_pressure(double pressure, double circumradius, int sides, double fraction) {
  check(pressure, circumradius);
  ring_requires(sides >= 3, "a polygon needs at least 3 sides");
  ring_requires(fraction >= 0 && fraction <= 1, "fraction along the side must be in 0..1");
  const double length = 2 * circumradius * std::sin(pi / sides);
  return {pressure * length * length * (fraction * (1 - fraction) / 2 - 1.0 / 12),
          pressure * circumradius * std::cos(pi / sides)};
}

double pressure_from_moments(const std::vector<double>& position, const std::vector<double>& moment) {
  ring_requires(position.size() == moment.size() && position.size() >= 3,
                "give at least three positions and as many moments");
  const auto count = static_cast<Eigen::Index>(position.size());
  // Centred and scaled: a parabola far from the origin is badly conditioned.
  const auto [low, high] = std::minmax_element(position.begin(), position.end());
  const double middle = (*low + *high) / 2, half = (*high - *low) / 2;
  ring_requires(half > 0, "positions must differ");
  Eigen::MatrixXd powers(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double x = (position[static_cast<std::size_t>(i)] - middle) / half;
    powers.row(i) << 1, x, x * x;
  }
  const auto factors = powers.colPivHouseholderQr();
  ring_requires(factors.rank() == 3, "at least three positions must differ");
  const Eigen::Vector3d fit = factors.solve(Eigen::Map<const Eigen::VectorXd>(moment.data(), count));
  return -2 * fit(2) / (half * half);
}

std::vector<double> ring_moments(const std::vector<double>& pressure, double radius) {
  ring_requires(pressure.size() >= 4, "give pressures at four or more angles");
  for (const double p : pressure)
    check(p, radius);
  const int count = static_cast<int>(pressure.size());
  std::vector<double> moment(pressure.size(), 0.0);
  for (int n = 2; 2 * n <= count; ++n) {
    double cosine_part = 0, sine_part = 0;
    for (int k = 0; k < count; ++k) {
      cosine_part += pressure[k] * std::cos(2 * pi * n * k / count);
      sine_part += pressure[k] * std::sin(2 * pi * n * k / count);
    }
    const double weight = (2 * n == count ? 1.0 : 2.0) / count * radius * radius / (n * n - 1.0);
    for (int k = 0; k < count; ++k)
      moment[k] +=
          weight * (cosine_part * std::cos(2 * pi * n * k / count) + sine_part * std::sin(2 * pi * n * k / count));
  }
  return moment;
}

}  // namespace voussoir::reference
