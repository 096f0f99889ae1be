#include "reference/tunnel/bedded_arc.hpp"

#include <gsl/gsl_poly.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace voussoir::reference {
namespace {

using Complex = std::complex<double>;

struct Numbers {
  double e, k, ks, g;  // as in the header
};

Numbers numbers_of(const BeddedArc& arc) {
  const double a2 = arc.radius * arc.radius, per_axial = a2 / arc.axial_stiffness;
  return {arc.bending_stiffness / (arc.axial_stiffness * a2), arc.normal_stiffness * per_axial,
          arc.shear_stiffness * per_axial, arc.weight * per_axial};
}

// roots of a monic cubic
std::array<Complex, 3> roots(double c2, double c1, double c0) {
  std::array<gsl_complex, 3> z;
  gsl_poly_complex_solve_cubic(c2, c1, c0, &z[0], &z[1], &z[2]);
  std::array<Complex, 3> found;
  std::ranges::transform(z, found.begin(),
                         [](const gsl_complex& root) { return Complex(GSL_REAL(root), GSL_IMAG(root)); });
  return found;
}

// w - u', w" + u' and its derivative at an angle
struct Strains {
  Complex axial, bending, bending_slope;
};

// cosh λθ, R sinh λθ, divided by cosh λθ0, so that stiff modes stay finite
Strains of_mode(const Numbers& n, Complex lambda, double angle, double end) {
  const Complex scale = 1.0 / std::cosh(lambda * end), even = std::cosh(lambda * angle) * scale,
                odd = std::sinh(lambda * angle) * scale, square = lambda * lambda;
  const Complex ratio = (1 + n.k + n.e * square * square) / (lambda * (1.0 - n.e * square));
  return {(1.0 - ratio * lambda) * even, (square + ratio * lambda) * even, (square * lambda + ratio * square) * odd};
}

Strains of_weight(const Numbers& n, double angle) {
  Eigen::Matrix2d matrix;
  matrix << 1 + n.e + n.k, -(1 + n.e), -(1 + n.e), 1 + n.e + n.ks;
  const Eigen::Vector2d solution = matrix.inverse() * Eigen::Vector2d(-n.g, -n.g);
  const double apart = solution[0] - solution[1];
  return {apart * std::cos(angle), -apart * std::cos(angle), apart * std::sin(angle)};
}

}  // namespace

MemberForces bedded_arc(const BeddedArc& arc, double angle) {
  const Numbers n = numbers_of(arc);
  const std::array<Complex, 3> squares = roots(2 - n.ks, ((1 + n.k) * (1 + n.e) - 1) / n.e, -(1 + n.k) * n.ks / n.e);
  Eigen::Matrix3cd ends;
  Eigen::Vector3cd lambda;
  for (int j = 0; j < 3; ++j) {
    lambda[j] = std::sqrt(squares[j]);
    const Strains mode = of_mode(n, lambda[j], arc.half_angle, arc.half_angle);
    ends.col(j) << mode.axial, mode.bending, mode.bending_slope;
  }
  const Strains load = of_weight(n, arc.half_angle);
  const Eigen::Vector3cd shares =
      ends.fullPivLu().solve(Eigen::Vector3cd(-load.axial, -load.bending, -load.bending_slope));
  Strains sum = of_weight(n, angle);
  for (int j = 0; j < 3; ++j) {
    const Strains mode = of_mode(n, lambda[j], angle, arc.half_angle);
    sum.axial += shares[j] * mode.axial;
    sum.bending += shares[j] * mode.bending;
  }
  // a curvature that grows is tension outside: no sagging
  return {-sum.bending.real() * arc.bending_stiffness / (arc.radius * arc.radius),
          sum.axial.real() * arc.axial_stiffness / arc.radius};
}

double sliding_arc_thrust(const BeddedArc& arc, double angle) {
  return arc.weight * arc.radius * (std::cos(angle) - std::cos(arc.half_angle));
}

}  // namespace voussoir::reference
