#include <cmath>

#include "reference/jointedbeam/jointedbeam.hpp"

namespace voussoir::reference {
namespace {

double span_of(const JointedBeam& beam) {
  return beam.blocks * beam.length;
}

// fractions of the height that are tried
constexpr int trials = 1000;

struct Arch {
  bool stands = false;
  double stress = 0, rise_lost = 0;  // Pa, m
};

// Equilibrium and shortening of the arch with compressed fraction `n`: rise Z0 = T (1 - 2n/3) at first, Z under load,
// greatest stress γ S²/(4 n Z), arch length S + 8 Z0²/(3 S) shortened by its mean stress over the modulus.
Arch arch(const JointedBeam& beam, double gravity, double n) {
  const double span = span_of(beam), modulus = beam.joint.normal.constant * span / (beam.blocks + 1);
  const double first = beam.height * (1 - 2 * n / 3), length = span + 8 * first * first / (3 * span);
  const double load = beam.density * beam.g * gravity * span * span / (4 * n), mean = (2.0 / 3 + n) / 3;
  // As Z² = Z0² - c/Z with c below: the rise of a shallow three-hinged arch. The greatest c is that at Z = Z0/√3.
  const double c = 3 * span / 8 * mean * load / modulus * length,
               most = 2 * first * first * first / (3 * std::sqrt(3.0));
  Arch a;
  a.stands = c <= most;
  if (!a.stands) return a;
  // the upper root of z³ - Z0² z + c = 0, by Viète
  const double rise = 2 * first / std::sqrt(3.0) * std::cos(std::acos(-c / most) / 3);
  a.stress = load / rise;
  a.rise_lost = first - rise;
  return a;
}

}  // namespace

double least_thrust(const JointedBeam& beam, double gravity, double deflection) {
  const double weight = beam.blocks * beam.density * beam.length * beam.height * beam.width * beam.g * gravity;
  return weight * span_of(beam) / (8 * (beam.height - deflection));
}

VoussoirBeam voussoir_beam(const JointedBeam& beam, double gravity) {
  VoussoirBeam best;
  int fallen = 0;
  double least = 0;
  for (int i = 1; i <= trials; ++i) {
    const double n = static_cast<double>(i) / trials;
    const Arch a = arch(beam, gravity, n);
    if (!a.stands) {
      ++fallen;
      continue;
    }
    if (best.compressed > 0 && a.stress >= least) continue;
    least = a.stress;
    best.compressed = n;
    best.thrust = 0.5 * a.stress * n * beam.height * beam.width;
    best.deflection = a.rise_lost;
  }
  best.buckling = static_cast<double>(fallen) / trials;
  return best;
}

double voussoir_beam_limit(const JointedBeam& beam, double fraction) {
  double low = 0, high = 1;
  while (voussoir_beam(beam, high).buckling < fraction)
    high *= 2;
  constexpr double width = 1e-3;  // g
  while (high - low > width) {
    const double middle = 0.5 * (low + high);
    (voussoir_beam(beam, middle).buckling < fraction ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace voussoir::reference
