#include "core/contact/face_integral.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/contact/pair_geometry.hpp"

namespace voussoir {
namespace {

// A polygon so much smaller than the square from which it was cut has lost digits to the square: it is cut again from a
// smaller one. One pass keeps them to 6 times the rounding of the polygon's own size; a cube's face needs 3.5.
constexpr double lost_digits = 6;

// and that often: each time the square is at least an eighth of the last one
constexpr int most_cuts = 24;

// Numbers on the mean plane: coordinates y in its axes from `origin`, the overlap u = at_origin + gradient·y.
template <int Dim>
struct MeanPlane {
  Vector<Dim> normal, origin;
  FixedMatrix<Dim, Dim - 1> axes;
  double at_origin;
  FixedMatrix<Dim - 1, 1> gradient;

  MeanPlane(const HalfSpace<Dim>& a, const HalfSpace<Dim>& b) {
    const Vector<Dim> difference = a.normal - b.normal, sum = a.normal + b.normal;
    const double length = difference.norm();
    normal = difference / length;
    origin = (a.offset - b.offset) / length * normal;
    axes.col(0) = perpendicular(normal);
    if constexpr (Dim == 3) axes.col(1) = normal.cross(axes.col(0));
    const double c = 0.5 * length;
    at_origin = ((a.offset + b.offset) - sum.dot(origin)) / c;
    gradient = -along(sum) / c;
  }

  // the part of a vector in it
  FixedMatrix<Dim - 1, 1> along(const Vector<Dim>& v) const {
    FixedMatrix<Dim - 1, 1> y;
    for (int k = 0; k < Dim - 1; ++k)
      y[k] = axes.col(k).dot(v);
    return y;
  }
};

// The half of the mean plane within a side plane: q·y <= slack. |q| is the sine between both.
template <int Flat>
struct Edge {
  FixedMatrix<Flat, 1> q;
  double slack;
  int plane;
};

// calls `with` for each of them
template <int Dim, class With>
[[gnu::always_inline]] inline void each_edge(const HalfSpaces<Dim>& planes, int face_a, int face_b,
                                             const MeanPlane<Dim>& mean, With with) {
  const auto axes = mean.axes;
  const Vector<Dim> origin = mean.origin;
  const HalfSpace<Dim>* const first = planes.data();
  const int count = static_cast<int>(planes.size());
  for (int i = 0; i < count; ++i) {
    if (i == face_a || i == face_b) continue;
    Edge<Dim - 1> e;
    for (int k = 0; k < Dim - 1; ++k)
      e.q[k] = axes.col(k).dot(first[i].normal);
    e.slack = -signed_distance(first[i], origin);
    e.plane = i;
    with(e);
  }
  with(Edge<Dim - 1>{-mean.gradient, mean.at_origin, no_plane});
}

// Side planes of both parts are flush if less than this many overlaps apart: about as far as shear springs shift blocks
// before they slip, the friction times kn over ks. And by less than this part of the pressed width; and within five
// degrees of parallel (1 - cos²).
constexpr double flush_overlaps = 10, flush_width = 0.02, flush_sine2 = 0.0076;

// The integrals along an edge of the segment or polygon, over |q|. If a plane of the other part is flush, both share
// it: half each if they coincide.
template <int Flat>
struct Border {
  int plane;
  int twin = -1;                           // the other one
  double twins = 0;                        // its share
  double per_behind = 0, per_overlap = 0;  // 1/m: its changes with where it is behind, and with the overlap
  double sine2;                            // |q|²
  double square;                           // ∫ u² ds
  FixedMatrix<Flat, 1> lever;              // ∫ u² y ds
};
template <int Flat>
using Borders = std::vector<Border<Flat>>;

// With a plane that is `behind` it, m; `overlap`: its mean on the edge, `extent`: of the polygon, both m; `sine2` of
// the angle between both. It decreases to zero at the end.
template <int Flat>
void share_with(int plane, double behind, double overlap, double extent, double sine2, Border<Flat>& border) {
  const double within = std::min(flush_overlaps * overlap, flush_width * extent);
  if (!(behind < within && sine2 < flush_sine2)) return;
  const double most = 0.5 * (1 - sine2 / flush_sine2), share = std::min(1 - behind / within, 1.0) * most;
  if (!(share > border.twins)) return;
  border.twin = plane;
  border.twins = share;
  border.per_behind = behind > 0 ? -most / within : 0;
  border.per_overlap =
      flush_overlaps * overlap < flush_width * extent ? -border.per_behind * behind / within * flush_overlaps : 0;
}

// a side of the segment or polygon, its overlap at both ends, and its place among the borders
template <int Flat>
struct Side {
  int border;
  FixedMatrix<Flat, 1> from, to;
  double overlap_from, overlap_to;
};
template <int Flat>
using Outline = std::vector<Side<Flat>>;

// The sums over a segment or polygon, coordinates of the mean plane. Those of the overlap from its values in the
// corners: on a needle pressed along one side, its second moment across is lost in the one along.
template <int Flat>
struct Sums {
  double area = 0, volume = 0, square = 0, polar = 0;
  FixedMatrix<Flat, 1> centre = FixedMatrix<Flat, 1>::Zero();
  FixedMatrix<Flat, 1> lean = FixedMatrix<Flat, 1>::Zero();  // ∫ u (y - centre) dA
};

bool measure(const HalfSpaces<2>& planes, int faces_a, int face_a, int face_b, const MeanPlane<2>& mean, double reach,
             std::vector<Vector<2>>&, Sums<1>& sums, Borders<1>& borders, Outline<1>* outline) {
  double low = -reach, high = reach;
  bool open = false;
  Edge<1> lowest{FixedMatrix<1, 1>(1), 0, no_plane}, highest = lowest;
  each_edge(planes, face_a, face_b, mean, [&](const Edge<1>& e) {
    if (e.q[0] == 0) {
      open |= e.slack < 0;
      return;
    }
    const double at = e.slack / e.q[0];
    if (e.q[0] > 0 && at < high) {
      high = at;
      highest = e;
    } else if (e.q[0] < 0 && at > low) {
      low = at;
      lowest = e;
    }
  });
  if (open || !(high > low)) return false;
  const double p = std::max(mean.at_origin + mean.gradient[0] * low, 0.0),
               q = std::max(mean.at_origin + mean.gradient[0] * high, 0.0);
  sums.area = high - low;
  sums.centre[0] = 0.5 * (low + high);
  sums.polar = sums.area * sums.area * sums.area / 12;
  sums.volume = 0.5 * sums.area * (p + q);
  sums.square = sums.area / 3 * (p * p + p * q + q * q);
  sums.lean = sums.polar * mean.gradient;
  borders.clear();
  const auto add = [&](const Edge<1>& e, double y, double u) {
    const int place = e.plane == no_plane ? no_plane : static_cast<int>(borders.size());
    if (outline) outline->push_back({place, FixedMatrix<1, 1>(y), FixedMatrix<1, 1>(y), u, u});
    if (e.plane == no_plane) return;
    const double square = u * u / std::abs(e.q[0]);
    Border<1> border{e.plane, -1, 0, 0, 0, e.q[0] * e.q[0], square, FixedMatrix<1, 1>(square * y)};
    each_edge(planes, face_a, face_b, mean, [&](const Edge<1>& other) {
      if (other.plane == no_plane || (other.plane < faces_a) == (e.plane < faces_a) || other.q[0] * e.q[0] <= 0) return;
      share_with(other.plane, other.slack / std::abs(other.q[0]) - (other.q[0] > 0 ? y : -y), u, sums.area, 0, border);
    });
    borders.push_back(border);
  };
  add(lowest, low, p);
  add(highest, high, q);
  return true;
}

// A square about a point, cut by all edges as clip_polygon does; most do not change it, which is checked first.
struct CutPolygon {
  struct Corner {
    double x, y;
    int edge;  // the cut that made the edge which ends in it; -1: the square's
  };
  std::vector<Corner> own[2];
  std::vector<double> left;
  std::vector<Edge<2>> cuts;  // and those that pass by within `near`
  Corner* corners = nullptr;
  std::size_t count = 0;
  double reach = 0;  // of every corner along both axes, from the point
  double near = 0;   // m: no plane farther behind is flush

  [[gnu::always_inline]] void cut(const Edge<2>& e, const Vector<2>& about, Corner*& then) {
    const double qx = e.q[0], qy = e.q[1], slack = e.slack - (qx * about[0] + qy * about[1]);
    if (slack >= reach * (std::abs(qx) + std::abs(qy)) + near) return;  // it passes beyond all corners
    Corner* const is = corners;
    double* const over = left.data();
    const std::size_t before_cut = count;
    double least = near;
    for (std::size_t k = 0; k < before_cut; ++k) {
      over[k] = slack - (qx * is[k].x + qy * is[k].y);
      least = std::min(least, over[k]);
    }
    if (!(least < near)) return;
    const int own_cut = static_cast<int>(cuts.size());
    cuts.push_back(e);
    if (!(least < 0)) return;
    Corner* kept = then;
    double farthest = 0;
    std::size_t k_before = before_cut - 1;
    const Corner* const room = then + left.size() - 1;
    for (std::size_t k = 0; k < before_cut && kept < room; k_before = k++) {
      const double here = over[k], there = over[k_before];
      if (here < 0) {
        if (!(there > 0)) continue;
      } else if (!(there < 0 && here > 0)) {
        *kept++ = {is[k].x, is[k].y, there < 0 ? own_cut : is[k].edge};
        continue;
      }
      const double way = there / (there - here), x = is[k_before].x, y = is[k_before].y;
      *kept++ = {x + way * (is[k].x - x), y + way * (is[k].y - y), here < 0 ? is[k].edge : own_cut};
      if (!(here < 0)) *kept++ = is[k];
    }
    for (const Corner* c = then; c != kept; ++c)
      farthest = std::max({farthest, std::abs(c->x), std::abs(c->y)});
    reach = farthest;
    near = 2 * flush_width * reach;
    count = kept - then;
    std::swap(corners, then);
    if (count < 3) count = 0;
  }

  void cut_all(const HalfSpaces<3>& planes, int face_a, int face_b, const MeanPlane<3>& mean, const Vector<2>& about,
               double half) {
    // each edge adds a corner at most; a polygon that rounding has bent may need more, and does without
    const std::size_t most = 2 * planes.size() + 8;
    if (left.size() < most) {
      own[0].resize(most);
      own[1].resize(most);
      left.resize(most);
    }
    cuts.clear();
    corners = own[0].data();
    Corner* then = own[1].data();
    corners[0] = {-half, -half, -1};
    corners[1] = {half, -half, -1};
    corners[2] = {half, half, -1};
    corners[3] = {-half, half, -1};
    count = 4;
    reach = half;
    near = 2 * flush_width * reach;
    each_edge(planes, face_a, face_b, mean, [&](const Edge<2>& e) {
      if (count > 0) cut(e, about, then);
    });
  }
};

bool measure(const HalfSpaces<3>& planes, int faces_a, int face_a, int face_b, const MeanPlane<3>& mean, double reach,
             std::vector<Vector<2>>& corners, Sums<2>& sums, Borders<2>& borders, Outline<2>* outline) {
  static thread_local CutPolygon own;
  CutPolygon& polygon = own;
  double half = reach, extent = 0;
  Vector<2> shift = Vector<2>::Zero();  // of the square's middle
  for (int i = 0; i < most_cuts; ++i) {
    polygon.cut_all(planes, face_a, face_b, mean, shift, half);
    if (polygon.count < 3) return false;
    Vector<2> low(polygon.corners[0].x, polygon.corners[0].y), high = low;
    for (std::size_t k = 1; k < polygon.count; ++k) {
      const Vector<2> y(polygon.corners[k].x, polygon.corners[k].y);
      low = low.cwiseMin(y);
      high = high.cwiseMax(y);
    }
    extent = (high - low).maxCoeff();
    if (!(extent > 0)) return false;
    if (extent * lost_digits >= half) break;
    shift += 0.5 * (low + high);
    half = extent;
  }
  const double here = mean.at_origin + mean.gradient.dot(shift), slope_x = mean.gradient[0], slope_y = mean.gradient[1];
  const double first_x = polygon.corners[0].x, first_y = polygon.corners[0].y;
  const auto overlap = [&](const CutPolygon::Corner& c) {
    return std::max(here + (slope_x * c.x + slope_y * c.y), 0.0);
  };
  borders.clear();
  const auto add_border = [&](int edge, double from_x, double from_y, double to_x, double to_y, double u, double w) {
    const bool borders_part = edge >= 0 && polygon.cuts[edge].plane != no_plane;
    if (outline) {
      const Vector<2> from(from_x, from_y), to(to_x, to_y), first(shift[0] + first_x, shift[1] + first_y);
      outline->push_back({borders_part ? static_cast<int>(borders.size()) : no_plane, first + from, first + to, u, w});
    }
    if (!borders_part) return;
    const double dx = to_x - from_x, dy = to_y - from_y, sine2 = polygon.cuts[edge].q.squaredNorm();
    const double over = std::sqrt((dx * dx + dy * dy) / sine2), uu = u * u, uw = u * w, ww = w * w;
    const double from = over / 12 * (3 * uu + 2 * uw + ww), to = over / 12 * (uu + 2 * uw + 3 * ww);
    Border<2> border{polygon.cuts[edge].plane,
                     -1,
                     0,
                     0,
                     0,
                     sine2,
                     from + to,
                     {from * from_x + to * to_x, from * from_y + to * to_y}};
    const bool of_a = border.plane < faces_a;
    const double x = shift[0] + first_x + 0.5 * (from_x + to_x), y = shift[1] + first_y + 0.5 * (from_y + to_y);
    for (const Edge<2>& other : polygon.cuts) {
      if (other.plane == no_plane || (other.plane < faces_a) == of_a) continue;
      const Vector<2>&q1 = polygon.cuts[edge].q, &q2 = other.q;
      if (!(q1.dot(q2) > 0)) continue;
      const double across = q1[0] * q2[1] - q1[1] * q2[0], squares = sine2 * q2.squaredNorm();
      if (!(across * across < flush_sine2 * squares)) continue;
      share_with(other.plane, (other.slack - (q2[0] * x + q2[1] * y)) / q2.norm(), 0.5 * (u + w), extent,
                 across * across / squares, border);
    }
    borders.push_back(border);
  };
  // places from the first corner
  double area = 0, volume = 0, square = 0, second = 0, moment_x = 0, moment_y = 0, pressed_x = 0, pressed_y = 0;
  const double p = overlap(polygon.corners[0]);
  double vx = polygon.corners[1].x - first_x, vy = polygon.corners[1].y - first_y, q = overlap(polygon.corners[1]);
  add_border(polygon.corners[1].edge, 0, 0, vx, vy, p, q);
  for (std::size_t k = 2; k < polygon.count; ++k) {
    const CutPolygon::Corner& c = polygon.corners[k];
    const double wx = c.x - first_x, wy = c.y - first_y, r = overlap(c);
    const double triangle = 0.5 * (vx * wy - vy * wx), sum = p + q + r;
    area += triangle;
    volume += triangle / 3 * sum;
    square += triangle / 6 * (p * p + q * q + r * r + p * q + q * r + r * p);
    second += triangle / 6 * (vx * vx + vy * vy + wx * wx + wy * wy + vx * wx + vy * wy);
    moment_x += triangle / 3 * (vx + wx);
    moment_y += triangle / 3 * (vy + wy);
    pressed_x += triangle / 12 * ((sum + q) * vx + (sum + r) * wx);
    pressed_y += triangle / 12 * ((sum + q) * vy + (sum + r) * wy);
    add_border(c.edge, vx, vy, wx, wy, q, r);
    vx = wx;
    vy = wy;
    q = r;
  }
  add_border(polygon.corners[0].edge, vx, vy, 0, 0, q, p);
  if (!(area > 0)) return false;
  const Vector<2> first(first_x, first_y), from_first(moment_x / area, moment_y / area), middle = first + from_first;
  sums.area = area;
  sums.volume = volume;
  sums.square = square;
  sums.polar = second - (moment_x * from_first[0] + moment_y * from_first[1]);
  sums.lean = Vector<2>(pressed_x, pressed_y) - volume * from_first;
  sums.centre = shift + middle;
  corners.resize(polygon.count);
  for (std::size_t k = 0; k < polygon.count; ++k)
    corners[k] = {polygon.corners[k].x - middle[0], polygon.corners[k].y - middle[1]};
  const Vector<2> origin = shift + first;
  for (Border<2>& b : borders)
    b.lever += b.square * origin;
  return true;
}

}  // namespace

template <int Dim>
bool integrate_face(const HalfSpaces<Dim>& planes, int faces_a, int face_a, int face_b, double reach,
                    FaceIntegral<Dim>& face, PressedPolygon& polygon, std::vector<FaceEdge<Dim>>* edges) {
  constexpr int Flat = Dim - 1;
  const HalfSpace<Dim>&a = planes[face_a], &b = planes[face_b];
  if (face_a >= faces_a || face_b < faces_a || !(-a.normal.dot(b.normal) > parallel_faces)) return false;
  const MeanPlane<Dim> mean(a, b);
  const Vector<Dim> sum = a.normal + b.normal;
  const double c = 0.5 * (a.normal - b.normal).norm();
  if (mean.gradient.isZero(0) && !(mean.at_origin > 0)) return false;
  Sums<Flat> sums;
  static thread_local Borders<Flat> borders;
  static thread_local Outline<Flat> outline;
  outline.clear();
  polygon.corners.clear();
  if (!measure(planes, faces_a, face_a, face_b, mean, reach, polygon.corners, sums, borders,
               edges ? &outline : nullptr) ||
      !(sums.volume > 0))
    return false;
  face.normal = mean.normal;
  face.area = sums.area;
  face.centre = mean.origin + mean.axes * sums.centre;
  face.volume = sums.volume;
  face.pressure = mean.origin + mean.axes * (sums.centre + sums.lean / sums.volume);
  face.square = sums.square;
  face.polar = sums.polar;
  face.force = sums.volume * mean.normal;
  face.moment = moment(face.pressure, face.force) - 0.25 * sums.square / (c * c) * moment(b.normal, a.normal);
  face.least_sine2 = 1;
  face.flush = false;
  // the share of its square with which an edge pulls, as either part's plane
  const auto pull_of = [&](int plane) {
    const Vector<Dim>& normal = planes[plane].normal;
    return Vector<Dim>(0.125 / c * normal.dot(mean.normal) * sum + (plane < faces_a ? -0.25 : 0.25) * normal);
  };
  for (const Border<Flat>& e : borders) {
    face.least_sine2 = std::min(face.least_sine2, e.sine2);
    Vector<Dim> pull = pull_of(e.plane);
    if (e.twin >= 0) {
      pull = (1 - e.twins) * pull + e.twins * pull_of(e.twin);
      face.flush = true;
    }
    face.force -= e.square * pull;
    face.moment -= moment(Vector<Dim>(e.square * mean.origin + mean.axes * e.lever), pull);
  }
  if (edges) {
    edges->clear();
    for (const Side<Flat>& side : outline) {
      FaceEdge<Dim> e;
      e.from = mean.origin + mean.axes * side.from;
      e.to = mean.origin + mean.axes * side.to;
      e.overlap_from = side.overlap_from;
      e.overlap_to = side.overlap_to;
      if (side.border >= 0) {
        const Border<Flat>& border = borders[side.border];
        e.plane = border.plane;
        e.twin = border.twin;
        e.pull = pull_of(border.plane);
        if (border.twin >= 0) {
          e.twin_pulls = pull_of(border.twin) - e.pull;
          e.pull += border.twins * e.twin_pulls;
        }
        e.twin_per_behind = border.per_behind;
        e.twin_per_overlap = border.per_overlap;
      }
      edges->push_back(e);
    }
  }
  if constexpr (Dim == 3) {
    polygon.axes = mean.axes;
    polygon.overlap = sums.volume / sums.area;
    polygon.gradient = mean.gradient;
  }
  return true;
}

template bool integrate_face<2>(const HalfSpaces<2>&, int, int, int, double, FaceIntegral<2>&, PressedPolygon&,
                                std::vector<FaceEdge<2>>*);
template bool integrate_face<3>(const HalfSpaces<3>&, int, int, int, double, FaceIntegral<3>&, PressedPolygon&,
                                std::vector<FaceEdge<3>>*);

}  // namespace voussoir
