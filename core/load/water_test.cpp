// Pressure of water on single blocks: volumes and moments by elementary geometry, faces against volume, published
// numbers.
#include "core/load/water.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"
#include "text/angle.hpp"

namespace voussoir::water_test {
namespace {

using namespace shapes;
using oracle::Real;
using oracle::RealVector;

constexpr int blocks = 10'000;

// volume and first moment about the origin
template <int Dim>
struct Solid {
  Real volume = 0;
  RealVector<Dim> moment = RealVector<Dim>::Zero();
};

template <int Dim>
struct RealPlane {
  RealVector<Dim> normal;
  Real offset;
};

Real determinant(const RealVector<3>& a, const RealVector<3>& b, const RealVector<3>& c) {
  return a.dot(b.cross(c));
}

// the corners of a plane within the others, in order around it
std::vector<RealVector<3>> corners_on(const std::vector<RealPlane<3>>& planes, std::size_t f) {
  std::vector<RealVector<3>> corners;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      if (i == f || j == f) continue;
      const auto &p = planes[f], &q = planes[i], &r = planes[j];
      const Real d = determinant(p.normal, q.normal, r.normal);
      if (std::abs(d) < 1e-12L) continue;
      const RealVector<3> x = (p.offset * q.normal.cross(r.normal) + q.offset * r.normal.cross(p.normal) +
                               r.offset * p.normal.cross(q.normal)) /
                              d;
      if (std::ranges::all_of(planes, [&](const auto& o) { return o.normal.dot(x) - o.offset < 1e-15L; }))
        corners.push_back(x);
    }
  if (corners.empty()) return corners;
  RealVector<3> middle = RealVector<3>::Zero();
  for (const RealVector<3>& x : corners)
    middle += x / static_cast<Real>(corners.size());
  const RealVector<3> n = planes[f].normal;
  RealVector<3> first = RealVector<3>::Unit(std::abs(n[0]) < 0.5L ? 0 : 1);
  first = (first - n.dot(first) * n).normalized();
  const RealVector<3> second = n.cross(first);
  const auto angle = [&](const RealVector<3>& x) { return std::atan2(second.dot(x - middle), first.dot(x - middle)); };
  std::ranges::sort(corners, {}, angle);
  return corners;
}

// Every corner from every choice of planes; tetrahedra from the origin, triangles in the plane.
Solid<3> solid_of(const std::vector<RealPlane<3>>& planes) {
  Solid<3> solid;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const std::vector<RealVector<3>> c = corners_on(planes, f);
    for (std::size_t k = 1; k + 1 < c.size(); ++k) {
      const Real piece = determinant(c[0], c[k], c[k + 1]) / 6;
      solid.volume += piece;
      solid.moment += piece / 4 * (c[0] + c[k] + c[k + 1]);
    }
  }
  return solid;
}

Solid<2> solid_of(const std::vector<RealPlane<2>>& planes) {
  Solid<2> solid;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const RealVector<2> n = planes[f].normal, along(-n[1], n[0]), foot = planes[f].offset * n;
    Real low = -1e9L, high = 1e9L;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      if (i == f) continue;
      const Real rate = planes[i].normal.dot(along), slack = planes[i].offset - planes[i].normal.dot(foot);
      if (std::abs(rate) < 1e-15L && slack < 0) low = high;
      if (rate > 1e-15L) high = std::min(high, slack / rate);
      if (rate < -1e-15L) low = std::max(low, slack / rate);
    }
    if (!(high > low)) continue;
    const RealVector<2> a = foot + low * along, b = foot + high * along;
    const Real piece = (a[0] * b[1] - a[1] * b[0]) / 2;
    solid.volume += piece;
    solid.moment += piece / 3 * (a + b);
  }
  return solid;
}

template <int Dim>
RealPlane<Dim> real_plane(const RealVector<Dim>& normal, Real offset) {
  const Real length = normal.norm();
  return {normal / length, offset / length};
}

// A block somewhere, turned anyhow, and a surface of water through it or near it.
template <int Dim>
struct Case {
  std::vector<Polytope<Dim>> parts;
  Standing<Dim> standing;
  std::vector<double> numbers;
  std::vector<WaterStretch<Dim>> surface;

  explicit Case(Random& random) {
    parts.push_back(centred_block<Dim>(random_planes<Dim>(random, integer(random, 0, 5), 1)));
    standing.axes = matrix(orientation<Dim>(random));
    for (int k = 0; k < Dim; ++k)
      standing.centroid[k] = uniform(random, -3, 3);
    const double level = standing.centroid[Dim - 1] + uniform(random, -2, 2);
    if constexpr (Dim == 2) {
      const int points = integer(random, 1, 4);
      double x = standing.centroid[0] + uniform(random, -2, 1);
      for (int k = 0; k < points; ++k) {
        numbers.insert(numbers.end(), {x, level + (points > 1 ? uniform(random, -0.5, 0.5) : 0)});
        x += uniform(random, 0.2, 1);
      }
    } else {
      const bool tilted = integer(random, 0, 1);
      const double along_x = tilted ? uniform(random, -1, 1) : 0, along_y = tilted ? uniform(random, -1, 1) : 0;
      numbers = {level - along_x * standing.centroid[0] - along_y * standing.centroid[1], along_x, along_y};
    }
    list_stretches<Dim>(numbers, surface);
  }

  double radius() const { return parts.front().radius; }
  Submerged<Dim> result() const { return submerged<Dim>(parts, radius(), standing, surface); }

  // below a stretch, moments about the centroid
  Solid<Dim> piece(const WaterStretch<Dim>& stretch) const {
    const RealVector<Dim> centroid = standing.centroid.template cast<Real>();
    std::vector<RealPlane<Dim>> planes;
    for (const HalfSpace<Dim>& f : parts.front().faces)
      planes.push_back(real_plane<Dim>(standing.axes.template cast<Real>() * f.normal.template cast<Real>(), f.offset));
    // rise·(x - point) <= 0
    const RealVector<Dim> rise = stretch.rise.template cast<Real>();
    planes.push_back(real_plane<Dim>(rise, rise.dot(stretch.point.template cast<Real>() - centroid)));
    if (std::isfinite(stretch.from))
      planes.push_back({-RealVector<Dim>::Unit(0), -(static_cast<Real>(stretch.from) - centroid[0])});
    if (std::isfinite(stretch.to)) planes.push_back({RealVector<Dim>::Unit(0), stretch.to - centroid[0]});
    return solid_of(planes);
  }
};

template <int D>
struct InDimension {
  static constexpr int value = D;
};
using Dimensions = testing::Types<InDimension<2>, InDimension<3>>;

template <class Dimension>
class Water : public testing::Test {};
TYPED_TEST_SUITE(Water, Dimensions);

// Eq. 6.8
template <int Dim>
void expect_elementary_geometry(int blocks) {
  Random random(Dim);
  int cut = 0;
  for (int i = 0; i < blocks; ++i) {
    const Case<Dim> one(random);
    const Submerged<Dim> found = one.result();
    Solid<Dim> expected;
    Real potential = 0;
    Load<Dim> load;
    for (const WaterStretch<Dim>& stretch : one.surface) {
      const Solid<Dim> piece = one.piece(stretch);
      expected.volume += piece.volume;
      expected.moment += piece.moment;
      const RealVector<Dim> below =
          (stretch.point - one.standing.centroid).template cast<Real>() * piece.volume - piece.moment;
      potential += stretch.rise.template cast<Real>().dot(below);
      load.force += static_cast<double>(piece.volume) * stretch.rise;
      load.moment += moment(Vector<Dim>(piece.moment.template cast<double>()), stretch.rise);
    }
    const double whole = one.parts.front().mass.volume, size = whole * one.radius(),
                 steep = steepness<Dim>(one.surface);
    cut += expected.volume > 1e-6L * whole && expected.volume < 0.999L * whole;
    ASSERT_NEAR(found.volume, static_cast<double>(expected.volume), 1e-12 * whole) << i;
    ASSERT_LT((found.first_moment - expected.moment.template cast<double>()).norm(), 1e-12 * size) << i;
    ASSERT_NEAR(found.potential, static_cast<double>(potential), 1e-12 * size * 10 * steep) << i;
    ASSERT_LT((found.load.force - load.force).norm(), 1e-12 * whole * steep) << i;
    ASSERT_LT((found.load.moment - load.moment).norm(), 1e-12 * size * steep) << i;
  }
  EXPECT_GT(cut, blocks / 5);
}

TYPED_TEST(Water, HasVolumeAndMomentsOfElementaryGeometry) {
  expect_elementary_geometry<TypeParam::value>(blocks / 5);
}

TEST(WaterLong, HasVolumeAndMomentsOfElementaryGeometry) {
  expect_elementary_geometry<2>(blocks);
  expect_elementary_geometry<3>(blocks);
}

TYPED_TEST(Water, PushesFacesAsItPushesTheVolume) {
  constexpr int Dim = TypeParam::value;
  Random random(10 + Dim);
  for (int i = 0; i < blocks; ++i) {
    const Case<Dim> one(random);
    const Load<Dim> by_volume = one.result().load;
    Load<Dim> by_faces;
    for (std::size_t f = 0; f < one.parts.front().faces.size(); ++f)
      by_faces += pressure_on_face<Dim>(one.parts.front(), f, one.standing, one.surface);
    const double whole = one.parts.front().mass.volume * steepness<Dim>(one.surface);
    ASSERT_LT((by_volume.force - by_faces.force).norm(), 1e-12 * whole) << i;
    ASSERT_LT((by_volume.moment - by_faces.moment).norm(), 1e-12 * whole * one.radius()) << i;
  }
}

// one pressure all around a block is in balance; on one face it is the face's area along its normal
TYPED_TEST(Water, OfOnePressureBalancesAroundABlock) {
  constexpr int Dim = TypeParam::value;
  Random random(20 + Dim);
  for (int i = 0; i < 100; ++i) {
    const Case<Dim> one(random);
    const Polytope<Dim>& part = one.parts.front();
    Load<Dim> sum;
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
      const Load<Dim> load = uniform_pressure_on_face<Dim>(part, f, one.standing.axes);
      const Vector<Dim> push = -face_area<Dim>(part, static_cast<int>(f)) * (one.standing.axes * part.faces[f].normal);
      EXPECT_LT((load.force - push).norm(), 1e-12);
      sum += load;
    }
    EXPECT_LT(sum.force.norm() + sum.moment.norm(), 1e-12);
  }
}

// the load is minus the gradient of the potential, by central differences along every degree of freedom
TYPED_TEST(Water, HasTheGradientOfItsPotential) {
  constexpr int Dim = TypeParam::value;
  Random random(30 + Dim);
  constexpr double way = 1e-5;
  for (int i = 0; i < 200; ++i) {
    const Case<Dim> one(random);
    const Rotation<Dim> start = orientation<Dim>(random);
    const auto potential = [&](int freedom, double by) {
      Case<Dim> moved = one;
      moved.standing.axes = matrix(start);
      if (freedom < Dim)
        moved.standing.centroid[freedom] += by;
      else
        moved.standing.axes = matrix(turned(start, Spin<Dim>(by * Spin<Dim>::Unit(freedom - Dim))));
      return moved.result();
    };
    const Load<Dim> load = potential(0, 0).load;
    for (int f = 0; f < freedoms<Dim>; ++f) {
      const double slope = (potential(f, way).potential - potential(f, -way).potential) / (2 * way);
      EXPECT_NEAR(-slope, f < Dim ? load.force[f] : load.moment[f - Dim], 1e-7) << i << " freedom " << f;
    }
  }
}

// The derivative of the load by the pose never exceeds the bound that determines the time step.
TYPED_TEST(Water, IsNoStifferThanItsBound) {
  constexpr int Dim = TypeParam::value;
  Random random(40 + Dim);
  constexpr double way = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const Case<Dim> one(random);
    BodyStiffness bound = greatest_water_stiffness<Dim>(one.parts, one.radius());
    const double steep = steepness<Dim>(one.surface);
    for (int f = 0; f < Dim; ++f) {
      Case<Dim> ahead = one, behind = one;
      ahead.standing.centroid[f] += way;
      behind.standing.centroid[f] -= way;
      const double stiffness = (behind.result().load.force - ahead.result().load.force)[f] / (2 * way);
      EXPECT_LE(stiffness, steep * bound.translation * (1 + 1e-9)) << i;
    }
    const auto turning = [&](double by) {
      Case<Dim> moved = one;
      Rotation<Dim> none;
      moved.standing.axes = matrix(turned(none, Spin<Dim>(by * Spin<Dim>::Unit(0)))) * one.standing.axes;
      return moved.result().load.moment[0];
    };
    EXPECT_LE((turning(-way) - turning(way)) / (2 * way), steep * bound.rotation * (1 + 1e-9)) << i;
  }
}

std::vector<WaterStretch<3>> level_3d(double h) {
  std::vector<WaterStretch<3>> surface;
  list_stretches<3>(std::vector<double>{h, 0, 0}, surface);
  return surface;
}

// a unit cube that stands on its corner, the water at this height above the corner
TEST(WaterNumbers, OfACubeOnItsCorner) {
  const std::vector<Polytope<3>> cube_parts{block<3>(cube<3>(0.5))};
  const Vector<3> diagonal = Vector<3>::Ones().normalized();
  const Standing<3> standing{.axes = matrix(rotation_onto(diagonal, Vector<3>::UnitZ()))};
  const double corner = -std::sqrt(3.0) / 2;
  struct Row {
    double level, volume, centroid;
  };
  for (const Row& row : {Row{0.2, 0.006928, 0.15}, Row{0.5, 0.108253, 0.375}, Row{0.866025403784, 0.5, 0.631477}}) {
    const Submerged<3> found = submerged<3>(cube_parts, std::sqrt(3.0) / 2, standing, level_3d(corner + row.level));
    EXPECT_NEAR(found.volume, row.volume, 5e-7);
    EXPECT_NEAR(found.first_moment[2] / found.volume - corner, row.centroid, 1e-6);
    EXPECT_LT(found.first_moment.head<2>().norm(), 1e-15);
    // a corner cut off by a plane: its edges measure √3 times the level
    if (row.level <= 0.5) {
      EXPECT_NEAR(found.volume, std::pow(std::sqrt(3.0) * row.level, 3) / 6, 1e-14);
    }
  }
}

// 2 x 1 m at 20 degrees, its centre 0.1 m above the level: the buoyancy acts at the centroid of the wet part, not at
// that of the block, and turns the block
TEST(WaterNumbers, OfATurnedBlock) {
  const std::vector<Polytope<2>> parts{block<2>(box<2>({-1, -0.5}, {1, 0.5}))};
  std::vector<WaterStretch<2>> surface;
  list_stretches<2>(std::vector<double>{0, 0}, surface);
  const Standing<2> standing{.centroid = {3, 0.1}, .axes = matrix(Rotation<2>{20 * degree})};
  const Submerged<2> found = submerged<2>(parts, std::hypot(1, 0.5), standing, surface);
  EXPECT_NEAR(found.volume, 0.787164, 5e-7);
  EXPECT_NEAR(found.first_moment[0] / found.volume, -0.205147, 5e-7);
  EXPECT_NEAR(found.first_moment[1] / found.volume + 0.1, -0.237638, 5e-7);
  EXPECT_EQ(found.load.force, Vector<2>(0, found.volume));
  EXPECT_NEAR(found.load.moment[0], -0.205147 * 0.787164, 1e-6);
}

TEST(WaterNumbers, OfATableAreStraightBetweenPointsAndConstantBeyond) {
  std::vector<WaterStretch<2>> surface;
  list_stretches<2>(std::vector<double>{0, 1, 2, 3, 3, 3}, surface);
  ASSERT_EQ(surface.size(), 3u);  // no bend at x = 3
  const auto level = [&](double x) {
    for (const WaterStretch<2>& s : surface)
      if (x >= s.from && x <= s.to) return s.rise.dot(s.point - Vector<2>(x, 0));
    return -1.0;
  };
  const std::vector<std::pair<double, double>> expected{{-5, 1}, {0, 1}, {0.5, 1.5}, {2, 3}, {2.5, 3}, {9, 3}};
  for (const auto& [x, h] : expected)
    EXPECT_DOUBLE_EQ(level(x), h) << x;
}

}  // namespace
}  // namespace voussoir::water_test
