#include "core/scene/region.hpp"

#include "core/scene/bodies.hpp"
#include "core/slicing/clump.hpp"

namespace voussoir {
namespace {

HalfSpaces<2> cylinder_planes(const CylinderSpec& c, const Vector<2>& origin) {
  return circle_region(to_vector<2>(c.from) - origin, c.radius, c.sides);
}
HalfSpaces<3> cylinder_planes(const CylinderSpec& c, const Vector<3>& origin) {
  return cylinder_region(to_vector<3>(c.from) - origin, to_vector<3>(c.to) - origin, c.radius, c.sides);
}

}  // namespace

template <int Dim>
HalfSpaces<Dim> region_planes(const RegionSpec& spec, const Vector<Dim>& origin) {
  HalfSpaces<Dim> region;
  if (spec.box) region = box_planes<Dim>(*spec.box, origin);
  if (spec.cylinder) region = cylinder_planes(*spec.cylinder, origin);
  for (const DomainPlaneSpec& p : spec.planes) {
    const HalfSpace<Dim> plane = to_half_space<Dim>(p.plane, origin);
    region.push_back(p.keep_below ? plane : HalfSpace<Dim>{-plane.normal, -plane.offset});
  }
  return region;
}

template HalfSpaces<2> region_planes<2>(const RegionSpec&, const Vector<2>&);
template HalfSpaces<3> region_planes<3>(const RegionSpec&, const Vector<3>&);

}  // namespace voussoir
