// The rest of the catalogue of extremes for the contact kernel, against exact arithmetic. Tests of its rows:
//   L1 L2 L4-L7 L10  certainty_test (by number)      L3 L6 (turned by Pythagorean quadruples)   here
//   L8  slicing_test MakeBlock.NamesTheFault           L9  symmetry_test
//   A1-A6  centre_test                               N1 N2 N4 N5  here; contacts: thin_contact_test Containment
//   N3  pair_judge ("length of the normal")          N6 N7  no aligning rotation and no fixed tangent seed is used;
//                                                    geometry_test Types.PerpendicularIsUnitAndPerpendicular
//   O1 O2  here    O3  contact_test OverlapAlong     C1  contact_test SectionArea.OfACubeAcrossItsDiagonalIsAHexagon
//   C2  pair_judge ("area"), and here                C3-C5  here
//   R, V, M  geometry/catalogue_test
#include <gtest/gtest.h>

#include <numbers>

#include "core/testing/contacts.hpp"
#include "core/testing/exact_contacts.hpp"
#include "text/angle.hpp"

namespace voussoir::catalogue_test {
namespace {

using exact::Quad;
using exact::Rational;
using exact::to_double;
using shapes::integer;
using shapes::power_of_ten;
using shapes::Random;
using shapes::uniform;

constexpr double ulp = std::numeric_limits<double>::epsilon();

// ---- L3, L6: the program --------------------------------------------------------------------------------------------

// planes that touch an ellipsoid of half axes 1, 1 and `thin`
HalfSpaces<3> tangent_planes(Random& random, int count, double thin) {
  HalfSpaces<3> planes;
  for (int i = 0; i < count; ++i) {
    const Vector<3> n = shapes::direction<3>(random);
    planes.push_back({n, Vector<3>(n[0], n[1], thin * n[2]).norm()});
  }
  return planes;
}

void expect_program_of_many_planes(int count) {
  Random random(501);
  for (const double thin : {1.0, 1e-3}) {
    const HalfSpaces<3> planes = tangent_planes(random, count, thin);
    const FeasibilityResult<3> r = solve_feasibility<3>(planes, {});
    ASSERT_EQ(r.status, FeasibilityStatus::optimal);
    const exact::ProgramBounds bounds = exact::feasibility_bounds(exact::planes_of(planes), r.basis);
    ASSERT_TRUE(bounds.proven);
    // extents are 1: 64 ulp of them
    EXPECT_LE(Rational(bounds.high - bounds.low).get_d(), 64 * ulp);
    EXPECT_NEAR(r.value, bounds.low.get_d(), 64 * ulp);
    EXPECT_LE(r.pivots, 10 * (count + 4));
  }
}

TEST(Program, OfAThousandPlanesIsProvenByItsBasis) {
  expect_program_of_many_planes(1000);
}
TEST(ProgramLong, OfFourThousandPlanesIsProvenByItsBasis) {
  expect_program_of_many_planes(4000);
}

// rows of whole numbers, orthogonal and of equal whole length: a turn times that length
struct WholeTurn {
  std::array<std::array<int, 3>, 3> rows;
  int length;
};
constexpr std::array whole_turns{
    WholeTurn{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 1}, WholeTurn{{{{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}}, 7},
    WholeTurn{{{{1, 4, 8}, {4, 7, -4}, {8, -4, 1}}}, 9}, WholeTurn{{{{4, 4, 7}, {1, -8, 4}, {8, -1, -4}}}, 9}};

// Eq. 3.27
TEST(Program, OfCubesThatTouchExactlyIsZero) {
  // a cube of half edge 40 and a turned one; all numbers whole, all normals equally long, so that nothing is rounded
  Random random(502);
  constexpr int half = 40;
  int touching_exactly = 0, apart = 0, overlapping = 0;
  for (int i = 0; i < 1500; ++i) {
    const WholeTurn& turn = whole_turns[integer(random, 0, 3)];
    const int own_half = integer(random, 1, 3);
    // a corner, a point of an edge or of a face of each, with whole coordinates in both frames
    Vector<3> on_a, on_b = Vector<3>::Zero(), row;
    const auto place = [&](int most) { return integer(random, 0, 1) ? most * (2 * integer(random, 0, 1) - 1) : 0; };
    for (int k = 0; k < 3; ++k)
      on_a[k] = k == 0 ? half : place(half);
    for (int k = 0; k < 3; ++k) {
      row << turn.rows[k][0], turn.rows[k][1], turn.rows[k][2];
      on_b += (k == 0 ? own_half * (2 * integer(random, 0, 1) - 1) : place(own_half)) * row;
    }
    const Vector<3> centre = on_a - on_b;
    HalfSpaces<3> planes = shapes::scaled<3>(shapes::cube<3>(half), turn.length);
    for (HalfSpace<3>& p : planes)
      p.normal *= turn.length;
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0}) {
        row << turn.rows[k][0], turn.rows[k][1], turn.rows[k][2];
        // the turned cube's half edge is own_half times the length: its corners are whole
        planes.push_back({side * row, side * row.dot(centre) + own_half * turn.length * turn.length});
      }
    const FeasibilityResult<3> r = solve_feasibility<3>(planes, {});
    ASSERT_EQ(r.status, FeasibilityStatus::optimal);
    const Rational value = exact::feasibility(exact::planes_of(planes)).value;
    const double size = turn.length * (half + own_half * turn.length) * std::sqrt(3.0);
    EXPECT_LE(std::abs(Rational(Rational(r.value) - value).get_d()), 64 * ulp * size) << "instance " << i;
    touching_exactly += sgn(value) == 0;
    apart += sgn(value) > 0;
    overlapping += sgn(value) < 0;
  }
  EXPECT_GT(touching_exactly, 300);
  EXPECT_GT(overlapping, 100);
  EXPECT_EQ(apart, 0);  // a point of each lies on a point of the other
}

// ---- N: the normal --------------------------------------------------------------------------------------------------

TEST(Normal, DeeperThanTheRadiusItIsOfTheNearestFaceAndReported) {
  HalfSpaces<3> planes = shapes::box<3>({-2, -2, -2}, {2, 2, 2});
  for (const HalfSpace<3>& p : shapes::box<3>({-1, -1, 1}, {1, 1, 5}))
    planes.push_back(p);
  Vector<3> normal;
  bool fallback = false;
  // 0.3 below A's top and 0.7 above B's bottom
  const Vector<3> point(0.1, 0.2, 1.7);
  for (const double radius : {1e-6, 1e-3, 0.1, 0.25}) {
    fallback = false;
    ASSERT_TRUE(contact_normal<3>(planes, 6, point, radius, normal, fallback));
    EXPECT_TRUE(fallback);
    EXPECT_EQ(normal, Vector<3>::UnitZ());
  }
  fallback = false;
  ASSERT_TRUE(contact_normal<3>(planes, 6, point, 0.75, normal, fallback));
  EXPECT_FALSE(fallback);
  EXPECT_EQ(normal, Vector<3>::UnitZ());
  // both parts' nearest faces have the same normal: no direction, and reported
  HalfSpaces<3> twice = shapes::cube<3>(1);
  for (const HalfSpace<3>& p : shapes::cube<3>(1))
    twice.push_back(p);
  EXPECT_FALSE(contact_normal<3>(twice, 6, {0, 0, 0.9}, 0.2, normal, fallback));
}

// Eqs 3.31-3.35
TEST(Normal, LeansTowardsAnEdgeByTheRadius) {
  // a point at depth d under a face and e beside an edge: gradient (r - d) ez + (r - e) ex, against -ez of the other
  HalfSpaces<3> planes = shapes::cube<3>(1);
  for (const HalfSpace<3>& p : shapes::box<3>({-9, -9, 0.99}, {9, 9, 9}))
    planes.push_back(p);
  const double d = 0.005, e = 0.03;
  for (double radius = 1e-2; radius <= 1; radius *= 1.5) {
    Vector<3> normal;
    bool fallback = false;
    ASSERT_TRUE(contact_normal<3>(planes, 6, {1 - e, 0, 1 - d}, radius, normal, fallback));
    EXPECT_FALSE(fallback);
    const Vector<3> of_a = Vector<3>(std::max(0.0, radius - e), 0, radius - d).normalized();
    const Vector<3> expected = (of_a + Vector<3>::UnitZ()).normalized();
    EXPECT_LT((normal - expected).norm(), 64 * ulp / radius);
  }
}

TEST(Normal, OfSymmetricContactsIsExact) {
  // N4: only rounding may break the symmetry
  const ContactSettings reference{.newton_tolerance = 1e-9};
  const Polytope<3> cube = contacts::unit_cube<3>();
  const Matrix<3> on_edge = Eigen::AngleAxisd(std::numbers::pi / 4, Vector<3>::UnitX()).toRotationMatrix();
  const Vector<3> up = on_edge.transpose() * Vector<3>::UnitZ();
  const Matrix<3> quarter = Eigen::AngleAxisd(std::numbers::pi / 2, Vector<3>::UnitZ()).toRotationMatrix();
  for (const double depth : {1e-3, 1e-5, 1e-9}) {
    const ContactGeometry<3> corner =
        contacts::touch<3>(cube, cube, Matrix<3>::Identity(), Vector<3>::Constant(1 - depth), reference)
            .contact.geometry;
    EXPECT_LT((corner.normal - Vector<3>::Constant(1 / std::numbers::sqrt3)).norm(), 1e-14) << depth;
    const ContactGeometry<3> edges = contacts::touch<3>(cube, cube, on_edge.transpose() * quarter * on_edge,
                                                        (std::numbers::sqrt2 - depth) * up, reference)
                                         .contact.geometry;
    EXPECT_LT((edges.normal - up).norm(), 1e-14) << depth;
  }
}

// ---- O: the search along the normal ---------------------------------------------------------------------------------

// Eq. 3.36
TEST(OverlapAlong, MeetsPlanesNearlyParallelToItExactly) {
  // A ends in a plane that the normal meets at 10^-k, so near that it comes first
  for (int k = 1; k <= 16; ++k)
    for (const double toward : {1.0, -1.0}) {
      const double slope = toward * std::pow(10.0, -k);
      HalfSpaces<3> planes = shapes::cube<3>(1);
      planes.push_back({{std::sqrt(1 - slope * slope), 0, slope}, 0.3 * std::abs(slope)});
      const int faces_a = static_cast<int>(planes.size());
      for (const HalfSpace<3>& p : shapes::box<3>({-2, -2, -0.5}, {2, 2, 3}))
        planes.push_back(p);
      double overlap = 0;
      int face_a = -1, face_b = -1;
      const Vector<3> point(0, 0, 0), n = Vector<3>::UnitZ();
      ASSERT_TRUE(overlap_along<3>(planes, faces_a, point, n, overlap, face_a, face_b));
      const std::vector<std::optional<Quad>> ends =
          exact::distances_along(exact::planes_of(planes), faces_a, 6, exact::point_of(point), exact::point_of(n));
      const Quad expected = exact::nearest(ends, 0, faces_a) + exact::nearest(ends, faces_a, 6);
      EXPECT_NEAR(overlap, to_double(expected), 1e-13 * overlap);
      EXPECT_EQ(face_a, toward > 0 ? faces_a - 1 : 4);
    }
}

TEST(OverlapAlong, EndsOnceIfTwoFacesMeet) {
  // the ridge of a roof: both sides end the search at the same place
  const Vector<3> left = Vector<3>(-1, 0, 1).normalized(), right = Vector<3>(1, 0, 1).normalized();
  HalfSpaces<3> planes = shapes::cube<3>(2);
  planes.push_back({left, left[2]});
  planes.push_back({right, right[2]});
  for (const HalfSpace<3>& p : shapes::box<3>({-2, -2, 0}, {2, 2, 3}))
    planes.push_back(p);
  double overlap = 0;
  int face_a = -1, face_b = -1;
  // also from a point on the other part's face, within rounding of it
  for (const double height : {0.5, 0.0, 1e-300, ulp}) {
    ASSERT_TRUE(overlap_along<3>(planes, 8, {0, 0.3, height}, Vector<3>::UnitZ(), overlap, face_a, face_b));
    EXPECT_NEAR(overlap, 1, 4 * ulp);
    EXPECT_TRUE(face_a == 6 || face_a == 7);
    EXPECT_EQ(planes[face_b].normal, Vector<3>(-Vector<3>::UnitZ()));
  }
}

// ---- C: the section -------------------------------------------------------------------------------------------------

// within 1e-12 and the first-order effect of 64 ulp of the reach on each plane
void expect_exact_section(const HalfSpaces<3>& planes, const Vector<3>& point, const Vector<3>& normal, double reach) {
  const exact::Section section =
      exact::section(exact::planes_of(planes), exact::point_of(point), exact::point_of(normal));
  const double area = to_double(section.area);
  EXPECT_NEAR(section_area<3>(planes, point, normal, 2 * reach), area,
              1e-12 * area + 64 * ulp * reach * to_double(section.sensitivity));
}

// in place of Eqs D.1 and D.2
TEST(SectionArea, IsExactAtAnyPlaceOfThePlane) {
  Random random(503);
  for (int i = 0; i < 150; ++i) {
    HalfSpaces<3> planes = shapes::random_planes<3>(random, integer(random, 0, 20), 1);
    // C3: planes of A and B coincide, or nearly
    const int first = integer(random, 0, static_cast<int>(planes.size()) - 1);
    planes.push_back(planes[first]);
    planes.push_back({planes[first].normal, planes[first].offset * (1 + (i % 3 - 1) * ulp)});
    const double squeeze = i % 2 ? power_of_ten(random, -6, 0) : 1;
    if (i % 2)
      for (const double side : {-1.0, 1.0})
        planes.push_back({side * Vector<3>::UnitX(), squeeze});
    expect_exact_section(planes, squeeze * 0.3 * shapes::direction<3>(random), shapes::direction<3>(random), 3);
  }
}

TEST(SectionArea, OfManyPlanes) {
  Random random(504);
  const HalfSpaces<3> planes = tangent_planes(random, 1000, 1e-2);
  for (int i = 0; i < 3; ++i)
    expect_exact_section(planes, {0.1, 0.1, 0.001}, shapes::direction<3>(random), 3);
}

TEST(SectionArea, OfATouchingPlaneIsNothing) {
  const HalfSpaces<3> cube = shapes::cube<3>(1);
  EXPECT_LE(section_area<3>(cube, {1, 0, 1}, Vector<3>(1, 0, 1).normalized(), 8), 64 * ulp);
  EXPECT_LE(section_area<3>(cube, {1, 1, 1}, Vector<3>::Ones().normalized(), 8), 64 * ulp);
  EXPECT_EQ(section_area<3>(cube, {0, 0, 1.5}, Vector<3>::UnitZ(), 8), 0);
  EXPECT_EQ(section_area<3>(cube, {3, 3, 3}, Vector<3>::Ones().normalized(), 8), 0);
}

TEST(SectionArea, TurnsWithTheNormalNearACorner) {
  // C5: a plane through a point near a corner, turned from one face to the next
  const HalfSpaces<3> cube = shapes::cube<3>(1);
  for (const double near : {0.3, 1e-3, 1e-9})
    for (int degrees = 0; degrees <= 90; ++degrees) {
      const double angle = degrees * degree;
      const Vector<3> n = Vector<3>(std::sin(angle), 0.3, std::cos(angle)).normalized();
      expect_exact_section(cube, Vector<3>::Constant(1 - near), n, 2 * std::numbers::sqrt3);
    }
}

}  // namespace
}  // namespace voussoir::catalogue_test
