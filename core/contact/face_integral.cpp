#include "core/contact/face_integral.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/contact/pair_geometry.hpp"

namespace voussoir {
namespace {

// A polygon so much smaller than the square that it was cut from has lost digits to the square: it is cut again from a
// smaller one. One pass keeps them to 16 times the rounding of the polygon's own size.
constexpr double lost_digits = 16;

// and that often: each time the square is at least an eighth of what it was
constexpr int most_cuts = 24;

// Numbers on the mean plane: coordinates y in its axes from `origin`, the overlap u = at_origin + gradient·y.
template <int Dim>
struct MeanPlane {
  Vector<Dim> normal, origin;
  Eigen::Matrix<double, Dim, Dim - 1> axes;
  double at_origin;
  Eigen::Matrix<double, Dim - 1, 1> gradient;

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

  // what of a vector lies in it
  Eigen::Matrix<double, Dim - 1, 1> along(const Vector<Dim>& v) const {
    Eigen::Matrix<double, Dim - 1, 1> y;
    for (int k = 0; k < Dim - 1; ++k)
      y[k] = axes.col(k).dot(v);
    return y;
  }
};

// what of the plane a side plane leaves: q·y <= slack
template <int Flat>
struct Edge {
  Eigen::Matrix<double, Flat, 1> q;
  double slack;
  int plane;  // -1: the pressed edge
};

// what lies along an edge of the segment or polygon, over |q|, which is the sine between both planes
template <int Flat>
struct Border {
  int plane;
  double square;                         // ∫ u² ds
  Eigen::Matrix<double, Flat, 1> lever;  // ∫ u² y ds
};
template <int Flat>
using Borders = std::vector<Border<Flat>>;

// The sums over a segment or polygon, coordinates of the mean plane. Of the overlap from its values in the corners: on
// a needle that presses along one side, its second moment across is lost in the one along.
template <int Flat>
struct Sums {
  double area = 0, volume = 0, square = 0, polar = 0;
  Eigen::Matrix<double, Flat, 1> centre = Eigen::Matrix<double, Flat, 1>::Zero();
  Eigen::Matrix<double, Flat, 1> lean = Eigen::Matrix<double, Flat, 1>::Zero();  // ∫ u (y - centre) dA
};

bool measure(const std::vector<Edge<1>>& edges, const MeanPlane<2>& mean, double reach, std::vector<Vector<2>>&,
             Sums<1>& sums, Borders<1>& borders) {
  double low = -reach, high = reach;
  const Edge<1>*lowest = nullptr, *highest = nullptr;
  for (const Edge<1>& e : edges) {
    if (e.q[0] == 0) {
      if (e.slack < 0) return false;
      continue;
    }
    const double at = e.slack / e.q[0];
    if (e.q[0] > 0 && at < high) {
      high = at;
      highest = &e;
    } else if (e.q[0] < 0 && at > low) {
      low = at;
      lowest = &e;
    }
  }
  if (!(high > low)) return false;
  const double p = std::max(mean.at_origin + mean.gradient[0] * low, 0.0),
               q = std::max(mean.at_origin + mean.gradient[0] * high, 0.0);
  sums.area = high - low;
  sums.centre[0] = 0.5 * (low + high);
  sums.polar = sums.area * sums.area * sums.area / 12;
  sums.volume = 0.5 * sums.area * (p + q);
  sums.square = sums.area / 3 * (p * p + p * q + q * q);
  sums.lean = sums.polar * mean.gradient;
  borders.clear();
  const auto add = [&](const Edge<1>* e, double y, double u) {
    if (e == nullptr || e->plane < 0) return;
    const double square = u * u / std::abs(e->q[0]);
    borders.push_back({e->plane, square, Eigen::Matrix<double, 1, 1>(square * y)});
  };
  add(lowest, low, p);
  add(highest, high, q);
  return true;
}

// of a polygon; the edge that ends in it is of `plane`
struct CutCorner {
  Vector<2> y;
  const Edge<2>* edge;  // null: the square's
};

// Cuts a square about a point by all edges, as clip_polygon does; most edges leave it as it is, which is seen first.
void cut(const std::vector<Edge<2>>& edges, const Vector<2>& about, double half, std::vector<CutCorner>& polygon) {
  // each edge adds a corner at most
  static thread_local std::vector<CutCorner> own[2];
  static thread_local std::vector<double> own_left;
  const std::size_t most = edges.size() + 5;
  if (own_left.size() < most) {
    own[0].resize(most);
    own[1].resize(most);
    own_left.resize(most);
  }
  CutCorner *is = own[0].data(), *then = own[1].data();
  double* const left = own_left.data();
  std::size_t count = 4;
  is[0] = {{-half, -half}, nullptr};
  is[1] = {{half, -half}, nullptr};
  is[2] = {{half, half}, nullptr};
  is[3] = {{-half, half}, nullptr};
  for (const Edge<2>& e : edges) {
    const double qx = e.q[0], qy = e.q[1], slack = e.slack - (qx * about[0] + qy * about[1]);
    if (slack >= half * (std::abs(qx) + std::abs(qy))) continue;  // beyond the square
    double least = 0;
    for (std::size_t k = 0; k < count; ++k) {
      left[k] = slack - (qx * is[k].y[0] + qy * is[k].y[1]);
      least = std::min(least, left[k]);
    }
    if (!(least < 0)) continue;
    std::size_t kept = 0;
    for (std::size_t k = 0, before = count - 1; k < count && kept + 1 < most; before = k++) {
      if (left[before] * left[k] < 0) {
        const double way = left[before] / (left[before] - left[k]);
        then[kept++] = {is[before].y + way * (is[k].y - is[before].y), left[k] < 0 ? is[k].edge : &e};
      }
      if (!(left[k] < 0)) {
        then[kept] = is[k];
        if (left[k] == 0 && left[before] < 0) then[kept].edge = &e;
        ++kept;
      }
    }
    std::swap(is, then);
    count = kept;
    if (count < 3) break;
  }
  polygon.assign(is, is + count);
}

bool measure(const std::vector<Edge<2>>& edges, const MeanPlane<3>& mean, double reach,
             std::vector<Vector<2>>& corners, Sums<2>& sums, Borders<2>& borders) {
  static thread_local std::vector<CutCorner> polygon;
  double half = reach;
  Vector<2> shift = Vector<2>::Zero();  // of the square's middle
  for (int i = 0; i < most_cuts; ++i) {
    cut(edges, shift, half, polygon);
    if (polygon.size() < 3) return false;
    Vector<2> low = polygon[0].y, high = low;
    for (const CutCorner& c : polygon) {
      low = low.cwiseMin(c.y);
      high = high.cwiseMax(c.y);
    }
    const double extent = (high - low).maxCoeff();
    if (!(extent > 0)) return false;
    if (extent * lost_digits >= half) break;
    shift += 0.5 * (low + high);
    half = extent;
  }
  const double here = mean.at_origin + mean.gradient.dot(shift);
  const auto overlap = [&](const Vector<2>& y) { return std::max(here + mean.gradient.dot(y), 0.0); };
  Vector<2> moment = Vector<2>::Zero(), pressed = Vector<2>::Zero();  // from the first corner
  double second = 0;
  const Vector<2> first = polygon[0].y;
  const double p = overlap(first);
  Vector<2> v = polygon[1].y - first;
  double q = overlap(polygon[1].y);
  borders.clear();
  const auto add_border = [&](const Edge<2>* e, const Vector<2>& from, const Vector<2>& to, double u, double w) {
    if (e == nullptr || e->plane < 0) return;
    const double over = std::sqrt((to - from).squaredNorm() / e->q.squaredNorm()), uu = u * u, uw = u * w, ww = w * w;
    borders.push_back({e->plane, over / 3 * (uu + uw + ww),
                       over / 12 * ((3 * uu + 2 * uw + ww) * from + (uu + 2 * uw + 3 * ww) * to)});
  };
  add_border(polygon[1].edge, Vector<2>::Zero(), v, p, q);
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vector<2> w = polygon[k].y - first;
    const double area = 0.5 * (v[0] * w[1] - v[1] * w[0]), r = overlap(polygon[k].y);
    sums.area += area;
    sums.volume += area / 3 * (p + q + r);
    sums.square += area / 6 * (p * p + q * q + r * r + p * q + q * r + r * p);
    second += area / 6 * (v.squaredNorm() + w.squaredNorm() + v.dot(w));
    moment += area / 3 * (v + w);
    pressed += area / 12 * ((p + 2 * q + r) * v + (p + q + 2 * r) * w);
    add_border(polygon[k].edge, v, w, q, r);
    v = w;
    q = r;
  }
  add_border(polygon[0].edge, v, Vector<2>::Zero(), q, p);
  if (!(sums.area > 0)) return false;
  const Vector<2> from_corner = moment / sums.area, middle = first + from_corner, origin = shift + first;
  sums.polar = second - moment.dot(from_corner);
  sums.lean = pressed - sums.volume * from_corner;
  corners.clear();
  for (const CutCorner& c : polygon)
    corners.push_back(c.y - middle);
  for (Border<2>& b : borders)
    b.lever += b.square * origin;
  sums.centre = shift + middle;
  return true;
}

}  // namespace

template <int Dim>
bool integrate_face(const HalfSpaces<Dim>& planes, int faces_a, int face_a, int face_b, double reach,
                    FaceIntegral<Dim>& face, PressedPolygon& polygon) {
  constexpr int Flat = Dim - 1;
  const HalfSpace<Dim>&a = planes[face_a], &b = planes[face_b];
  if (face_a >= faces_a || face_b < faces_a || !(-a.normal.dot(b.normal) > parallel_faces)) return false;
  const MeanPlane<Dim> mean(a, b);
  const Vector<Dim> sum = a.normal + b.normal;
  const double c = 0.5 * (a.normal - b.normal).norm();
  static thread_local std::vector<Edge<Flat>> edges;
  edges.clear();
  for (int i = 0; i < static_cast<int>(planes.size()); ++i)
    if (i != face_a && i != face_b)
      edges.push_back({mean.along(planes[i].normal), -signed_distance(planes[i], mean.origin), i});
  if (!mean.gradient.isZero(0))
    edges.push_back({-mean.gradient, mean.at_origin, -1});
  else if (!(mean.at_origin > 0))
    return false;

  Sums<Flat> sums;
  static thread_local Borders<Flat> borders;
  polygon.corners.clear();
  if (!measure(edges, mean, reach, polygon.corners, sums, borders) || !(sums.volume > 0)) return false;
  face.normal = mean.normal;
  face.area = sums.area;
  face.centre = mean.origin + mean.axes * sums.centre;
  face.volume = sums.volume;
  face.pressure = mean.origin + mean.axes * (sums.centre + sums.lean / sums.volume);
  face.square = sums.square;
  face.polar = sums.polar;
  face.force = sums.volume * mean.normal;
  face.moment = moment(face.pressure, face.force) - 0.25 * sums.square / (c * c) * moment(b.normal, a.normal);
  for (const Border<Flat>& e : borders) {
    const HalfSpace<Dim>& side = planes[e.plane];
    const Vector<Dim> pull = 0.125 * side.normal.dot(mean.normal) / c * sum + (e.plane < faces_a ? -0.25 : 0.25) * side.normal;
    face.force -= e.square * pull;
    face.moment -= moment(Vector<Dim>(e.square * mean.origin + mean.axes * e.lever), pull);
  }
  if constexpr (Dim == 3) {
    polygon.axes = mean.axes;
    polygon.overlap = sums.volume / sums.area;
    polygon.gradient = mean.gradient;
  }
  return true;
}

template bool integrate_face<2>(const HalfSpaces<2>&, int, int, int, double, FaceIntegral<2>&, PressedPolygon&);
template bool integrate_face<3>(const HalfSpaces<3>&, int, int, int, double, FaceIntegral<3>&, PressedPolygon&);

}  // namespace voussoir
