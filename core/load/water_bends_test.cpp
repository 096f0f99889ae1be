// Water whose table bends at a face or a corner: polygons and tables on a coarse grid, so that coincidences abound,
// against a quadrature of pressure along their edges and of wet height over their width.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/load/water.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::water_bends_test {
namespace {

using namespace shapes;
using oracle::Real;
using Point = oracle::RealVector<2>;

constexpr int cases = 10'000;
constexpr int grid = 4;  // coordinates are whole numbers from -grid to grid

// h(x), straight between points and constant beyond
Real surface_at(const std::vector<double>& table, Real x) {
  const std::size_t last = table.size() - 2;
  if (x <= table[0]) return table[1];
  if (x >= table[last]) return table[last + 1];
  std::size_t k = 0;
  while (table[k + 2] < x)
    k += 2;
  const Real along = (x - table[k]) / (Real(table[k + 2]) - table[k]);
  return table[k + 1] + along * (Real(table[k + 3]) - table[k + 1]);
}

// Simpson's rule, exact to the third power, between ascending places within [0, 1]
template <class Function>
auto integrated(const std::vector<Real>& places, const Function& f) {
  auto sum = (f(Real(0)) * Real(0)).eval();
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Real a = places[i], b = places[i + 1];
    // a hair within: at an end the function may have another value beyond it
    const Real in = (b - a) * 1e-15L;
    if (b > a) sum += (b - a) / 6 * (f(a + in) + 4 * f((a + b) / 2) + f(b - in));
  }
  return sum;
}

// adds the places at which a function that is linear between the given ones crosses zero
template <class Function>
std::vector<Real> with_zeros(std::vector<Real> places, const Function& f) {
  std::ranges::sort(places);
  std::vector<Real> all = places;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Real a = places[i], b = places[i + 1], at_a = f(a), at_b = f(b);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) all.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  std::ranges::sort(all);
  return all;
}

struct Push {
  Point force = Point::Zero();
  Real moment = 0;  // about `centroid`
};

// of pressure on an edge whose outer side is on the right of the line from a to b
Push pressure_on(const Point& a, const Point& b, const std::vector<double>& table, const Point& centroid) {
  const auto at = [&](Real t) { return Point(a + t * (b - a)); };
  const auto depth = [&](Real t) { return surface_at(table, at(t)[0]) - at(t)[1]; };
  std::vector<Real> places{0, 1};
  for (std::size_t k = 0; k < table.size(); k += 2)
    if ((table[k] - a[0]) * (table[k] - b[0]) < 0) places.push_back((table[k] - a[0]) / (b[0] - a[0]));
  const Point inward(a[1] - b[1], b[0] - a[0]);  // as long as the edge
  const auto push = [&](Real t) {
    const Real p = std::max(Real(0), depth(t));
    const Point arm = at(t) - centroid;
    return oracle::RealVector<3>(p * inward[0], p * inward[1], p * (arm[0] * inward[1] - arm[1] * inward[0]));
  };
  const oracle::RealVector<3> sum = integrated(with_zeros(places, depth), push);
  return {sum.head<2>(), sum[2]};
}

// the corners of a convex polygon, counter-clockwise: those of the hull of points (Andrew 1979)
std::vector<Point> hull_of(std::vector<Point> points) {
  std::ranges::sort(points,
                    [](const Point& p, const Point& q) { return std::pair(p[0], p[1]) < std::pair(q[0], q[1]); });
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side, std::ranges::reverse(points)) {
    const std::size_t first = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= first + 2) {
        const Point u = hull.back() - hull[hull.size() - 2], v = p - hull.back();
        if (u[0] * v[1] - u[1] * v[0] > 0) break;
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
  }
  return hull;
}

// the part below the surface: volume, and its first moment about the origin
oracle::RealVector<3> wet_part(const std::vector<Point>& ring, const std::vector<double>& table) {
  const auto [low, high] = std::ranges::minmax(ring, {}, [](const Point& p) { return p[0]; });
  const Real from = low[0], width = high[0] - low[0];
  const auto x_at = [&](Real t) { return from + t * width; };
  // the upper or the lower bound of the polygon at a place
  const auto bound = [&](Real t, bool upper) {
    Real z = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a[0] > b[0]) != upper || a[0] == b[0]) continue;
      const Real along = (x_at(t) - a[0]) / (b[0] - a[0]);
      if (along >= -1e-12L && along <= 1 + 1e-12L) z = a[1] + along * (b[1] - a[1]);
    }
    return z;
  };
  std::vector<Real> places{0, 1};
  const auto add = [&](Real x) {
    if (const Real t = (x - from) / width; t > 0 && t < 1) places.push_back(t);
  };
  for (const Point& p : ring)
    add(p[0]);
  for (std::size_t k = 0; k < table.size(); k += 2)
    add(table[k]);
  for (const bool upper : {true, false})
    places = with_zeros(places, [&](Real t) { return surface_at(table, x_at(t)) - bound(t, upper); });
  return integrated(places, [&](Real t) {
    const Real bottom = bound(t, false),
               top = std::clamp(surface_at(table, x_at(t)), bottom, std::max(bottom, bound(t, true)));
    return oracle::RealVector<3>(
        width * oracle::RealVector<3>(top - bottom, x_at(t) * (top - bottom), (top * top - bottom * bottom) / 2));
  });
}

// whole numbers, in ascending order if they are places along x
std::vector<double> random_table(Random& random) {
  std::vector<double> table;
  double x = integer(random, -grid, 0);
  for (int k = integer(random, 1, 5); k > 0; --k, x += integer(random, 1, 3))
    table.insert(table.end(), {x, static_cast<double>(integer(random, -grid, grid))});
  return table;
}

// A convex polygon with corners on the grid, turned by quarter turns from its position in its body.
struct OnGrid {
  std::vector<Point> ring;  // in the world
  Polytope<2> part;
  Standing<2> standing;

  explicit OnGrid(Random& random) {
    std::vector<Point> points;
    do {
      points.clear();
      for (int k = integer(random, 3, 6); k > 0; --k)
        points.emplace_back(integer(random, -grid, grid), integer(random, -grid, grid));
      ring = hull_of(points);
    } while (ring.size() < 3);
    const int quarters = integer(random, 0, 3);
    Matrix<2> turn = Matrix<2>::Identity();
    for (int k = 0; k < quarters; ++k)
      turn = Matrix<2>(turn * (Matrix<2>() << 0, -1, 1, 0).finished());
    std::vector<Vector<2>> corners;
    for (const Point& p : ring)
      corners.push_back(turn.transpose() * p.cast<double>());
    part = block<2>(hull_planes<2>(corners));
    standing = {.centroid = turn * part.mass.centroid, .axes = turn};
    part = moved_origin<2>(part, part.mass.centroid);
  }

  // the ends of a face in the world, the outer side on the right of the line between them
  std::array<Point, 2> face(std::size_t f) const {
    std::array<Point, 2> ends;
    for (int k = 0; k < 2; ++k) {
      const Vector<2> v = standing.centroid + standing.axes * part.vertices[part.loops[f][k]];
      ends[k] = {std::round(v[0]), std::round(v[1])};
    }
    const Vector<2> n = standing.axes * part.faces[f].normal;
    const Point way = ends[1] - ends[0];
    if (way[1] * n[0] - way[0] * n[1] < 0) std::swap(ends[0], ends[1]);
    return ends;
  }
};

bool is_bend(const std::vector<double>& table, Real x) {
  for (std::size_t k = 0; k < table.size(); k += 2)
    if (table[k] == x) return true;
  return false;
}

// The depth of a point is known to some roundings of the coordinates and of the slope times them, a load to those times
// the extent: 1e-12 is ten times that.
double tolerance(std::span<const WaterStretch<2>> surface) {
  return 1e-12 * steepness<2>(surface) * grid * grid;
}

void expect_faces_as_by_quadrature(int cases) {
  Random random(52);
  std::vector<WaterStretch<2>> surface;
  int faces = 0, wet_at_bends = 0, wrong = 0;
  for (int i = 0; i < cases; ++i) {
    const std::vector<double> table = random_table(random);
    const OnGrid one(random);
    list_stretches<2>(table, surface);
    const double allowed = tolerance(surface);
    for (std::size_t f = 0; f < one.part.faces.size(); ++f) {
      const auto [a, b] = one.face(f);
      const Push expected = pressure_on(a, b, table, one.standing.centroid.cast<Real>());
      const Load<2> found = pressure_on_face<2>(one.part, f, one.standing, surface);
      ++faces;
      wet_at_bends += a[0] == b[0] && is_bend(table, a[0]) && expected.force.norm() > 0;
      wrong += !((found.force - expected.force.cast<double>()).norm() < allowed &&
                 std::abs(found.moment[0] - static_cast<double>(expected.moment)) < allowed * grid);
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << faces << " faces";
  EXPECT_GT(wet_at_bends, cases / 20);
}

void expect_volume_as_by_quadrature(int cases) {
  Random random(53);
  std::vector<WaterStretch<2>> surface;
  for (int i = 0; i < cases; ++i) {
    const std::vector<double> table = random_table(random);
    const OnGrid one(random);
    list_stretches<2>(table, surface);
    const double allowed = tolerance(surface);
    const Submerged<2> found = submerged<2>({one.part}, one.part.radius, one.standing, surface);
    const oracle::RealVector<3> wet = wet_part(one.ring, table);
    const Point centroid = one.standing.centroid.cast<Real>();
    const Point moment = Point(wet[1], wet[2]) - wet[0] * centroid;
    ASSERT_NEAR(found.volume, static_cast<double>(wet[0]), allowed) << i;
    ASSERT_LT((found.first_moment - moment.cast<double>()).norm(), allowed * grid) << i;
    Push sum;
    for (std::size_t k = 0; k < one.ring.size(); ++k) {
      const Push push = pressure_on(one.ring[k], one.ring[(k + 1) % one.ring.size()], table, centroid);
      sum.force += push.force;
      sum.moment += push.moment;
    }
    ASSERT_LT((found.load.force - sum.force.cast<double>()).norm(), allowed * grid) << i;
    ASSERT_NEAR(found.load.moment[0], static_cast<double>(sum.moment), allowed * grid * grid) << i;
  }
}

TEST(BentWater, PressesOnFacesAsByQuadrature) {
  expect_faces_as_by_quadrature(cases / 5);
}
TEST(BentWater, LiftsTheVolumeAsByQuadrature) {
  expect_volume_as_by_quadrature(cases / 5);
}
TEST(BentWaterLong, PressesAndLiftsAsByQuadrature) {
  expect_faces_as_by_quadrature(cases);
  expect_volume_as_by_quadrature(cases);
}

// At any bend, the first and the last one too, and from either side: the load on a face there is the load a hair beside
// it.
TEST(BentWater, AtABendEqualsItsLoadBesideTheBend) {
  Random random(54);
  constexpr double hair = 1e-9;  // m
  std::vector<WaterStretch<2>> surface;
  int faces = 0, wrong = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<double> table = random_table(random);
    list_stretches<2>(table, surface);
    const Polytope<2> part = block<2>(box<2>({-1, -grid - 1}, {1, grid + 1}));
    for (std::size_t k = 0; k < table.size(); k += 2)
      for (std::size_t f = 0; f < part.faces.size(); ++f) {
        const double side = part.faces[f].normal[0];
        if (std::abs(side) < 0.5) continue;
        const auto force = [&](double beside) {
          return pressure_on_face<2>(part, f, {.centroid = {table[k] - side + beside, 0}}, surface).force;
        };
        const double depth = table[k + 1] + grid + 1;  // of the lower end
        bool right = std::abs(force(0)[0] + side * depth * depth / 2) <= 1e-12 * depth * depth;
        for (const double beside : {-hair, hair})
          right = right && (force(beside) - force(0)).norm() <= hair * steepness<2>(surface) * 2 * depth + 1e-12;
        ++faces;
        wrong += !right;
      }
  }
  EXPECT_EQ(wrong, 0) << "of " << faces << " faces";
}

}  // namespace
}  // namespace voussoir::water_bends_test
