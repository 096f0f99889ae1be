#include "core/contact/sub_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/contact/pair_geometry.hpp"

namespace voussoir {
namespace {

// the grid is across the section when a face's direction is nearly normal to it: no cell is cut off there
constexpr double least_slope = 1e-3;

constexpr double unbounded = std::numeric_limits<double>::infinity();

// one direction of the grid seen in the section: a point at y is at first + slope·y, in units of cells
template <int Flat>
struct Ruler {
  double first = 0;
  FixedMatrix<Flat, 1> slope;
  int cells = 1;

  // cells with numbers out of range belong to the last ones: the overlap may reach a little beyond a face
  double low(int cell) const { return cell == 0 ? -unbounded : cell; }
  double high(int cell) const { return cell == cells - 1 ? unbounded : cell + 1; }
};

// the integrals of a cell's section
template <int Flat>
struct CellArea {
  double area = 0;
  FixedMatrix<Flat, 1> centroid;
  FixedMatrix<Flat, Flat> moment;  // about the centroid, over the area, m²
};

// directions of a face: 2-D its own, 3-D its longest edge and across
template <int Dim>
FixedMatrix<Dim, Dim - 1> directions(const Polytope<Dim>& part, int face) {
  const std::vector<int>& loop = part.loops[face];
  Vector<Dim> longest = Vector<Dim>::Zero();
  for (std::size_t k = 0; k < (Dim == 2 ? 1 : loop.size()); ++k) {
    const Vector<Dim> edge = part.vertices[loop[(k + 1) % loop.size()]] - part.vertices[loop[k]];
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  FixedMatrix<Dim, Dim - 1> e;
  e.col(0) = longest.normalized();
  if constexpr (Dim == 3) e.col(1) = part.faces[face].normal.cross(e.col(0));
  return e;
}

// the grid of the divided face in the section's axes; `origin` and `turn` take its frame to the first part's
template <int Dim>
void lay_rulers(const Polytope<Dim>& part, int face, const Vector<Dim>& origin, const Matrix<Dim>& turn, int along,
                const Vector<Dim>& point, const FixedMatrix<Dim, Dim - 1>& axes, Ruler<Dim - 1> (&rulers)[Dim - 1]) {
  const FixedMatrix<Dim, Dim - 1> e = directions(part, face);
  const Vector<Dim> seen = turn.transpose() * (point - origin);
  for (int k = 0; k < Dim - 1; ++k) {
    double low = unbounded, high = -unbounded;
    for (const int v : part.loops[face]) {
      low = std::min(low, e.col(k).dot(part.vertices[v]));
      high = std::max(high, e.col(k).dot(part.vertices[v]));
    }
    const double per_length = along / (high - low);
    rulers[k].first = (e.col(k).dot(seen) - low) * per_length;
    rulers[k].slope = per_length * (axes.transpose() * (turn * e.col(k)));
    rulers[k].cells = along;
  }
}

// ---- plane: the section is a segment
// ---------------------------------------------------------------------------------

FixedMatrix<2, 1> section_axes(const Vector<2>& normal) {
  return perpendicular(normal);
}

template <class Visit>
void visit_cells(const HalfSpaces<2>& planes, const Vector<2>& normal, double reach, const Ruler<1> (&rulers)[1],
                 const Visit& visit) {
  const Segment section = section_segment(planes, Vector<2>::Zero(), normal, reach);
  const Ruler<1>& ruler = rulers[0];
  const double slope = ruler.slope[0];
  const bool across = std::abs(slope) * (section.high - section.low) < least_slope;
  const auto place = [&](double cell) { return (cell - ruler.first) / slope; };
  for (int i = 0; i < ruler.cells; ++i) {
    double low = section.low, high = section.high;
    if (across) {
      if (!(ruler.low(i) <= ruler.first && ruler.first < ruler.high(i))) continue;
    } else {
      low = std::max(low, place(slope > 0 ? ruler.low(i) : ruler.high(i)));
      high = std::min(high, place(slope > 0 ? ruler.high(i) : ruler.low(i)));
    }
    if (!(high > low)) continue;
    CellArea<1> piece;
    piece.area = high - low;
    piece.centroid[0] = 0.5 * (low + high);
    piece.moment(0, 0) = piece.area * piece.area / 12;
    visit(i, piece);
  }
}

// ---- space: a polygon
// ------------------------------------------------------------------------------------------------

FixedMatrix<3, 2> section_axes(const Vector<3>& normal) {
  FixedMatrix<3, 2> axes;
  axes.col(0) = perpendicular(normal);
  axes.col(1) = normal.cross(axes.col(0));
  return axes;
}

using Polygon = std::vector<Vector<2>>;

// the part between the cell's two lines across the ruler
void cut_strip(const Polygon& polygon, const Ruler<2>& ruler, int cell, Polygon& spare, Polygon& strip) {
  strip = polygon;
  if (cell > 0) {
    clip_polygon(strip, -ruler.slope, ruler.first - cell, spare);
    std::swap(strip, spare);
  }
  if (cell < ruler.cells - 1) {
    clip_polygon(strip, ruler.slope, cell + 1 - ruler.first, spare);
    std::swap(strip, spare);
  }
}

// area, centroid and second moment, by triangles around the first corner
CellArea<2> measure(const Polygon& polygon) {
  CellArea<2> piece;
  Vector<2> first_moment = Vector<2>::Zero();
  Matrix<2> second = Matrix<2>::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vector<2> u = polygon[k] - polygon[0], v = polygon[k + 1] - polygon[0];
    const double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
    piece.area += area;
    first_moment += area / 3 * (u + v);
    second += area / 12 * (u * u.transpose() + v * v.transpose() + (u + v) * (u + v).transpose());
  }
  if (!(piece.area > 0)) return piece;
  const Vector<2> from_corner = first_moment / piece.area;
  piece.centroid = polygon[0] + from_corner;
  piece.moment = second / piece.area - from_corner * from_corner.transpose();
  return piece;
}

template <class Visit>
void visit_cells(const HalfSpaces<3>& planes, const Vector<3>& normal, double reach, const Ruler<2> (&rulers)[2],
                 const Visit& visit) {
  static thread_local Polygon section, strip, cell, spare;
  section_polygon(planes, Vector<3>::Zero(), normal, reach, section);
  for (int i = 0; i < rulers[0].cells; ++i) {
    cut_strip(section, rulers[0], i, spare, strip);
    if (strip.size() < 3) continue;
    for (int j = 0; j < rulers[1].cells; ++j) {
      cut_strip(strip, rulers[1], j, spare, cell);
      const CellArea<2> piece = measure(cell);
      if (piece.area > 0) visit(i * rulers[1].cells + j, piece);
    }
  }
}

// ---------------------------------------------------------------------------------------------------------------------

// the shear force of another division, shared by areas
template <int Dim>
void hand_over(const JointState<Dim>& history, std::span<SubContact<Dim>> subs) {
  double area = 0;
  for (const SubContact<Dim>& sub : subs)
    area += sub.area;
  for (SubContact<Dim>& sub : subs) {
    sub.history = {};
    if (!(sub.area > 0)) continue;
    const double fraction = sub.area / area;
    sub.history = history;
    sub.history.point = sub.point;
    sub.history.shear_force *= fraction;
    sub.history.dashpot *= fraction;
    sub.history.area *= fraction;
  }
}

}  // namespace

template <int Dim>
void divide(const Pair<Dim>& pair, int along, Contact<Dim>& contact, std::span<SubContact<Dim>> subs) {
  static thread_local HalfSpaces<Dim> planes;
  const Polytope<Dim>&a = *pair.a, &b = *pair.b;
  const Vector<Dim>& point = contact.proof.point;
  const Vector<Dim>& normal = contact.proof.axis;
  const int faces_a = static_cast<int>(a.faces.size());
  assemble<Dim>(pair, point, planes);

  const int face_a = contact.geometry.face_a, face_b = contact.geometry.face_b;
  const bool on_b = face_area<Dim>(b, face_b) < face_area<Dim>(a, face_a);
  const int face = on_b ? faces_a + face_b : face_a;
  Ruler<Dim - 1> rulers[Dim - 1];
  const FixedMatrix<Dim, Dim - 1> axes = section_axes(normal);
  if (on_b)
    lay_rulers<Dim>(b, face_b, pair.offset, pair.rotation, along, point, axes, rulers);
  else
    lay_rulers<Dim>(a, face_a, Vector<Dim>::Zero(), Matrix<Dim>::Identity(), along, point, axes, rulers);

  for (SubContact<Dim>& sub : subs)
    sub.area = 0;
  visit_cells(planes, normal, 4 * std::min(a.radius, b.radius), rulers, [&](int cell, const CellArea<Dim - 1>& piece) {
    SubContact<Dim>& sub = subs[cell];
    const Vector<Dim> centroid = axes * piece.centroid;
    int end_a, end_b;
    if (!overlap_along<Dim>(planes, faces_a, centroid, normal, sub.overlap, end_a, end_b) || !(sub.overlap > 0)) return;
    // the overlap decreases with the slopes of the two faces that end it: its centre of pressure
    const Vector<Dim>&p = planes[end_a].normal, &q = planes[end_b].normal;
    const auto gradient = (axes.transpose() * (q / q.dot(normal) - p / p.dot(normal))).eval();
    const auto lean = (piece.moment * gradient).eval();
    sub.area = piece.area;
    sub.overlap_variance = gradient.dot(lean);
    sub.gyration2 = piece.moment.trace();
    sub.point = pair.axes * (point + centroid + axes * (lean / sub.overlap));
  });

  if (contact.divided_face != face || contact.cells != static_cast<int>(subs.size()))
    hand_over<Dim>(contact.history, subs);
  contact.divided_face = face;
  contact.cells = static_cast<int>(subs.size());
  for (SubContact<Dim>& sub : subs)
    if (!(sub.area > 0)) sub = {};
}

template void divide<2>(const Pair<2>&, int, Contact<2>&, std::span<SubContact<2>>);
template void divide<3>(const Pair<3>&, int, Contact<3>&, std::span<SubContact<3>>);

}  // namespace voussoir
