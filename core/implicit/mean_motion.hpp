// Motion of a rigid body over one implicit step by its mean velocity and spin: the midpoint rule, with Cayley's
// rotation.
//
//   x1 = x0 + h v,  M (v1 - v0) = h Σ f,  v = (v0 + v1)/2
//   Λ1 = cay(h w) Λ0, W = J⁻¹ (P0 + P1)/2 in the body, w in space,  Λ1 P1 - Λ0 P0 = h Σ r × f
//
// where cay(h w) turns by 2 atan(h|w|/2). The velocity of a point at the mean of its arms before and after the step,
// r = (r0 + r1)/2, is then exactly its displacement over h: v + w × r. So the work of forces is exact, and a pair's
// moments cancel (Simo & Wong 1991, IJNME 31, 19).
#pragma once

#include "core/model/bodies_state.hpp"
#include "core/model/model.hpp"

namespace voussoir {

template <int Dim>
struct MeanMotion {
  Vector<Dim> velocity = Vector<Dim>::Zero();  // m/s
  Spin<Dim> spin = Spin<Dim>::Zero();          // rad/s, world axes
};

// rad: the rotation vector of a Cayley turn
template <int Dim>
Spin<Dim> turn_of_step(const Spin<Dim>& spin, double h);

// Change of a body's moment of momentum in space, N m s, and its derivative by the mean spin.
template <int Dim>
struct SpinChange {
  Spin<Dim> change;
  FixedMatrix<spin_freedoms<Dim>, spin_freedoms<Dim>> by_spin;
};
template <int Dim>
SpinChange<Dim> spin_change(const Body<Dim>& body, const Motion<Dim>& before, const Spin<Dim>& spin, double h);

// the motion at the end of the step, or at its half, where velocities are those of the start
template <int Dim>
Motion<Dim> motion_after(const Body<Dim>& body, const Motion<Dim>& before, const MeanMotion<Dim>& mean, double h);
template <int Dim>
Motion<Dim> motion_at_half(const Motion<Dim>& before, const MeanMotion<Dim>& mean, double h);

// its moments of inertia about the world's axes, kg m²
template <int Dim>
FixedMatrix<spin_freedoms<Dim>, spin_freedoms<Dim>> world_inertia(const Body<Dim>& body, const Rotation<Dim>& rotation);

// J, with its moment of momentum
template <int Dim>
double kinetic_energy(const Body<Dim>& body, const Motion<Dim>& motion);

}  // namespace voussoir
