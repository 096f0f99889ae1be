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
};

// The sums over a segment or polygon, coordinates of the mean plane. Of the overlap from its values in the corners: on
// a needle that presses along one side, its second moment across is lost in the one along.
template <int Flat>
struct Sums {
  double area = 0, volume = 0, square = 0, polar = 0;
  Eigen::Matrix<double, Flat, 1> centre = Eigen::Matrix<double, Flat, 1>::Zero();
  Eigen::Matrix<double, Flat, 1> lean = Eigen::Matrix<double, Flat, 1>::Zero();  // ∫ u (y - centre) dA
};

bool measure(const std::vector<Edge<1>>& edges, const MeanPlane<2>& mean, double reach, std::vector<Vector<2>>&,
             Sums<1>& sums) {
  double low = -reach, high = reach;
  for (const Edge<1>& e : edges) {
    if (e.q[0] > 0)
      high = std::min(high, e.slack / e.q[0]);
    else if (e.q[0] < 0)
      low = std::max(low, e.slack / e.q[0]);
    else if (e.slack < 0)
      return false;
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
  return true;
}

// Cuts a square about a point by all edges, as clip_polygon does; most edges leave it as it is, which is seen first.
void cut(const std::vector<Edge<2>>& edges, const Vector<2>& about, double half, std::vector<Vector<2>>& polygon) {
  // each edge adds a corner at most
  static thread_local std::vector<Vector<2>> own[2];
  static thread_local std::vector<double> own_left;
  const std::size_t most = edges.size() + 5;
  if (own_left.size() < most) {
    own[0].resize(most);
    own[1].resize(most);
    own_left.resize(most);
  }
  Vector<2>*is = own[0].data(), *then = own[1].data();
  double* const left = own_left.data();
  std::size_t count = 4;
  is[0] = {-half, -half};
  is[1] = {half, -half};
  is[2] = {half, half};
  is[3] = {-half, half};
  for (const Edge<2>& e : edges) {
    const double qx = e.q[0], qy = e.q[1], slack = e.slack - (qx * about[0] + qy * about[1]);
    if (slack >= half * (std::abs(qx) + std::abs(qy))) continue;  // beyond the square
    double least = 0;
    for (std::size_t k = 0; k < count; ++k) {
      left[k] = slack - (qx * is[k][0] + qy * is[k][1]);
      least = std::min(least, left[k]);
    }
    if (!(least < 0)) continue;
    std::size_t kept = 0;
    for (std::size_t k = 0, before = count - 1; k < count && kept + 1 < most; before = k++) {
      if (left[before] * left[k] < 0) {
        const double way = left[before] / (left[before] - left[k]);
        then[kept++] = is[before] + way * (is[k] - is[before]);
      }
      if (!(left[k] < 0)) then[kept++] = is[k];
    }
    std::swap(is, then);
    count = kept;
    if (count < 3) break;
  }
  polygon.assign(is, is + count);
}

bool measure(const std::vector<Edge<2>>& edges, const MeanPlane<3>& mean, double reach, std::vector<Vector<2>>& polygon,
             Sums<2>& sums) {
  double half = reach;
  Vector<2> shift = Vector<2>::Zero();  // of the square's middle
  for (int i = 0; i < most_cuts; ++i) {
    cut(edges, shift, half, polygon);
    if (polygon.size() < 3) return false;
    Vector<2> low = polygon[0], high = polygon[0];
    for (const Vector<2>& v : polygon) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
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
  const double p = overlap(polygon[0]);
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vector<2> v = polygon[k] - polygon[0], w = polygon[k + 1] - polygon[0];
    const double area = 0.5 * (v[0] * w[1] - v[1] * w[0]), q = overlap(polygon[k]), r = overlap(polygon[k + 1]);
    sums.area += area;
    sums.volume += area / 3 * (p + q + r);
    sums.square += area / 6 * (p * p + q * q + r * r + p * q + q * r + r * p);
    second += area / 6 * (v.squaredNorm() + w.squaredNorm() + v.dot(w));
    moment += area / 3 * (v + w);
    pressed += area / 12 * ((p + 2 * q + r) * v + (p + q + 2 * r) * w);
  }
  if (!(sums.area > 0)) return false;
  const Vector<2> from_corner = moment / sums.area, middle = polygon[0] + from_corner;
  sums.polar = second - moment.dot(from_corner);
  sums.lean = pressed - sums.volume * from_corner;
  for (Vector<2>& v : polygon)
    v -= middle;
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
  static thread_local std::vector<Edge<Flat>> edges;
  edges.clear();
  for (int i = 0; i < static_cast<int>(planes.size()); ++i)
    if (i != face_a && i != face_b)
      edges.push_back({mean.along(planes[i].normal), -signed_distance(planes[i], mean.origin)});
  if (!mean.gradient.isZero(0))
    edges.push_back({-mean.gradient, mean.at_origin});
  else if (!(mean.at_origin > 0))
    return false;

  Sums<Flat> sums;
  polygon.corners.clear();
  if (!measure(edges, mean, reach, polygon.corners, sums) || !(sums.volume > 0)) return false;
  face.normal = mean.normal;
  face.area = sums.area;
  face.centre = mean.origin + mean.axes * sums.centre;
  face.volume = sums.volume;
  face.pressure = mean.origin + mean.axes * (sums.centre + sums.lean / sums.volume);
  face.square = sums.square;
  face.polar = sums.polar;
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
