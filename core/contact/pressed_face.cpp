#include "core/contact/pressed_face.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/face_integral.hpp"
#include "core/contact/pair_geometry.hpp"
#include "core/contact/region_integral.hpp"
#include "core/law/elastic_coulomb.hpp"

namespace voussoir {
namespace {

// Where the largest overlap is less than this fraction of the contact polygon's width, both energies agree within
// all_face and the polygon's is the answer (a test draws pairs of faces).
constexpr double flat_overlap = 0.02;

// Cosine of 25 degrees. Faces farther from parallel do not lie on each other: at an angle t they meet in a wedge, whose
// energies differ by t/2 over the sine of its far end, which is more than all_region.
constexpr double lie_on_each_other = 0.90630778703664996;

// Where the energies' ratio is so far from 1, all is the face's, or all the region's. Of two faces that meet at a blunt
// edge the one that lies nearer to the other part's counts, until both lie alike: there the ratio is 3/4 or less.
constexpr double all_face = 0.07, all_region = 0.2;

// How much of a face presses, m: of a polygon twice the area over the perimeter, at most half its least width.
double width_of(const FaceIntegral<2>& face, const PressedPolygon&) {
  return face.area;
}
double width_of(const FaceIntegral<3>& face, const PressedPolygon& polygon) {
  double perimeter = 0;
  const auto& c = polygon.corners;
  for (std::size_t k = 0; k < c.size(); ++k)
    perimeter += (c[(k + 1) % c.size()] - c[k]).norm();
  return 2 * face.area / perimeter;
}

// the largest overlap on it, m
double deepest(const FaceIntegral<2>& face, const PressedPolygon&) {
  // linear along a segment: mean and mean square tell both ends
  const double mean = face.volume / face.area;
  return mean + std::sqrt(std::max(3 * (face.square / face.area - mean * mean), 0.0));
}
double deepest(const FaceIntegral<3>&, const PressedPolygon& polygon) {
  double most = 0;
  for (const Vector<2>& y : polygon.corners)
    most = std::max(most, polygon.overlap + polygon.gradient.dot(y));
  return most;
}

// g and its derivative; `flat`: not all is the region's
struct Blend {
  double value, slope;
  bool flat;
};
Blend blend(double ratio) {
  const double off = std::abs(ratio - 1);
  if (off >= all_region) return {ratio, 1, false};
  if (off <= all_face) return {1, 0, true};
  constexpr double span = all_region - all_face;
  const double s = (all_region - off) / span, h = s * s * (3 - 2 * s);
  const double h_slope = 6 * s * (1 - s) / span * (ratio > 1 ? -1 : 1);
  return {ratio + h * (1 - ratio), 1 - h + h_slope * (1 - ratio), true};
}

// the polygon's axes in the world, laid normal to the force
void turn_axes(const Matrix<2>&, const Vector<2>&, const Vector<2>&, PressedPolygon&) {}
void turn_axes(const Matrix<3>& axes, const Vector<3>& mean_normal, const Vector<3>& normal, PressedPolygon& polygon) {
  for (int k = 0; k < 2; ++k) {
    const Vector<3> axis = axes * polygon.axes.col(k);
    polygon.axes.col(k) = carried(axis, mean_normal, normal, 0.0);
  }
}
Spin<2> turned_moment(const Matrix<2>&, const Spin<2>& moment) {
  return moment;
}
Spin<3> turned_moment(const Matrix<3>& axes, const Spin<3>& moment) {
  return axes * moment;
}

}  // namespace

template <int Dim>
void find_nearest_faces(const Pair<Dim>& pair, Contact<Dim>& contact, HalfSpaces<Dim>& planes) {
  assemble<Dim>(pair, contact.proof.point, planes);
  const int faces_a = static_cast<int>(pair.a->faces.size());
  const auto nearest = [&](int first, int last) {
    int face = first;
    for (int i = first + 1; i < last; ++i)
      if (planes[i].offset < planes[face].offset) face = i;
    return face - first;
  };
  contact.geometry.face_a = nearest(0, faces_a);
  contact.geometry.face_b = nearest(faces_a, static_cast<int>(planes.size()));
}

template <int Dim>
bool press_face(const Pair<Dim>& pair, const HalfSpaces<Dim>& planes, Contact<Dim>& contact, PressedFace<Dim>& face) {
  const Vector<Dim> seen_from = contact.proof.point;
  const int faces_a = static_cast<int>(pair.a->faces.size());
  const double reach = 4 * std::min(pair.a->radius, pair.b->radius);

  FaceIntegral<Dim> f;
  ContactGeometry<Dim>& g = contact.geometry;
  const auto without_pressure = [&] {
    g.area = g.overlap = 0;
    face.flat = false;
    g.normal = pair.axes * planes[g.face_a].normal;
    g.point = pair.axes * seen_from;
    face.normal = g.normal;
    face.centre = g.point;
    face.force.setZero();
    face.couple.setZero();
    face.square = face.polar = face.gyration2 = 0;
    face.polygon.corners.clear();
    return true;
  };
  const int face_a = g.face_a, face_b = faces_a + g.face_b;
  const bool faces = -planes[face_a].normal.dot(planes[face_b].normal) > lie_on_each_other &&
                     integrate_face<Dim>(planes, faces_a, face_a, face_b, reach, f, face.polygon);
  Blend share{1, 0, true};
  RegionIntegral<Dim> r;
  const bool surely_flat = faces && deepest(f, face.polygon) < flat_overlap * width_of(f, face.polygon);
  if (!surely_flat) {
    const RegionStatus status = integrate_region<Dim>(planes, faces_a, reach, r);
    const bool region = status == RegionStatus::ok;
    if (status == RegionStatus::too_many_planes) {
      without_pressure();
      return false;
    }
    if (!region && !faces) return without_pressure();
    if (region) share = faces ? blend(r.square / f.square) : Blend{0, 1, false};
  }
  face.flat = share.flat;
  Vector<Dim> force = Vector<Dim>::Zero(), point = r.pressure;
  Spin<Dim> about = Spin<Dim>::Zero();
  face.square = r.square;
  double area = r.area;
  face.gyration2 = r.spread;
  face.polar = 0;
  if (face.flat) {
    const double part = share.slope == 0 ? 1 : share.value - r.square / f.square * share.slope;
    force = part * f.force;
    about = part * f.moment;
    face.square = share.value * f.square;
    point = f.pressure;
    area = f.area;
    face.gyration2 = f.polar / f.area + (f.centre - f.pressure).squaredNorm();
    if constexpr (Dim == 3) face.polar = f.polar;
  }
  if (share.slope != 0) {
    force += share.slope * r.force;
    about += share.slope * r.moment;
  }
  const double size = force.norm();
  if (!(size > 0) || !(area > 0)) return without_pressure();
  g.point = pair.axes * (seen_from + point);
  g.normal = pair.axes * (force / size);
  g.overlap = size / area;
  g.area = area;
  g.stiffness_factor = 1;
  face.force = pair.axes * force;
  face.couple = turned_moment(pair.axes, Spin<Dim>(about - moment(point, force)));
  face.normal = g.normal;
  face.centre = face.flat ? Vector<Dim>(pair.axes * (seen_from + f.centre)) : g.point;
  if (face.flat)
    turn_axes(pair.axes, pair.axes * f.normal, g.normal, face.polygon);
  else
    face.polygon.corners.clear();
  return true;
}

template void find_nearest_faces<2>(const Pair<2>&, Contact<2>&, HalfSpaces<2>&);
template void find_nearest_faces<3>(const Pair<3>&, Contact<3>&, HalfSpaces<3>&);
template bool press_face<2>(const Pair<2>&, const HalfSpaces<2>&, Contact<2>&, PressedFace<2>&);
template bool press_face<3>(const Pair<3>&, const HalfSpaces<3>&, Contact<3>&, PressedFace<3>&);

}  // namespace voussoir
