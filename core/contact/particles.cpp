#include "core/contact/particles.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/rounding.hpp"
#include "core/potential/contact.hpp"
#include "core/potential/particle.hpp"

namespace voussoir {
namespace {

template <int Dim>
bool has_particle(const Pair<Dim>& pair) {
  return is_particle(*pair.a) || is_particle(*pair.b);
}

// m: bound of the motions of any points of the two, added up, before they touch. If they then touch, one point was
// within `way` of both; sqrt(f + 1), at most 1 there for each, was at least sqrt(v + 1) for one of the two at any point
// between them.
template <int Dim>
double proven_gap(const Pair<Dim>& pair, const PotentialContact<Dim>& found) {
  const double least = found.bound - found.rounding;
  if (!(least > 0)) return 0;
  const double above = least / (std::sqrt(1 + least) + 1);
  return above * (1 / pair.a->particle->steepness + 1 / pair.b->particle->steepness) * downwards;
}

// the least eigenvalue of a symmetric matrix across a unit vector
double least_across(const Matrix<2>& m, const Vector<2>& normal) {
  const Vector<2> t = perpendicular(normal);
  return t.dot(m * t);
}
double least_across(const Matrix<3>& m, const Vector<3>& normal) {
  const Vector<3> t = perpendicular(normal), u = normal.cross(t);
  const double half_sum = (t.dot(m * t) + u.dot(m * u)) / 2, half_difference = (t.dot(m * t) - u.dot(m * u)) / 2;
  const double mixed = t.dot(m * u);
  return half_sum - std::sqrt(half_difference * half_difference + mixed * mixed);
}

// m/rad: one over the two surfaces' curvatures at the point, summed, in the direction in which they are least. Flat
// ones (k = 0) have none: then it is this many times their size.
constexpr double farthest_walk = 1e7;

template <int Dim>
double walk_of_point(const PlacedPotential<Dim>& a, const PlacedPotential<Dim>& b, const PotentialContact<Dim>& found) {
  const PotentialDerivatives<Dim> of_a = derivatives<Dim>(a, found.point), of_b = derivatives<Dim>(b, found.point);
  const Matrix<Dim> curvatures = of_a.hessian / of_a.gradient.norm() + of_b.hessian / of_b.gradient.norm();
  const double least = least_across(curvatures, found.normal);
  return 1 / std::max(least, 1 / (farthest_walk * std::min(a.reach, b.reach)));
}

ContactStatus status_of(PotentialStatus status) {
  switch (status) {
    case PotentialStatus::separated:
      return ContactStatus::separated;
    case PotentialStatus::touching:
      return ContactStatus::touching;
    case PotentialStatus::undecided:
      return ContactStatus::undecided;
    case PotentialStatus::no_normal:
      return ContactStatus::no_normal;
    case PotentialStatus::no_answer:
      break;
  }
  return ContactStatus::centre_not_converged;
}

// A pair that touched before most likely still touches. For any other the full gap is computed, so that it is not
// needed again until the bodies have moved as far.
template <int Dim>
PotentialContact<Dim> find(const PotentialPair<Dim>& pair, bool touched, const PotentialStart<Dim>& start,
                           PotentialWorkspace<Dim>& workspace) {
  PotentialContact<Dim> found =
      resolve<Dim>(pair, touched ? PotentialQuery::overlap : PotentialQuery::least, workspace, start);
  if (touched || found.status != PotentialStatus::touching) return found;
  const int iterations = found.iterations;
  found = resolve<Dim>(pair, PotentialQuery::overlap, workspace, {found.point, found.ratio});
  found.iterations += iterations;
  return found;
}

template <int Dim>
void resolve_particles(const Pair<Dim>& pair, const ContactSettings& settings, Contact<Dim>& contact,
                       KernelCounters& counters) {
  static thread_local PotentialWorkspace<Dim> workspace;
  const Vector<Dim>&centre_a = pair.a->centre, &centre_b = pair.b->centre;
  const PotentialPair<Dim> seen{&pair.a->particle->shape, &pair.b->particle->shape, pair.rotation,
                                pair.offset + pair.rotation * centre_b - centre_a};
  const bool warm = contact.proof.kind == ProofKind::least_point;
  PotentialStart<Dim> start;
  if (warm) start = {contact.proof.point - centre_a, contact.proof.support};
  PotentialContact<Dim> found = find<Dim>(seen, contact.touching(), start, workspace);
  counters.newton_iterations += found.iterations;
  if (!warm || found.status == PotentialStatus::no_answer) ++counters.cold_starts;
  if (warm && found.status == PotentialStatus::no_answer) {
    found = find<Dim>(seen, contact.touching(), {}, workspace);
    counters.newton_iterations += found.iterations;
  }

  contact.status = status_of(found.status);
  if (contact.status == ContactStatus::undecided) ++counters.undecided;
  contact.proof = {};
  contact.proof.kind = ProofKind::least_point;
  contact.proof.point = found.point + centre_a;
  contact.proof.support = found.ratio;
  contact.proof.margin = proven_gap(pair, found);
  contact.geometry = {};
  if (!contact.touching()) return;
  contact.geometry.point = pair.axes * contact.proof.point;
  contact.geometry.normal = pair.axes * found.normal;
  contact.geometry.overlap = found.overlap;
  // A force with a potential: of a stiffness k the force k δ ρ and the energy k δ²/2 (core/potential/contact.hpp) are
  // those of an overlap δ/ρ on a spring of k ρ².
  if (settings.normal == ContactNormal::multipliers) {
    contact.geometry.overlap = found.energy_overlap / found.energy_rate;
    contact.geometry.stiffness_factor = found.energy_rate * found.energy_rate;
  }
  contact.proof.axis = found.normal;
  contact.proof.margin = walk_of_point(workspace.a, workspace.b, found);
}

}  // namespace

template <int Dim>
void narrow_phase_with_particles(std::span<const Pair<Dim>> pairs, const ContactSettings& settings,
                                 const Solvers<Dim>& solvers, std::span<Contact<Dim>* const> contacts,
                                 KernelCounters& counters) {
  for (std::size_t from = 0, to = 0; from < pairs.size(); from = to) {
    if (has_particle(pairs[from])) {
      ++counters.evaluations;
      resolve_particles(pairs[from], settings, *contacts[from], counters);
      to = from + 1;
      continue;
    }
    for (to = from + 1; to < pairs.size() && !has_particle(pairs[to]);)
      ++to;
    narrow_phase<Dim>(pairs.subspan(from, to - from), settings, solvers, contacts.subspan(from, to - from), counters);
  }
}

template void narrow_phase_with_particles<2>(std::span<const Pair<2>>, const ContactSettings&, const Solvers<2>&,
                                             std::span<Contact<2>* const>, KernelCounters&);
template void narrow_phase_with_particles<3>(std::span<const Pair<3>>, const ContactSettings&, const Solvers<3>&,
                                             std::span<Contact<3>* const>, KernelCounters&);

}  // namespace voussoir
