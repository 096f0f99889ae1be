#include "core/contact/integrated_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/face_integral.hpp"
#include "core/contact/pair_geometry.hpp"
#include "core/contact/region_integral.hpp"

namespace voussoir {
namespace {

// If the largest overlap is less than this fraction of the contact polygon's width, both energies agree within all_face
// and the polygon's is used (a test draws pairs of faces).
constexpr double flat_overlap = 0.02;

// Cosine of 25 degrees. Faces farther from parallel do not rest on each other: at an angle t they meet in a wedge,
// whose energies differ by t/2 over the sine of its far end, which is more than all_region.
constexpr double nearly_parallel = 0.90630778703664996;

// Up to the first distance of the energies' ratio from 1 all is the face's, from the second on all the region's. Of two
// faces that meet at a blunt edge the one nearer to parallel with the other part's counts, until both are equally near:
// then the ratio is 3/4 or less.
constexpr double all_face = 0.07, all_region = 0.2;

// The pressed width of a face, m: of a polygon twice the area over the perimeter, at most half its least width.
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
  // linear along a segment: mean and mean square give both ends
  const double mean = face.volume / face.area;
  return mean + std::sqrt(std::max(3 * (face.square / face.area - mean * mean), 0.0));
}
double deepest(const FaceIntegral<3>&, const PressedPolygon& polygon) {
  double most = 0;
  for (const Vector<2>& y : polygon.corners)
    most = std::max(most, polygon.overlap + polygon.gradient.dot(y));
  return most;
}

// Square of the sine of 25 degrees. A side plane at a smaller angle to the polygon is a face that may rest on the other
// part as well: then the region decides.
constexpr double no_blunt_edge = 0.17860619515673035;

// of both parts' size: a bound of the error of distances from planes
constexpr double surely_inside = 1e-13;

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

// the polygon's axes in the world, turned normal to the force
void turn_axes(const Matrix<2>&, const Vector<2>&, const Vector<2>&, PressedPolygon&) {}
void turn_axes(const Matrix<3>& axes, const Vector<3>& mean_normal, const Vector<3>& normal, PressedPolygon& polygon) {
  // by the rotation of one normal to the other, which are less than half a right angle apart
  const Vector<3> turn = mean_normal.cross(normal);
  const double half = 1 / (1 + mean_normal.dot(normal));
  const Vector<3> first = axes * polygon.axes.col(0), across = turn.cross(first);
  polygon.axes.col(0) = first + across + half * turn.cross(across);
  polygon.axes.col(1) = normal.cross(polygon.axes.col(0));
}
Spin<2> turned_moment(const Matrix<2>&, const Spin<2>& moment) {
  return moment;
}
Spin<3> turned_moment(const Matrix<3>& axes, const Spin<3>& moment) {
  return axes * moment;
}

template <int Dim>
double reach_of(const Pair<Dim>& pair) {
  return 4 * std::min(pair.a->radius, pair.b->radius);
}

template <int Dim>
bool lie_on_each_other(const HalfSpaces<Dim>& planes, int faces_a, double reach, const ContactGeometry<Dim>& geometry,
                       FaceIntegral<Dim>& f, PressedPolygon& polygon, std::vector<FaceEdge<Dim>>* edges = nullptr) {
  const int face_a = geometry.face_a, face_b = faces_a + geometry.face_b;
  return -planes[face_a].normal.dot(planes[face_b].normal) > nearly_parallel &&
         integrate_face<Dim>(planes, faces_a, face_a, face_b, reach, f, polygon, edges);
}

template <int Dim>
bool surely_flat(const FaceIntegral<Dim>& f, const PressedPolygon& polygon) {
  return f.least_sine2 > no_blunt_edge && deepest(f, polygon) < flat_overlap * width_of(f, polygon);
}

template <int Dim>
void without_pressure(const Pair<Dim>& pair, const HalfSpaces<Dim>& planes, Contact<Dim>& contact,
                      IntegratedContact<Dim>& face) {
  ContactGeometry<Dim>& g = contact.geometry;
  g.area = g.overlap = 0;
  face.flat = false;
  g.normal = pair.axes * planes[g.face_a].normal;
  g.point = pair.axes * contact.proof.point;
  face.normal = g.normal;
  face.centre = g.point;
  face.force.setZero();
  face.couple.setZero();
  face.square = face.polar = face.gyration2 = 0;
  face.polygon.corners.clear();
}

// The contact force, from the integrals over the faces and over the region by their shares; places as seen from
// contact.proof.point.
template <int Dim>
void answer(const Pair<Dim>& pair, const HalfSpaces<Dim>& planes, const FaceIntegral<Dim>& f,
            const RegionIntegral<Dim>& r, const Blend& share, Contact<Dim>& contact, IntegratedContact<Dim>& face) {
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
  if (!(size > 0)) return without_pressure<Dim>(pair, planes, contact, face);  // deep in the other on all sides
  ContactGeometry<Dim>& g = contact.geometry;
  g.point = pair.axes * (contact.proof.point + point);
  face.force = pair.axes * force;
  g.normal = face.force / size;
  g.overlap = size / area;
  g.area = area;
  g.stiffness_factor = 1;
  face.couple = turned_moment(pair.axes, Spin<Dim>(about - moment(point, force)));
  face.normal = g.normal;
  face.centre = face.flat ? Vector<Dim>(pair.axes * (contact.proof.point + f.centre)) : g.point;
  if (face.flat)
    turn_axes(pair.axes, pair.axes * f.normal, g.normal, face.polygon);
  else
    face.polygon.corners.clear();
}

// `may_lie`: two faces may lie on each other; `region`: its integrals, if they are known
template <int Dim>
bool integrate(const Pair<Dim>& pair, const HalfSpaces<Dim>& planes, bool may_lie, const RegionIntegral<Dim>* region,
               Contact<Dim>& contact, IntegratedContact<Dim>& face) {
  const int faces_a = static_cast<int>(pair.a->faces.size());
  const double reach = reach_of(pair);
  FaceIntegral<Dim> f;
  const bool faces = may_lie && lie_on_each_other<Dim>(planes, faces_a, reach, contact.geometry, f, face.polygon);
  if (faces && surely_flat(f, face.polygon)) {
    answer<Dim>(pair, planes, f, {}, {1, 0, true}, contact, face);
    return true;
  }
  RegionIntegral<Dim> r;
  RegionStatus status = RegionStatus::ok;
  if (region != nullptr)
    r = *region;
  else
    status = integrate_region<Dim>(planes, faces_a, reach, r);
  if (status == RegionStatus::ok)
    answer<Dim>(pair, planes, f, r, faces ? blend(r.square / f.square) : Blend{0, 1, false}, contact, face);
  else if (status == RegionStatus::empty && faces)
    answer<Dim>(pair, planes, f, r, {1, 0, true}, contact, face);
  else
    without_pressure<Dim>(pair, planes, contact, face);
  return status != RegionStatus::too_many_planes;
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
bool integrate_contact(const Pair<Dim>& pair, const HalfSpaces<Dim>& planes, Contact<Dim>& contact,
                       IntegratedContact<Dim>& face) {
  return integrate<Dim>(pair, planes, true, nullptr, contact, face);
}

template <int Dim>
void integrate_moved(const Pair<Dim>& pair, const Contact<Dim>& contact, const IntegratedContact<Dim>& face,
                     std::span<const Pair<Dim>> moved, std::span<Contact<Dim>> contacts,
                     std::span<IntegratedContact<Dim>> faces) {
  static thread_local HalfSpaces<Dim> here;
  static thread_local std::vector<HalfSpaces<Dim>> planes;
  static thread_local std::vector<RegionIntegral<Dim>> regions;
  planes.resize(moved.size());
  regions.resize(moved.size());
  assemble<Dim>(pair, contact.proof.point, here);
  for (std::size_t k = 0; k < moved.size(); ++k) {
    contacts[k] = contact;
    find_nearest_faces<Dim>(moved[k], contacts[k], planes[k]);
  }
  const bool followed = integrate_moved_regions<Dim>(here, static_cast<int>(pair.a->faces.size()), reach_of(pair),
                                                     face.flat, planes, std::span(regions));
  for (std::size_t k = 0; k < moved.size(); ++k)
    integrate<Dim>(moved[k], planes[k], !followed || face.flat, followed ? &regions[k] : nullptr, contacts[k],
                   faces[k]);
}

template <int Dim>
bool integrate_as_before(const Pair<Dim>& pair, Contact<Dim>& contact, IntegratedContact<Dim>& face) {
  const ContactGeometry<Dim>& g = contact.geometry;
  if (contact.proof.kind != ProofKind::interior_point || g.face_a < 0) return false;
  // for most corners and edges this is soon decided
  if (!(g.overlap < flat_overlap * (Dim == 2 ? g.area : std::sqrt(g.area)))) return false;
  const Vector<Dim>&normal_a = pair.a->faces[g.face_a].normal, &normal_b = pair.b->faces[g.face_b].normal;
  if (!(-normal_a.dot(pair.rotation * normal_b) > nearly_parallel)) return false;
  static thread_local HalfSpaces<Dim> planes;
  assemble<Dim>(pair, contact.proof.point, planes);
  FaceIntegral<Dim> f;
  if (!lie_on_each_other<Dim>(planes, static_cast<int>(pair.a->faces.size()), reach_of(pair), contact.geometry, f,
                              face.polygon) ||
      !surely_flat(f, face.polygon))
    return false;
  double margin = std::numeric_limits<double>::infinity();
  for (const HalfSpace<Dim>& p : planes)
    margin = std::min(margin, -signed_distance<Dim>(p, f.centre));
  if (!(margin > surely_inside * (pair.a->radius + pair.b->radius + pair.offset.norm()))) return false;
  answer<Dim>(pair, planes, f, {}, {1, 0, true}, contact, face);
  contact.proof.point += f.centre;
  contact.proof.margin = margin;
  return true;
}

template <int Dim>
bool find_sensitivity(const Pair<Dim>& pair, const Contact<Dim>& contact, FaceSensitivity<Dim>& sensitivity) {
  if (contact.geometry.face_a < 0) return false;
  static thread_local HalfSpaces<Dim> planes;
  static thread_local PressedPolygon polygon;
  static thread_local std::vector<FaceEdge<Dim>> edges;
  const Vector<Dim>& origin = contact.proof.point;
  assemble<Dim>(pair, origin, planes);
  const int faces_a = static_cast<int>(pair.a->faces.size());
  FaceIntegral<Dim> f;
  if (!lie_on_each_other<Dim>(planes, faces_a, reach_of(pair), contact.geometry, f, polygon, &edges) ||
      !surely_flat(f, polygon))
    return false;
  FaceSensitivity<Dim>& s = sensitivity;
  s = find_face_sensitivity<Dim>(planes, faces_a, planes[contact.geometry.face_a],
                                 planes[faces_a + contact.geometry.face_b], Vector<Dim>(pair.offset - origin), f,
                                 polygon, edges);
  const Matrix<Dim>& axes = pair.axes;
  const auto along_world = [&](auto& rows) {
    rows.template leftCols<Dim>() = (rows.template leftCols<Dim>() * axes.transpose()).eval();
    if constexpr (Dim == 3) rows.template rightCols<3>() = (rows.template rightCols<3>() * axes.transpose()).eval();
  };
  for (auto* places : {&s.force, &s.centre, &s.pressure, &s.gradient}) {
    along_world(*places);
    *places = (axes * *places).eval();
  }
  along_world(s.moment);
  if constexpr (Dim == 3) s.moment = (axes * s.moment).eval();
  for (auto* numbers : {&s.area, &s.volume, &s.square, &s.polar})
    along_world(*numbers);
  return true;
}

template <int Dim>
void move_by(const Pair<Dim>& pair, const FaceSensitivity<Dim>& s, int freedom, double step, Contact<Dim>& contact,
             IntegratedContact<Dim>& face) {
  ContactGeometry<Dim>& g = contact.geometry;
  const Vector<Dim> origin = pair.axes * contact.proof.point, normal = face.normal;
  const Spin<Dim> about =
      face.couple + moment(Vector<Dim>(g.point - origin), face.force) + step * s.moment.col(freedom);
  const double area = g.area;
  face.force += step * s.force.col(freedom);
  face.square += step * s.square[freedom];
  face.polar += step * s.polar[freedom];
  face.centre += step * s.centre.col(freedom);
  g.area += step * s.area[freedom];
  g.point += step * s.pressure.col(freedom);
  face.couple = about - moment(Vector<Dim>(g.point - origin), face.force);
  const double size = face.force.norm();
  face.normal = g.normal = face.force / size;
  g.overlap = size / g.area;
  if constexpr (Dim == 3) {
    PressedPolygon& p = face.polygon;
    p.overlap += step * (s.volume[freedom] - p.overlap * s.area[freedom]) / area;
    p.gradient += step * p.axes.transpose() * s.gradient.col(freedom);
    turn_axes(Matrix<3>::Identity(), normal, face.normal, p);
  }
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                          \
  template void integrate_moved<Dim>(const Pair<Dim>&, const Contact<Dim>&, const IntegratedContact<Dim>&, \
                                     std::span<const Pair<Dim>>, std::span<Contact<Dim>>,                  \
                                     std::span<IntegratedContact<Dim>>);                                   \
  template bool find_sensitivity<Dim>(const Pair<Dim>&, const Contact<Dim>&, FaceSensitivity<Dim>&);       \
  template void move_by<Dim>(const Pair<Dim>&, const FaceSensitivity<Dim>&, int, double, Contact<Dim>&,    \
                             IntegratedContact<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE
template bool integrate_as_before<2>(const Pair<2>&, Contact<2>&, IntegratedContact<2>&);
template bool integrate_as_before<3>(const Pair<3>&, Contact<3>&, IntegratedContact<3>&);
template void find_nearest_faces<2>(const Pair<2>&, Contact<2>&, HalfSpaces<2>&);
template void find_nearest_faces<3>(const Pair<3>&, Contact<3>&, HalfSpaces<3>&);
template bool integrate_contact<2>(const Pair<2>&, const HalfSpaces<2>&, Contact<2>&, IntegratedContact<2>&);
template bool integrate_contact<3>(const Pair<3>&, const HalfSpaces<3>&, Contact<3>&, IntegratedContact<3>&);

}  // namespace voussoir
