#include "core/motion/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

template <int Dim>
bool all_free(const std::array<bool, Dim>& freedoms) {
  return std::all_of(freedoms.begin(), freedoms.end(), [](bool f) { return f; });
}

template <std::size_t Size>
bool none_free(const std::array<bool, Size>& freedoms) {
  return std::none_of(freedoms.begin(), freedoms.end(), [](bool f) { return f; });
}

template <int Dim>
Spin<Dim> damped_moment(const Body<Dim>& body, const Load<Dim>& load, double local_damping, const Motion<Dim>& motion) {
  if (local_damping == 0) return load.moment;
  const Spin<Dim> spin = angular_velocity(body, motion);
  Spin<Dim> moment;
  for (int k = 0; k < spin_freedoms<Dim>; ++k)
    moment[k] = damped(load.moment[k], spin[k], local_damping);
  return moment;
}

void rotate(const Body<2>& body, const Load<2>& load, double damping, StepTimes times, Motion<2>& motion) {
  motion.angular_momentum += times.kick * damped_moment(body, load, damping, motion);
  motion.rotation.angle += times.drift * motion.angular_momentum[0] / body.inertia[0];
}

// turns the body about its principal axis k by the share of a step; the momentum seen from the body turns back
void turn_about(int k, double dt, const Body<3>& body, Motion<3>& motion) {
  Spin<3>& momentum = motion.angular_momentum;
  const double half_angle = 0.5 * dt * momentum[k] / body.inertia[k];
  const double c = std::cos(half_angle), s = std::sin(half_angle);
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double mi = momentum[i], mj = momentum[j];
  // as a change: a cosine near one is rounded the same way step after step, and the momentum would drift
  momentum[i] += 2 * s * (c * mj - s * mi);
  momentum[j] -= 2 * s * (c * mi + s * mj);
  const Vector<3> axis = s * body.principal_axes.col(k);
  motion.rotation.quaternion *= Eigen::Quaterniond(c, axis[0], axis[1], axis[2]);
}

// some axes are held: the free components of the spin obey the free block of the inertia tensor
void rotate_partly(const Body<3>& body, const Spin<3>& moment, StepTimes times, Motion<3>& motion) {
  const Matrix<3> axes = matrix(motion.rotation) * body.principal_axes;
  Matrix<3> inertia = axes * body.inertia.asDiagonal() * axes.transpose();
  Spin<3> spin = angular_velocity(body, motion), kick = moment;
  for (int k = 0; k < 3; ++k) {
    if (body.free_rotation[k]) continue;
    inertia.row(k).setZero();
    inertia.col(k).setZero();
    inertia(k, k) = 1;
    kick[k] = 0;
    spin[k] = 0;
  }
  spin += times.kick * Spin<3>(inertia.inverse() * kick);
  motion.rotation = turned(motion.rotation, times.drift * spin);
  motion.angular_momentum = angular_momentum(body, motion.rotation, spin);
}

void rotate(const Body<3>& body, const Load<3>& load, double damping, StepTimes times, Motion<3>& motion) {
  const Spin<3> moment = damped_moment(body, load, damping, motion);
  if (!all_free<3>(body.free_rotation)) {
    rotate_partly(body, moment, times, motion);
    return;
  }
  const Matrix<3> axes = matrix(motion.rotation) * body.principal_axes;
  motion.angular_momentum += times.kick * (axes.transpose() * moment);
  const double dt = times.drift;
  turn_about(0, 0.5 * dt, body, motion);
  turn_about(1, 0.5 * dt, body, motion);
  turn_about(2, dt, body, motion);
  turn_about(1, 0.5 * dt, body, motion);
  turn_about(0, 0.5 * dt, body, motion);
  motion.rotation.quaternion.normalize();
}

}  // namespace

double damped(double force, double velocity, double local_damping) {
  if (velocity == 0) return force;
  return force - local_damping * std::abs(force) * (velocity > 0 ? 1 : -1);
}

template <int Dim>
void advance(const Body<Dim>& body, const Load<Dim>& load, double local_damping, StepTimes times, Motion<Dim>& motion) {
  for (int k = 0; k < Dim; ++k) {
    if (!body.free_translation[k]) continue;
    motion.velocity[k] += times.kick * damped(load.force[k], motion.velocity[k], local_damping) / body.mass;
    motion.displacement[k] += times.drift * motion.velocity[k];
  }
  if (!none_free(body.free_rotation)) rotate(body, load, local_damping, times, motion);
}

template <int Dim>
double unbalanced_ratio(const Model<Dim>& model, const State<Dim>& state) {
  double sum = 0;
  long long touching = 0;
  for (const Contact<Dim>& c : state.contacts) {
    if (!c.touching()) continue;
    sum += c.force.norm();
    ++touching;
  }
  const double mean = touching > 0 ? sum / static_cast<double>(touching) : 0;

  double largest = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (body.fixed) continue;
    const double frequency = b < state.frequency.size() ? state.frequency[b] : 0;
    double squares = 0, momentum = 0;
    for (int k = 0; k < Dim; ++k) {
      if (!body.free_translation[k]) continue;
      squares += state.loads[b].force[k] * state.loads[b].force[k];
      momentum += std::pow(body.mass * state.motions[b].velocity[k], 2);
    }
    for (int k = 0; k < spin_freedoms<Dim>; ++k) {
      if (!body.free_rotation[k]) continue;
      squares += std::pow(state.loads[b].moment[k] / body.radius, 2);
      momentum += std::pow(state.motions[b].angular_momentum[k] / body.radius, 2);
    }
    largest = std::max(largest, std::sqrt(squares) + frequency * std::sqrt(momentum));
  }
  if (largest == 0) return 0;
  return mean > 0 ? largest / mean : std::numeric_limits<double>::infinity();
}

template void advance<2>(const Body<2>&, const Load<2>&, double, StepTimes, Motion<2>&);
template void advance<3>(const Body<3>&, const Load<3>&, double, StepTimes, Motion<3>&);
template double unbalanced_ratio<2>(const Model<2>&, const State<2>&);
template double unbalanced_ratio<3>(const Model<3>&, const State<3>&);

}  // namespace voussoir
