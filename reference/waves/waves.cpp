#include "reference/waves/waves.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace voussoir::reference {
namespace {

double half_phase(double blocks) {
  return std::numbers::pi / blocks;
}

}  // namespace

double BlockChain::speed() const {
  return std::sqrt(stiffness * spacing / density);
}
double BlockChain::impedance() const {
  return density * speed();
}
double BlockChain::angular_frequency(double blocks) const {
  return 2 * std::sqrt(stiffness / (density * spacing)) * std::sin(half_phase(blocks));
}
double BlockChain::group_speed(double blocks) const {
  return speed() * std::cos(half_phase(blocks));
}

double returned_by_full_block(double blocks, double dashpot) {
  const std::complex<double> turn = std::polar(1.0, half_phase(blocks));
  return std::abs(dashpot - std::conj(turn)) / std::abs(dashpot + turn);
}
double returned_by_half_block(double blocks, double dashpot) {
  const double c = std::cos(half_phase(blocks));
  return std::abs(dashpot - c) / (dashpot + c);
}
double returned_through_half_joint(double blocks, double dashpot) {
  const double c = dashpot * std::cos(half_phase(blocks));
  return std::abs(1 - c) / (1 + c);
}

double free_surface(double blocks) {
  return 2 * std::cos(half_phase(blocks));
}

double base_under_wave(double blocks) {
  return 2 / (1 + std::cos(half_phase(blocks)));
}

double passed_by_joint(double blocks, double ratio) {
  return 1 / std::hypot(1, (1 / ratio - 1) * std::tan(half_phase(blocks)));
}

double SquareGrid::shear_speed() const {
  return std::sqrt(shear_stiffness * side / (2 * density));
}

std::vector<double> surface_of_column(const SquareGrid& grid, const std::vector<double>& upgoing, double step) {
  const int n = grid.blocks;
  const double a = grid.side, ks = grid.shear_stiffness * a, bend = grid.normal_stiffness * a * a * a / 12;
  const double mass = grid.density * a * a, inertia = mass * a * a / 6, c = grid.density * grid.shear_speed() * a;
  std::vector<double> u(n, 0), turn(n, 0), v(n, 0), spin(n, 0), found;
  double plate = 0, face_before = 0;
  for (std::size_t i = 0; i < upgoing.size(); ++i) {
    std::vector<double> force(n, 0), moment(n, 0);
    for (int j = 0; j < n; ++j)
      moment[j] -= ks * a * a * turn[j];  // two sides, each with a lever of a/2
    for (int j = 0; j + 1 < n; ++j) {
      const double shear = ks * (u[j + 1] - u[j] + 0.5 * a * (turn[j + 1] + turn[j]));
      const double couple = bend * (turn[j + 1] - turn[j]);
      force[j] += shear;
      force[j + 1] -= shear;
      moment[j] += couple - 0.5 * a * shear;
      moment[j + 1] -= couple + 0.5 * a * shear;
    }
    // the plate moves over the step before, with the face half-way
    const double face = u[0] + 0.5 * a * turn[0], stiffness = 2 * ks, y = 0.5 * step * stiffness / c;
    if (i > 0) plate = (plate * (1 - y) + 2 * y * 0.5 * (face + face_before) + 2 * step * upgoing[i - 1]) / (1 + y);
    face_before = face;
    const double on_base = -stiffness * (face - plate);
    force[0] += on_base;
    moment[0] += 0.5 * a * on_base;
    for (int j = 0; j < n; ++j) {
      v[j] += (i == 0 ? 0.5 : 1) * step * force[j] / mass;
      spin[j] += (i == 0 ? 0.5 : 1) * step * moment[j] / inertia;
      u[j] += step * v[j];
      turn[j] += step * spin[j];
    }
    found.push_back(v[n - 1]);
  }
  return found;
}

}  // namespace voussoir::reference
