#include "core/key_blocks/recut.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/polytope.hpp"

namespace voussoir {
namespace {

constexpr double whole_face = 1e-6;   // of a face's area, by which the area of its contact may differ
constexpr double vanishing = 1e-9;    // of a block's radius: a plane that cuts off less makes no face
constexpr double same_plane = 1e-12;  // of normals, and of offsets over the mass's size: planes of the domain repeat

}  // namespace

template <int Dim>
Recutter<Dim>::Recutter(const Assembly<Dim>& assembly) : assembly_(assembly) {
  double size = 0;
  for (const Body<Dim>& body : assembly.model.bodies)
    size = std::max(size, body.reference.norm() + body.radius);
  for (const Body<Dim>& body : assembly.model.bodies)
    for (const Polytope<Dim>& part : body.parts)
      for (std::size_t f = 0; f < part.faces.size(); ++f) {
        if (part.joints[f] != no_joint) continue;
        const HalfSpace<Dim> plane = moved_origin<Dim>(part.faces[f], -body.reference);
        const auto known = std::find_if(loose_.begin(), loose_.end(), [&](const HalfSpace<Dim>& other) {
          return (other.normal - plane.normal).norm() <= same_plane &&
                 std::abs(other.offset - plane.offset) <= same_plane * size;
        });
        if (known == loose_.end()) loose_.push_back(plane);
      }
}

// whether a body has corners on both sides of a plane; `corners` relative to the centroid
template <int Dim>
bool Recutter<Dim>::is_crossed(const HalfSpace<Dim>& plane, const Vector<Dim>& centroid, double radius,
                               const std::vector<Vector<Dim>>& corners) const {
  const double height = signed_distance(plane, centroid);
  if (std::abs(height) > radius) return false;
  const auto beyond = [&](const Vector<Dim>& corner) {
    return height > 0 ? height + plane.normal.dot(corner) < -vanishing * radius
                      : height + plane.normal.dot(corner) > vanishing * radius;
  };
  return std::any_of(corners.begin(), corners.end(), beyond);
}

template <int Dim>
bool Recutter<Dim>::cut(int body, std::span<const HalfSpace<Dim>> planes) {
  const Body<Dim>& b = assembly_.model.bodies[body];
  const Polytope<Dim>& part = b.parts[0];
  faces_ = part.faces;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (part.joints[f] == no_joint) continue;
    const HalfSpace<Dim>& plane = planes[part.joints[f]];
    const double sign = part.faces[f].normal.dot(assembly_.model.joints[part.joints[f]].plane.normal) < 0 ? -1 : 1;
    faces_[f] = moved_origin<Dim>({sign * plane.normal, sign * plane.offset}, b.reference);
  }
  const double least = vanishing * b.radius;
  if (std::any_of(faces_.begin(), faces_.end(), [&](const HalfSpace<Dim>& face) { return !(face.offset > 2 * least); }))
    return false;
  surface_ = find_surface(faces_, least);
  return surface_.status == SurfaceStatus::ok;
}

// whether no plane but those of its faces crosses the block, as sliced and with the new planes, nor leaves it on the
// other side
template <int Dim>
bool Recutter<Dim>::stays_whole(int body, std::span<const HalfSpace<Dim>> planes) const {
  const Body<Dim>& b = assembly_.model.bodies[body];
  const Polytope<Dim>& part = b.parts[0];
  double radius = 0;
  for (const Vector<Dim>& corner : surface_.vertices)
    radius = std::max(radius, corner.norm());
  for (std::size_t j = 0; j < planes.size(); ++j) {
    if (std::find(part.joints.begin(), part.joints.end(), static_cast<int>(j)) != part.joints.end()) continue;
    const HalfSpace<Dim>& before = assembly_.model.joints[j].plane;
    if ((signed_distance(before, b.reference) > 0) != (signed_distance(planes[j], b.reference) > 0)) return false;
    if (is_crossed(before, b.reference, b.radius, part.vertices)) return false;
    if (is_crossed(planes[j], b.reference, radius, surface_.vertices)) return false;
  }
  return std::none_of(loose_.begin(), loose_.end(), [&](const HalfSpace<Dim>& plane) {
    return is_crossed(plane, b.reference, b.radius, part.vertices) ||
           is_crossed(plane, b.reference, radius, surface_.vertices);
  });
}

// the faces on rock, and the areas
template <int Dim>
bool Recutter<Dim>::add_faces(int body, Block<Dim>& block) const {
  const Body<Dim>& b = assembly_.model.bodies[body];
  const Polytope<Dim>& part = b.parts[0];
  std::size_t matched = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (part.loops[f].size() < Dim && surface_.loops[f].size() < Dim) continue;
    if (part.loops[f].size() < Dim || surface_.loops[f].size() < Dim) return false;
    const double area = face_area<Dim>(surface_.vertices, surface_.loops[f]);
    block.surface += area;
    const RockContact<Dim>* on = nullptr;
    for (const int place : assembly_.contacts.of(body)) {
      const RockContact<Dim>& contact = assembly_.contacts.list[place];
      const double inwards = contact.body_b == body ? 1 : -1;
      if (contact.joint != part.joints[f] || !(inwards * contact.normal.dot(part.faces[f].normal) < 0)) continue;
      if (on || contact.joint == no_joint || !contact.one_joint) return false;
      on = &contact;
    }
    if (!on) continue;
    const double former = face_area<Dim>(part, static_cast<int>(f));
    if (std::abs(on->area - former) > whole_face * former) return false;
    ++matched;
    const JointProperties& properties = assembly_.model.properties[on->properties];
    RockFace<Dim> face;
    face.normal = -faces_[f].normal;
    face.joint = on->joint;
    face.properties = on->properties;
    face.area = area;
    face.set_friction(properties);
    face.cohesion = area * properties.cohesion;
    face.centroid = b.reference + face_centroid<Dim>(surface_.vertices, surface_.loops[f], faces_[f].normal);
    block.contact_area += area;
    block.faces.push_back(face);
    block.normals.push_back(face.normal);
  }
  return matched == assembly_.contacts.of(body).size();
}

template <int Dim>
bool Recutter<Dim>::recut(int body, std::span<const HalfSpace<Dim>> planes, Block<Dim>& block) {
  const Body<Dim>& b = assembly_.model.bodies[body];
  if (b.parts.size() != 1 || !b.present || !assembly_.water[body].force.isZero(0)) return false;
  for (const BoltCrossing<Dim>& crossing : assembly_.crossings) {
    const RockContact<Dim>& contact = assembly_.contacts.list[crossing.contact];
    if (contact.body_a == body || contact.body_b == body) return false;
  }
  if (!cut(body, planes) || !stays_whole(body, planes)) return false;
  block = {};
  block.bodies = {body};
  if (!add_faces(body, block)) return false;
  const MassProperties<Dim> mass = integrate<Dim>(surface_.vertices, surface_.loops);
  const double former = volume(b);
  block.volume = mass.volume;
  block.weight = b.mass * mass.volume / former * assembly_.model.gravity.norm();
  block.centroid = b.reference + mass.centroid;
  block.stated.force = assembly_.stated[body].force + b.mass * (mass.volume / former - 1) * assembly_.model.gravity;
  block.fixed = b.fixed;
  return true;
}

template class Recutter<2>;
template class Recutter<3>;

}  // namespace voussoir
