#include "core/load/quiet_plate.hpp"

namespace voussoir {

template <int Dim>
PlateStep<Dim> step_of(const QuietPlate<Dim>& constants, const Vector<Dim>& face, const Vector<Dim>& plate,
                       const Vector<Dim>& velocity, const Vector<Dim>& upgoing, double h) {
  // along each axis: C (w1 - w0) = h K (u0 + h v/2 - (w0 + w1)/2) + 2 h C v_in
  const Vector<Dim> apart = constants.axes.transpose() * (face - plate), v = constants.axes.transpose() * velocity,
                    in = constants.axes.transpose() * upgoing;
  Vector<Dim> path, force, slope;
  PlateStep<Dim> step;
  for (int k = 0; k < Dim; ++k) {
    const double K = constants.stiffness[k], C = constants.impedance[k], y = 0.5 * h * K / C;
    path[k] = h * (K / C * (apart[k] + 0.5 * h * v[k]) + 2 * in[k]) / (1 + y);
    force[k] = -K * (apart[k] + 0.5 * h * v[k] - h * in[k]) / (1 + y);
    slope[k] = -0.5 * h * K / (1 + y);
    step.came_in += 2 * C * in[k] * path[k];
    step.went_out += C * path[k] * path[k] / h;
  }
  step.plate = plate + constants.axes * path;
  step.mean_force = constants.axes * force;
  step.by_velocity = constants.axes * slope.asDiagonal() * constants.axes.transpose();
  return step;
}

template <int Dim>
Vector<Dim> force_of(const QuietPlate<Dim>& constants, const Vector<Dim>& face, const Vector<Dim>& plate) {
  const Vector<Dim> apart = constants.axes.transpose() * (face - plate);
  return -(constants.axes * Vector<Dim>(constants.stiffness.cwiseProduct(apart)));
}

template <int Dim>
double energy_of(const QuietPlate<Dim>& constants, const Vector<Dim>& face, const Vector<Dim>& plate) {
  const Vector<Dim> apart = constants.axes.transpose() * (face - plate);
  return 0.5 * apart.dot(constants.stiffness.cwiseProduct(apart));
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                      \
  template PlateStep<Dim> step_of<Dim>(const QuietPlate<Dim>&, const Vector<Dim>&, const Vector<Dim>&, \
                                       const Vector<Dim>&, const Vector<Dim>&, double);                \
  template Vector<Dim> force_of<Dim>(const QuietPlate<Dim>&, const Vector<Dim>&, const Vector<Dim>&);  \
  template double energy_of<Dim>(const QuietPlate<Dim>&, const Vector<Dim>&, const Vector<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
