// The contact kernel: decision, point, normal, overlap and area against separating axes, closed forms and long double.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "core/contact/contact_between.hpp"
#include "core/testing/contacts.hpp"

namespace voussoir::contact_test {
namespace {

using namespace contacts;
using shapes::Random;

// ---- the decision ---------------------------------------------------------------------------------------------------

template <int Dim>
void expect_decision_by_separating_axes(std::uint64_t seed, int pairs) {
  Random random(seed);
  int touching = 0, close = 0;
  for (int i = 0; i < pairs; ++i) {
    const Polytope<Dim> a =
        shapes::centred_block<Dim>(shapes::random_planes<Dim>(random, shapes::integer(random, 0, 8), 1));
    const Polytope<Dim> b =
        shapes::centred_block<Dim>(shapes::random_planes<Dim>(random, shapes::integer(random, 0, 8), 1));
    const Matrix<Dim> turn = matrix(shapes::orientation<Dim>(random));
    // pushed together along a direction until they nearly touch, then a step of 1e-9 to 1 forwards or backwards
    const Vector<Dim> along = shapes::direction<Dim>(random);
    const double outside = distance_of_touching<Dim>(a, b, turn, along);
    const double step = shapes::power_of_ten(random, -9, 0) * (i % 2 ? 1 : -1);
    const Vector<Dim> offset = (outside + step) * along;
    const double gap = static_cast<double>(oracle::separation<Dim>(a, b, turn, offset));
    if (std::abs(gap) < undecided) continue;
    const ContactStatus status = touch<Dim>(a, b, turn, offset).contact.status;
    EXPECT_EQ(status, gap < 0 ? ContactStatus::touching : ContactStatus::separated) << "gap " << gap;
    // the other body as the first one
    EXPECT_EQ(touch<Dim>(b, a, turn.transpose(), -turn.transpose() * offset).contact.status, status);
    touching += gap < 0;
    close += std::abs(gap) < 1e-6;
  }
  EXPECT_GT(touching, pairs / 4);
  EXPECT_GT(close, pairs / 10);
}

// Eq. 3.27
TEST(Decision, AgreesWithSeparatingAxes3D) {
  expect_decision_by_separating_axes<3>(61, 80);
}
TEST(Decision, AgreesWithSeparatingAxes2D) {
  expect_decision_by_separating_axes<2>(62, 500);
}

TEST(Decision, TouchingExactlyIsNoContact) {
  const Polytope<3> cube = unit_cube<3>();
  const Polytope<2> square = unit_cube<2>();
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) {
          EXPECT_EQ(touch<3>(cube, cube, Vector<3>(x, y, z)).contact.status, ContactStatus::undecided);
        }
      if (x != 0 || y != 0) {
        EXPECT_EQ(touch<2>(square, square, Vector<2>(x, y)).contact.status, ContactStatus::undecided);
      }
    }
  // and the smallest overlap that counts is a contact
  EXPECT_EQ(touch<3>(cube, cube, Vector<3>(0, 0, 1 - 1e-12)).contact.status, ContactStatus::touching);
  EXPECT_EQ(touch<3>(cube, cube, Vector<3>(0, 0, 1 + 1e-12)).contact.status, ContactStatus::separated);
}

// ---- closed forms ---------------------------------------------------------------------------------------------------

TEST(ClosedForm, CubeOnCube) {
  const Polytope<3> cube = unit_cube<3>();
  for (const double overlap : {1e-2, 1e-4, 1e-6, 1e-9, 1e-11}) {
    const Vector<3> offset(0.25, -0.5, 1 - overlap);
    const Outcome<3> r = touch<3>(cube, cube, offset);
    ASSERT_EQ(r.contact.status, ContactStatus::touching);
    const ContactGeometry<3>& g = r.contact.geometry;
    EXPECT_NEAR(g.overlap, overlap, 1e-15);
    EXPECT_LT((g.normal - Vector<3>::UnitZ()).norm(), exact);
    EXPECT_NEAR(g.area, 0.75 * 0.5, area_tolerance);
    EXPECT_LT((g.point - Vector<3>(0.125, -0.25, 0.5 - overlap / 2)).norm(), point_tolerance);
    EXPECT_NEAR(g.point[2], 0.5 - overlap / 2, point_tolerance * overlap + 1e-15);
    EXPECT_EQ(cube.faces[g.face_a].normal, Vector<3>::UnitZ());
    EXPECT_EQ(cube.faces[g.face_b].normal, Vector<3>(-Vector<3>::UnitZ()));
  }
}

TEST(ClosedForm, SquareOnSquare) {
  const Polytope<2> square = unit_cube<2>();
  for (const double overlap : {1e-2, 1e-4, 1e-6, 1e-9, 1e-11}) {
    const ContactGeometry<2> g = touch<2>(square, square, Vector<2>(0.25, 1 - overlap)).contact.geometry;
    EXPECT_NEAR(g.overlap, overlap, 1e-15);
    EXPECT_LT((g.normal - Vector<2>::UnitY()).norm(), exact);
    EXPECT_NEAR(g.area, 0.75, area_tolerance);
    EXPECT_LT((g.point - Vector<2>(0.125, 0.5 - overlap / 2)).norm(), point_tolerance);
  }
}

TEST(ClosedForm, VertexOnVertexAlongTheDiagonal) {
  const Polytope<3> cube = unit_cube<3>();
  const Polytope<2> square = unit_cube<2>();
  for (const double h : {1e-2, 1e-5, 1e-9}) {
    const ContactGeometry<3> g = touch<3>(cube, cube, Vector<3>::Constant(1 - h)).contact.geometry;
    EXPECT_LT((g.normal - Vector<3>::Constant(1 / std::sqrt(3.0))).norm(), point_tolerance);
    EXPECT_LT((g.point - Vector<3>::Constant(0.5 - h / 2)).norm(), point_tolerance * h + 1e-15);
    EXPECT_NEAR(g.overlap, std::sqrt(3.0) * h, point_tolerance * h);
    // the overlap is a cube of side h, cut across its diagonal: a hexagon
    EXPECT_NEAR(g.area, 3 * std::sqrt(3.0) / 4 * h * h, point_tolerance * h * h);
    const ContactGeometry<2> flat = touch<2>(square, square, Vector<2>::Constant(1 - h)).contact.geometry;
    EXPECT_LT((flat.normal - Vector<2>::Constant(1 / std::numbers::sqrt2)).norm(), point_tolerance);
    EXPECT_NEAR(flat.overlap, std::numbers::sqrt2 * h, point_tolerance * h);
    EXPECT_NEAR(flat.area, std::numbers::sqrt2 * h, point_tolerance * h);
  }
}

TEST(ClosedForm, CrossedEdgesMeetAlongTheirCommonPerpendicular) {
  // both cubes stand on an edge: the lower one's along x, the upper one's turned by an angle about z
  const Polytope<3> cube = unit_cube<3>();
  const double half_diagonal = std::sqrt(0.5);
  const Matrix<3> on_edge = Eigen::AngleAxisd(std::numbers::pi / 4, Vector<3>::UnitX()).toRotationMatrix();
  Random random(63);
  for (const double overlap : {1e-2, 1e-5, 1e-9})
    for (int i = 0; i < 10; ++i) {
      const double angle = i == 0 ? std::numbers::pi / 2 : shapes::uniform(random, 0.02, std::numbers::pi - 0.02);
      const Matrix<3> about_z = Eigen::AngleAxisd(angle, Vector<3>::UnitZ()).toRotationMatrix();
      // in the frame of the first body the world is turned back
      const Matrix<3> turn = on_edge.transpose() * about_z * on_edge;
      const Vector<3> up = on_edge.transpose() * Vector<3>::UnitZ();
      const ContactGeometry<3> g = touch<3>(cube, cube, turn, (2 * half_diagonal - overlap) * up).contact.geometry;
      EXPECT_LT((g.normal - up).norm(), point_tolerance);
      EXPECT_NEAR(g.overlap, overlap, point_tolerance * overlap + 1e-15);
      EXPECT_LT((g.point - (half_diagonal - overlap / 2) * up).norm(),
                point_tolerance * overlap / std::sin(angle) + 1e-14);
      // the section halfway is a rhombus of height `overlap`, since the edges' flanks slope by 45 degrees
      EXPECT_NEAR(g.area, overlap * overlap / std::sin(angle),
                  area_tolerance * overlap * overlap / std::sin(angle) + 1e-24);
    }
}

TEST(ClosedForm, AVertexOnAFace) {
  // an octahedron's corner pushed into a cube's top: a square pyramid, upside down
  const Polytope<3> cube = shapes::block<3>(shapes::cube<3>(3));
  const Polytope<3> octahedron = shapes::block<3>(shapes::platonic_solids(1)[2].planes);
  for (const double depth : {1e-2, 1e-6}) {
    const ContactGeometry<3> g =
        touch<3>(cube, octahedron, Vector<3>(0, 0, 3 + std::sqrt(3.0) - depth)).contact.geometry;
    EXPECT_LT((g.normal - Vector<3>::UnitZ()).norm(), point_tolerance);
    EXPECT_NEAR(g.overlap, depth, point_tolerance * depth);
    EXPECT_LT(g.point.head<2>().norm(), point_tolerance);
    // four flanks against one lid and five far planes: slack s of the lid by 1/s = 4/(depth - s), s = depth/5
    EXPECT_NEAR(g.point[2], 3 - depth / 5, 2 * depth * depth + point_tolerance * depth);
    EXPECT_NEAR(g.area, 2 * std::pow(3 - g.point[2] - depth, 2), area_tolerance * depth * depth + 1e-15);
  }
}

TEST(SectionArea, OfACubeAcrossItsDiagonalIsAHexagon) {
  for (const double edge : {1e-3, 1.0, 1e4}) {
    const HalfSpaces<3> planes = shapes::cube<3>(edge / 2);
    EXPECT_NEAR(section_area<3>(planes, {0, 0, 0}, Vector<3>::Ones().normalized(), 10 * edge),
                3 * std::sqrt(3.0) / 4 * edge * edge, exact * edge * edge);
    EXPECT_NEAR(section_area<3>(planes, {0, 0, 0}, Vector<3>(1, 1, 0).normalized(), 10 * edge),
                std::numbers::sqrt2 * edge * edge, exact * edge * edge);
    EXPECT_NEAR(section_area<2>(shapes::cube<2>(edge / 2), {0, 0}, Vector<2>::Ones().normalized(), 10 * edge),
                std::numbers::sqrt2 * edge, exact * edge);
  }
}

template <int Dim>
void expect_sections(std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 100; ++i) {
    const HalfSpaces<Dim> planes = shapes::random_planes<Dim>(random, 8, 1);
    const Vector<Dim> point = 0.4 * shapes::direction<Dim>(random), n = shapes::direction<Dim>(random);
    const double expected = static_cast<double>(
        oracle::section<Dim>(planes, point.template cast<oracle::Real>(), n.template cast<oracle::Real>()));
    EXPECT_NEAR(section_area<Dim>(planes, point, n, 10), expected, exact);
  }
}

// in place of Eqs D.1 and D.2
TEST(SectionArea, AgreesWithLasserresRecursion) {
  expect_sections<3>(64);
  expect_sections<2>(65);
}

// Eq. 3.36
TEST(OverlapAlong, FindsTheEndsAndReportsWhenThereAreNone) {
  HalfSpaces<3> planes = shapes::cube<3>(1);
  for (const HalfSpace<3>& p : shapes::box<3>({-1, -1, 0.5}, {1, 1, 3}))
    planes.push_back(p);
  double overlap = 0;
  int face_a = -1, face_b = -1;
  ASSERT_TRUE(overlap_along<3>(planes, 6, {0, 0, 0.6}, Vector<3>::UnitZ(), overlap, face_a, face_b));
  EXPECT_NEAR(overlap, 0.5, exact);
  EXPECT_EQ(planes[face_a].normal, Vector<3>::UnitZ());
  EXPECT_GE(face_b, 6);
  // along a tilted normal the ends are farther apart
  const double c = std::cos(0.1), s = std::sin(0.1);
  ASSERT_TRUE(overlap_along<3>(planes, 6, {0, 0, 0.6}, {s, 0, c}, overlap, face_a, face_b));
  EXPECT_NEAR(overlap, 0.5 / c, exact);
  planes.erase(planes.begin() + 4);  // the first part's lid
  EXPECT_FALSE(overlap_along<3>(planes, 5, {0, 0, 0.6}, Vector<3>::UnitZ(), overlap, face_a, face_b));
}

// Eqs 3.31-3.35
TEST(ContactNormal, TurnsGraduallyAsAPointRoundsAnEdge) {
  // a small cube travels over the edge of a large one; no step may turn the normal by more than a few slopes of the
  // potential
  const Polytope<2> large = shapes::block<2>(shapes::cube<2>(1));
  const Polytope<2> small = shapes::block<2>(shapes::placed<2>(shapes::cube<2>(0.1), matrix(Rotation<2>{0.7}), {0, 0}));
  Vector<2> last = Vector<2>::Zero();
  double largest = 0;
  const int steps = 4000;
  for (int i = 0; i <= steps; ++i) {
    const double angle = std::numbers::pi / 2 * i / steps;
    // on a circle around the corner, deep enough to touch throughout
    const Vector<2> offset =
        Vector<2>(1, 1) - Vector<2>(0.02, 0.02) + 0.1 * Vector<2>(std::cos(angle), std::sin(angle));
    const Outcome<2> r = touch<2>(large, small, Matrix<2>::Identity(), offset, {.potential_radius = 2});
    ASSERT_EQ(r.contact.status, ContactStatus::touching);
    if (i > 0) largest = std::max(largest, (r.contact.geometry.normal - last).norm());
    last = r.contact.geometry.normal;
  }
  EXPECT_LT(largest, 0.02);
  EXPECT_GT(largest, 0);
}

// ---- symmetry -------------------------------------------------------------------------------------------------------

template <int Dim>
void expect_symmetry(std::uint64_t seed, int pairs) {
  Random random(seed);
  int compared = 0;
  for (int i = 0; i < pairs; ++i) {
    const Polytope<Dim> a = shapes::centred_block<Dim>(shapes::random_planes<Dim>(random, 5, 1));
    const Polytope<Dim> b = shapes::centred_block<Dim>(shapes::random_planes<Dim>(random, 5, 0.5));
    const Matrix<Dim> turn = matrix(shapes::orientation<Dim>(random));
    const Vector<Dim> along = shapes::direction<Dim>(random);
    const double outside = distance_of_touching<Dim>(a, b, turn, along);
    const double depth = shapes::power_of_ten(random, -9, -2);
    const Vector<Dim> offset = (outside - depth) * along;
    const Outcome<Dim> ab = touch<Dim>(a, b, turn, offset);
    ASSERT_EQ(ab.contact.status, ContactStatus::touching);
    const ContactGeometry<Dim>& g = ab.contact.geometry;
    expect_sound<Dim>(a, b, turn, offset, g);

    // seen from the other body: same place, opposite normal
    const ContactGeometry<Dim> h = touch<Dim>(b, a, turn.transpose(), -turn.transpose() * offset).contact.geometry;
    const double blur = 1e-14 / depth + point_tolerance;  // rounding of the other frame, seen from an overlap this thin
    EXPECT_LT((turn * h.normal + g.normal).norm(), blur);
    EXPECT_NEAR(h.overlap, g.overlap, blur * g.overlap);
    EXPECT_LT((turn * h.point + offset - g.point).norm(), blur);
    EXPECT_NEAR(h.area, g.area, 10 * blur * (g.area + depth));
    EXPECT_EQ(h.face_a, g.face_b);
    EXPECT_EQ(h.face_b, g.face_a);

    // powers of two change the unit, and no bit of anything else
    for (const double factor : {0x1p-10, 0x1p13}) {
      const ContactGeometry<Dim> s =
          touch<Dim>(shapes::scaled_block<Dim>(a, factor), shapes::scaled_block<Dim>(b, factor), turn, factor * offset)
              .contact.geometry;
      EXPECT_EQ(s.normal, g.normal);
      EXPECT_EQ(s.point, factor * g.point);
      EXPECT_EQ(s.overlap, factor * g.overlap);
      EXPECT_EQ(s.area, std::pow(factor, Dim - 1) * g.area);
    }
    ++compared;
  }
  EXPECT_EQ(compared, pairs);
}

TEST(Symmetry, SwappingThePartsReversesTheNormal3D) {
  expect_symmetry<3>(66, 40);
}
TEST(Symmetry, SwappingThePartsReversesTheNormal2D) {
  expect_symmetry<2>(67, 200);
}

// ---- parts anywhere -------------------------------------------------------------------------------------------------

// planes and points from one frame to another: Eqs 3.22-3.26
TEST(ContactBetween, CubesFarFromTheOrigin) {
  const Polytope<3> cube = unit_cube<3>();
  // a quarter turn about x: up becomes -y
  Matrix<3> quarter;
  quarter << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  // multiples of 2^-10 stay exact so far out
  const double overlap = 1.0 / 1024;
  const Pose<3> low{{3e5, -4e5, 1e5}, Matrix<3>::Identity()};
  const Pose<3> high{low.position + Vector<3>(0.25, -0.5, 1 - overlap), quarter};
  const ContactBetween<3> r = contact_between<3>(cube, low, cube, high);
  ASSERT_EQ(r.status, ContactStatus::touching);
  EXPECT_NEAR(r.geometry.overlap, overlap, 1e-15);
  EXPECT_NEAR(r.geometry.area, 0.75 * 0.5, area_tolerance);
  EXPECT_LT((r.geometry.normal - Vector<3>::UnitZ()).norm(), exact);
  EXPECT_EQ(cube.faces[r.geometry.face_a].normal, Vector<3>::UnitZ());
  EXPECT_LT((quarter * cube.faces[r.geometry.face_b].normal + Vector<3>::UnitZ()).norm(), exact);
  ASSERT_TRUE(r.origin == low.position || r.origin == high.position);
  const Vector<3> from_low = (r.origin - low.position) + r.geometry.point;
  EXPECT_LT((from_low - Vector<3>(0.125, -0.25, 0.5 - overlap / 2)).norm(), point_tolerance);

  EXPECT_LT((contact_between<3>(cube, high, cube, low).geometry.normal + Vector<3>::UnitZ()).norm(), exact);
  EXPECT_EQ(contact_between<3>(cube, low, cube, {low.position + Vector<3>(0, 0, 1.5)}).status,
            ContactStatus::separated);
  EXPECT_EQ(contact_between<3>(cube, low, cube, high, QueryLevel::overlap).geometry.area, 0);
}

TEST(ContactBetween, RefusesInvalidPlacements) {
  const Polytope<2> square = unit_cube<2>();
  const Pose<2> here;
  Pose<2> nowhere, stretched, skewed;
  nowhere.position[1] = std::numeric_limits<double>::infinity();
  stretched.axes(0, 0) = 1 + 1e-9;
  skewed.axes(0, 1) = 1e-9;
  for (const Pose<2>& bad : {nowhere, stretched, skewed}) {
    EXPECT_THROW(contact_between<2>(square, here, square, bad), std::invalid_argument);
    EXPECT_THROW(contact_between<2>(square, bad, square, here), std::invalid_argument);
  }
  EXPECT_THROW(contact_between<2>(square, here, Polytope<2>{}, here), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::contact_test
