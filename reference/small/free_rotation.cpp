#include <gsl/gsl_errno.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "reference/require.hpp"
#include "reference/small/small.hpp"

namespace voussoir::reference {
namespace {

constexpr Require rotation_requires{"free rotation: "};

// The motion w_a = A cn u, w_b = B sn u, w_c = C dn u, u = u0 + rate t; c is the axis the angular momentum circles
// about.
struct Motion {
  int a = 0, b = 1, c = 2;
  bool steady = false;
  double amplitude_a = 0, amplitude_b = 0, amplitude_c = 0;
  double start = 0, rate = 0;
  double parameter = 0;  // m = k^2
};

double incomplete_integral(double phi, double parameter) {
  gsl_sf_result result;
  rotation_requires(gsl_sf_ellint_F_e(phi, std::sqrt(parameter), GSL_PREC_DOUBLE, &result) == GSL_SUCCESS,
                    "the start is on the middle axis, about which rotation is unstable; tilt it");
  return result.val;
}

Motion motion_of(const FreeRotation& body) {
  const auto& inertia = body.inertia;
  const auto& w = body.angular_velocity;
  for (int i = 0; i < 3; ++i) {
    rotation_requires(std::isfinite(inertia[i]) && inertia[i] > 0, "moments of inertia must be positive");
    rotation_requires(std::isfinite(w[i]), "angular velocity must be finite");
    rotation_requires(inertia[i] <= (inertia[(i + 1) % 3] + inertia[(i + 2) % 3]) * (1 + 1e-12),
                      "a moment of inertia exceeds the sum of the others; no body has such moments");
  }
  gsl_set_error_handler_off();

  // Axes from the smallest moment to the largest; then c the end whose side of the separatrix the start is on.
  std::array<int, 3> axis{0, 1, 2};
  std::sort(axis.begin(), axis.end(), [&](int i, int j) { return inertia[i] < inertia[j]; });
  const double low = inertia[axis[0]], middle = inertia[axis[1]], high = inertia[axis[2]];
  const double w_low = w[axis[0]], w_high = w[axis[2]];
  const double side = high * (high - middle) * w_high * w_high - low * (middle - low) * w_low * w_low;
  const bool about_high = high > middle && (side >= 0 || middle == low);
  Motion motion;
  motion.a = about_high ? axis[0] : axis[2];
  motion.b = axis[1];
  motion.c = about_high ? axis[2] : axis[0];

  const double i_a = inertia[motion.a], i_b = inertia[motion.b], i_c = inertia[motion.c];
  const double w_a = w[motion.a], w_b = w[motion.b], w_c = w[motion.c];
  // |2 E I_c - L^2| and |2 E I_a - L^2|, as sums without cancellation
  const double wobble = i_a * std::abs(i_c - i_a) * w_a * w_a + i_b * std::abs(i_c - i_b) * w_b * w_b;
  const double spin = i_b * std::abs(i_b - i_a) * w_b * w_b + i_c * std::abs(i_c - i_a) * w_c * w_c;
  const bool on_middle = w_a == 0 && w_c == 0;
  motion.steady = wobble == 0 || spin == 0 || on_middle;
  if (motion.steady) return motion;

  motion.amplitude_a = std::sqrt(wobble / (i_a * std::abs(i_c - i_a)));
  motion.amplitude_b = std::sqrt(wobble / (i_b * std::abs(i_c - i_b)));
  motion.amplitude_c = std::copysign(std::sqrt(spin / (i_c * std::abs(i_c - i_a))), w_c);
  motion.parameter = std::min(1.0, std::abs(i_b - i_a) * wobble / (std::abs(i_c - i_b) * spin));

  // Euler: I_b w_b' = e (I_c - I_a) w_c w_a with e the parity of (a, b, c); it gives the direction.
  const double parity = (motion.b - motion.a + 3) % 3 == 1 ? 1 : -1;
  motion.rate = std::sqrt(std::abs(i_c - i_b) * spin / (i_a * i_b * i_c)) * parity * (i_c > i_a ? 1 : -1) *
                (motion.amplitude_c > 0 ? 1 : -1);
  motion.start = incomplete_integral(std::atan2(w_b / motion.amplitude_b, w_a / motion.amplitude_a), motion.parameter);
  return motion;
}

using Quaternion = std::array<double, 4>;  // scalar first

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

// a + share * b
Quaternion sum(const Quaternion& a, double fraction, const Quaternion& b) {
  return {a[0] + fraction * b[0], a[1] + fraction * b[1], a[2] + fraction * b[2], a[3] + fraction * b[3]};
}

constexpr double largest_turn = 0.005;  // rad in a step of the attitude

}  // namespace

std::array<double, 3> free_rotation(const FreeRotation& body, double time) {
  rotation_requires(std::isfinite(time), "time must be finite");
  const Motion motion = motion_of(body);
  if (motion.steady) return body.angular_velocity;
  double sn = 0, cn = 0, dn = 0;
  const int status = gsl_sf_elljac_e(motion.start + motion.rate * time, motion.parameter, &sn, &cn, &dn);
  if (status != GSL_SUCCESS) throw std::runtime_error(std::string("free rotation: ") + gsl_strerror(status));
  std::array<double, 3> w{};
  w[motion.a] = motion.amplitude_a * cn;
  w[motion.b] = motion.amplitude_b * sn;
  w[motion.c] = motion.amplitude_c * dn;
  return w;
}

double free_rotation_period(const FreeRotation& body) {
  const Motion motion = motion_of(body);
  gsl_sf_result complete;
  if (motion.steady || motion.rate == 0 ||
      gsl_sf_ellint_Kcomp_e(std::sqrt(motion.parameter), GSL_PREC_DOUBLE, &complete) != GSL_SUCCESS)
    return std::numeric_limits<double>::infinity();
  return 4 * complete.val / std::abs(motion.rate);
}

std::array<double, 3> free_rotation_in_space(const FreeRotation& body, double time) {
  rotation_requires(time >= 0, "time must not be negative");
  double fastest = 0;
  for (int i = 0; i < 3; ++i)  // the energy bounds the velocity about each axis
    for (int k = 0; k < 3; ++k)
      fastest += body.inertia[k] / body.inertia[i] * body.angular_velocity[k] * body.angular_velocity[k];
  const auto steps = static_cast<long>(std::ceil(time * std::sqrt(fastest) / largest_turn)) + 1;
  const double h = time / static_cast<double>(steps);
  Quaternion attitude{1, 0, 0, 0};
  const auto rate = [](const Quaternion& q, const std::array<double, 3>& w) {
    return product(q, {0, w[0] / 2, w[1] / 2, w[2] / 2});
  };
  std::array<double, 3> begin = body.angular_velocity;
  for (long k = 0; k < steps; ++k) {
    const double t = h * static_cast<double>(k);
    const std::array<double, 3> middle = free_rotation(body, t + h / 2), end = free_rotation(body, t + h);
    const Quaternion one = rate(attitude, begin), two = rate(sum(attitude, h / 2, one), middle),
                     three = rate(sum(attitude, h / 2, two), middle), four = rate(sum(attitude, h, three), end);
    for (int i = 0; i < 4; ++i)
      attitude[i] += h / 6 * (one[i] + 2 * two[i] + 2 * three[i] + four[i]);
    begin = end;
  }
  const Quaternion conjugate{attitude[0], -attitude[1], -attitude[2], -attitude[3]};
  const Quaternion turned = product(product(attitude, {0, begin[0], begin[1], begin[2]}), conjugate);
  return {turned[1], turned[2], turned[3]};
}

}  // namespace voussoir::reference
