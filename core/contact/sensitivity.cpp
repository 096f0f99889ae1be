#include "core/contact/sensitivity.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/pair_geometry.hpp"
#include "core/contact/rounding.hpp"
#include "core/solvers/symmetric_system.hpp"

namespace voussoir {
namespace {

// One motion of the second body, in the first one's frame, and the changes of the contact so far.
template <int Dim>
struct Moved {
  Vector<Dim> way;  // displacement of the second centroid
  Spin<Dim> turn;
  Vector<Dim> point, normal;  // of the contact

  Vector<Dim> turning(const Vector<Dim>& v) const { return cross(turn, v); }
};

// An edge of the section of two blocks through the contact's point; no motion changes on which plane it lies.
struct SectionEdge {
  int plane;
  Vector<3> middle;                 // m, seen from the point
  double along_normal, in_section;  // the plane's normal, along the contact's and across it
  double length;                    // m
};

template <int Dim>
struct Finder {
  const Pair<Dim>& pair;
  const HalfSpaces<Dim>& planes;  // seen from the contact point: offsets are slacks
  const Contact<Dim>& contact;
  double size, radius;  // m: the smaller inscribed radius; of the potential particles
  std::span<const double> weights;
  int faces_a = static_cast<int>(pair.a->faces.size());
  Vector<Dim> lever = contact.proof.point - pair.offset;  // of the point about the second centroid
  const Vector<Dim>& n = contact.proof.axis;

  bool of_second(int plane) const { return plane >= faces_a; }

  Vector<Dim> normal_change(int plane, const Moved<Dim>& m) const {
    return of_second(plane) ? m.turning(planes[plane].normal) : Vector<Dim>(Vector<Dim>::Zero());
  }
  // at a fixed place
  double slack_change_at_rest(int plane, const Moved<Dim>& m) const {
    return of_second(plane) ? planes[plane].normal.dot(m.way + m.turning(lever)) : 0;
  }
  // at the contact's point, which moves
  double slack_change(int plane, const Moved<Dim>& m) const {
    return slack_change_at_rest(plane, m) - planes[plane].normal.dot(m.point);
  }

  // ---- point --------------------------------------------------------------------------------------------------------

  // columns: the normal, in which the region is thin, first
  Matrix<Dim> axes() const {
    Matrix<Dim> t;
    t.col(0) = n;
    t.col(1) = perpendicular(n);
    if constexpr (Dim == 3) t.col(2) = n.cross(Vector<3>(t.col(1)));
    return t;
  }

  bool find_point(const Matrix<Dim>& t, const Matrix<Dim>& hessian, Moved<Dim>& m) const {
    Vector<Dim> right = Vector<Dim>::Zero();
    for (int i = faces_a; i < static_cast<int>(planes.size()); ++i) {
      const double slack = planes[i].offset;
      right += weight_of(weights, i) *
               (t.transpose() * (slack_change_at_rest(i, m) / slack * planes[i].normal - m.turning(planes[i].normal)) /
                slack);
    }
    if (!solve_symmetric<Dim>(hessian, right)) return false;
    m.point = t * right;
    return true;
  }

  // ---- normal -------------------------------------------------------------------------------------------------------

  // one part's unit gradient and its change
  void potential_change(int first, int last, const Moved<Dim>& m, Vector<Dim>& direction, Vector<Dim>& change) const {
    Vector<Dim> gradient = Vector<Dim>::Zero(), gradient_change = Vector<Dim>::Zero();
    double nearest = std::numeric_limits<double>::infinity();
    int face = first;
    for (int i = first; i < last; ++i) {
      const double slack = planes[i].offset;
      if (slack < radius) {
        const double weight = weight_of(weights, i);
        gradient += weight * (radius - slack) * planes[i].normal;
        gradient_change += weight * ((radius - slack) * normal_change(i, m) - slack_change(i, m) * planes[i].normal);
      }
      if (slack < nearest) {
        nearest = slack;
        face = i;
      }
    }
    const double length = gradient.norm();
    if (length > parallel_gradients * radius) {
      direction = gradient / length;
      change = (gradient_change - direction.dot(gradient_change) * direction) / length;
    } else {
      direction = planes[face].normal;
      change = normal_change(face, m);
    }
  }

  void find_normal(Moved<Dim>& m) const {
    Vector<Dim> of_a, of_b, change_a, change_b;
    potential_change(0, faces_a, m, of_a, change_a);
    potential_change(faces_a, static_cast<int>(planes.size()), m, of_b, change_b);
    const Vector<Dim> change = change_a - change_b;
    m.normal = (change - n.dot(change) * n) / (of_a - of_b).norm();
  }

  // ---- overlap and area ---------------------------------------------------------------------------------------------

  // of the distance slack/(a·along) to a plane along a direction that changes
  double distance_change(int plane, const Vector<Dim>& along, const Vector<Dim>& along_change,
                         const Moved<Dim>& m) const {
    const Vector<Dim>& a = planes[plane].normal;
    const double slope = a.dot(along), slope_change = normal_change(plane, m).dot(along) + a.dot(along_change);
    return (slack_change(plane, m) - planes[plane].offset / slope * slope_change) / slope;
  }

  double overlap_change(const Moved<Dim>& m) const {
    return distance_change(contact.geometry.face_a, n, m.normal, m) +
           distance_change(faces_a + contact.geometry.face_b, -n, -m.normal, m);
  }

  // The plane of a place of the section's boundary, by the distance within the section.
  int plane_at(const Vector<Dim>& place) const {
    double least = std::numeric_limits<double>::infinity();
    int nearest = 0;
    for (int i = 0; i < static_cast<int>(planes.size()); ++i) {
      const double along = planes[i].normal.dot(n), steep = std::sqrt(std::max(1 - along * along, 0.0));
      const double distance = std::abs(signed_distance(planes[i], place));
      if (!(steep > 0 && distance < least * steep)) continue;  // one across the normal bounds no section
      least = distance / steep;
      nearest = i;
    }
    return nearest;
  }

  // The planes of the section's ends, its high one first.
  std::array<int, 2> edges_of(const Segment& section) const {
    const Vector<2> along = perpendicular(n);
    return {plane_at(section.high * along), plane_at(section.low * along)};
  }

  double area_change(const Moved<Dim>& m, const std::array<int, 2>& ends) const {
    static_assert(Dim == 2);
    const Vector<2> along = perpendicular(n), along_change = perpendicular(m.normal);
    return distance_change(ends[0], along, along_change, m) + distance_change(ends[1], -along, -along_change, m);
  }

  std::vector<SectionEdge> edges_of(const std::vector<Vector<2>>& section) const {
    static_assert(Dim == 3);
    FixedMatrix<3, 2> t;
    t.col(0) = perpendicular(n);
    t.col(1) = n.cross(Vector<3>(t.col(0)));
    std::vector<SectionEdge> edges;
    edges.reserve(section.size());
    for (std::size_t k = 0; k < section.size(); ++k) {
      const Vector<2>&here = section[k], &next = section[(k + 1) % section.size()];
      const Vector<3> middle = t * (0.5 * (here + next));
      const int plane = plane_at(middle);
      const Vector<3>& a = planes[plane].normal;
      edges.push_back({plane, middle, a.dot(n), Vector<2>(t.transpose() * a).norm(), (next - here).norm()});
    }
    return edges;
  }

  // Every edge moves outwards in the section's plane, linearly along itself: by its middle times its length.
  double area_change(const Moved<Dim>& m, const std::vector<SectionEdge>& edges) const {
    double sum = 0;
    for (const SectionEdge& e : edges) {
      // the section's axes turn with its normal and by nothing else
      const double growth =
          slack_change(e.plane, m) - normal_change(e.plane, m).dot(e.middle) + e.along_normal * m.normal.dot(e.middle);
      sum += growth / e.in_section * e.length;
    }
    return sum;
  }
};

template <int Dim>
auto section_of(const HalfSpaces<Dim>& planes, const Vector<Dim>& normal, double reach) {
  const Vector<Dim> here = Vector<Dim>::Zero();
  if constexpr (Dim == 2) {
    return section_segment(planes, here, normal, reach);
  } else {
    std::vector<Vector<2>> polygon;
    section_polygon(planes, here, normal, reach, polygon);
    return polygon;
  }
}

}  // namespace

bool has_sensitivity(const ContactSettings& settings) {
  return settings.point == ContactPoint::analytic_centre && settings.normal == ContactNormal::potential &&
         settings.overlap == OverlapSearch::closed_form;
}

template <int Dim>
bool find_sensitivity(const Pair<Dim>& pair, const ContactSettings& settings, const Contact<Dim>& contact,
                      ContactSensitivity<Dim>& sensitivity) {
  static thread_local HalfSpaces<Dim> planes;
  static thread_local std::vector<double> weights;
  assemble<Dim>(pair, contact.proof.point, planes);
  assemble_weights(pair, weights);
  const double size = std::min(pair.a->inscribed_radius, pair.b->inscribed_radius);
  const Finder<Dim> finder{pair, planes, contact, size, settings.potential_radius * size, weights};

  const Matrix<Dim> t = finder.axes();
  Matrix<Dim> hessian = Matrix<Dim>::Zero();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const HalfSpace<Dim>& p = planes[i];
    if (!(p.offset > 0)) return false;
    const Vector<Dim> row = t.transpose() * p.normal / p.offset;
    hessian += weight_of(weights, i) * (row * row.transpose());
  }
  const auto edges =
      finder.edges_of(section_of<Dim>(planes, contact.proof.axis, 4 * std::min(pair.a->radius, pair.b->radius)));

  for (int f = 0; f < freedoms<Dim>; ++f) {
    Moved<Dim> m;
    m.way.setZero();
    m.turn.setZero();
    if (f < Dim)
      m.way = pair.axes.row(f).transpose();
    else if constexpr (Dim == 3)
      m.turn = pair.axes.row(f - Dim).transpose();
    else
      m.turn[0] = 1;
    if (!finder.find_point(t, hessian, m)) return false;
    finder.find_normal(m);
    sensitivity.point.col(f) = m.point;
    sensitivity.normal.col(f) = m.normal;
    sensitivity.overlap[f] = finder.overlap_change(m);
    sensitivity.area[f] = finder.area_change(m, edges);
  }
  return sensitivity.point.allFinite() && sensitivity.normal.allFinite() && sensitivity.overlap.allFinite() &&
         sensitivity.area.allFinite();
}

template bool find_sensitivity<2>(const Pair<2>&, const ContactSettings&, const Contact<2>&, ContactSensitivity<2>&);
template bool find_sensitivity<3>(const Pair<3>&, const ContactSettings&, const Contact<3>&, ContactSensitivity<3>&);

}  // namespace voussoir
