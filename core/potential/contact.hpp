// The contact of two potential particles (Boon 2013, Eq. A.3): minimise f_A + f_B subject to f_A = f_B, which is
//   v = min over x of max(f_A, f_B) = max over λ of min over x of λ f_A + (1 - λ) f_B,   0 <= λ <= 1.
// v < 0: they overlap, and the least point is the contact point, where λ ∇f_A = -(1 - λ) ∇f_B.
// Every λ and x give two bounds: max(f_A, f_B) at x from above, the weighted sum's least value from below. They prove
// the decision and show how near the result is.
#pragma once

#include "core/potential/descent.hpp"

namespace voussoir {

// Two particles in the frame of the first.
template <int Dim>
struct PotentialPair {
  const PotentialShape<Dim>* a = nullptr;
  const PotentialShape<Dim>* b = nullptr;
  Matrix<Dim> rotation = Matrix<Dim>::Identity();  // frame of the second -> frame of the first
  Vector<Dim> offset = Vector<Dim>::Zero();        // origin of the second in the frame of the first, m
};

enum class PotentialQuery {
  decision,  // touching or not, as soon as it is proven
  least,     // and the least point of both, also if they do not touch
  overlap    // as `decision`, and if they touch point, normal and overlap
};

enum class PotentialStatus {
  separated,  // proven: the bound from below is above zero by more than rounding
  touching,   // proven: the point lies inside both by more than rounding
  undecided,  // nearer to touching than rounding resolves: no contact
  no_normal,  // touching, but the gradients vanish at the point (one centre on the other)
  no_answer   // the iteration did not end; it must not be taken for separated
};

// frame of the first body
template <int Dim>
struct PotentialContact {
  PotentialStatus status = PotentialStatus::no_answer;
  Vector<Dim> point = Vector<Dim>::Zero();   // m
  double ratio = 1;                          // λ / (1 - λ)
  double value = 0;                          // max(f_A, f_B) at the point: v from above
  double bound = 0;                          // v from below; value - bound is the duality gap
  double rounding = 0;                       // of both
  Vector<Dim> normal = Vector<Dim>::Zero();  // unit, from the first to the second: mean of the gradients' directions
  double overlap = 0;                        // between the surfaces along the normal through the point, m
  double energy_overlap = 0;                 // of a force with a potential, see below, m
  double energy_rate = 0;                    // by which that overlap falls as the bodies part along the normal
  int iterations = 0;                        // Newton's, of which each takes one factorisation
};

// The conservative overlap. The bracketed overlap's force has no potential: the overlap depends on the point, and the
// force has no term for this. The pair's value has one: by the envelope theorem it changes as if the least point and λ
// were fixed, so that U = k δ(v)² / 2 acts at the contact point, along the same normal, by k δ (-dδ/dn). With
//   δ(v) = S (1 - sqrt(1 + v)),   -dδ/dn = S |λ ∇f_A| / (2 sqrt(1 + v)),   S = length of A + length of B
// it is the true overlap between spheres, and at k = 0 between faces and right-angled features (energy_scale).
// The force on the second body, N, along the normal, for a stiffness in N/m; and the energy, J.
template <int Dim>
double conservative_force(const PotentialContact<Dim>& contact, double stiffness) {
  return stiffness * contact.energy_overlap * contact.energy_rate;
}
template <int Dim>
double conservative_energy(const PotentialContact<Dim>& contact, double stiffness) {
  return stiffness * contact.energy_overlap * contact.energy_overlap / 2;
}

// A shape's part of S, m: the distance of the surface beyond one face from the point at which sqrt(f + 1) would vanish,
// on a straight line; halfway out to the sphere, |x - c|² = R² / 2. r at k = 0, R at k = 1.
template <int Dim>
double energy_scale(const PotentialShape<Dim>& shape);

// the start: the point in the first body's frame and the ratio of the step before
template <int Dim>
struct PotentialStart {
  Vector<Dim> point = Vector<Dim>::Zero();
  double ratio = 0;  // 0: no start
};

// memory that is kept from one pair to the next
template <int Dim>
struct PotentialWorkspace {
  PlacedPotential<Dim> a, b;            // the pair's, in the frame of the first: valid until the next pair
  PlacedPotential<Dim> near_a, near_b;  // with only the planes that count around the contact
  RayScratch ray;
  std::vector<double> columns;
};

// Both shapes are valid (core/potential/valid_shape.hpp) and the offset is finite. For k = 0 of both the least point
// need not be unique; the value is.
template <int Dim>
PotentialContact<Dim> resolve(const PotentialPair<Dim>& pair, PotentialQuery query, PotentialWorkspace<Dim>& workspace,
                              const PotentialStart<Dim>& start = {});

}  // namespace voussoir
