#include "core/scene/joint_outline.hpp"

#include "core/scene/bodies.hpp"

namespace voussoir {
namespace {

// a corner of an outline is in the joint's plane within this fraction of its distance from the joint's point: far above
// the rounding of coordinates and angles of six digits, far below any intended offset from the plane
constexpr double off_plane = 1e-4;

std::vector<Vector<2>> corners_of(const JointSpec& joint, const Vector<3>& normal, const Outline<3>& outline,
                                  const Vector<3>& origin) {
  std::vector<Vector<2>> corners;
  const Node& list = *joint.subject.node->find("corners");
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const Vector<3> corner = to_vector<3>(joint.outline.corners[i]) - origin - outline.centre;
    if (std::abs(normal.dot(corner)) > off_plane * corner.norm())
      refuse(list.items[i], key_path(joint.subject.path, "corners") + "." + std::to_string(i + 1),
             "is not in the joint's plane; move the corner, or correct dip, dip_direction or point");
    corners.push_back(outline.axes.transpose() * corner);
  }
  corners = counter_clockwise(std::move(corners));
  if (corners.empty())
    refuse(joint.subject, "corners",
           "are not the corners of a convex polygon in order; give at least three, one after the other around it, or "
           "divide the joint into "
           "two");
  return corners;
}

}  // namespace

template <int Dim>
Outline<Dim> outline_of(const JointSpec& joint, const Vector<Dim>& normal, const Vector<Dim>& origin) {
  Outline<Dim> outline;
  outline.shape = joint.outline.shape;
  if (outline.shape == OutlineForm::none) return outline;
  outline.centre = to_vector<Dim>(joint.plane.point) - origin;
  outline.axes = plane_axes(normal);
  outline.half_sizes[0] = joint.outline.length / 2;
  if constexpr (Dim == 3) {
    outline.half_sizes[1] = joint.outline.width / 2;
    if (outline.shape == OutlineForm::polygon) outline.corners = corners_of(joint, normal, outline, origin);
  }
  return outline;
}

template Outline<2> outline_of<2>(const JointSpec&, const Vector<2>&, const Vector<2>&);
template Outline<3> outline_of<3>(const JointSpec&, const Vector<3>&, const Vector<3>&);

}  // namespace voussoir
