#include "reference/tunnel/lining.hpp"

#include <cmath>
#include <string>

#include "reference/require.hpp"
#include "reference/tunnel/bolted_ring.hpp"

namespace voussoir::reference {
namespace {

constexpr Require lining_requires{"lining: "};

void require_positive(double value, const std::string& name) {
  lining_requires(std::isfinite(value) && value > 0, name + " must be positive and finite");
}

}  // namespace

double lining_hoop_force(const SoftLining& lining) {
  require_positive(lining.radius, "radius");
  require_positive(lining.shear_modulus, "shear modulus");
  require_positive(lining.lining_modulus, "lining modulus");
  require_positive(lining.lining_thickness, "lining thickness");
  require_positive(lining.interface_stiffness, "interface stiffness");
  lining_requires(std::isfinite(lining.in_situ_pressure), "in-situ pressure must be finite");
  lining_requires(std::abs(lining.lining_poisson_ratio) < 1, "lining Poisson's ratio must be between -1 and 1");
  const double flexibility = lining.radius * (1 - lining.lining_poisson_ratio * lining.lining_poisson_ratio) /
                                 (lining.lining_modulus * lining.lining_thickness) +
                             1 / (lining.interface_stiffness * lining.radius);
  const double modulus =
      modulus_of_held_rock(lining.shear_modulus, lining.ground_poisson_ratio, lining.radius, lining.fixed_radius);
  return lining.in_situ_pressure * lining.radius / (1 + 2 * modulus * flexibility);
}

RingLiningForces ring_lining(const RingLining& lining, LiningContact contact) {
  require_positive(lining.radius, "radius");
  require_positive(lining.ground_modulus, "ground modulus");
  require_positive(lining.lining_modulus, "lining modulus");
  require_positive(lining.lining_area, "lining area");
  require_positive(lining.lining_inertia, "lining inertia");
  lining_requires(std::isfinite(lining.vertical_stress) && std::isfinite(lining.horizontal_ratio),
                  "vertical stress and horizontal ratio must be finite");
  lining_requires(lining.ground_poisson_ratio >= 0 && lining.ground_poisson_ratio < 0.5,
                  "ground Poisson's ratio must be in 0..0.5, 0.5 excluded");
  lining_requires(std::abs(lining.lining_poisson_ratio) < 1, "lining Poisson's ratio must be between -1 and 1");

  const double nu = lining.ground_poisson_ratio, radius = lining.radius;
  const double modulus_ratio = lining.ground_modulus * (1 - lining.lining_poisson_ratio * lining.lining_poisson_ratio) /
                               (lining.lining_modulus * (1 - nu * nu));
  const double c = modulus_ratio * radius / lining.lining_area;
  const double f = modulus_ratio * radius * radius * radius / lining.lining_inertia;
  const double mean = 0.5 * (1 + lining.horizontal_ratio) * lining.vertical_stress * radius;
  const double wave = 0.5 * (1 - lining.horizontal_ratio) * lining.vertical_stress * radius;
  const double a0 = c * f * (1 - nu) / (c + f + c * f * (1 - nu));

  if (contact == LiningContact::full_slip) {
    const double a2 = (f + 6) * (1 - nu) / (2 * f * (1 - nu) + 6 * (5 - 6 * nu));
    return {mean * (1 - a0), wave * (1 - 2 * a2), wave * radius * (1 - 2 * a2)};
  }
  const double beta = ((6 + f) * c * (1 - nu) + 2 * f * nu) / (3 * f + 3 * c + 2 * c * f * (1 - nu));
  const double b2 = c * (1 - nu) / (2 * (c * (1 - nu) + 4 * nu - 6 * beta - 3 * beta * c * (1 - nu)));
  const double a2 = beta * b2;
  return {mean * (1 - a0), wave * (1 + 2 * a2), 0.5 * wave * radius * (1 - 2 * a2 + 2 * b2)};
}

double thrust_at(const RingLiningForces& forces, double angle_from_crown) {
  return forces.thrust_mean - forces.thrust_wave * std::cos(2 * angle_from_crown);
}

double moment_at(const RingLiningForces& forces, double angle_from_crown) {
  return forces.moment_wave * std::cos(2 * angle_from_crown);
}

}  // namespace voussoir::reference
