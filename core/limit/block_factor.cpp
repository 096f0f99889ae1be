#include "core/limit/block_factor.hpp"

#include <algorithm>
#include <limits>

#include "core/limit/limit.hpp"

namespace voussoir {
namespace {

constexpr int rock = 0, own = 1;  // bodies of the assembly

template <int Dim>
CornerAssembly<Dim> corners_of(const Assembly<Dim>& assembly, const Block<Dim>& block) {
  CornerAssembly<Dim> corners{{{}, {block.centroid, 0, 0, {}}}, {}, assembly.model.properties};
  CornerBody<Dim>& body = corners.bodies[own];
  body.free.fill(true);
  for (std::size_t k = 0; k < block.contacts.size(); ++k) {
    const RockContact<Dim>& contact = assembly.contacts.list[block.contacts[k]];
    const JointProperties& p = assembly.model.properties[contact.properties];
    const bool is_b = std::binary_search(block.bodies.begin(), block.bodies.end(), contact.body_b);
    const auto places = assembly.contacts.corners_of(contact);
    corners.faces.push_back({rock,
                             own,
                             Vector<Dim>((is_b ? 1 : -1) * contact.normal),
                             {places.begin(), places.end()},
                             contact.properties,
                             p.friction,
                             contact.one_joint ? p.cohesion : 0});
    for (const Vector<Dim>& place : places)
      body.radius = std::max(body.radius, (place - block.centroid).norm());
  }
  return corners;
}

}  // namespace

template <int Dim>
std::optional<double> factor_with_moments(const Assembly<Dim>& assembly, const Block<Dim>& block) {
  if (block.contacts.empty()) return {};
  CornerAssembly<Dim> corners = corners_of(assembly, block);
  Loads<Dim> loads{{}, {block.stated.force + block.water.force, block.stated.moment + block.water.moment}};
  for (const BlockBolt<Dim>& bolt : block.bolts) {
    const BoltProperties& p = assembly.model.bolt_properties[assembly.model.bolts[bolt.bolt].properties];
    const double least = !p.yield ? bolt.capacity : p.tension_only ? 0 : -bolt.capacity;
    if (least < bolt.capacity) {
      corners.ties.push_back({rock, own, bolt.place, Vector<Dim>(-bolt.direction), least, bolt.capacity, 0, bolt.bolt});
      continue;
    }
    const Vector<Dim> pull = bolt.capacity * bolt.direction;
    loads[own].force += pull;
    loads[own].moment += moment(Vector<Dim>(bolt.place - block.centroid), pull);
  }
  CornerBody<Dim>& body = corners.bodies[own];
  body.weight = std::max(loads[own].force.norm(), loads[own].moment.norm() / body.radius);
  if (!(body.weight > 0)) return {};
  const CriticalStrength<Dim> found =
      find_factor_of_safety(corners, loads, std::vector<bool>(corners.faces.size(), true));
  switch (found.status) {
    case LimitStatus::found:
      return 0.5 * (found.collapses + found.stands);
    case LimitStatus::carries_any:
    case LimitStatus::not_attained:  // by self-stress at any friction above none
      return std::numeric_limits<double>::infinity();
    case LimitStatus::carries_nothing:
      return 0;
    default:
      return {};
  }
}

template std::optional<double> factor_with_moments<2>(const Assembly<2>&, const Block<2>&);
template std::optional<double> factor_with_moments<3>(const Assembly<3>&, const Block<3>&);

}  // namespace voussoir
