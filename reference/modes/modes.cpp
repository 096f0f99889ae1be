#include "reference/modes/modes.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace voussoir::reference {
namespace {

struct Measures {
  double area, inertia_of_face, mass, inertia;
};

Measures measures_of(const SwayingBlock& b) {
  const double mass = b.density * b.width * b.height;
  return {b.width, b.width * b.width * b.width / 12, mass, mass * (b.width * b.width + b.height * b.height) / 12};
}

}  // namespace

double axial_mode(int blocks, int j) {
  return 2 * std::sin((2 * j - 1) * std::numbers::pi / (2 * (2 * blocks + 1)));
}

SwayModes sway_modes(const SwayingBlock& b, bool middle_of_overlap) {
  const Measures of = measures_of(b);
  const double weight = of.mass * b.gravity, half = b.height / 2;
  const double arm = half - (middle_of_overlap ? weight / (b.normal_stiffness * of.area) / 2 : 0);
  // roots of det(K - λ M) = 0
  const double p = b.shear_stiffness * of.area / of.mass, c = p * arm;
  const double q =
      (b.shear_stiffness * of.area * arm * arm + b.normal_stiffness * of.inertia_of_face - weight * half) / of.inertia;
  const double coupling = c * b.shear_stiffness * of.area * arm / of.inertia;
  const double upper = (p + q) / 2 + std::sqrt((p - q) * (p - q) / 4 + coupling);
  return {b.normal_stiffness * of.area / of.mass, (p * q - coupling) / upper, upper};
}

double least_normal_stiffness(const SwayingBlock& b) {
  const Measures of = measures_of(b);
  return of.mass * b.gravity * b.height / 2 / of.inertia_of_face;
}

std::vector<double> bending_modes(const SwayingBlock& b, int blocks, int count) {
  const Measures of = measures_of(b);
  const double half = b.height / 2;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * blocks, 2 * blocks);
  Eigen::VectorXd root(2 * blocks);
  for (int j = 0; j < blocks; ++j) {
    Eigen::VectorXd slip = Eigen::VectorXd::Zero(2 * blocks), turn = slip;
    slip[2 * j] = 1;
    slip[2 * j + 1] = half;
    turn[2 * j + 1] = 1;
    if (j > 0) {
      slip[2 * j - 2] = -1;
      slip[2 * j - 1] = half;
      turn[2 * j - 1] = -1;
    }
    k += b.shear_stiffness * of.area * slip * slip.transpose() +
         b.normal_stiffness * of.inertia_of_face * turn * turn.transpose();
    root[2 * j] = std::sqrt(of.mass);
    root[2 * j + 1] = std::sqrt(of.inertia);
  }
  const Eigen::VectorXd inverse = root.cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(inverse.asDiagonal() * k * inverse.asDiagonal());
  std::vector<double> modes;
  for (int i = 0; i < count; ++i)
    modes.push_back(std::sqrt(solver.eigenvalues()[i]));
  return modes;
}

}  // namespace voussoir::reference
