#include "core/step/lining_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/stage/install_linings.hpp"

namespace voussoir {
namespace {

// Of the length that half a node represents: the tangent of its interface is found by a motion of this size, and an
// interface open by no more counts as closed, or the first loads would meet no stiffness.
constexpr double small_motion = 1e-8, closed_within = 1e-5;

// half a node at its rock face, world axes
struct AtRock {
  Vector<2> normal;      // into the rock
  Vector<2> along;       // t
  Vector<2> from_block;  // m, of the node from the block's centroid
  LiningMotion motion;

  // `seconds`: of the last step
  AtRock(const LiningRock& rock, int node, const BodiesState<2>& bodies, double seconds = 0)
      : normal(bodies.poses[rock.body].axes * rock.normal),
        along(perpendicular(normal)),
        from_block(between(bodies.poses[rock.body], bodies.poses[node])) {
    const Vector<2> at = seen_from_rock(rock, node, bodies);
    motion.closure = rock.normal.dot(at);
    motion.place = rock.normal[0] * at[1] - rock.normal[1] * at[0];
    motion.seconds = seconds;
  }
  Vector<2> force(const LiningContact& c) const { return -c.normal * normal + c.shear * along; }  // on the node
};

LiningJoint joint_of(const Model<2>& model, const Schedule& schedule, double viscous_ratio, const Lining& lining,
                     double length, double inverse_mass) {
  const int p = lining.interface_properties;
  const JointProperties& properties = model.properties[p];
  const bool damps = viscous_ratio > 0 && inverse_mass > 0;
  return {properties, schedule.friction[p], schedule.strength_factor.empty() ? 1 : schedule.strength_factor[p],
          damps ? 2 * viscous_ratio * std::sqrt(properties.normal_stiffness * length / inverse_mass) : 0};
}

// calls what(a, b, beam, strain) for every beam of a lining, a and b its nodes' bodies
template <class Work>
void each_beam(const Lining& lining, const BodiesState<2>& bodies, const Work& work) {
  for (int k = 0; k < lining.beams(); ++k) {
    const int a = lining.first_body + k, b = lining.first_body + lining.next(k);
    const Beam beam = lining.beam(k);
    work(a, b, beam, beam_strain(beam, moved_node(bodies, a), moved_node(bodies, b)));
  }
}

// calls what(contact, half's length, rock, body of the node) for every half node with rock opposite
template <class Supports, class Work>
void each_at_rock(const Model<2>& model, Supports& supports, const Work& work) {
  for (auto& lined : supports.linings) {
    const Lining& lining = model.linings[lined.lining];
    for (std::size_t i = 0; i < lined.contacts.size(); ++i)
      if (auto& contact = lined.contacts[i]; contact.rock >= 0)
        work(lining, contact, lining.nodes[i / 2].half_length[i % 2], lined.rock[contact.rock],
             lining.first_body + static_cast<int>(i / 2));
  }
}

// If a node has left its block's face, the interface history passes to the next face; with none opposite, the node is
// free.
void follow_rock(const Model<2>& model, const BodiesState<2>& bodies, SupportsState<2>& supports, Ledger& ledger) {
  for (LiningState& lined : supports.linings) {
    const Lining& lining = model.linings[lined.lining];
    for (std::size_t i = 0; i < lined.contacts.size(); ++i) {
      LiningContact& contact = lined.contacts[i];
      const int rock = rock_opposite(lining, lined, static_cast<int>(i), bodies);
      if (rock == contact.rock) continue;
      const JointProperties& p = model.properties[lining.interface_properties];
      const double length = lining.nodes[i / 2].half_length[i % 2];
      if (rock < 0) {
        if (p.shear_stiffness > 0)
          ledger.energy.flows[Source::lining_slip] +=
              0.5 * contact.shear * contact.shear / (p.shear_stiffness * length);
        contact = {.closure = contact.closure, .place = contact.place};
        continue;
      }
      const int node = lining.first_body + static_cast<int>(i / 2);
      const LiningMotion now = AtRock(lined.rock[rock], node, bodies).motion;
      // its displacement since the last step, relative to the block that it comes from
      double closed = 0, slipped = 0;
      if (contact.rock >= 0) {
        const LiningMotion last = AtRock(lined.rock[contact.rock], node, bodies).motion;
        closed = last.closure - contact.closure;
        slipped = last.place - contact.place;
      }
      contact.rock = rock;
      contact.closure = now.closure - closed;
      contact.place = now.place - slipped;
    }
  }
}

void add_pair(int body_a, int body_b, const BodiesState<2>& bodies, const FixedMatrix<3, 3>& stiffness,
              const FixedMatrix<3, 1>& wrench, std::vector<PairStiffness<2>>& pairs) {
  PairStiffness<2> pair;
  pair.contact = -1;
  pair.body_a = body_a;
  pair.body_b = body_b;
  pair.apart = between(bodies.poses[body_a], bodies.poses[body_b]);
  pair.stiffness = stiffness;
  pair.wrench = wrench;
  pairs.push_back(pair);
}

void add_beam_pairs(const Model<2>& model, const State<2>& state, std::vector<PairStiffness<2>>& pairs) {
  for (const LiningState& lined : state.supports.linings)
    each_beam(model.linings[lined.lining], state.bodies, [&](int a, int b, const Beam& beam, const BeamStrain& strain) {
      const BeamForces forces = beam_forces(beam, strain);
      add_pair(a, b, state.bodies, beam_tangent(beam, strain).bottomRightCorner<3, 3>(),
               {forces.force[1][0], forces.force[1][1], forces.moment[1]}, pairs);
    });
}

}  // namespace

template <int Dim>
void find_lining_forces(const Model<Dim>& model, const Schedule& schedule, const JointStep& last,
                        const BodiesState<Dim>& bodies, SupportsState<Dim>& supports, Ledger& ledger, Counters&) {
  if constexpr (Dim == 2) {
    if (supports.linings.empty()) return;
    follow_rock(model, bodies, supports, ledger);
    each_at_rock(model, supports,
                 [&](const Lining& lining, LiningContact& contact, double length, const LiningRock& rock, int node) {
                   const AtRock at(rock, node, bodies, last.length);
                   const double inverse_mass = bodies.poses[rock.body].inverse_mass + bodies.poses[node].inverse_mass;
                   const LiningJoint joint =
                       joint_of(model, schedule, last.viscous_ratio, lining, length, inverse_mass);
                   const LiningAnswer answer = interface_answer(joint, length, at.motion, contact);
                   ledger.energy.elastic += answer.elastic;
                   ledger.energy.flows[Source::lining_slip] += answer.friction;
                   ledger.energy.flows[Source::dashpots] += answer.dashpots;
                 });
    for (const LiningState& lined : supports.linings)
      each_beam(model.linings[lined.lining], bodies, [&](int, int, const Beam& beam, const BeamStrain& strain) {
        ledger.energy.elastic += beam_forces(beam, strain).energy;
      });
  }
}

template <int Dim>
void lining_loads(const Model<Dim>& model, int, const LoadInputs<Dim>& now, std::vector<Load<Dim>>& loads) {
  if constexpr (Dim == 2) {
    for (const LiningState& lined : now.supports.linings)
      each_beam(model.linings[lined.lining], now.bodies, [&](int a, int b, const Beam& beam, const BeamStrain& strain) {
        const BeamForces forces = beam_forces(beam, strain);
        loads[a] += {forces.force[0], Spin<2>(forces.moment[0])};
        loads[b] += {forces.force[1], Spin<2>(forces.moment[1])};
      });
    each_at_rock(model, now.supports,
                 [&](const Lining&, const LiningContact& contact, double, const LiningRock& rock, int node) {
                   const AtRock at(rock, node, now.bodies);
                   const Vector<2> force = at.force(contact);
                   loads[node] += {force, Spin<2>::Zero()};
                   loads[rock.body] += {-force, -moment(at.from_block, force)};
                 });
  }
}

template <int Dim>
void add_lining_stiffness(const Model<Dim>& model, const LoadInputs<Dim>& now, std::vector<BodyStiffness>& stiffness) {
  if constexpr (Dim == 2) {
    for (const LiningState& lined : now.supports.linings) {
      const Lining& lining = model.linings[lined.lining];
      for (std::size_t n = 0; n < lining.nodes.size(); ++n)
        stiffness[lining.first_body + n].translation += lining.nodes[n].mass * lining.nodes[n].square_frequency;
    }
    each_at_rock(model, now.supports,
                 [&](const Lining& lining, const LiningContact&, double length, const LiningRock& rock, int node) {
                   const JointProperties& p = model.properties[lining.interface_properties];
                   const double k = (model.bodies[rock.body].fixed ? 1 : 2) * length *
                                    std::max(p.normal_stiffness, p.shear_stiffness);
                   stiffness[node].translation += k;
                   stiffness[rock.body].translation += k;
                   stiffness[rock.body].rotation +=
                       k * between(now.bodies.poses[rock.body], now.bodies.poses[node]).squaredNorm();
                 });
  }
}

template <int Dim>
void add_lining_pairs(const Model<Dim>& model, const Settings&, const State<Dim>& state,
                      std::vector<PairStiffness<Dim>>& pairs) {
  if constexpr (Dim == 2) {
    add_beam_pairs(model, state, pairs);
    for (std::size_t l = 0; l < state.supports.linings.size(); ++l) {
      const LiningState &lined = state.supports.linings[l], &base = state.increment.base.supports.linings[l];
      const Lining& lining = model.linings[lined.lining];
      for (std::size_t i = 0; i < lined.contacts.size(); ++i) {
        const LiningContact& contact = lined.contacts[i];
        const double length = lining.nodes[i / 2].half_length[i % 2];
        if (contact.rock < 0 || contact.closure < -closed_within * length) continue;
        const LiningRock& rock = lined.rock[contact.rock];
        const int node = lining.first_body + static_cast<int>(i / 2);
        const AtRock at(rock, node, state.bodies, state.time_step.length);
        const LiningJoint joint = joint_of(model, state.schedule, 0, lining, length, 0);
        // from the start of the increment; at a block that it has reached since, from there
        const LiningContact begin = base.contacts[i].rock == contact.rock ? base.contacts[i] : contact;
        const auto force_at = [&](double closer, double farther) {
          LiningContact trial = begin;
          LiningMotion motion = at.motion;
          motion.closure = std::max(motion.closure, 0.0) + closer;
          motion.place += farther;
          interface_answer(joint, length, motion, trial);
          return Vector<2>(at.force(trial));
        };
        const double h = small_motion * length;
        const Vector<2> here = force_at(0, 0);
        FixedMatrix<3, 3> stiffness = FixedMatrix<3, 3>::Zero();
        stiffness.topLeftCorner<2, 2>() = ((here - force_at(h, 0)) / h) * at.normal.transpose() +
                                          ((here - force_at(0, h)) / h) * at.along.transpose();
        const Vector<2> now = at.force(contact);
        add_pair(rock.body, node, state.bodies, stiffness, {now[0], now[1], 0}, pairs);
      }
    }
  }
}

template <int Dim>
bool has_linings(const Model<Dim>&, const LoadInputs<Dim>& now) {
  return !now.supports.linings.empty();
}

template <int Dim>
void add_interface_forces(const SupportsState<Dim>& supports, ForcesAtRest& sums) {
  const InterfaceSum of_linings = interface_sum(supports.linings);
  sums.add_support(of_linings.forces, of_linings.touching);
}

template <int Dim>
void tie_linings(const Model<Dim>& model, const SupportsState<Dim>& supports, const TwoBodies& tie) {
  for (const LiningState& lined : supports.linings) {
    const Lining& lining = model.linings[lined.lining];
    for (int node = 0; node < static_cast<int>(lining.nodes.size()); ++node)
      tie(lining.first_body, lining.first_body + node);
    for (const LiningRock& rock : lined.rock)
      tie(lining.first_body, rock.body);
  }
}

template <int Dim>
void tell_touching_nodes(const Model<Dim>& model, const SupportsState<Dim>& supports, const TwoBodies& tell) {
  for (const LiningState& lined : supports.linings)
    for (std::size_t i = 0; i < lined.contacts.size(); ++i)
      if (const int rock = lined.contacts[i].rock; rock >= 0)
        tell(lined.rock[rock].body, model.linings[lined.lining].first_body + static_cast<int>(i / 2));
}

template <int Dim>
void scale_nodes(const Model<Dim>& model, const std::vector<int>& place, Eigen::VectorXd& scale) {
  constexpr int F = freedoms<Dim>;
  for (const Lining& lining : model.linings)
    for (std::size_t k = 0; lining.first_body >= 0 && k < lining.nodes.size(); ++k) {
      const LiningNode& node = lining.nodes[k];
      const int i = place[lining.first_body + k];
      const double length = node.half_length[0] + node.half_length[1];
      const double translation = 2 * lining.properties.axial() / length +
                                 model.properties[lining.interface_properties].normal_stiffness * length;
      for (int f = 0; f < F; ++f)
        scale[F * i + f] = f < Dim ? translation : translation * length * length / 12;
    }
}

template <int Dim>
std::string loose_lining(const Model<Dim>& model, const SupportsState<Dim>& supports) {
  for (const LiningState& lined : supports.linings) {
    const auto touches = [](const LiningContact& c) {
      return c.rock >= 0 && (c.bond == Bond::whole || c.closure >= 0);
    };
    if (!lined.rock.empty() && std::ranges::none_of(lined.contacts, touches))
      return fmt::format("no node of the lining '{}' touches rock any more",
                         model.linings[lined.lining].properties.name);
  }
  return {};
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                      \
  template bool has_linings<Dim>(const Model<Dim>&, const LoadInputs<Dim>&);                                           \
  template void find_lining_forces<Dim>(const Model<Dim>&, const Schedule&, const JointStep&, const BodiesState<Dim>&, \
                                        SupportsState<Dim>&, Ledger&, Counters&);                                      \
  template void lining_loads<Dim>(const Model<Dim>&, int, const LoadInputs<Dim>&, std::vector<Load<Dim>>&);            \
  template void add_lining_stiffness<Dim>(const Model<Dim>&, const LoadInputs<Dim>&, std::vector<BodyStiffness>&);     \
  template void add_lining_pairs<Dim>(const Model<Dim>&, const Settings&, const State<Dim>&,                           \
                                      std::vector<PairStiffness<Dim>>&);                                               \
  template void add_interface_forces<Dim>(const SupportsState<Dim>&, ForcesAtRest&);                                   \
  template void tie_linings<Dim>(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&);                      \
  template void tell_touching_nodes<Dim>(const Model<Dim>&, const SupportsState<Dim>&, const TwoBodies&);              \
  template void scale_nodes<Dim>(const Model<Dim>&, const std::vector<int>&, Eigen::VectorXd&);                        \
  template std::string loose_lining<Dim>(const Model<Dim>&, const SupportsState<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
