#include "core/slicing/clump.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

#include "core/geometry/half_space_inl.hpp"

namespace voussoir {
namespace {

// Two faces that share less than this of the smaller one's area (and, in lengths, less than its root) touch at an
// edge: above the rounding of their corners, below any contact that could transfer load.
constexpr double least_fraction = 1e-9;

// a corner beyond a joint's extent by no more than this times the extent's or the face's size lies in it
constexpr double extent_rounding = 1e-9;

// a face of a part on one side of a joint
template <int Dim>
struct JointFace {
  int part, face;
  FixedMatrix<Dim - 1, 1> low, high;  // box along the joint's axes
};

template <int Dim>
struct FacesOfJoint {
  std::vector<JointFace<Dim>> below, above;
};

template <int Dim>
std::vector<Vector<Dim>> corners(const Polytope<Dim>& part, int face) {
  std::vector<Vector<Dim>> points;
  for (const int v : part.loops[face])
    points.push_back(part.vertices[v]);
  return points;
}

double size_of(const std::vector<Vector<2>>& ends) {
  double length = 0;
  for (const Vector<2>& p : ends)
    length = std::max(length, (p - ends.front()).norm());
  return length;
}

double size_of(const std::vector<Vector<3>>& ring) {
  Vector<3> twice = Vector<3>::Zero();
  for (std::size_t k = 1; k + 1 < ring.size(); ++k)
    twice += (ring[k] - ring[0]).cross(ring[k + 1] - ring[0]);
  return twice.norm() / 2;
}

// the part of a ring of points (2-D: of a segment) in a half-space
template <int Dim>
std::vector<Vector<Dim>> clipped(const std::vector<Vector<Dim>>& ring, const HalfSpace<Dim>& plane) {
  std::vector<Vector<Dim>> left;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vector<Dim>&a = ring[k], &b = ring[(k + 1) % ring.size()];
    const double da = signed_distance<Dim>(plane, a), db = signed_distance<Dim>(plane, b);
    if (da <= 0) left.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) left.push_back(a + da / (da - db) * (b - a));
  }
  return left;
}

template <int Dim>
std::vector<FacesOfJoint<Dim>> faces_by_joint(const std::vector<Polytope<Dim>>& parts,
                                              const std::vector<Cut<Dim>>& cuts,
                                              const std::map<int, std::size_t>& place) {
  std::vector<FacesOfJoint<Dim>> all(cuts.size());
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t f = 0; f < parts[p].faces.size(); ++f) {
      const auto at = place.find(parts[p].joints[f]);
      if (at == place.end()) continue;
      const Cut<Dim>& cut = cuts[at->second];
      const auto axes = plane_axes(cut.plane.normal);
      JointFace<Dim> face{static_cast<int>(p), static_cast<int>(f), {}, {}};
      face.low.setConstant(std::numeric_limits<double>::max());
      face.high.setConstant(std::numeric_limits<double>::lowest());
      for (const int v : parts[p].loops[f]) {
        const FixedMatrix<Dim - 1, 1> y = axes.transpose() * parts[p].vertices[v];
        face.low = face.low.cwiseMin(y);
        face.high = face.high.cwiseMax(y);
      }
      const bool below = parts[p].faces[f].normal.dot(cut.plane.normal) > 0;
      (below ? all[at->second].below : all[at->second].above).push_back(face);
    }
  return all;
}

// the area that two faces share, and whether the joint covers it
template <int Dim>
SharedFace shared(const std::vector<Polytope<Dim>>& parts, const Cut<Dim>& cut, const JointFace<Dim>& below,
                  const JointFace<Dim>& above) {
  SharedFace face{cut.joint, below.part, above.part, 0, true};
  std::vector<Vector<Dim>> region = corners(parts[below.part], below.face);
  const double size = size_of(region);
  const Polytope<Dim>& other = parts[above.part];
  for (int f = 0; f < static_cast<int>(other.faces.size()) && !region.empty(); ++f)
    if (f != above.face) region = clipped<Dim>(region, other.faces[f]);
  if (region.empty()) return face;
  const double area = size_of(region);
  if (area <= least_fraction * std::min(size, size_of(corners(other, above.face)))) return face;
  face.area = area;
  const double reach = std::isinf(cut.extent.radius) ? 0 : cut.extent.radius;
  const double rounding = extent_rounding * (reach + (below.high - below.low).norm());
  for (const HalfSpace<Dim>& bound : cut.extent.bounds)
    for (const Vector<Dim>& p : region)
      face.covered = face.covered && signed_distance<Dim>(bound, p) <= rounding;
  return face;
}

// pairs whose boxes overlap, by a sweep along the first axis
template <int Dim, class Visit>
void sweep(std::vector<JointFace<Dim>>& below, std::vector<JointFace<Dim>>& above, const Visit& visit) {
  const auto by_low = [](const JointFace<Dim>& a, const JointFace<Dim>& b) {
    return std::pair(a.low[0], a.part) < std::pair(b.low[0], b.part);
  };
  std::sort(below.begin(), below.end(), by_low);
  std::sort(above.begin(), above.end(), by_low);
  std::vector<const JointFace<Dim>*> active;  // above, begun and not yet passed
  std::vector<const JointFace<Dim>*> active_below;
  const auto meet = [&](std::vector<const JointFace<Dim>*>& others, const JointFace<Dim>& face, bool is_below) {
    std::erase_if(others, [&](const JointFace<Dim>* other) { return other->high[0] < face.low[0]; });
    for (const JointFace<Dim>* other : others)
      if ((other->low.array() <= face.high.array()).all() && (face.low.array() <= other->high.array()).all())
        is_below ? visit(face, *other) : visit(*other, face);
  };
  for (std::size_t i = 0, j = 0; i < below.size() || j < above.size();) {
    const bool next_below = j == above.size() || (i < below.size() && below[i].low[0] <= above[j].low[0]);
    const JointFace<Dim>& face = next_below ? below[i++] : above[j++];
    meet(next_below ? active : active_below, face, next_below);
    (next_below ? active_below : active).push_back(&face);
  }
}

}  // namespace

template <int Dim>
std::vector<SharedFace> shared_faces(const std::vector<Polytope<Dim>>& parts, const std::vector<Cut<Dim>>& cuts) {
  std::map<int, std::size_t> place;
  for (std::size_t c = 0; c < cuts.size(); ++c)
    place[cuts[c].joint] = c;
  std::vector<SharedFace> all;
  std::vector<FacesOfJoint<Dim>> by_joint = faces_by_joint(parts, cuts, place);
  for (std::size_t c = 0; c < cuts.size(); ++c)
    sweep<Dim>(by_joint[c].below, by_joint[c].above, [&](const JointFace<Dim>& below, const JointFace<Dim>& above) {
      const SharedFace face = shared(parts, cuts[c], below, above);
      if (face.area > 0) all.push_back(face);
    });
  std::sort(all.begin(), all.end(), [](const SharedFace& a, const SharedFace& b) {
    return std::tie(a.joint, a.below, a.above) < std::tie(b.joint, b.below, b.above);
  });
  return all;
}

template <int Dim>
std::vector<int> bodies_of(const std::vector<Polytope<Dim>>& parts, const std::vector<Cut<Dim>>& cuts, bool heal) {
  // only these joints can hold parts together
  std::vector<Cut<Dim>> holding;
  std::map<int, JointKind> kind;
  for (const Cut<Dim>& cut : cuts)
    if (cut.kind == JointKind::construction || (heal && !cut.extent.infinite())) {
      holding.push_back(cut);
      kind[cut.joint] = cut.kind;
    }

  // each part points to a lower one of its body, the lowest to itself
  std::vector<int> lower(parts.size());
  std::iota(lower.begin(), lower.end(), 0);
  const auto lowest = [&](int part) {
    while (lower[part] != part)
      part = lower[part] = lower[lower[part]];
    return part;
  };
  for (const SharedFace& face : shared_faces(parts, holding))
    if (kind[face.joint] == JointKind::construction || !face.covered) {
      const std::pair<int, int> ends = std::minmax(lowest(face.below), lowest(face.above));
      lower[ends.second] = ends.first;
    }

  std::vector<int> body(parts.size());
  int count = 0;
  for (std::size_t p = 0; p < parts.size(); ++p)
    body[p] = lower[p] == static_cast<int>(p) ? count++ : body[lowest(static_cast<int>(p))];
  return body;
}

template <int Dim>
std::vector<Polytope<Dim>> excavated(std::vector<Polytope<Dim>> parts, const HalfSpaces<Dim>& region) {
  std::erase_if(parts, [&](const Polytope<Dim>& part) { return lies_inside<Dim>(region, part.mass.centroid); });
  return parts;
}

HalfSpaces<3> cylinder_region(const Vector<3>& from, const Vector<3>& to, double radius, int sides, double turn) {
  const Vector<3> axis = (to - from).normalized();
  const Vector<3> first = perpendicular(axis), second = axis.cross(first);
  HalfSpaces<3> planes{{-axis, -axis.dot(from)}, {axis, axis.dot(to)}};
  for (int k = 0; k < sides; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / sides;
    const Vector<3> out = std::cos(angle) * first + std::sin(angle) * second;
    planes.push_back({out.normalized(), out.normalized().dot(from) + radius});
  }
  return planes;
}

HalfSpaces<2> circle_region(const Vector<2>& centre, double radius, int sides, double turn) {
  HalfSpaces<2> planes;
  for (int k = 0; k < sides; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / sides;
    const Vector<2> out(std::cos(angle), std::sin(angle));
    planes.push_back({out, out.dot(centre) + radius});
  }
  return planes;
}

template std::vector<SharedFace> shared_faces<2>(const std::vector<Polytope<2>>&, const std::vector<Cut<2>>&);
template std::vector<SharedFace> shared_faces<3>(const std::vector<Polytope<3>>&, const std::vector<Cut<3>>&);
template std::vector<int> bodies_of<2>(const std::vector<Polytope<2>>&, const std::vector<Cut<2>>&, bool);
template std::vector<int> bodies_of<3>(const std::vector<Polytope<3>>&, const std::vector<Cut<3>>&, bool);
template std::vector<Polytope<2>> excavated<2>(std::vector<Polytope<2>>, const HalfSpaces<2>&);
template std::vector<Polytope<3>> excavated<3>(std::vector<Polytope<3>>, const HalfSpaces<3>&);

}  // namespace voussoir
