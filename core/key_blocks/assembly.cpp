#include "core/key_blocks/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/key_blocks/direction_cone.hpp"
#include "core/model/water_surfaces.hpp"

namespace voussoir {
namespace {

constexpr double closed_surface = 1e-9;  // of a surface: a free area below it is rounding

template <int Dim>
std::vector<Load<Dim>> stated_loads(const Model<Dim>& model) {
  std::vector<Load<Dim>> loads(model.bodies.size());
  for (std::size_t b = 0; b < model.bodies.size(); ++b)
    loads[b].force = model.bodies[b].mass * model.gravity;
  for (const AppliedForce<Dim>& applied : model.applied) {
    const Vector<Dim> force = applied.last_factor * applied.force;
    loads[applied.body].force += force;
    loads[applied.body].moment += moment(applied.place, force);
  }
  return loads;
}

// whether a point of a contact's plane is within the contact
template <int Dim>
bool is_within(const RockContact<Dim>& contact, std::span<const Vector<Dim>> corners, const Vector<Dim>& point) {
  if constexpr (Dim == 2) {
    return (point - corners[0]).dot(corners[1] - corners[0]) >= 0 &&
           (point - corners[1]).dot(corners[0] - corners[1]) >= 0;
  } else {
    bool left = false, right = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vector<3>&a = corners[k], &b = corners[(k + 1) % corners.size()];
      const double side = contact.normal.dot((b - a).cross(point - a));
      left |= side > 0;
      right |= side < 0;
    }
    return !(left && right);
  }
}

template <int Dim>
std::vector<BoltCrossing<Dim>> crossings_of(const Model<Dim>& model, const RockContacts<Dim>& contacts,
                                            const std::vector<bool>& installed) {
  std::vector<BoltCrossing<Dim>> crossings;
  if (std::find(installed.begin(), installed.end(), true) == installed.end()) return crossings;
  for (std::size_t i = 0; i < contacts.list.size(); ++i) {
    const RockContact<Dim>& contact = contacts.list[i];
    const std::span<const Vector<Dim>> corners = contacts.corners_of(contact);
    for (std::size_t b = 0; b < model.bolts.size(); ++b) {
      if (!installed[b]) continue;
      const Bolt<Dim>& bolt = model.bolts[b];
      const Vector<Dim> along = bolt.toe - bolt.collar;
      const double from = contact.normal.dot(bolt.collar - corners[0]), to = contact.normal.dot(bolt.toe - corners[0]);
      if ((from > 0) == (to > 0) || from == to) continue;
      const Vector<Dim> point = bolt.collar + from / (from - to) * along;
      if (!is_within(contact, corners, point)) continue;
      // tension pulls body_b, on the side of the normal, back through the joint
      crossings.push_back(
          {static_cast<int>(b), static_cast<int>(i), Vector<Dim>((from < 0 ? -1 : 1) * along.normalized()), point});
    }
  }
  return crossings;
}

template <int Dim>
void add_bolts(const Assembly<Dim>& assembly, Block<Dim>& block) {
  for (const int contact : block.contacts) {
    const auto [begin, end] =
        std::equal_range(assembly.crossings.begin(), assembly.crossings.end(), BoltCrossing<Dim>{0, contact},
                         [](const BoltCrossing<Dim>& a, const BoltCrossing<Dim>& b) { return a.contact < b.contact; });
    for (auto crossing = begin; crossing != end; ++crossing) {
      const BoltProperties& properties =
          assembly.model.bolt_properties[assembly.model.bolts[crossing->bolt].properties];
      const bool is_b =
          std::binary_search(block.bodies.begin(), block.bodies.end(), assembly.contacts.list[contact].body_b);
      block.bolts.push_back({crossing->bolt, Vector<Dim>((is_b ? 1 : -1) * crossing->on_b), crossing->place,
                             properties.pretension, properties.yield.value_or(properties.pretension)});
    }
  }
}

template <int Dim>
int face_for(const Assembly<Dim>& assembly, const RockContact<Dim>& contact, const Vector<Dim>& normal,
             Block<Dim>& block) {
  for (std::size_t f = 0; f < block.faces.size(); ++f)
    if (block.faces[f].joint == contact.joint && (block.faces[f].normal - normal).norm() <= closing_tolerance)
      return static_cast<int>(f);
  RockFace<Dim> face;
  face.normal = normal;
  face.joint = contact.joint;
  face.properties = contact.properties;
  face.set_friction(assembly.model.properties[contact.properties]);
  block.faces.push_back(face);
  block.normals.push_back(normal);
  return static_cast<int>(block.faces.size()) - 1;
}

// about another point, to which it is at `lever`
template <int Dim>
void add_load(const Load<Dim>& load, const Vector<Dim>& lever, Load<Dim>& sum) {
  sum.force += load.force;
  sum.moment += load.moment + moment(lever, load.force);
}

template <int Dim>
void add_bodies(const Assembly<Dim>& assembly, Block<Dim>& block) {
  for (const int body : block.bodies) {
    const Body<Dim>& b = assembly.model.bodies[body];
    const double size = assembly.volumes[body];
    block.volume += size;
    block.centroid += size * b.reference;
    block.weight += b.mass * assembly.model.gravity.norm();
    block.surface += assembly.contacts.surface[body];
    block.fixed |= b.fixed;
  }
  if (block.volume > 0) block.centroid /= block.volume;
  for (const int body : block.bodies) {
    const Vector<Dim> lever = assembly.model.bodies[body].reference - block.centroid;
    add_load<Dim>(assembly.stated[body], lever, block.stated);
    add_load<Dim>(assembly.water[body], lever, block.water);
  }
}

}  // namespace

template <int Dim>
void RockFace<Dim>::set_friction(const JointProperties& joint) {
  rough = joint.follows_barton_bandis() ? &joint : nullptr;
  tan_friction = rough ? 0 : std::tan(joint.friction);
}

template <int Dim>
double RockFace<Dim>::tan_friction_at(double normal_force) const {
  return rough ? std::tan(peak_friction(*rough, normal_force / area)) : tan_friction;
}

template <int Dim>
double RockFace<Dim>::friction_slope(double normal_force) const {
  return rough ? std::tan(envelope_tangent(*rough, normal_force / area).friction) : tan_friction;
}

template <int Dim>
double RockFace<Dim>::friction_gain(double normal_force, double more) const {
  if (!rough) return more * tan_friction;
  return friction_force(std::max(0.0, normal_force + more)) - friction_force(normal_force);
}

template <int Dim>
bool Block<Dim>::enclosed() const {
  return surface - contact_area < closed_surface * surface;
}

template <int Dim>
Assembly<Dim> make_assembly(Model<Dim> model, const WaterValues& water, const std::vector<bool>& bolts) {
  Assembly<Dim> assembly;
  assembly.contacts = find_rock_contacts(model);
  assembly.stated = stated_loads(model);
  assembly.water = water_loads_at_reference<Dim>(model, water);
  assembly.water_values = water;
  assembly.crossings = crossings_of(model, assembly.contacts, bolts);
  for (const Body<Dim>& body : model.bodies) {
    assembly.free.push_back(body.present && !body.fixed && !body.parts.empty());
    assembly.volumes.push_back(volume(body));
  }
  assembly.model = std::move(model);
  return assembly;
}

template <int Dim>
void gather(const Assembly<Dim>& assembly, std::span<const int> bodies, const std::vector<char>& gone,
            Block<Dim>& block) {
  block.faces.clear();
  block.normals.clear();
  block.contacts.clear();
  block.face_of_contact.clear();
  block.bolts.clear();
  block.contact_area = block.surface = block.volume = block.weight = 0;
  block.centroid.setZero();
  block.stated = block.water = {};
  block.fixed = false;
  block.bodies.assign(bodies.begin(), bodies.end());
  std::sort(block.bodies.begin(), block.bodies.end());
  add_bodies(assembly, block);
  const auto is_inside = [&](int body) {
    return block.bodies.size() == 1 ? body == block.bodies[0]
                                    : std::binary_search(block.bodies.begin(), block.bodies.end(), body);
  };
  for (const int body : block.bodies)
    for (const int place : assembly.contacts.of(body)) {
      const RockContact<Dim>& contact = assembly.contacts.list[place];
      const bool is_b = contact.body_b == body;
      const int other = is_b ? contact.body_a : contact.body_b;
      if (is_inside(other)) {
        block.surface -= contact.area;  // seen from both bodies
        continue;
      }
      if (!gone.empty() && gone[other]) continue;
      const int face = face_for(assembly, contact, Vector<Dim>((is_b ? 1 : -1) * contact.normal), block);
      RockFace<Dim>& on = block.faces[face];
      on.area += contact.area;
      on.centroid += contact.area * contact.centroid;
      if (contact.one_joint) on.cohesion += contact.area * assembly.model.properties[contact.properties].cohesion;
      block.contact_area += contact.area;
      block.contacts.push_back(place);
      block.face_of_contact.push_back(face);
    }
  for (RockFace<Dim>& face : block.faces)
    face.centroid /= face.area;
  if (!assembly.crossings.empty()) add_bolts(assembly, block);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                      \
  template struct RockFace<Dim>;                                                                       \
  template struct Block<Dim>;                                                                          \
  template Assembly<Dim> make_assembly<Dim>(Model<Dim>, const WaterValues&, const std::vector<bool>&); \
  template void gather<Dim>(const Assembly<Dim>&, std::span<const int>, const std::vector<char>&, Block<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
