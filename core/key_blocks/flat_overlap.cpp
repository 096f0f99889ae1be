#include "core/key_blocks/flat_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir {
namespace {

constexpr double most_oblique = 0.3;  // sine of the angle between two axes: coordinates round by its inverse

double turn(const FlatPoint& o, const FlatPoint& a, const FlatPoint& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

// the cells of a grid over the faces below, each with the faces whose boxes meet it
class Grid {
 public:
  explicit Grid(const FlatFaces& faces) {
    for (const FlatFaces::Face& face : faces.faces())
      for (int k = 0; k < 2; ++k) {
        low_[k] = std::min(low_[k], face.low[k]);
        high_[k] = std::max(high_[k], face.high[k]);
      }
    const double count = static_cast<double>(faces.faces().size());
    const std::array<double, 2> size{high_[0] - low_[0], high_[1] - low_[1]};
    const double side = size[1] > 0 ? std::sqrt(size[0] * size[1] / count) : size[0] / count;
    for (int k = 0; k < 2; ++k)
      cells_[k] = size[k] > 0 ? std::max(1, static_cast<int>(std::min(size[k] / side, count))) : 1;
    first_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] + 1, 0);
    for (const FlatFaces::Face& face : faces.faces())
      for_cells(face, [&](std::size_t cell) { ++first_[cell + 1]; });
    for (std::size_t c = 0; c + 1 < first_.size(); ++c)
      first_[c + 1] += first_[c];
    places_.resize(first_.back());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < faces.faces().size(); ++i)
      for_cells(faces.faces()[i], [&](std::size_t cell) { places_[next[cell]++] = static_cast<int>(i); });
  }

  template <class Act>
  void for_near(const FlatFaces::Face& face, const Act& act) const {
    for_cells(face, [&](std::size_t cell) {
      for (int i = first_[cell]; i < first_[cell + 1]; ++i)
        act(places_[i]);
    });
  }

 private:
  int cell_of(double coordinate, int axis) const {
    const double size = high_[axis] - low_[axis];
    if (!(size > 0)) return 0;
    const double cell = (coordinate - low_[axis]) / size * cells_[axis];
    return static_cast<int>(std::clamp(cell, 0.0, cells_[axis] - 1.0));
  }
  template <class Act>
  void for_cells(const FlatFaces::Face& face, const Act& act) const {
    const int x1 = cell_of(face.high[0], 0), y0 = cell_of(face.low[1], 1), y1 = cell_of(face.high[1], 1);
    for (int x = cell_of(face.low[0], 0); x <= x1; ++x)
      for (int y = y0; y <= y1; ++y)
        act(static_cast<std::size_t>(x) * cells_[1] + y);
  }

  FlatPoint low_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  FlatPoint high_{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  std::array<int, 2> cells_{1, 1};
  std::vector<int> first_, places_;
};

void measure(FlatOverlap& overlap) {
  const FlatPoint o = overlap.corners.front();
  double twice = 0, x = 0, y = 0;
  for (std::size_t k = 1; k + 1 < overlap.corners.size(); ++k) {
    const FlatPoint &a = overlap.corners[k], &b = overlap.corners[k + 1];
    const double part = turn(o, a, b);
    twice += part;
    x += part * (a[0] + b[0] - 2 * o[0]);
    y += part * (a[1] + b[1] - 2 * o[1]);
  }
  overlap.area = std::abs(twice) / 2;
  if (overlap.area > 0) overlap.centroid = {o[0] + x / (3 * twice), o[1] + y / (3 * twice)};
}

// the area (of segments the length) common to their boxes
double common_box(const FlatFaces::Face& a, const FlatFaces::Face& b) {
  double area = 1;
  for (int axis = 0; axis < (a.segment() ? 1 : 2); ++axis)
    area *= std::max(0.0, std::min(a.high[axis], b.high[axis]) - std::max(a.low[axis], b.low[axis]));
  return area;
}

// clips by every edge of the other polygon in turn
class Clipper {
 public:
  void overlap(const FlatFaces& a_side, const FlatFaces::Face& a, const FlatFaces& b_side, const FlatFaces::Face& b) {
    if (a.segment()) return overlap_segments(a, b);
    found.corners.assign(a_side.corners(a), a_side.corners(a) + a.corners);
    const FlatPoint* edges = b_side.corners(b);
    for (int e = 0; e < b.corners && !found.corners.empty(); ++e) {
      const FlatPoint &p = edges[e], &q = edges[(e + 1) % b.corners];
      b.counter_clockwise ? clip(p, q) : clip(q, p);
    }
    found.area = 0;
    if (found.corners.size() > 2) measure(found);
  }

  FlatOverlap found;

 private:
  void overlap_segments(const FlatFaces::Face& a, const FlatFaces::Face& b) {
    const double from = std::max(a.low[0], b.low[0]), to = std::min(a.high[0], b.high[0]);
    found = {to - from, {0.5 * (from + to), 0}, {{from, 0}, {to, 0}}};
  }

  // keeps the part to the left of the line from p to q
  void clip(const FlatPoint& p, const FlatPoint& q) {
    clipped_.clear();
    const std::size_t count = found.corners.size();
    double depth = turn(p, q, found.corners[0]);
    for (std::size_t k = 0; k < count; ++k) {
      const FlatPoint &a = found.corners[k], &b = found.corners[k + 1 < count ? k + 1 : 0];
      const double next = turn(p, q, b);
      if (depth >= 0) clipped_.push_back(a);
      if ((depth > 0 && next < 0) || (depth < 0 && next > 0)) {
        const double share = depth / (depth - next);
        clipped_.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])});
      }
      depth = next;
    }
    found.corners.swap(clipped_);
  }

  std::vector<FlatPoint> clipped_;
};

}  // namespace

template <int Dim>
PlaneFrame<Dim>::PlaneFrame(const Vector<Dim>& normal, const Vector<Dim>& edge, const Vector<Dim>& next_edge)
    : normal_(normal), first_(perpendicular(normal)), first_coordinate_(first_) {
  if constexpr (Dim == 3) {
    const auto within = [&](const Vector<3>& v) -> Vector<3> { return v - normal.dot(v) * normal; };
    const Vector<3> along = within(edge);
    if (along.norm() > 0) first_ = along.normalized();
    second_ = normal.cross(first_);
    const Vector<3> oblique = within(next_edge).normalized();
    if (std::abs(second_.dot(oblique)) > most_oblique) second_ = oblique;
    unit_area_ = std::abs(normal.dot(first_.cross(second_)));
    const Vector<3> across_second = second_.cross(normal), across_first = normal.cross(first_);
    first_coordinate_ = across_second / first_.dot(across_second);
    second_coordinate_ = across_first / second_.dot(across_first);
  }
}

template class PlaneFrame<2>;
template class PlaneFrame<3>;

double FlatFaces::end_face(int body, int part, int face, int joint) {
  const int first = faces_.empty() ? 0 : faces_.back().first + faces_.back().corners;
  const FlatPoint* corner = corners_.data() + first;
  Face added{body, part, face, joint, first, static_cast<int>(corners_.size()) - first, *corner, *corner, true};
  double twice = 0;
  for (int k = 0; k < added.corners; ++k) {
    for (int axis = 0; axis < 2; ++axis) {
      added.low[axis] = std::min(added.low[axis], corner[k][axis]);
      added.high[axis] = std::max(added.high[axis], corner[k][axis]);
    }
    if (k > 0 && k + 1 < added.corners) twice += turn(corner[0], corner[k], corner[k + 1]);
  }
  added.counter_clockwise = twice > 0;
  faces_.push_back(added);
  return added.segment() ? added.high[0] - added.low[0] : std::abs(twice) / 2;
}

void for_overlaps(
    const FlatFaces& below, const FlatFaces& above, double negligible,
    const std::function<void(const FlatFaces::Face& below, const FlatFaces::Face& above, const FlatOverlap&)>& act) {
  if (below.faces().empty() || above.faces().empty()) return;
  const Grid grid(below);
  std::vector<int> seen_by(below.faces().size(), -1);
  Clipper clipper;
  for (std::size_t i = 0; i < above.faces().size(); ++i) {
    const FlatFaces::Face& face = above.faces()[i];
    grid.for_near(face, [&](int place) {
      if (seen_by[place] == static_cast<int>(i)) return;
      seen_by[place] = static_cast<int>(i);
      const FlatFaces::Face& other = below.faces()[place];
      const double least = negligible * std::min(face.box(), other.box());
      if (!(common_box(face, other) > least)) return;  // most neighbours within the plane touch by rounding alone
      clipper.overlap(below, other, above, face);
      if (clipper.found.area > least) act(other, face, clipper.found);
    });
  }
}

}  // namespace voussoir
