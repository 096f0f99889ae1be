#include "core/potential/drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/potential/surface.hpp"

namespace voussoir {
namespace {

constexpr double wanted = 0.01;  // error over the sphere's radius
constexpr int most_divisions = 16;

// half way round a corner, as a fraction of `near`
constexpr double half_way = 0.4;

// further divisions end when they reduce the error by less than this fraction
constexpr double least_gain = 0.2;

// The points at which an edge is divided, from 0 to 1: evenly, and from its ends to `near`, where the body is rounded
// off.
std::vector<double> divided(int divisions, double near) {
  std::vector<double> places;
  for (int k = 0; k <= divisions; ++k)
    places.push_back(static_cast<double>(k) / divisions);
  if (!(near > 0 && 2 * near * divisions < 1)) return places;
  places.insert(places.begin() + 1, {half_way * near, near});
  places.insert(places.end() - 1, {1 - near, 1 - half_way * near});
  return places;
}

template <int Dim>
class Drawer {
 public:
  Drawer(const PotentialShape<Dim>& shape, const Polytope<Dim>& enclosing, int divisions)
      : potential_(placed<Dim>(shape)), enclosing_(enclosing), divisions_(divisions), radius_(shape.corner_radius) {}

  PotentialDrawing<Dim> draw() {
    if constexpr (Dim == 2)
      draw_outline();
    else
      for (const std::vector<int>& loop : enclosing_.loops)
        if (loop.size() > 2) draw_face(loop);
    return std::move(drawing_);
  }

 private:
  // the distance, over a length, from a rounded edge of the points next to it
  double near(double length) const { return radius_ / length; }

  // the point of the surface on the ray to a point of a face
  int on_surface(const Vector<Dim>& beyond) {
    const Vector<Dim> way = beyond - potential_.centre;
    drawing_.points.push_back(potential_.centre + distance_to_surface<Dim>(potential_, potential_.centre, way) * way);
    normals_.push_back(derivatives<Dim>(potential_, drawing_.points.back()).gradient.normalized());
    return static_cast<int>(drawing_.points.size()) - 1;
  }

  // points of an edge of the enclosing body, once for both its faces
  std::vector<int> points_along(int from, int to) {
    const auto known = edges_.find({std::min(from, to), std::max(from, to)});
    std::vector<int> points;
    if (known != edges_.end()) {
      points = known->second;
    } else {
      const Vector<Dim>&a = enclosing_.vertices[std::min(from, to)], &b = enclosing_.vertices[std::max(from, to)];
      const std::vector<double> places = divided(divisions_, near((b - a).norm()));
      points.push_back(corner(std::min(from, to)));
      for (std::size_t k = 1; k + 1 < places.size(); ++k)
        points.push_back(on_surface(a + places[k] * (b - a)));
      points.push_back(corner(std::max(from, to)));
      edges_[{std::min(from, to), std::max(from, to)}] = points;
    }
    if (from > to) std::reverse(points.begin(), points.end());
    return points;
  }

  int corner(int vertex) {
    const auto known = corners_.find(vertex);
    return known != corners_.end() ? known->second : corners_[vertex] = on_surface(enclosing_.vertices[vertex]);
  }

  // The face's edges, and copies of them that shrink to its middle.
  void draw_face(const std::vector<int>& loop) {
    Vector<Dim> middle = Vector<Dim>::Zero();
    for (const int v : loop)
      middle += enclosing_.vertices[v] / static_cast<double>(loop.size());
    double width = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < loop.size(); ++k)
      width = std::min(
          width,
          (0.5 * (enclosing_.vertices[loop[k]] + enclosing_.vertices[loop[(k + 1) % loop.size()]]) - middle).norm());
    std::vector<double> scales = divided(divisions_, near(width));
    if (scales.size() > static_cast<std::size_t>(divisions_) + 1) scales.erase(scales.begin() + 1, scales.begin() + 3);

    std::vector<int> outer;
    std::vector<Vector<Dim>> on_edge;  // of the enclosing body
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int from = loop[k], to = loop[(k + 1) % loop.size()];
      const std::vector<int> along = points_along(from, to);
      const Vector<Dim>&a = enclosing_.vertices[std::min(from, to)], &b = enclosing_.vertices[std::max(from, to)];
      std::vector<double> places = divided(divisions_, near((b - a).norm()));
      for (std::size_t j = 0; j + 1 < along.size(); ++j) {
        outer.push_back(along[j]);
        const double place = from < to ? places[j] : places[places.size() - 1 - j];
        on_edge.push_back(a + place * (b - a));
      }
    }
    for (std::size_t s = scales.size() - 1; s-- > 0;) {
      std::vector<int> inner;
      for (const Vector<Dim>& x : on_edge) {
        if (s == 0 && !inner.empty())
          inner.push_back(inner.front());
        else
          inner.push_back(on_surface(middle + scales[s] * (x - middle)));
      }
      for (std::size_t k = 0; k < outer.size(); ++k) {
        const std::size_t next = (k + 1) % outer.size();
        add_cell({outer[k], outer[next], inner[next]});
        if (s > 0) add_cell({outer[k], inner[next], inner[k]});
      }
      outer = std::move(inner);
    }
  }

  void draw_outline() {
    if constexpr (Dim == 2) {
      const std::vector<int> ring = boundary_ring(enclosing_);
      std::vector<int> outline;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::vector<int> along = points_along(ring[k], ring[(k + 1) % ring.size()]);
        outline.insert(outline.end(), along.begin(), along.end() - 1);
      }
      for (std::size_t k = 0; k < outline.size(); ++k)
        note_error(std::array{outline[k], outline[(k + 1) % outline.size()]});
      drawing_.cells.push_back(std::move(outline));
    }
  }

  void add_cell(const std::array<int, 3>& cell) {
    drawing_.cells.emplace_back(cell.begin(), cell.end());
    note_error(cell);
  }

  template <std::size_t Size>
  void note_error(const std::array<int, Size>& cell) {
    double turned = 0, least = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const int i : cell) {
      const Vector<Dim> p = drawing_.points[i] - potential_.centre;
      farthest = std::max(farthest, p.norm());
      for (const int j : cell) {
        turned = std::max(turned, (normals_[i] - normals_[j]).dot(drawing_.points[i] - drawing_.points[j]));
        least = std::min(least, normals_[i].dot(drawing_.points[j] - potential_.centre));
      }
    }
    const double over = Size == 2 ? 4 : 3;
    // if the centre's ray to one point runs along another's tangent this gives no bound
    const double error = least > 0 ? farthest / least * turned / over : potential_.reach;
    drawing_.error = std::max(drawing_.error, error);
  }

  PlacedPotential<Dim> potential_;
  const Polytope<Dim>& enclosing_;
  int divisions_;
  double radius_;
  PotentialDrawing<Dim> drawing_;
  std::vector<Vector<Dim>> normals_;
  std::map<int, int> corners_;
  std::map<std::pair<int, int>, std::vector<int>> edges_;
};

}  // namespace

template <int Dim>
PotentialDrawing<Dim> draw(const PotentialShape<Dim>& shape, const Polytope<Dim>& enclosing) {
  PotentialDrawing<Dim> best = Drawer<Dim>(shape, enclosing, 2).draw();
  for (int divisions = 4; best.error > wanted * shape.sphere_radius && divisions <= most_divisions; divisions *= 2) {
    PotentialDrawing<Dim> finer = Drawer<Dim>(shape, enclosing, divisions).draw();
    if (finer.error > (1 - least_gain) * best.error) break;
    best = std::move(finer);
  }
  return best;
}

template PotentialDrawing<2> draw<2>(const PotentialShape<2>&, const Polytope<2>&);
template PotentialDrawing<3> draw<3>(const PotentialShape<3>&, const Polytope<3>&);

}  // namespace voussoir
