#include "core/support/beam.hpp"

#include <cmath>
#include <numbers>

namespace voussoir {

namespace {

using BeamVector = FixedMatrix<6, 1>;

// the derivatives by the six degrees of freedom, for a chord along `along`, of its length, and of its turn times its
// length
BeamVector lengthening(const Vector<2>& along) {
  return (BeamVector() << -along, 0, along, 0).finished();
}
BeamVector turning(const Vector<2>& along) {
  return (BeamVector() << along[1], -along[0], 0, -along[1], along[0], 0).finished();
}

}  // namespace

BeamStrain beam_strain(const Beam& beam, const BeamNode& first, const BeamNode& second) {
  const Vector<2>& c = beam.chord;
  const Vector<2> d = second.displacement - first.displacement;
  const Vector<2> chord = c + d;
  const double rest = c.norm();

  BeamStrain strain;
  strain.length = chord.norm();
  if (!(strain.length > 0)) return strain;
  strain.along = chord / strain.length;
  // l² - L² = 2 c·d + d·d: nothing cancels when d is small
  strain.elongation = (2 * c.dot(d) + d.dot(d)) / (strain.length + rest);

  // c × (c + d) = c × d: a small turn is as accurate as d
  const double turn = std::atan2(c[0] * d[1] - c[1] * d[0], c.dot(chord));
  constexpr double full = 2 * std::numbers::pi;
  const double mean = 0.5 * (first.rotation + second.rotation);
  const double turns = full * std::floor((mean - turn) / full + 0.5);
  strain.end_rotation = {first.rotation - turns - turn, second.rotation - turns - turn};
  return strain;
}

BeamForces beam_forces(const Beam& beam, const BeamStrain& strain) {
  BeamForces result;
  if (!(strain.length > 0)) return result;
  const double rest = beam.chord.norm(), stretch = beam.axial_stiffness / rest, bend = beam.bending_stiffness / rest;
  const auto& [t1, t2] = strain.end_rotation;
  const double m1 = bend * (4 * t1 + 2 * t2), m2 = bend * (2 * t1 + 4 * t2);
  result.normal_force = -stretch * strain.elongation;
  result.end_moment = {m1, m2};
  result.shear_force = (m1 + m2) / strain.length;
  result.energy = 0.5 * (stretch * strain.elongation * strain.elongation + m1 * t1 + m2 * t2);

  const Vector<2>& e = strain.along;
  const Vector<2> left(-e[1], e[0]);
  result.force[1] = result.normal_force * e + result.shear_force * left;
  result.force[0] = -result.force[1];
  result.moment = {-m1, -m2};
  return result;
}

BeamMatrix beam_tangent(const Beam& beam, const BeamStrain& strain) {
  if (!(strain.length > 0)) return BeamMatrix::Zero();
  const BeamForces now = beam_forces(beam, strain);
  const double rest = beam.chord.norm(), stretch = beam.axial_stiffness / rest, bend = beam.bending_stiffness / rest;
  const BeamVector r = lengthening(strain.along), z = turning(strain.along);
  BeamVector t1 = -z / strain.length, t2 = t1;  // change of the end rotations
  t1[2] += 1;
  t2[5] += 1;

  const auto product = [](const BeamVector& a, const BeamVector& b) -> BeamMatrix {
    return a.lazyProduct(b.transpose());
  };
  const BeamMatrix mixed = product(t1, t2), turned = product(r, z);
  // by the material, then by the forces: ∂²l = z zᵀ/l and ∂²α = -(r zᵀ + z rᵀ)/l²
  BeamMatrix k = stretch * product(r, r);
  k += bend * (4 * (product(t1, t1) + product(t2, t2)) + 2 * (mixed + mixed.transpose()));
  k += now.shear_force / strain.length * (turned + turned.transpose());
  k -= now.normal_force / strain.length * product(z, z);
  return k;
}

double largest_eigenvalue_bound(const BeamMatrix& stiffness, const std::array<BeamInertia, 2>& nodes) {
  BeamVector moves;  // 1/√kg, 1/√(kg m²); 0 if it is held
  for (int i = 0; i < 6; ++i) {
    const BeamInertia& node = nodes[i / 3];
    const double inertia = i % 3 == 2 ? node.inertia : node.mass;
    moves[i] = inertia > 0 ? 1 / std::sqrt(inertia) : 0;
  }
  BeamMatrix s = moves.asDiagonal() * stiffness * moves.asDiagonal();
  const double size = s.norm();
  if (!(size > 0)) return 0;
  // the 32nd root of the sum of the eigenvalues' 32nd powers: compressed beams have negative ones too
  s /= size;
  for (int power = 1; power < 16; power *= 2)
    s = BeamMatrix(s.lazyProduct(s));
  double root = s.squaredNorm();
  for (int power = 1; power < 32; power *= 2)
    root = std::sqrt(root);
  return size * root;
}

}  // namespace voussoir
