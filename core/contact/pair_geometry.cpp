#include "core/contact/pair_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/contact/rounding.hpp"
#include "core/geometry/half_space_inl.hpp"

namespace voussoir {
namespace {

// one part's fraction of the normal: its unit gradient, or the normal of its nearest face if the gradient is zero
template <int Dim>
Vector<Dim> potential_direction(std::span<const HalfSpace<Dim>> faces, std::span<const double> weights,
                                const Vector<Dim>& point, double radius, bool& fallback) {
  Vector<Dim> gradient = Vector<Dim>::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  int face = 0;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const double slack = -signed_distance(faces[i], point);
    if (slack < radius) gradient += weight_of(weights, i) * (radius - slack) * faces[i].normal;
    if (slack < nearest) {
      nearest = slack;
      face = static_cast<int>(i);
    }
  }
  const double length = gradient.norm();
  if (length > parallel_gradients * radius) return gradient / length;
  fallback = true;
  return faces[face].normal;
}

}  // namespace

template <int Dim>
void assemble(const Pair<Dim>& pair, const Vector<Dim>& origin, HalfSpaces<Dim>& planes) {
  planes.resize(pair.a->faces.size() + pair.b->faces.size());
  HalfSpace<Dim>* plane = planes.data();
  for (const HalfSpace<Dim>& f : pair.a->faces)
    *plane++ = moved_origin<Dim>(f, origin);
  const Vector<Dim> shift = origin - pair.offset;
  const Matrix<Dim> rotation = pair.rotation;
  for (const HalfSpace<Dim>& f : pair.b->faces) {
    plane->normal.noalias() = rotation * f.normal;
    plane->offset = f.offset - plane->normal.dot(shift);
    ++plane;
  }
}

template <int Dim>
void assemble_weights(const Pair<Dim>& pair, std::vector<double>& weights) {
  weights.clear();
  if (pair.a->face_weights.empty() && pair.b->face_weights.empty()) return;
  for (const Polytope<Dim>* part : {pair.a, pair.b})
    for (std::size_t f = 0; f < part->faces.size(); ++f)
      weights.push_back(weight_of(part->face_weights, f));
}

template <int Dim>
bool contact_normal(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point, double radius,
                    Vector<Dim>& normal, bool& fallback, std::span<const double> weights) {
  const std::span<const HalfSpace<Dim>> all(planes);
  const std::span<const double> of_b = weights.empty() ? weights : weights.subspan(faces_a);
  const Vector<Dim> difference = potential_direction<Dim>(all.first(faces_a), weights, point, radius, fallback) -
                                 potential_direction<Dim>(all.subspan(faces_a), of_b, point, radius, fallback);
  const double length = difference.norm();
  if (!(length > parallel_gradients)) return false;
  normal = difference / length;
  return true;
}

template <int Dim>
bool overlap_along(const HalfSpaces<Dim>& planes, int faces_a, const Vector<Dim>& point, const Vector<Dim>& normal,
                   double& overlap, int& face_a, int& face_b) {
  double forward = std::numeric_limits<double>::infinity(), backward = forward;
  face_a = face_b = -1;
  for (int i = 0; i < static_cast<int>(planes.size()); ++i) {
    const double slope = i < faces_a ? planes[i].normal.dot(normal) : -planes[i].normal.dot(normal);
    if (!(slope > 0)) continue;
    const double distance = -signed_distance(planes[i], point) / slope;
    double& best = i < faces_a ? forward : backward;
    if (distance < best) {
      best = distance;
      (i < faces_a ? face_a : face_b) = i;
    }
  }
  overlap = forward + backward;
  return face_a >= 0 && face_b >= 0;
}

Segment section_segment(const HalfSpaces<2>& planes, const Vector<2>& point, const Vector<2>& normal, double reach) {
  const Vector<2> along = perpendicular(normal);
  Segment section{-reach, reach};
  for (const HalfSpace<2>& p : planes) {
    const double slope = p.normal.dot(along), slack = -signed_distance(p, point);
    if (slope > 0) section.high = std::min(section.high, slack / slope);
    if (slope < 0) section.low = std::max(section.low, slack / slope);
  }
  return section;
}

void clip_polygon(const std::vector<Vector<2>>& polygon, const Vector<2>& q, double slack,
                  std::vector<Vector<2>>& clipped) {
  clipped.clear();
  if (polygon.empty()) return;
  const double inside_first = slack - q.dot(polygon.front());
  double inside_here = inside_first;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const bool last = k + 1 == polygon.size();
    const Vector<2>&here = polygon[k], &next = polygon[last ? 0 : k + 1];
    const double inside_next = last ? inside_first : slack - q.dot(next);
    if (inside_here >= 0) clipped.push_back(here);
    if ((inside_here > 0 && inside_next < 0) || (inside_here < 0 && inside_next > 0))
      clipped.push_back(here + inside_here / (inside_here - inside_next) * (next - here));
    inside_here = inside_next;
  }
}

void section_polygon(const HalfSpaces<3>& planes, const Vector<3>& point, const Vector<3>& normal, double reach,
                     std::vector<Vector<2>>& polygon) {
  static thread_local std::vector<Vector<2>> clipped;
  const Vector<3> t1 = perpendicular(normal), t2 = normal.cross(t1);
  polygon.assign({{-reach, -reach}, {reach, -reach}, {reach, reach}, {-reach, reach}});
  for (const HalfSpace<3>& p : planes) {
    clip_polygon(polygon, {p.normal.dot(t1), p.normal.dot(t2)}, -signed_distance(p, point), clipped);
    std::swap(polygon, clipped);
  }
}

template <>
double section_area(const HalfSpaces<2>& planes, const Vector<2>& point, const Vector<2>& normal, double reach) {
  const Segment section = section_segment(planes, point, normal, reach);
  return std::max(section.high - section.low, 0.0);
}

template <>
double section_area(const HalfSpaces<3>& planes, const Vector<3>& point, const Vector<3>& normal, double reach) {
  static thread_local std::vector<Vector<2>> polygon;
  section_polygon(planes, point, normal, reach, polygon);
  double twice = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vector<2> u = polygon[k] - polygon[0], v = polygon[k + 1] - polygon[0];
    twice += u[0] * v[1] - u[1] * v[0];
  }
  return 0.5 * std::abs(twice);
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                                      \
  template void assemble<Dim>(const Pair<Dim>&, const Vector<Dim>&, HalfSpaces<Dim>&);                                 \
  template void assemble_weights<Dim>(const Pair<Dim>&, std::vector<double>&);                                         \
  template bool contact_normal<Dim>(const HalfSpaces<Dim>&, int, const Vector<Dim>&, double, Vector<Dim>&, bool&,      \
                                    std::span<const double>);                                                          \
  template bool overlap_along<Dim>(const HalfSpaces<Dim>&, int, const Vector<Dim>&, const Vector<Dim>&, double&, int&, \
                                   int&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
