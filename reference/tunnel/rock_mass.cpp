#include "reference/tunnel/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "reference/require.hpp"

namespace voussoir::reference::network {
namespace {

constexpr Require rock_mass_requires{"rock mass: "};

// how far inside a polygon's edge a point is: offset - normal·x, normal unit
struct Side {
  double x = 0, y = 0, offset = 0;
  double inside(const Point& at) const { return offset - x * at[0] - y * at[1]; }
};

std::vector<Side> sides_of(const Polygon& polygon, const Point& origin) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double x = b[1] - a[1], y = a[0] - b[0], size = std::hypot(x, y);
    if (!(size > 0)) continue;
    sides.push_back({x / size, y / size, (x * (a[0] - origin[0]) + y * (a[1] - origin[1])) / size});
  }
  return sides;
}

// the trace's part within a convex polygon has a length
bool enters(const Trace& trace, const Polygon& polygon) {
  const double c = std::cos(trace.angle), s = std::sin(trace.angle);
  double low = -trace.length / 2, high = trace.length / 2;
  for (const Side& side : sides_of(polygon, trace.middle)) {
    const double slope = side.x * c + side.y * s;  // inside if slope·t < offset
    if (slope > 0)
      high = std::min(high, side.offset / slope);
    else if (slope < 0)
      low = std::max(low, side.offset / slope);
    else if (side.offset <= 0)
      return false;
  }
  return high > low;
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

struct Piece {
  Polygon polygon;
  Point middle;
  double reach = 0;  // of a circle about the middle that contains it
};

Piece piece_of(Polygon polygon) {
  Piece piece{std::move(polygon), {0, 0}, 0};
  for (const Point& corner : piece.polygon)
    for (int k = 0; k < 2; ++k)
      piece.middle[k] += corner[k] / static_cast<double>(piece.polygon.size());
  for (const Point& corner : piece.polygon)
    piece.reach = std::max(piece.reach, distance(corner, piece.middle));
  return piece;
}

}  // namespace

std::vector<Trace> draw_traces(const Point& low, const Point& high, double density, double angle, double deviation,
                               double length, std::uint64_t seed) {
  rock_mass_requires(high[0] > low[0] && high[1] > low[1], "traces need a box with an area");
  rock_mass_requires(density > 0 && length > 0 && deviation >= 0, "density and length of traces must be positive");
  std::mt19937_64 bits(seed);
  const auto uniform = [&] { return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53; };
  std::vector<Trace> traces;
  const auto count = std::llround(density * (high[0] - low[0]) * (high[1] - low[1]));
  for (long long i = 0; i < count; ++i) {
    const double x = uniform(), y = uniform(), size = std::sqrt(-2 * std::log(uniform()));  // Box and Muller
    const double normal = size * std::cos(2 * std::numbers::pi * uniform());
    traces.push_back(
        {{low[0] + x * (high[0] - low[0]), low[1] + y * (high[1] - low[1])}, angle + deviation * normal, length});
  }
  return traces;
}

// The largest circle touches three sides: all threes are tried, for polygons have few.
SpacedJointsModuli spaced_joints_moduli(double spacing, double normal_stiffness, double shear_stiffness,
                                        double poisson_ratio) {
  rock_mass_requires(spacing > 0 && normal_stiffness > 0 && shear_stiffness > 0,
                     "spacing and stiffnesses must be positive");
  rock_mass_requires(poisson_ratio >= 0 && poisson_ratio < 0.5, "Poisson's ratio must be in 0..0.5, 0.5 excluded");
  const double young = normal_stiffness * spacing;
  return {young, shear_stiffness * spacing, young / (2 * (1 + poisson_ratio))};
}

double inscribed_radius(const Polygon& polygon) {
  rock_mass_requires(polygon.size() >= 3, "a polygon needs three corners");
  const Point origin = polygon[0];
  const std::vector<Side> sides = sides_of(polygon, origin);
  double largest = 0;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j)
      for (std::size_t k = j + 1; k < sides.size(); ++k) {
        // normal·x + t = offset for the three
        const Side &p = sides[i], &q = sides[j], &r = sides[k];
        const double ax = q.x - p.x, ay = q.y - p.y, bx = r.x - p.x, by = r.y - p.y;
        const double a = q.offset - p.offset, b = r.offset - p.offset, det = ax * by - ay * bx;
        if (det == 0) continue;
        const Point centre{(a * by - ay * b) / det, (ax * b - a * bx) / det};
        double least = std::numeric_limits<double>::infinity();
        for (const Side& side : sides)
          least = std::min(least, side.inside(centre));
        largest = std::max(largest, least);
      }
  return largest;
}

std::vector<Polygon> cut_by_traces(const Polygon& whole, const std::vector<Trace>& traces, double least_radius) {
  rock_mass_requires(least_radius > 0, "the least inscribed radius must be positive, in m");
  std::vector<Piece> pieces{piece_of(whole)};
  for (const Trace& trace : traces) {
    const Point normal{-std::sin(trace.angle), std::cos(trace.angle)};
    const Line line{normal, normal[0] * trace.middle[0] + normal[1] * trace.middle[1]};
    const std::size_t before = pieces.size();
    for (std::size_t i = 0; i < before; ++i) {
      if (distance(pieces[i].middle, trace.middle) > pieces[i].reach + trace.length / 2) continue;
      if (!enters(trace, pieces[i].polygon)) continue;
      // so thin a piece could not contain the circle
      std::vector<Polygon> halves = cut(pieces[i].polygon, {line}, least_radius);
      if (halves.size() < 2 ||
          std::ranges::any_of(halves, [&](const Polygon& half) { return inscribed_radius(half) < least_radius; }))
        continue;
      pieces[i] = piece_of(std::move(halves[0]));
      pieces.push_back(piece_of(std::move(halves[1])));
    }
  }
  std::vector<Polygon> polygons;
  for (Piece& piece : pieces)
    polygons.push_back(std::move(piece.polygon));
  return polygons;
}

std::vector<Trace> in_turn(const std::vector<std::vector<Trace>>& sets) {
  std::size_t longest = 0;
  for (const std::vector<Trace>& set : sets)
    longest = std::max(longest, set.size());
  std::vector<Trace> all;
  for (std::size_t i = 0; i < longest; ++i)
    for (const std::vector<Trace>& set : sets)
      if (i < set.size()) all.push_back(set[i]);
  return all;
}

OedometerAnswer oedometer(std::vector<Block> blocks, const Point& low, const Point& high, int cells,
                          double normal_stiffness, double shear_stiffness, int along, double tolerance) {
  rock_mass_requires(along == 0 || along == 1, "an oedometer presses along 0 (x) or 1 (y)");
  const Point size{high[0] - low[0], high[1] - low[1]};
  rock_mass_requires(size[0] > 0 && size[1] > 0, "an oedometer needs a box with an area");
  // walls left, right, below, above, as thick as they are long
  const std::array<Point, 4> shifts{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const int first_wall = static_cast<int>(blocks.size());
  for (const Point& shift : shifts) {
    const double left = low[0] + shift[0] * size[0], bottom = low[1] + shift[1] * size[1];
    const double right = left + size[0], top = bottom + size[1];
    blocks.push_back({{{{left, bottom}, {right, bottom}, {right, top}, {left, top}}}, {true, true, true}});
  }
  constexpr double strain = 1;  // the network is linear
  blocks[first_wall + 2 * along + 1].imposed[along] = -strain * size[along];
  Network network;
  network.springs = springs(faces(blocks, tolerance), cells, normal_stiffness, shear_stiffness);
  for (Spring& spring : network.springs)
    if (spring.second >= first_wall) spring.shear_stiffness = 0;
  network.blocks = std::move(blocks);
  const Solution solution = solve(network);
  Point stress{};
  for (std::size_t i = 0; i < network.springs.size(); ++i)
    if (const int wall = network.springs[i].second - first_wall; wall >= 0)
      stress[wall / 2] += solution.springs[i].normal / (2 * size[1 - wall / 2]);
  const double axial = stress[along] / strain, side = stress[1 - along] / strain;
  return {(axial - side) / 2, side / (axial + side), axial, side};
}

}  // namespace voussoir::reference::network
