#include "core/implicit/mean_motion.hpp"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

constexpr double small_turn = 1e-8;

// of the derivative by the spin: of a turn of one over the step
constexpr double step_of_turn = 1e-6;

bool turns_freely(const Body<3>& body) {
  return std::ranges::all_of(body.free_rotation, [](bool free) { return free; });
}

// principal axes in the world
Matrix<3> axes_of(const Body<3>& body, const Rotation<3>& rotation) {
  return matrix(rotation) * body.principal_axes;
}

Matrix<3> inertia_of(const Body<3>& body, const Rotation<3>& rotation) {
  const Matrix<3> axes = axes_of(body, rotation);
  return axes * body.inertia.asDiagonal() * axes.transpose();
}
FixedMatrix<1, 1> inertia_of(const Body<2>& body, const Rotation<2>&) {
  return FixedMatrix<1, 1>(body.inertia[0]);
}

// of a body that turns freely
Spin<3> change_of_momentum(const Body<3>& body, const Motion<3>& before, const Spin<3>& spin, double h) {
  const Matrix<3> axes = axes_of(body, before.rotation);
  const Spin<3> after = 2 * body.inertia.cwiseProduct(axes.transpose() * spin) - before.angular_momentum;
  return matrix(turned(Rotation<3>{}, turn_of_step<3>(spin, h))) * (axes * after) - axes * before.angular_momentum;
}

SpinChange<2> change_of_spin(const Body<2>& body, const Motion<2>& before, const Spin<2>& spin, double) {
  const double inertia = body.inertia[0];
  SpinChange<2> found;
  found.change = Spin<2>(2 * (inertia * spin[0] - before.angular_momentum[0]));
  found.by_spin(0, 0) = 2 * inertia;
  return found;
}

SpinChange<3> change_of_spin(const Body<3>& body, const Motion<3>& before, const Spin<3>& spin, double h) {
  SpinChange<3> found;
  if (!turns_freely(body)) {  // the free components obey the free block of the inertia
    found.by_spin = 2 * inertia_of(body, before.rotation);
    found.change = found.by_spin * (spin - angular_velocity(body, before));
    return found;
  }
  found.change = change_of_momentum(body, before, spin, h);
  const double step = step_of_turn * (spin.norm() + 1 / h);
  for (int k = 0; k < 3; ++k) {
    const Spin<3> more = spin + step * Spin<3>::Unit(k), less = spin - step * Spin<3>::Unit(k);
    found.by_spin.col(k) =
        (change_of_momentum(body, before, more, h) - change_of_momentum(body, before, less, h)) / (2 * step);
  }
  return found;
}

Spin<2> momentum_after(const Body<2>& body, const Motion<2>& before, const Rotation<2>&, const Spin<2>& spin) {
  return 2 * body.inertia[0] * spin - before.angular_momentum;
}

Spin<3> momentum_after(const Body<3>& body, const Motion<3>& before, const Rotation<3>& after, const Spin<3>& spin) {
  if (!turns_freely(body)) return angular_momentum<3>(body, after, 2 * spin - angular_velocity(body, before));
  return 2 * body.inertia.cwiseProduct(axes_of(body, before.rotation).transpose() * spin) - before.angular_momentum;
}

}  // namespace

template <int Dim>
Spin<Dim> turn_of_step(const Spin<Dim>& spin, double h) {
  const double half = 0.5 * h * spin.norm();
  return half < small_turn ? Spin<Dim>(h * spin) : Spin<Dim>(std::atan(half) / half * h * spin);
}

template <int Dim>
SpinChange<Dim> spin_change(const Body<Dim>& body, const Motion<Dim>& before, const Spin<Dim>& spin, double h) {
  return change_of_spin(body, before, spin, h);
}

template <int Dim>
Motion<Dim> motion_after(const Body<Dim>& body, const Motion<Dim>& before, const MeanMotion<Dim>& mean, double h) {
  Motion<Dim> after;
  after.displacement = before.displacement + h * mean.velocity;
  after.rotation = turned(before.rotation, turn_of_step<Dim>(mean.spin, h));
  after.velocity = 2 * mean.velocity - before.velocity;
  after.angular_momentum = momentum_after(body, before, after.rotation, mean.spin);
  return after;
}

template <int Dim>
Motion<Dim> motion_at_half(const Motion<Dim>& before, const MeanMotion<Dim>& mean, double h) {
  Motion<Dim> half = before;
  half.displacement += 0.5 * h * mean.velocity;
  half.rotation = turned(before.rotation, Spin<Dim>(0.5 * turn_of_step<Dim>(mean.spin, h)));
  return half;
}

template <int Dim>
FixedMatrix<spin_freedoms<Dim>, spin_freedoms<Dim>> world_inertia(const Body<Dim>& body,
                                                                  const Rotation<Dim>& rotation) {
  return inertia_of(body, rotation);
}

template <int Dim>
double kinetic_energy(const Body<Dim>& body, const Motion<Dim>& motion) {
  return 0.5 * body.mass * motion.velocity.squaredNorm() +
         0.5 * motion.angular_momentum.dot(motion.angular_momentum.cwiseQuotient(body.inertia));
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                               \
  template Spin<Dim> turn_of_step<Dim>(const Spin<Dim>&, double);                                               \
  template SpinChange<Dim> spin_change<Dim>(const Body<Dim>&, const Motion<Dim>&, const Spin<Dim>&, double);    \
  template Motion<Dim> motion_after<Dim>(const Body<Dim>&, const Motion<Dim>&, const MeanMotion<Dim>&, double); \
  template Motion<Dim> motion_at_half<Dim>(const Motion<Dim>&, const MeanMotion<Dim>&, double);                 \
  template FixedMatrix<spin_freedoms<Dim>, spin_freedoms<Dim>> world_inertia<Dim>(const Body<Dim>&,             \
                                                                                  const Rotation<Dim>&);        \
  template double kinetic_energy<Dim>(const Body<Dim>&, const Motion<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
