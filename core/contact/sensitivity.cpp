#include "core/contact/sensitivity.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/pair_geometry.hpp"
#include "core/contact/rounding.hpp"
#include "core/solvers/symmetric_system.hpp"

namespace voussoir {
namespace {

// Sums over planes of one part: of w a aᵀ, and of w a times a length.
template <int Dim>
struct PartSums {
  Matrix<Dim> spread = Matrix<Dim>::Zero();
  Vector<Dim> along = Vector<Dim>::Zero();
};

// All motions at once: what depends on the planes is summed over them first, and is the same for every motion.
template <int Dim>
struct Finder {
  static constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  using Vectors = FixedMatrix<Dim, F>;  // of every motion one
  using Numbers = FixedMatrix<1, F>;

  const Pair<Dim>& pair;
  const HalfSpaces<Dim>& planes;  // seen from the contact point: offsets are slacks
  const Contact<Dim>& contact;
  double radius;  // m: of the potential particles
  std::span<const double> weights;
  int faces_a = static_cast<int>(pair.a->faces.size());
  const Vector<Dim>& n = contact.proof.axis;
  FixedMatrix<S, S> turns = turns_of(pair);  // columns: of the motions that are turns
  // of the second body's matter at the contact's point; of that point itself, of the normal
  Vectors way = ways(), point{}, normal{};

  bool of_second(int plane) const { return plane >= faces_a; }

  static FixedMatrix<S, S> turns_of(const Pair<Dim>& pair) {
    if constexpr (Dim == 3)
      return pair.axes.transpose();
    else
      return FixedMatrix<1, 1>::Ones();
  }

  // of every motion, the change of a vector that turns with the second body
  Vectors turned(const Vector<Dim>& v) const {
    Vectors change = Vectors::Zero();
    for (int s = 0; s < S; ++s)
      change.col(Dim + s) = cross(Spin<Dim>(turns.col(s)), v);
    return change;
  }
  Vectors ways() const {
    Vectors all = turned(contact.proof.point - pair.offset);
    all.template leftCols<Dim>() = pair.axes.transpose();
    return all;
  }

  Vectors normal_change(int plane) const {
    return of_second(plane) ? turned(planes[plane].normal) : Vectors(Vectors::Zero());
  }
  // at the contact's point, which moves
  Numbers slack_change(int plane) const {
    const auto a = planes[plane].normal.transpose();
    return of_second(plane) ? Numbers(a.lazyProduct(way - point)) : Numbers(-a.lazyProduct(point));
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

  // of planes [first, last): rows in the axes t, over their slacks; false: the point is not within
  bool add_barrier(const Matrix<Dim>& t, int first, int last, PartSums<Dim>& sums) const {
    for (int i = first; i < last; ++i) {
      const HalfSpace<Dim>& p = planes[i];
      if (!(p.offset > 0)) return false;
      const double weight = weight_of(weights, i);
      const Vector<Dim> row = t.transpose().lazyProduct(p.normal) / p.offset;
      sums.spread += weight * row.lazyProduct(row.transpose());
      sums.along += weight / p.offset * p.normal;
    }
    return true;
  }

  bool find_point() {
    const Matrix<Dim> t = axes();
    PartSums<Dim> of_a, of_b;
    if (!add_barrier(t, 0, faces_a, of_a) || !add_barrier(t, faces_a, static_cast<int>(planes.size()), of_b))
      return false;
    const Vectors along_t = t.transpose().lazyProduct(way), turned_t = t.transpose().lazyProduct(turned(of_b.along));
    Vectors right = of_b.spread.lazyProduct(along_t) - turned_t;
    if (!solve_symmetric<Dim, F>(of_a.spread + of_b.spread, right)) return false;
    point = t.lazyProduct(right);
    return true;
  }

  // ---- normal -------------------------------------------------------------------------------------------------------

  // one part's unit gradient and its change
  void find_direction(int first, int last, Vector<Dim>& direction, Vectors& change) const {
    PartSums<Dim> near;  // of the planes within the particle's radius
    double nearest = std::numeric_limits<double>::infinity();
    int face = first;
    for (int i = first; i < last; ++i) {
      const double slack = planes[i].offset;
      if (slack < radius) {
        const double weight = weight_of(weights, i);
        near.along += weight * (radius - slack) * planes[i].normal;
        near.spread += weight * planes[i].normal.lazyProduct(planes[i].normal.transpose());
      }
      if (slack < nearest) {
        nearest = slack;
        face = i;
      }
    }
    const double length = near.along.norm();
    if (!(length > parallel_gradients * radius)) {
      direction = planes[face].normal;
      change = normal_change(face);
      return;
    }
    direction = near.along / length;
    const Vectors of_gradient = of_second(first) ? Vectors(turned(near.along) - near.spread.lazyProduct(way - point))
                                                 : Vectors(near.spread.lazyProduct(point));
    change = (of_gradient - direction.lazyProduct(direction.transpose().lazyProduct(of_gradient))) / length;
  }

  void find_normal() {
    Vector<Dim> of_a, of_b;
    Vectors change_a, change_b;
    find_direction(0, faces_a, of_a, change_a);
    find_direction(faces_a, static_cast<int>(planes.size()), of_b, change_b);
    const Vectors change = change_a - change_b;
    normal = (change - n.lazyProduct(n.transpose().lazyProduct(change))) / (of_a - of_b).norm();
  }

  // ---- overlap and area ---------------------------------------------------------------------------------------------

  // of the distance slack/(a·along) to a plane along a direction that changes
  Numbers distance_change(int plane, const Vector<Dim>& along, const Vectors& along_change) const {
    const Vector<Dim>& a = planes[plane].normal;
    const double slope = a.dot(along);
    const Numbers slope_change =
        along.transpose().lazyProduct(normal_change(plane)) + a.transpose().lazyProduct(along_change);
    return (slack_change(plane) - planes[plane].offset / slope * slope_change) / slope;
  }

  Numbers overlap_change() const {
    return distance_change(contact.geometry.face_a, n, normal) +
           distance_change(faces_a + contact.geometry.face_b, -n, -normal);
  }

  // The plane of a place of the section's boundary, by the distance within the section; `steep`: of every plane the
  // length of its normal within it.
  int plane_at(const Vector<Dim>& place, const std::vector<double>& steep) const {
    double least = std::numeric_limits<double>::infinity();
    int nearest = 0;
    for (int i = 0; i < static_cast<int>(planes.size()); ++i) {
      const double distance = std::abs(signed_distance(planes[i], place));
      if (!(steep[i] > 0 && distance < least * steep[i])) continue;  // one across the normal bounds no section
      least = distance / steep[i];
      nearest = i;
    }
    return nearest;
  }
  const std::vector<double>& steepness() const {
    static thread_local std::vector<double> steep;
    steep.clear();
    for (const HalfSpace<Dim>& p : planes) {
      const double along = p.normal.dot(n);
      steep.push_back(std::sqrt(std::max(1 - along * along, 0.0)));
    }
    return steep;
  }

  Numbers area_change(const Segment& section) const {
    static_assert(Dim == 2);
    const std::vector<double>& steep = steepness();
    const Vector<2> along = perpendicular(n);
    Vectors along_change;
    for (int f = 0; f < F; ++f)
      along_change.col(f) = perpendicular(Vector<2>(normal.col(f)));
    return distance_change(plane_at(section.high * along, steep), along, along_change) +
           distance_change(plane_at(section.low * along, steep), -along, -along_change);
  }

  // Every edge moves outwards in the section's plane, linearly along itself: by its middle times its length. The
  // section's axes turn with its normal and by nothing else.
  Numbers area_change(const std::vector<Vector<2>>& section) const {
    static_assert(Dim == 3);
    const std::vector<double>& steep = steepness();
    FixedMatrix<3, 2> t;
    t.col(0) = perpendicular(n);
    t.col(1) = n.cross(Vector<3>(t.col(0)));
    // of edges of either part: of their planes' normals; of their middles, by the normal's turn and by the body's
    Vector<3> of_a = Vector<3>::Zero(), of_b = of_a, by_normal = of_a, by_turn = of_a;
    for (std::size_t k = 0; k < section.size(); ++k) {
      const Vector<2>&here = section[k], &next = section[(k + 1) % section.size()];
      const Vector<3> middle = t.lazyProduct(0.5 * (here + next));
      const int plane = plane_at(middle, steep);
      const Vector<3>& a = planes[plane].normal;
      const double weight = (next - here).norm() / Vector<2>(t.transpose().lazyProduct(a)).norm();
      by_normal += weight * a.dot(n) * middle;
      if (of_second(plane)) {
        of_b += weight * a;
        by_turn += weight * a.cross(middle);
      } else {
        of_a += weight * a;
      }
    }
    Numbers change = of_b.transpose().lazyProduct(way - point) - of_a.transpose().lazyProduct(point) +
                     by_normal.transpose().lazyProduct(normal);
    change.template rightCols<3>() -= by_turn.transpose().lazyProduct(turns);
    return change;
  }
};

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
  Finder<Dim> finder{pair, planes, contact, settings.potential_radius * size, weights};
  if (!finder.find_point()) return false;
  finder.find_normal();
  sensitivity.point = finder.point;
  sensitivity.normal = finder.normal;
  sensitivity.overlap = finder.overlap_change();
  const double reach = 4 * std::min(pair.a->radius, pair.b->radius);
  const Vector<Dim> here = Vector<Dim>::Zero();
  if constexpr (Dim == 2) {
    sensitivity.area = finder.area_change(section_segment(planes, here, contact.proof.axis, reach));
  } else {
    static thread_local std::vector<Vector<2>> section;
    section_polygon(planes, here, contact.proof.axis, reach, section);
    sensitivity.area = finder.area_change(section);
  }
  return sensitivity.point.allFinite() && sensitivity.normal.allFinite() && sensitivity.overlap.allFinite() &&
         sensitivity.area.allFinite();
}

template bool find_sensitivity<2>(const Pair<2>&, const ContactSettings&, const Contact<2>&, ContactSensitivity<2>&);
template bool find_sensitivity<3>(const Pair<3>&, const ContactSettings&, const Contact<3>&, ContactSensitivity<3>&);

}  // namespace voussoir
