#include "core/step/bolt_forces.hpp"

#include <cmath>

namespace voussoir {
namespace {

template <int Dim>
const BoltProperties& properties_of(const Model<Dim>& model, const BoltSpring<Dim>& spring) {
  return model.bolt_properties[model.bolts[spring.bolt].properties];
}

// where a spring stands, world axes, m
template <int Dim>
struct Stretched {
  Vector<Dim> apart;         // of its anchors
  Vector<Dim> arm_a, arm_b;  // of the second anchor from each centroid

  Stretched(const State<Dim>& state, const BoltSpring<Dim>& spring) {
    const CachedPose<Dim>&a = state.poses[spring.body_a], &b = state.poses[spring.body_b];
    arm_b = b.axes * spring.place_b;
    arm_a = between(a, b) + arm_b;
    apart = arm_a - a.axes * spring.place_a;
  }
};

// on the second body, world axes
template <int Dim>
Vector<Dim> force_of(const State<Dim>& state, const BoltSpring<Dim>& spring, const Stretched<Dim>& at) {
  if (spring.broken) return Vector<Dim>::Zero();
  const Matrix<Dim>& axes = state.poses[spring.body_a].axes;
  Vector<Dim> direction = axes * spring.axis;
  if (const double distance = at.apart.norm(); spring.length > 0 && distance > 0)
    direction = (direction.dot(at.apart) < 0 ? -1 / distance : 1 / distance) * at.apart;
  return -(spring.force * direction + axes * spring.shear);
}

}  // namespace

template <int Dim>
void find_bolt_forces(const Model<Dim>& model, State<Dim>& state) {
  for (BoltSpring<Dim>& spring : state.bolt_springs) {
    const Stretched<Dim> at(state, spring);
    const Vector<Dim> apart = state.poses[spring.body_a].axes.transpose() * at.apart;
    const BoltAnswer<Dim> answer = bolt_answer<Dim>(properties_of(model, spring), apart, spring);
    state.energy.elastic += answer.elastic;
    state.energy.flows[Source::bolt_yield] += answer.lost;
  }
}

template <int Dim>
void bolt_loads(const Model<Dim>&, int, const State<Dim>& state, std::vector<Load<Dim>>& loads) {
  for (const BoltSpring<Dim>& spring : state.bolt_springs) {
    const Stretched<Dim> at(state, spring);
    const Vector<Dim> force = force_of(state, spring, at);
    loads[spring.body_b] += {force, moment(at.arm_b, force)};
    loads[spring.body_a] += {-force, -moment(at.arm_a, force)};
  }
}

template <int Dim>
void add_bolt_stiffness(const Model<Dim>& model, const State<Dim>& state, std::vector<BodyStiffness>& stiffness) {
  for (const BoltSpring<Dim>& spring : state.bolt_springs) {
    const Stretched<Dim> at(state, spring);
    const bool one_is_fixed = model.bodies[spring.body_a].fixed || model.bodies[spring.body_b].fixed;
    const double k = (one_is_fixed ? 1 : 2) * stiffest<Dim>(properties_of(model, spring), spring);
    stiffness[spring.body_a].translation += k;
    stiffness[spring.body_a].rotation += k * at.arm_a.squaredNorm();
    stiffness[spring.body_b].translation += k;
    stiffness[spring.body_b].rotation += k * at.arm_b.squaredNorm();
  }
}

template <int Dim>
void add_bolt_pairs(const Model<Dim>& model, const State<Dim>& state, std::vector<PairStiffness<Dim>>& pairs) {
  constexpr int S = spin_freedoms<Dim>;
  for (const BoltSpring<Dim>& spring : state.bolt_springs) {
    if (spring.broken || (model.bodies[spring.body_a].fixed && model.bodies[spring.body_b].fixed)) continue;
    const Stretched<Dim> at(state, spring);
    const CachedPose<Dim>& a = state.poses[spring.body_a];
    const Matrix<Dim> own =
        bolt_stiffness<Dim>(properties_of(model, spring), Vector<Dim>(a.axes.transpose() * at.apart), spring);
    const Matrix<Dim> k = a.axes * own * a.axes.transpose();
    const Vector<Dim> force = force_of(state, spring, at);
    PairStiffness<Dim> pair;
    pair.contact = -1;
    pair.body_a = spring.body_a;
    pair.body_b = spring.body_b;
    pair.apart = between(a, state.poses[spring.body_b]);
    pair.wrench.template head<Dim>() = force;
    pair.wrench.template tail<S>() = moment(at.arm_b, force);
    for (int f = 0; f < freedoms<Dim>; ++f) {
      // the second anchor as the second body moves along this freedom
      const Vector<Dim> way = f < Dim ? Vector<Dim>(Vector<Dim>::Unit(f % Dim))
                                      : cross(Spin<Dim>(Spin<Dim>::Unit((f + S - Dim) % S)), at.arm_b);
      const Vector<Dim> lost = k * way;
      pair.stiffness.template block<Dim, 1>(0, f) = lost;
      pair.stiffness.template block<S, 1>(Dim, f) = moment(at.arm_b, lost);
      if (f >= Dim) pair.stiffness.template block<S, 1>(Dim, f) -= moment(way, force);
    }
    pairs.push_back(pair);
  }
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                           \
  template void find_bolt_forces<Dim>(const Model<Dim>&, State<Dim>&);                                      \
  template void bolt_loads<Dim>(const Model<Dim>&, int, const State<Dim>&, std::vector<Load<Dim>>&);        \
  template void add_bolt_stiffness<Dim>(const Model<Dim>&, const State<Dim>&, std::vector<BodyStiffness>&); \
  template void add_bolt_pairs<Dim>(const Model<Dim>&, const State<Dim>&, std::vector<PairStiffness<Dim>>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
