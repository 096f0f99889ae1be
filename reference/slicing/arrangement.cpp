#include "reference/slicing/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace voussoir::reference {
namespace {

// normals of two planes whose sine is below this are parallel: sets of one orientation differ by rounding only
constexpr double parallel = 1e-12;

using Point2 = std::array<double, 2>;
using Point3 = std::array<double, 3>;

template <std::size_t Dim>
double dot(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < Dim; ++k)
    sum += a[k] * b[k];
  return sum;
}

Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <int Dim>
bool inside(const std::array<double, Dim>& p, const Box<Dim>& box) {
  for (int k = 0; k < Dim; ++k)
    if (!(p[k] > box.low[k] && p[k] < box.high[k])) return false;
  return true;
}

// whether a plane meets the interior: the box's corners are on both of its sides
template <int Dim>
bool meets(const std::array<double, Dim>& normal, double offset, const Box<Dim>& box) {
  double least = -offset, most = -offset;
  for (int k = 0; k < Dim; ++k) {
    least += std::min(normal[k] * box.low[k], normal[k] * box.high[k]);
    most += std::max(normal[k] * box.low[k], normal[k] * box.high[k]);
  }
  return least < 0 && most > 0;
}

std::optional<Point2> crossing(const Line2& a, const Line2& b) {
  const double sine = a.normal[0] * b.normal[1] - a.normal[1] * b.normal[0];
  if (std::abs(sine) < parallel) return {};
  return Point2{(a.offset * b.normal[1] - b.offset * a.normal[1]) / sine,
                (a.normal[0] * b.offset - b.normal[0] * a.offset) / sine};
}

struct Line3 {
  Point3 point, direction;
};

std::optional<Line3> crossing(const Plane3& a, const Plane3& b) {
  const Point3 along = cross(a.normal, b.normal);
  const double square = dot(along, along);
  if (square < parallel * parallel) return {};
  // x = ((a.offset b.normal - b.offset a.normal) × along) / |along|²
  Point3 combined;
  for (int k = 0; k < 3; ++k)
    combined[k] = a.offset * b.normal[k] - b.offset * a.normal[k];
  Point3 point = cross(combined, along);
  for (double& x : point)
    x /= square;
  return Line3{point, along};
}

bool meets(const Line3& line, const Box<3>& box) {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (line.direction[k] == 0) {
      if (!(line.point[k] > box.low[k] && line.point[k] < box.high[k])) return false;
      continue;
    }
    const double a = (box.low[k] - line.point[k]) / line.direction[k],
                 b = (box.high[k] - line.point[k]) / line.direction[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from < to;
}

}  // namespace

long long pieces(const std::vector<Line2>& lines, const Box<2>& box) {
  long long count = 1;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!meets<2>(lines[i].normal, lines[i].offset, box)) continue;
    ++count;
    for (std::size_t j = 0; j < i; ++j)
      if (const auto point = crossing(lines[i], lines[j])) count += inside<2>(*point, box);
  }
  return count;
}

long long pieces(const std::vector<Plane3>& planes, const Box<3>& box) {
  long long count = 1;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (!meets<3>(planes[i].normal, planes[i].offset, box)) continue;
    ++count;
    for (std::size_t j = 0; j < i; ++j) {
      const auto line = crossing(planes[i], planes[j]);
      if (!line || !meets(*line, box)) continue;
      ++count;
      for (std::size_t k = 0; k < j; ++k) {
        const double speed = dot(planes[k].normal, line->direction);
        if (std::abs(speed) < parallel) continue;
        const double at = (planes[k].offset - dot(planes[k].normal, line->point)) / speed;
        Point3 point;
        for (int axis = 0; axis < 3; ++axis)
          point[axis] = line->point[axis] + at * line->direction[axis];
        count += inside<3>(point, box);
      }
    }
  }
  return count;
}

double enclosed_area(const std::vector<Line2>& chain) {
  std::vector<Point2> corners;
  for (std::size_t i = 0; i < chain.size(); ++i)
    corners.push_back(crossing(chain[i], chain[(i + 1) % chain.size()]).value());
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 &p = corners[i], &q = corners[(i + 1) % corners.size()];
    twice += (p[0] - corners[0][0]) * (q[1] - corners[0][1]) - (q[0] - corners[0][0]) * (p[1] - corners[0][1]);
  }
  return std::abs(twice) / 2;
}

}  // namespace voussoir::reference
