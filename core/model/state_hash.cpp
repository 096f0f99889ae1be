#include "core/model/state_hash.hpp"

#include <bit>
#include <cstdint>

#include "core/base/fingerprint.hpp"
#include "core/model/fields.hpp"

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
  void add(bool b) { add(static_cast<int>(b)); }
  void add(Bond b) { add(static_cast<int>(b)); }
  void add(const Rotation<2>& r) { add(r.angle); }
  void add(const Rotation<3>& r) { add(r.quaternion.coeffs()); }
  template <class T>
  void add(const std::vector<T>& list) {
    for (const T& one : list)
      add(one);
  }
  template <HasFields T>
  void add(const T& object) {
    visit_fields(object, *this);
  }

  void operator()(Hashed, const auto&... fields) { (add(fields), ...); }
  void operator()(HashedIfSet, const auto& field) {
    if (field != 0) add(field);
  }
  void operator()(Saved, const auto&...) {}
  void operator()(Found, const auto&...) {}
};

template <int Dim>
void add_contact(const ContactsState<Dim>& contacts, std::size_t place, Bytes& bytes) {
  const Contact<Dim>& c = contacts.list[place];
  if (c.bond_due) {
    bytes.add(c.part_a);
    bytes.add(c.part_b);
  }
  const std::span<const JointRise<Dim>> rises = rises_of(contacts, place);
  if (c.touching() || highest(rises) != nullptr)  // a rise is kept beyond the loss of contact
    for (const JointRise<Dim>& rise : rises)
      bytes.add(rise);
  if (!c.touching()) return;
  bytes.add(c);
  for (const SubContact<Dim>& s : subs_of(contacts, place))
    bytes.add(s);
}

}  // namespace

template <int Dim>
std::string state_hash(const Model<Dim>& model, const State<Dim>& state) {
  Bytes bytes;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (!model.bodies[b].present) continue;
    bytes.add(static_cast<int>(b));
    bytes.add(state.bodies.motions[b]);
  }
  for (std::size_t i = 0; i < state.contacts.list.size(); ++i)
    add_contact(state.contacts, i, bytes);
  bytes.add(state.schedule);
  bytes.add(state.supports);
  bytes.add(state.loads);
  return fingerprint(bytes.text);
}

template std::string state_hash<2>(const Model<2>&, const State<2>&);
template std::string state_hash<3>(const Model<3>&, const State<3>&);

}  // namespace voussoir
