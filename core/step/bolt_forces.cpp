#include "core/step/bolt_forces.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "core/step/anchors.hpp"

namespace voussoir {
namespace {

template <int Dim>
const BoltProperties& properties_of(const Model<Dim>& model, const BoltSpring<Dim>& spring) {
  return model.bolt_properties[model.bolts[spring.bolt].properties];
}

// whether the spring is a joint crossing of a grouted bar
template <int Dim>
bool is_grouted(const Model<Dim>& model, const BoltSpring<Dim>& spring) {
  return properties_of(model, spring).kind == BoltKind::grouted;
}

// of the joints of a bar
template <int Dim>
std::span<const BoltSpring<Dim>> joints_of(const SupportsState<Dim>& supports, const GroutedBolt<Dim>& grouted) {
  return std::span(supports.bolt_springs).subspan(grouted.first_spring, grouted.joints());
}

// the block of a segment
template <int Dim>
int body_of(std::span<const BoltSpring<Dim>> joints, std::size_t stretch) {
  return stretch == 0 ? joints[0].body_a : joints[stretch - 1].body_b;
}

// direction in which a spring pulls on its first body, unit, world axes
template <int Dim>
Vector<Dim> direction_of(const BodiesState<Dim>& bodies, const BoltSpring<Dim>& spring, const Stretched<Dim>& at) {
  const Vector<Dim> axis = bodies.poses[spring.body_a].axes * spring.axis;
  const double distance = at.apart.norm();
  if (spring.length == 0 || !(distance > 0)) return axis;
  return (axis.dot(at.apart) < 0 ? -1 / distance : 1 / distance) * at.apart;
}

// moves the rock along the bar by the opening of its joints
template <int Dim>
void find_bar_force(const BodiesState<Dim>& bodies, GroutedBolt<Dim>& grouted, SupportsState<Dim>& supports,
                    Ledger& ledger, Counters& counters) {
  static thread_local GroutWorkspace workspace;
  static thread_local std::vector<double> rock;
  const std::size_t nodes = grouted.stretch.size();
  rock.resize(nodes);
  double opened = 0;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (i > 0 && grouted.stretch[i] != grouted.stretch[i - 1]) {
      BoltSpring<Dim>& joint = supports.bolt_springs[grouted.first_spring + grouted.stretch[i - 1]];
      const Stretched<Dim> at(bodies, joint);
      joint.extension = direction_of(bodies, joint, at).dot(at.apart) - joint.length;
      opened += joint.extension;
    }
    rock[i] = opened;
  }
  const GroutStep step = move_rock(grouted.bar, rock, grouted.state, workspace);
  if (!step.converged) ++counters.unconverged;
  ledger.energy.elastic += step.stored;
  ledger.energy.flows[Source::bolt_yield] += step.dissipated;
  for (std::size_t i = 1; i < nodes; ++i) {
    if (grouted.stretch[i] == grouted.stretch[i - 1]) continue;
    BoltSpring<Dim>& joint = supports.bolt_springs[grouted.first_spring + grouted.stretch[i - 1]];
    joint.force = grouted.state.bar_force[i - 1];
    joint.plastic = grouted.state.plastic_stretch[i - 1];
  }
}

// on the second body, world axes
template <int Dim>
Vector<Dim> force_of(const BodiesState<Dim>& bodies, const BoltSpring<Dim>& spring, const Stretched<Dim>& at) {
  if (spring.broken) return Vector<Dim>::Zero();
  return -(spring.force * direction_of(bodies, spring, at) + bodies.poses[spring.body_a].axes * spring.shear);
}

}  // namespace

template <int Dim>
bool has_springs(const Model<Dim>&, const LoadInputs<Dim>& now) {
  return !now.supports.bolt_springs.empty();
}

template <int Dim>
bool has_bars(const Model<Dim>&, const LoadInputs<Dim>& now) {
  return !now.supports.grouted.empty();
}

template <int Dim>
void find_spring_forces(const Model<Dim>& model, const Schedule&, const JointStep&, const BodiesState<Dim>& bodies,
                        SupportsState<Dim>& supports, Ledger& ledger, Counters&) {
  for (BoltSpring<Dim>& spring : supports.bolt_springs) {
    if (is_grouted(model, spring)) continue;
    const Stretched<Dim> at(bodies, spring);
    const Vector<Dim> apart = bodies.poses[spring.body_a].axes.transpose() * at.apart;
    const BoltAnswer<Dim> answer = bolt_answer<Dim>(properties_of(model, spring), apart, spring);
    ledger.energy.elastic += answer.elastic;
    ledger.energy.flows[Source::bolt_yield] += answer.lost;
  }
}

template <int Dim>
void find_bar_forces(const Model<Dim>&, const Schedule&, const JointStep&, const BodiesState<Dim>& bodies,
                     SupportsState<Dim>& supports, Ledger& ledger, Counters& counters) {
  for (GroutedBolt<Dim>& grouted : supports.grouted)
    find_bar_force(bodies, grouted, supports, ledger, counters);
}

template <int Dim>
void bolt_loads(const Model<Dim>&, int, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  for (const BoltSpring<Dim>& spring : now.supports.bolt_springs) {
    const Stretched<Dim> at(now.bodies, spring);
    const Vector<Dim> force = force_of(now.bodies, spring, at);
    loads[spring.body_b] += {force, moment(at.arm_b, force)};
    loads[spring.body_a] += {-force, -moment(at.arm_a, force)};
  }
}

template <int Dim>
void add_spring_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness) {
  for (const BoltSpring<Dim>& spring : now.supports.bolt_springs) {
    if (is_grouted(model, spring)) continue;
    const Stretched<Dim> at(now.bodies, spring);
    const bool one_is_fixed = model.bodies[spring.body_a].fixed || model.bodies[spring.body_b].fixed;
    const double k = (one_is_fixed ? 1 : 2) * stiffest<Dim>(properties_of(model, spring), spring);
    stiffness[spring.body_a].translation += k;
    stiffness[spring.body_a].rotation += k * at.arm_a.squaredNorm();
    stiffness[spring.body_b].translation += k;
    stiffness[spring.body_b].rotation += k * at.arm_b.squaredNorm();
  }
}

template <int Dim>
void add_bar_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness) {
  for (const GroutedBolt<Dim>& grouted : now.supports.grouted) {
    const auto joints = joints_of(now.supports, grouted);
    std::size_t free = 0;
    for (std::size_t s = 0; s <= joints.size(); ++s)
      free += !model.bodies[body_of(joints, s)].fixed;
    for (std::size_t s = 0; s <= joints.size(); ++s) {
      // the force acts at its joints, where it also turns
      double arm2 = 0, of_bar = grouted.stiffness[s];
      const auto add_joint = [&](const BoltSpring<Dim>& joint, double arm) {
        arm2 = std::max(arm2, arm);
        if (joint.length > 0) of_bar += std::abs(joint.force) / joint.length;
      };
      if (s > 0) add_joint(joints[s - 1], Stretched<Dim>(now.bodies, joints[s - 1]).arm_b.squaredNorm());
      if (s < joints.size()) add_joint(joints[s], Stretched<Dim>(now.bodies, joints[s]).arm_a.squaredNorm());
      // sum of a row with all signs positive; for a single one the diagonal
      const double k = (free > 1 ? 2 : 1) * of_bar;
      BodyStiffness& of_body = stiffness[body_of(joints, s)];
      of_body.translation += k;
      of_body.rotation += k * arm2;
    }
  }
}

namespace {

template <int Dim>
void add_pairs_of(const Model<Dim>& model, const BodiesState<Dim>& bodies, const SupportsState<Dim>& supports,
                  const GroutedBolt<Dim>& grouted, std::vector<PairStiffness<Dim>>& pairs) {
  GroutWorkspace workspace;
  std::vector<double> stiffness;
  const auto joints = joints_of(supports, grouted);
  const std::size_t stretches = joints.size() + 1;
  condensed_stiffness(grouted.bar, grouted.state, grouted.stretch, static_cast<int>(stretches), workspace, stiffness);
  for (std::size_t p = 0; p < stretches; ++p)
    for (std::size_t q = p + 1; q < stretches; ++q) {
      const int a = body_of(joints, p), b = body_of(joints, q);
      const double k = -stiffness[p * stretches + q];
      if (a == b || (model.bodies[a].fixed && model.bodies[b].fixed) || (q > p + 1 && !(k > 0))) continue;
      const BoltSpring<Dim>& joint = joints[q - 1];
      const Stretched<Dim> at(bodies, joint);
      const Vector<Dim> way = direction_of(bodies, joint, at);
      const Matrix<Dim> along = way * way.transpose();
      Vector<Dim> force = Vector<Dim>::Zero();
      Matrix<Dim> stiffness_here = std::max(k, 0.0) * along;
      if (q == p + 1) {
        force = force_of(bodies, joint, at);
        if (joint.length > 0) stiffness_here += joint.force / way.dot(at.apart) * (Matrix<Dim>::Identity() - along);
      }
      pairs.push_back(pair_of<Dim>(bodies, a, b, at.arm_b, stiffness_here, force));
    }
}

}  // namespace

template <int Dim>
void add_spring_pairs(const Model<Dim>& model, const Settings&, const State<Dim>& state,
                      std::vector<PairStiffness<Dim>>& pairs) {
  for (const BoltSpring<Dim>& spring : state.supports.bolt_springs) {
    if (is_grouted(model, spring)) continue;
    if (spring.broken || (model.bodies[spring.body_a].fixed && model.bodies[spring.body_b].fixed)) continue;
    const Stretched<Dim> at(state.bodies, spring);
    const CachedPose<Dim>& a = state.bodies.poses[spring.body_a];
    const Matrix<Dim> own =
        bolt_stiffness<Dim>(properties_of(model, spring), Vector<Dim>(a.axes.transpose() * at.apart), spring);
    const Matrix<Dim> k = a.axes * own * a.axes.transpose();
    pairs.push_back(
        pair_of<Dim>(state.bodies, spring.body_a, spring.body_b, at.arm_b, k, force_of(state.bodies, spring, at)));
  }
}

template <int Dim>
void add_bar_pairs(const Model<Dim>& model, const Settings&, const State<Dim>& state,
                   std::vector<PairStiffness<Dim>>& pairs) {
  for (const GroutedBolt<Dim>& grouted : state.supports.grouted)
    add_pairs_of(model, state.bodies, state.supports, grouted, pairs);
}

template <int Dim>
void add_spring_forces(const SupportsState<Dim>& supports, ForcesAtRest& sums) {
  for (const BoltSpring<Dim>& spring : supports.bolt_springs)
    if (!spring.broken) sums.add_support(std::abs(spring.force) + spring.shear.norm(), 1);
}

template <int Dim>
void tie_springs(const Model<Dim>&, const SupportsState<Dim>& supports, const TwoBodies& tie) {
  for (const BoltSpring<Dim>& spring : supports.bolt_springs)
    if (!spring.broken) tie(spring.body_a, spring.body_b);
}

template <int Dim>
void tie_bars(const Model<Dim>&, const SupportsState<Dim>& supports, const TwoBodies& tie) {
  for (const GroutedBolt<Dim>& grouted : supports.grouted)
    for (const int body : grouted.body)
      tie(grouted.body.front(), body);
}

template <int Dim>
std::optional<double> most_turned(const Model<Dim>& model, const BodiesState<Dim>& bodies,
                                  const SupportsState<Dim>& supports) {
  std::optional<double> most;
  for (const BoltSpring<Dim>& spring : supports.bolt_springs) {
    if (spring.broken || (model.bodies[spring.body_a].fixed && model.bodies[spring.body_b].fixed)) continue;
    const Vector<Dim> axis = bodies.poses[spring.body_a].axes * spring.axis;
    const Vector<Dim> direction = direction_of(bodies, spring, Stretched<Dim>(bodies, spring));
    const double along = direction.dot(axis);
    const Vector<Dim> across = direction - along * axis;
    most = std::max(most.value_or(0), std::atan2(across.norm(), along));
  }
  return most;
}

template <int Dim>
bool hangs_on_spring(const SupportsState<Dim>& supports, int body) {
  return std::ranges::any_of(supports.bolt_springs, [&](const BoltSpring<Dim>& spring) {
    return !spring.broken && (spring.body_a == body || spring.body_b == body);
  });
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                      \
  template bool has_springs<Dim>(const Model<Dim>&, const LoadInputs<Dim>&);                                           \
  template bool has_bars<Dim>(const Model<Dim>&, const LoadInputs<Dim>&);                                              \
  template void find_spring_forces<Dim>(const Model<Dim>&, const Schedule&, const JointStep&, const BodiesState<Dim>&, \
                                        SupportsState<Dim>&, Ledger&, Counters&);                                      \
  template void find_bar_forces<Dim>(const Model<Dim>&, const Schedule&, const JointStep&, const BodiesState<Dim>&,    \
                                     SupportsState<Dim>&, Ledger&, Counters&);                                         \
  template void bolt_loads<Dim>(const Model<Dim>&, int, const LoadInputs<Dim>&, std::vector<Load<Dim>>&);              \
  template void add_spring_stiffness<Dim>(const Model<Dim>&, const LoadInputs<Dim>&, std::vector<BodyStiffness>&);     \
  template void add_bar_stiffness<Dim>(const Model<Dim>&, const LoadInputs<Dim>&, std::vector<BodyStiffness>&);        \
  template void add_spring_pairs<Dim>(const Model<Dim>&, const Settings&, const State<Dim>&,                           \
                                      std::vector<PairStiffness<Dim>>&);                                               \
  template void add_bar_pairs<Dim>(const Model<Dim>&, const Settings&, const State<Dim>&,                              \
                                   std::vector<PairStiffness<Dim>>&);                                                  \
  template void add_spring_forces<Dim>(const SupportsState<Dim>&, ForcesAtRest&);                                      \
  template void tie_springs<Dim>(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&);                      \
  template void tie_bars<Dim>(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&);                         \
  template std::optional<double> most_turned<Dim>(const Model<Dim>&, const BodiesState<Dim>&,                          \
                                                  const SupportsState<Dim>&);                                          \
  template bool hangs_on_spring<Dim>(const SupportsState<Dim>&, int);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
