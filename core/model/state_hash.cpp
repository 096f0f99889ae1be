#include "core/model/state_hash.hpp"

#include <bit>
#include <cstdint>

#include "core/base/fingerprint.hpp"

namespace voussoir {
namespace {

struct Bytes {
  std::string text;

  // lowest byte first on any machine
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte)
      text.push_back(static_cast<char>(word >> (8 * byte)));
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(int x) { add(static_cast<std::uint64_t>(x)); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& v) {
    for (const double x : v)
      add(x);
  }
  void add(const Rotation<2>& r) { add(r.angle); }
  void add(const Rotation<3>& r) { add(r.quaternion.coeffs()); }
};

}  // namespace

template <int Dim>
std::string state_hash(const Model<Dim>& model, const State<Dim>& state) {
  Bytes bytes;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].present) continue;
    bytes.add(static_cast<int>(b));
    bytes.add(state.bodies.motions[b].displacement);
    bytes.add(state.bodies.motions[b].rotation);
    bytes.add(state.bodies.motions[b].velocity);
    bytes.add(state.bodies.motions[b].angular_momentum);
  }
  const auto remember = [&](const JointState<Dim>& history) {
    bytes.add(history.shear_force);
    bytes.add(history.normal);
    bytes.add(history.point);
    bytes.add(history.plastic_slip);
    if (history.twist != 0) bytes.add(history.twist);
    bytes.add(history.shear_stiffness);
    bytes.add(static_cast<int>(history.bonded));
  };
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i) {
    const Contact<Dim>& c = state.contacts.list[i];
    if (c.bond_due) {
      bytes.add(c.part_a);
      bytes.add(c.part_b);
    }
    if (!c.touching()) continue;
    for (const int key : {c.part_a, c.part_b, c.cells})
      bytes.add(key);
    remember(c.history);
    for (const SubContact<Dim>& s : subs_of(state.contacts, i))
      remember(s.history);
  }
  for (const std::vector<double>& water : state.schedule.water)
    for (const double number : water)
      bytes.add(number);
  for (const BoltSpring<Dim>& s : state.supports.bolt_springs) {
    bytes.add(s.bolt);
    bytes.add(s.number);
    bytes.add(s.body_a);
    bytes.add(s.body_b);
    bytes.add(s.place_a);
    bytes.add(s.place_b);
    bytes.add(s.axis);
    bytes.add(s.length);
    bytes.add(s.stiffness);
    bytes.add(s.plastic);
    bytes.add(s.slip);
    bytes.add(static_cast<int>(s.broken));
    bytes.add(s.force);
    bytes.add(s.shear);
  }
  for (const GroutedBolt<Dim>& g : state.supports.grouted) {
    bytes.add(g.bolt);
    bytes.add(g.first_spring);
    for (const int body : g.body)
      bytes.add(body);
    for (const Vector<Dim>& place : g.place)
      bytes.add(place);
    const GroutedBarState& s = g.state;
    for (const std::vector<double>* list :
         {&g.bar.position, &g.bar.bond_length, &s.displacement, &s.rock, &s.bond_force, &s.bond_strength, &s.slip,
          &s.bar_force, &s.bar_strength, &s.plastic_stretch})
      for (const double x : *list)
        bytes.add(x);
    bytes.add(s.plate_force);
    bytes.add(s.plate_closure);
  }
  for (const LiningState& lined : state.supports.linings) {
    bytes.add(lined.lining);
    for (const LiningContact& c : lined.contacts) {
      bytes.add(c.rock);
      for (const double x : {c.closure, c.place, c.shear, c.plastic_slip, c.normal})
        bytes.add(x);
      bytes.add(static_cast<int>(c.bonded));
    }
  }
  for (const ReliefLoad<Dim>& held : state.loads.relief) {
    bytes.add(held.body);
    bytes.add(held.load.force);
    bytes.add(held.load.moment);
    bytes.add(held.share);
  }
  return fingerprint(bytes.text);
}

template std::string state_hash<2>(const Model<2>&, const State<2>&);
template std::string state_hash<3>(const Model<3>&, const State<3>&);

}  // namespace voussoir
