// Rotations, half-spaces, vertices, faces and mass against closed forms and integration by sections.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "core/geometry/surface.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::geometry_test {
namespace {

using shapes::Random;

constexpr double pi = std::numbers::pi;

// a few roundings of numbers of order one
constexpr double rounding = 1e-14;

// vertices of well-shaped blocks lose two to three digits, their third powers some more
constexpr double mass_tolerance = 1e-12;

// at a distance of 1e6 sizes the offsets have an error of 1e-10 of the size: the uncertainty of the input, times ten
constexpr double far_origin_tolerance = 1e-9;

// ---- rotations ------------------------------------------------------------------------------------------------------

TEST(Types, MomentAndVelocityDoTheSameWork) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vector<3> r3 = shapes::normal_vector<3>(random), f3 = shapes::normal_vector<3>(random);
    const Spin<3> w3 = shapes::normal_vector<3>(random);
    EXPECT_NEAR(f3.dot(cross(w3, r3)), w3.dot(moment(r3, f3)), 20 * rounding);
    const Vector<2> r2 = shapes::normal_vector<2>(random), f2 = shapes::normal_vector<2>(random);
    const Spin<2> w2 = shapes::normal_vector<1>(random);
    EXPECT_NEAR(f2.dot(cross(w2, r2)), w2.dot(moment(r2, f2)), 20 * rounding);
  }
  EXPECT_EQ(moment(Vector<2>(1, 0), Vector<2>(0, 1))[0], 1);  // counter-clockwise is positive
}

// Eq. 3.21
TEST(Types, TurningFollowsRodrigues) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vector<3> axis = shapes::direction<3>(random);
    const double angle = shapes::power_of_ten(random, -9, 0.5);
    Matrix<3> k;
    k << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
    const Matrix<3> expected = Matrix<3>::Identity() + std::sin(angle) * k + (1 - std::cos(angle)) * k * k;
    const Rotation<3> before = shapes::orientation<3>(random);
    const Rotation<3> after = turned(before, Spin<3>(angle * axis));
    EXPECT_LT((matrix(after) - expected * matrix(before)).norm(), 10 * rounding);
    if (angle < pi) {
      EXPECT_LT((rotation_vector(turned({}, Spin<3>(angle * axis))) - angle * axis).norm(), 10 * rounding);
    }
  }
  EXPECT_NEAR(rotation_vector(turned(Rotation<2>{0.25}, Spin<2>(7)))[0], 7.25, rounding);
  EXPECT_LT((matrix(Rotation<2>{pi / 2}) * Vector<2>(1, 0) - Vector<2>(0, 1)).norm(), rounding);
}

TEST(Types, AMillionSmallTurnsStayARotation) {
  Rotation<3> r;
  const Spin<3> turn(1e-6 * 2 * pi, 0, 0);
  for (int i = 0; i < 1'000'000; ++i)
    r = turned(r, turn);
  EXPECT_NEAR(r.quaternion.norm(), 1, rounding);
  EXPECT_LT((matrix(r) - Matrix<3>::Identity()).norm(), 1e-9);  // 1e6 roundings of 1e-16, systematic at worst
}

TEST(Types, PerpendicularIsUnitAndPerpendicular) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Vector<3> n = shapes::direction<3>(random);
    if (i < 3) n = Vector<3>::Unit(i);
    EXPECT_NEAR(perpendicular(n).norm(), 1, rounding);
    EXPECT_NEAR(perpendicular(n).dot(n), 0, rounding);
  }
  EXPECT_EQ(perpendicular(Vector<2>(1, 0)), Vector<2>(0, 1));  // to the left
}

TEST(Types, RotationOntoIsTheShortestThatTakesOneDirectionToTheOther) {
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    const Vector<3> from = shapes::direction<3>(random);
    // every second pair nearly or wholly opposite, where the axis is what rounding leaves
    const double away = i < 300 ? std::pow(10.0, -i / 20) : 0;
    const Vector<3> opposite = away * perpendicular(from) - from;
    const Vector<3> to = i % 2 ? opposite : shapes::direction<3>(random);
    const Rotation<3> turn = rotation_onto(2 * from, 3 * to);
    EXPECT_NEAR(turn.quaternion.norm(), 1, rounding);
    EXPECT_LT((matrix(turn) * from - to.normalized()).norm(), 1e-7)
        << i;  // nearer than 4e-8 to the opposite is opposite
    EXPECT_NEAR(rotation_vector(turn).norm(), std::acos(std::clamp(from.dot(to.normalized()), -1.0, 1.0)), 1e-7) << i;
  }
  EXPECT_EQ(matrix(rotation_onto(Vector<3>::UnitX(), Vector<3>::UnitX())), Matrix<3>::Identity());
}

// ---- half-spaces ----------------------------------------------------------------------------------------------------

// Eqs 3.3-3.5 as printed: x north, y east, z down, looking down
Vector<3> printed_normal(double dip, double dip_direction) {
  const double chi = pi / 2 - dip, kappa = dip_direction <= pi ? dip_direction + pi : dip_direction - pi;
  return {std::cos(kappa) * std::cos(chi), std::sin(kappa) * std::cos(chi), std::sin(chi)};
}

// Eqs 3.3-3.5
TEST(HalfSpace, JointNormalIsUpwardAndAcrossStrikeAndDip) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const double dip = shapes::uniform(random, 0, pi / 2), direction = shapes::uniform(random, 0, 2 * pi);
    const Vector<3> n = upward_normal_3d(dip, direction);
    const Vector<3> strike(std::sin(direction - pi / 2), std::cos(direction - pi / 2), 0);
    const Vector<3> down(std::cos(dip) * std::sin(direction), std::cos(dip) * std::cos(direction), -std::sin(dip));
    EXPECT_NEAR(n.norm(), 1, rounding);
    EXPECT_GE(n[2], 0);
    EXPECT_NEAR(n.dot(strike), 0, rounding);
    EXPECT_NEAR(n.dot(down), 0, rounding);
    const Vector<3> printed = printed_normal(dip, direction);
    EXPECT_LT((n + Vector<3>(printed[1], printed[0], -printed[2])).norm(), rounding);
  }
  // the section looks north: a joint that dips east has its normal to the right
  EXPECT_LT((upward_normal_2d(0.3, pi / 2) - Vector<2>(std::sin(0.3), std::cos(0.3))).norm(), rounding);
  EXPECT_LT((upward_normal_2d(0.3, 3 * pi / 2) - Vector<2>(-std::sin(0.3), std::cos(0.3))).norm(), rounding);
}

// Eqs 3.19 and 3.20
TEST(HalfSpace, MovingTheOriginMovesNoPoint) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const HalfSpace<3> plane{shapes::direction<3>(random), shapes::uniform(random, -1, 1)};
    const Vector<3> shift = shapes::normal_vector<3>(random), point = shapes::normal_vector<3>(random);
    EXPECT_NEAR(signed_distance<3>(plane, point), signed_distance<3>(moved_origin<3>(plane, shift), point - shift),
                10 * rounding);
  }
}

// ---- topology -------------------------------------------------------------------------------------------------------

// loops close, run counter-clockwise seen from outside, share each edge once in each direction, and obey Euler
void expect_closed_surface(const Polytope<3>& part) {
  std::map<std::pair<int, int>, int> edges;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const std::vector<int>& loop = part.loops[f];
    ASSERT_GE(loop.size(), 3u);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int i = loop[k], j = loop[(k + 1) % loop.size()], l = loop[(k + 2) % loop.size()];
      ++edges[{i, j}];
      const Vector<3> turn = (part.vertices[j] - part.vertices[i]).cross(part.vertices[l] - part.vertices[j]);
      EXPECT_GT(turn.dot(part.faces[f].normal), 0);
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_EQ(
      static_cast<int>(part.vertices.size()) - static_cast<int>(edges.size()) / 2 + static_cast<int>(part.faces.size()),
      2);
}

// ∫ n dA = 0 and ∫ x·n dA = 3 V (2-D: 2 A) hold for any closed surface
template <int Dim>
void expect_divergence_theorem(const Polytope<Dim>& part) {
  Vector<Dim> sum = Vector<Dim>::Zero();
  double flux = 0;
  const double unit = std::pow(part.radius, Dim - 1);
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const double area = face_area<Dim>(part, static_cast<int>(f));
    sum += area * part.faces[f].normal;
    flux += area * part.faces[f].offset;
  }
  EXPECT_LT(sum.norm(), mass_tolerance * unit);
  EXPECT_NEAR(flux, Dim * part.mass.volume, mass_tolerance * unit * part.radius);
}

TEST(Topology, RandomBlocksAreClosed) {
  Random random(6);
  for (int i = 0; i < 60; ++i) {
    const Polytope<3> part = shapes::block<3>(shapes::random_planes<3>(random, shapes::integer(random, 0, 14), 1));
    expect_closed_surface(part);
    expect_divergence_theorem<3>(part);
    const Polytope<2> flat = shapes::block<2>(shapes::random_planes<2>(random, shapes::integer(random, 0, 9), 1));
    EXPECT_EQ(flat.vertices.size(), flat.faces.size());
    for (std::size_t f = 0; f < flat.faces.size(); ++f) {
      ASSERT_EQ(flat.loops[f].size(), 2u);
      const Vector<2> along = flat.vertices[flat.loops[f][1]] - flat.vertices[flat.loops[f][0]];
      EXPECT_LT((Vector<2>(along[1], -along[0]).normalized() - flat.faces[f].normal).norm(), 1e-9);
    }
    expect_divergence_theorem<2>(flat);
  }
}

TEST(Topology, ManyPlanesThroughAVertexAreOneVertex) {
  for (const int sides : {3, 4, 5, 12, 24}) {
    const Polytope<3> part = shapes::block<3>(shapes::pyramid(sides, 1, 2));
    EXPECT_EQ(static_cast<int>(part.vertices.size()), sides + 1);
    EXPECT_EQ(static_cast<int>(part.faces.size()), sides + 1);
    expect_closed_surface(part);
    const double base = sides * std::tan(pi / sides);
    EXPECT_NEAR(part.mass.volume, base * 2 / 3, mass_tolerance);
    EXPECT_NEAR(part.mass.centroid[2], 0.5, mass_tolerance);
    const auto lowest = std::min_element(part.faces.begin(), part.faces.end(),
                                         [](const auto& a, const auto& b) { return a.normal[2] < b.normal[2]; });
    EXPECT_NEAR(face_area<3>(part, static_cast<int>(lowest - part.faces.begin())), base, mass_tolerance);
  }
}

TEST(Topology, APlaneThroughACornerBoundsNothing) {
  HalfSpaces<3> planes = shapes::cube<3>(1);
  planes.push_back({Vector<3>(1, 1, 1).normalized(), std::sqrt(3.0)});
  const Surface<3> surface = find_surface<3>(planes, 0);
  EXPECT_EQ(surface.vertices.size(), 8u);
  EXPECT_TRUE(surface.loops.back().empty());
}

// ---- mass -----------------------------------------------------------------------------------------------------------

TEST(Mass, PlatonicSolidsHaveTheirClosedForms) {
  Random random(7);
  for (const double scale : {1e-3, 1.0, 1e4})
    for (const shapes::Platonic& solid : shapes::platonic_solids(scale)) {
      SCOPED_TRACE(solid.name);
      const Vector<3> shift = 3 * scale * shapes::normal_vector<3>(random);
      const Polytope<3> part =
          shapes::block<3>(shapes::placed<3>(solid.planes, matrix(shapes::orientation<3>(random)), shift));
      EXPECT_EQ(static_cast<int>(part.vertices.size()), solid.vertices);
      EXPECT_EQ(part.faces.size(), solid.planes.size());
      expect_closed_surface(part);
      EXPECT_NEAR(part.inscribed_radius, scale, mass_tolerance * scale);
      EXPECT_NEAR(part.mass.volume, solid.volume, mass_tolerance * solid.volume);
      EXPECT_LT((part.mass.centroid - shift).norm(), mass_tolerance * scale);
      const Matrix<3> inertia = inertia_tensor(moved_origin<3>(part.mass, part.mass.centroid));
      EXPECT_LT((inertia - solid.inertia * Matrix<3>::Identity()).norm(), 10 * mass_tolerance * solid.inertia);
    }
}

TEST(Mass, RegularPolygonsHaveTheirClosedForms) {
  Random random(8);
  for (const double scale : {1e-3, 1.0, 1e4})
    for (int sides = 3; sides < 13; ++sides) {
      const Vector<2> shift = 3 * scale * shapes::normal_vector<2>(random);
      const Polytope<2> part = shapes::block<2>(
          shapes::placed<2>(shapes::regular_polygon(sides, scale), matrix(shapes::orientation<2>(random)), shift));
      const double tangent = std::tan(pi / sides), area = sides * tangent * scale * scale;
      const double inertia = area * scale * scale / 2 * (1 + tangent * tangent / 3);
      EXPECT_EQ(static_cast<int>(part.vertices.size()), sides);
      EXPECT_NEAR(part.inscribed_radius, scale, mass_tolerance * scale);
      EXPECT_NEAR(part.mass.volume, area, mass_tolerance * area);
      EXPECT_LT((part.mass.centroid - shift).norm(), mass_tolerance * scale);
      EXPECT_NEAR(inertia_tensor(moved_origin<2>(part.mass, part.mass.centroid)), inertia,
                  10 * mass_tolerance * inertia);
    }
}

// volume, centroid and second moments along random directions against integration by sections
template <int Dim>
void expect_mass_by_sections(Random& random) {
  const Vector<Dim> shift = 0.3 * shapes::normal_vector<Dim>(random);
  const HalfSpaces<Dim> planes =
      shapes::placed<Dim>(shapes::random_planes<Dim>(random, 7, 1), Matrix<Dim>::Identity(), shift);
  const Polytope<Dim> part = shapes::block<Dim>(planes);
  for (int i = 0; i < 3; ++i) {
    const Vector<Dim> u = shapes::direction<Dim>(random);
    std::vector<oracle::Real> heights;
    for (const Vector<Dim>& v : part.vertices)
      heights.push_back(u.dot(v));
    const double volume = static_cast<double>(oracle::moment<Dim>(planes, u, heights, 0));
    const double first = static_cast<double>(oracle::moment<Dim>(planes, u, heights, 1));
    const double second = static_cast<double>(oracle::moment<Dim>(planes, u, heights, 2));
    EXPECT_NEAR(part.mass.volume, volume, 10 * mass_tolerance);
    EXPECT_NEAR(part.mass.volume * u.dot(part.mass.centroid), first, 10 * mass_tolerance);
    EXPECT_NEAR(u.dot(part.mass.second_moment * u), second, 10 * mass_tolerance);
  }
  EXPECT_NEAR(part.mass.volume, static_cast<double>(oracle::volume<Dim>(planes)), 10 * mass_tolerance);
}

TEST(Mass, RandomBlocksAgreeWithIntegrationBySections) {
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    expect_mass_by_sections<3>(random);
    expect_mass_by_sections<2>(random);
  }
}

TEST(Mass, DoesNotDependOnTheOrigin) {
  Random random(10);
  for (int i = 0; i < 20; ++i) {
    const HalfSpaces<3> planes = shapes::random_planes<3>(random, 8, 1);
    const Vector<3> shift = 1e6 * shapes::direction<3>(random);
    const Polytope<3> near = shapes::block<3>(planes);
    const Polytope<3> far = shapes::block<3>(shapes::placed<3>(planes, Matrix<3>::Identity(), shift));
    EXPECT_EQ(near.vertices.size(), far.vertices.size());
    EXPECT_NEAR(near.mass.volume, far.mass.volume, far_origin_tolerance * near.mass.volume);
    EXPECT_LT((near.mass.centroid + shift - far.mass.centroid).norm(), far_origin_tolerance);
    // there and back
    const Polytope<3> back = moved_origin<3>(moved_origin<3>(near, Vector<3>(1, 2, 3)), Vector<3>(-1, -2, -3));
    EXPECT_LT((back.mass.second_moment - near.mass.second_moment).norm(), 100 * mass_tolerance);
    EXPECT_NEAR(back.radius, near.radius, 10 * mass_tolerance);
  }
}

TEST(Mass, ThinSlabsAndNeedlesAreExact) {
  for (const double thin : {1e-3, 1e-6}) {
    const Polytope<3> slab = shapes::block<3>(shapes::box<3>({-1, -2, -thin}, {1, 2, thin}));
    EXPECT_NEAR(slab.mass.volume, 16 * thin, 16 * thin * mass_tolerance);
    EXPECT_NEAR(slab.inscribed_radius, thin, thin * mass_tolerance);
    EXPECT_NEAR(inertia_tensor(slab.mass)(2, 2), 16 * thin * 20 / 12, 30 * thin * mass_tolerance);
    const Polytope<3> needle = shapes::block<3>(shapes::box<3>({-1, -thin, -thin}, {1, thin, thin}));
    EXPECT_NEAR(needle.mass.volume, 8 * thin * thin, 8 * thin * thin * mass_tolerance);
    EXPECT_NEAR(inertia_tensor(needle.mass)(0, 0), 8 * std::pow(thin, 4) * 2 / 3, 1e-11 * std::pow(thin, 4));
    const Polytope<2> strip = shapes::block<2>(shapes::box<2>({-1, -thin}, {1, thin}));
    EXPECT_NEAR(strip.mass.volume, 4 * thin, 4 * thin * mass_tolerance);
  }
}

}  // namespace
}  // namespace voussoir::geometry_test
