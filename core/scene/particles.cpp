#include "core/scene/particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/potential/particle.hpp"
#include "core/potential/support.hpp"
#include "core/potential/valid_shape.hpp"
#include "core/slicing/block.hpp"

namespace voussoir {
namespace {

// unit normals, in an order of their own
template <int Dim>
void put_in_order(HalfSpaces<Dim>& planes) {
  for (HalfSpace<Dim>& plane : planes) {
    const double length = plane.normal.norm();
    plane = {plane.normal / length, plane.offset / length};
  }
  std::sort(planes.begin(), planes.end(), [](const HalfSpace<Dim>& p, const HalfSpace<Dim>& q) {
    for (int k = 0; k < Dim; ++k)
      if (p.normal[k] != q.normal[k]) return p.normal[k] < q.normal[k];
    return p.offset < q.offset;
  });
}

template <int Dim>
BlockResult<Dim> block_of(const HalfSpaces<Dim>& planes) {
  return make_block<Dim>(planes, std::vector<int>(planes.size(), no_joint));
}

// the centroid of the planes moved outwards by r; the origin if they do not form a block
template <int Dim>
Vector<Dim> middle_of(HalfSpaces<Dim> planes, double corner_radius) {
  for (HalfSpace<Dim>& plane : planes)
    plane.offset += corner_radius;
  const BlockResult<Dim> block = block_of<Dim>(planes);
  return block.status == BlockStatus::ok ? block.part.mass.centroid : Vector<Dim>(Vector<Dim>::Zero());
}

// the key that caused a problem
std::string key_of(const ShapeVerdict& verdict) {
  switch (verdict.problem) {
    case ShapeProblem::corner_radius:
      return "corner_radius";
    case ShapeProblem::sphericity:
      return "sphericity";
    case ShapeProblem::sphere_radius:
    case ShapeProblem::sphere_does_not_enclose:
      return "sphere_radius";
    case ShapeProblem::centre_outside:
      return "centre";
    default:
      return "planes";
  }
}

template <int Dim>
PotentialShape<Dim> shape_of(const BlockSpec& block, const HalfSpaces<Dim>& planes, const Vector<Dim>& origin) {
  const ParticleSpec& stated = block.particle;
  PotentialShape<Dim> shape;
  shape.sphericity = *stated.sphericity;
  shape.corner_radius = stated.corner_radius.value_or(stated.sphere_radius.value_or(1));  // a sphere has none
  if (shape.sphericity < 1) shape.planes = planes;
  shape.centre = stated.centre ? Vector<Dim>(Eigen::Map<const Vector<Dim>>(stated.centre->data()) - origin)
                               : middle_of<Dim>(planes, shape.corner_radius);
  if (stated.sphere_radius) {
    shape.sphere_radius = *stated.sphere_radius;
  } else {
    const double least = enclosing_radius<Dim>(shape.planes, shape.corner_radius, shape.centre);
    shape.sphere_radius = std::isfinite(least) && least > 0 ? least : 1;  // invalid values are reported by the check
  }
  const ShapeVerdict verdict = check_shape<Dim>(shape);
  if (verdict.ok()) return shape;
  const std::string key = key_of(verdict);
  const std::string place = key == "planes" && block.box ? "box" : key;
  refuse(block.subject, place, describe<Dim>(verdict, shape));
}

// A block that encloses the particle, bounded along its planes and along the axes.
template <int Dim>
BlockResult<Dim> enclosing_block(const PotentialShape<Dim>& shape) {
  const PlacedPotential<Dim> own = placed<Dim>(shape);
  RayScratch scratch;
  HalfSpaces<Dim> faces;
  const auto add = [&](const Vector<Dim>& direction) {
    const double farthest = direction.dot(own.centre) + own.reach;
    faces.push_back({direction, std::min(find_support<Dim>(own, direction, scratch).bound, farthest)});
  };
  for (const HalfSpace<Dim>& plane : own.planes)
    add(plane.normal);
  for (int k = 0; k < Dim; ++k) {
    add(Vector<Dim>::Unit(k));
    add(-Vector<Dim>::Unit(k));
  }
  return block_of<Dim>(faces);
}

template <int Dim>
PotentialShape<Dim> seen_from(PotentialShape<Dim> shape, const Vector<Dim>& point) {
  for (HalfSpace<Dim>& plane : shape.planes)
    plane = moved_origin(plane, point);
  shape.centre -= point;
  return shape;
}

}  // namespace

void check_particle_keys(const BlockSpec& block) {
  if (block.shape != BlockShape::potential) return;
  const Subject& table = block.subject;
  const ParticleSpec& stated = block.particle;
  if (table.node->find("vertices"))
    refuse(table, "vertices",
           "cannot define a potential particle; give its planes, or a box, at a distance r inside its faces");
  const bool has_planes = table.node->find("planes") || table.node->find("box");
  if (*stated.sphericity < 1) {
    if (!has_planes)
      refuse(table, "planes",
             fmt::format("sphericity = {:g} needs planes; add them or box, or write sphericity = 1 for a sphere",
                         *stated.sphericity));
    if (!stated.corner_radius)
      refuse(table, "corner_radius",
             "r rounds the corners of a potential particle; write for example corner_radius = 0.05");
    return;
  }
  if (!stated.sphere_radius)
    refuse(table, "sphere_radius", "a sphere needs its radius; write for example sphere_radius = 0.5");
  if (!stated.centre && !has_planes)
    refuse(table, "centre", "a sphere without planes needs its centre; write for example centre = [0, 0, 1]");
}

template <int Dim>
Polytope<Dim> make_particle_part(const BlockSpec& block, HalfSpaces<Dim> planes, const Vector<Dim>& origin) {
  put_in_order<Dim>(planes);
  const PotentialShape<Dim> shape = shape_of<Dim>(block, planes, origin);
  BlockResult<Dim> enclosing = enclosing_block<Dim>(shape);
  if (enclosing.status != BlockStatus::ok)
    refuse(*block.subject.node, block.subject.path,
           enclosing.status == BlockStatus::far
               ? "the particle is so far from the middle of the scene that its coordinates are rounded by more than "
                 "1e-6 of its size; move "
                 "the solids together, or make it larger"
               : "the particle is thinner than 1e-8 of its length; make corner_radius larger");
  Polytope<Dim>& part = enclosing.part;
  part.particle =
      std::make_shared<const Particle<Dim>>(make_particle<Dim>(seen_from<Dim>(shape, Vector<Dim>(part.centre))));
  return std::move(part);
}

template <int Dim>
Polytope<Dim> finish_particle(const BlockSpec& block, Polytope<Dim> part) {
  Particle<Dim> particle = *part.particle;
  particle.mass = mass_of<Dim>(particle.shape, block.particle.mass_tolerance);
  particle.drawing = draw<Dim>(particle.shape, moved_origin<Dim>(part, Vector<Dim>(part.centre)));
  part.mass = moved_origin<Dim>(particle.mass.mass, -part.centre);
  part.particle = std::make_shared<const Particle<Dim>>(std::move(particle));
  return part;
}

template <int Dim>
void add_inner_particles(const ContactSettings& settings, Model<Dim>& model) {
  if (!model.particles) return;
  for (Body<Dim>& body : model.bodies)
    for (Polytope<Dim>& part : body.parts)
      if (!part.particle)
        part.particle = std::make_shared<const Particle<Dim>>(inner_particle<Dim>(part, settings.potential_radius));
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                        \
  template Polytope<Dim> make_particle_part<Dim>(const BlockSpec&, HalfSpaces<Dim>, const Vector<Dim>&); \
  template Polytope<Dim> finish_particle<Dim>(const BlockSpec&, Polytope<Dim>);                          \
  template void add_inner_particles<Dim>(const ContactSettings&, Model<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
