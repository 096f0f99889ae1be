// The exchangeable parts of the kernel: centroid of the overlap, overlap by bracketing, a solver of the centre that
// fails.
#include "core/contact/overlap_region.hpp"

#include <gtest/gtest.h>

#include "core/contact/bracketing.hpp"
#include "core/testing/contacts.hpp"

namespace voussoir::overlap_region_test {
namespace {

using namespace contacts;
using shapes::Random;

// ---- the region: closed forms ---------------------------------------------------------------------------------------

// centroid to 1e-12 of the extents, volume to 1e-12 of itself
template <int Dim>
void expect_region(const HalfSpaces<Dim>& planes, const Vector<Dim>& inside, const Vector<Dim>& centroid,
                   const Vector<Dim>& extents, double volume) {
  OverlapRegion<Dim> region;
  ASSERT_TRUE(overlap_region<Dim>(planes, inside, region));
  for (int k = 0; k < Dim; ++k)
    EXPECT_NEAR(region.centroid[k], centroid[k], exact * extents[k]) << "axis " << k;
  EXPECT_NEAR(region.volume, volume, exact * volume);
}

TEST(OverlapRegion, OfBoxesIsABoxOfAnyThickness) {
  for (const double thin : {1.0, 1e-3, 1e-10, 1e-14})
    for (const double narrow : {1.0, 1e-6}) {
      HalfSpaces<3> planes = shapes::box<3>({-3, -3 * narrow, -2}, {1, 1 * narrow, thin});
      for (const HalfSpace<3>& p : shapes::box<3>({-1, -2 * narrow, 0}, {4, 4 * narrow, 5}))
        planes.push_back(p);
      expect_region<3>(planes, {0.9, -1.9 * narrow, 0.01 * thin}, {0, -0.5 * narrow, 0.5 * thin}, {2, 3 * narrow, thin},
                       6 * narrow * thin);
    }
  for (const double thin : {1.0, 1e-10, 1e-14}) {
    HalfSpaces<2> planes = shapes::box<2>({-3, -1}, {1, thin});
    for (const HalfSpace<2>& p : shapes::box<2>({-1, 0}, {2, 7}))
      planes.push_back(p);
    expect_region<2>(planes, {0.99, 0.9 * thin}, {0, 0.5 * thin}, {2, thin}, 2 * thin);
  }
}

TEST(OverlapRegion, OfACornerInAFaceIsAPyramid) {
  for (const int sides : {3, 4, 7})
    for (const double height : {1.0, 1e-5, 1e-10, 1e8}) {
      const double base = sides * std::tan(std::numbers::pi / sides);
      expect_region<3>(shapes::pyramid(sides, 1, height), {0.1, -0.1, 0.8 * height}, {0, 0, height / 4}, {1, 1, height},
                       base * height / 3);
      // a needle
      expect_region<3>(shapes::pyramid(sides, height, 1), {0, 0, 1e-3}, {0, 0, 0.25}, {height, height, 1},
                       base * height * height / 3);
    }
  // in the plane a triangle: base 2, apex above the middle
  for (const double height : {1.0, 1e-10}) {
    const Vector<2> right = Vector<2>(height, 1).normalized(), left(-right[0], right[1]);
    expect_region<2>({{{0, -1}, 0}, {right, right[0]}, {left, right[0]}}, {0.5, 0.1 * height}, {0, height / 3},
                     {2, height}, height);
  }
}

TEST(OverlapRegion, IsRefusedWithoutAnInteriorPointOrWhenOpen) {
  OverlapRegion<3> region;
  EXPECT_FALSE(overlap_region<3>(shapes::cube<3>(1), {0, 0, 1}, region));
  HalfSpaces<3> open = shapes::cube<3>(1);
  open.pop_back();
  EXPECT_FALSE(overlap_region<3>(open, {0, 0, 0}, region));
}

// ---- the region: long double ----------------------------------------------------------------------------------------

// heights of all vertices along u: every choice of Dim planes whose common point lies in the region
template <int Dim>
std::vector<oracle::Real> heights(const HalfSpaces<Dim>& planes, const Vector<Dim>& u, oracle::Real rounding) {
  std::vector<oracle::Real> list;
  oracle::for_each_choice(static_cast<int>(planes.size()), Dim, [&](const std::vector<int>& choice) {
    oracle::RealMatrix<Dim> rows;
    oracle::RealVector<Dim> offsets;
    for (int k = 0; k < Dim; ++k) {
      rows.row(k) = planes[choice[k]].normal.template cast<oracle::Real>().transpose();
      offsets[k] = planes[choice[k]].offset;
    }
    const Eigen::FullPivLU<oracle::RealMatrix<Dim>> lu(rows);
    if (!lu.isInvertible()) return;
    const oracle::RealVector<Dim> vertex = lu.solve(offsets);
    for (const HalfSpace<Dim>& p : planes)
      if (p.normal.template cast<oracle::Real>().dot(vertex) - p.offset > rounding) return;
    list.push_back(u.template cast<oracle::Real>().dot(vertex));
  });
  return list;
}

// random solids squeezed by `thin` in a random direction
template <int Dim>
void expect_regions(std::uint64_t seed, int count, double thin) {
  Random random(seed);
  // the region's extent is about 1: the rounding of a double's plane, seen from the thickness
  const double allowed = exact + 4 * std::numeric_limits<double>::epsilon() / thin;
  for (int i = 0; i < count; ++i) {
    const Matrix<Dim> turn = matrix(shapes::orientation<Dim>(random));
    Matrix<Dim> squeeze = Matrix<Dim>::Identity();
    squeeze(0, 0) = thin;
    HalfSpaces<Dim> planes = shapes::random_planes<Dim>(random, 6, 1);
    for (HalfSpace<Dim>& p : planes) {
      p.normal = turn * (squeeze.inverse() * p.normal);
      const double length = p.normal.norm();
      p.normal /= length;
      p.offset /= length;
    }
    OverlapRegion<Dim> region;
    const Vector<Dim> inside = turn * squeeze * (0.5 * shapes::direction<Dim>(random));
    ASSERT_TRUE(overlap_region<Dim>(planes, inside, region));
    const oracle::Real volume = oracle::volume<Dim>(planes);
    EXPECT_NEAR(static_cast<double>(region.volume / volume), 1, allowed);
    for (int k = 0; k < Dim; ++k) {
      const Vector<Dim> u = turn.col(k).normalized();
      const double extent = k == 0 ? thin : 1;
      const double middle =
          static_cast<double>(oracle::moment<Dim>(planes, u, heights<Dim>(planes, u, 1e-17L), 1) / volume);
      EXPECT_NEAR(u.dot(region.centroid), middle, allowed * extent) << "direction " << k << ", thin " << thin;
    }
  }
}

TEST(OverlapRegion, AgreesWithLasserresRecursion) {
  expect_regions<3>(81, 20, 1);
  expect_regions<3>(82, 20, 1e-5);
  expect_regions<2>(83, 100, 1);
  expect_regions<2>(84, 100, 1e-10);
}

// ---- the region as a contact's point --------------------------------------------------------------------------------

TEST(CentroidPoint, OfACornerInAFaceLiesAQuarterDeep) {
  const ContactSettings settings{.point = ContactPoint::centroid};
  const Polytope<3> cube = shapes::block<3>(shapes::cube<3>(3));
  const Polytope<3> octahedron = shapes::block<3>(shapes::platonic_solids(1)[2].planes);
  const Polytope<2> large = shapes::block<2>(shapes::cube<2>(3));
  const Polytope<2> small = shapes::block<2>(shapes::cube<2>(1));
  for (const double depth : {1e-2, 1e-6, 1e-10}) {
    const double rounding = 4e-15;  // of coordinates of 5 m
    const Vector<3> offset(0, 0, 3 + std::sqrt(3.0) - depth);
    const Outcome<3> cold = touch<3>(cube, octahedron, Matrix<3>::Identity(), offset, settings);
    ASSERT_TRUE(cold.contact.touching());
    EXPECT_NEAR(cold.contact.geometry.point[2], 3 - depth / 4, rounding);
    EXPECT_LT(cold.contact.geometry.point.head<2>().norm(), rounding);
    EXPECT_NEAR(cold.contact.geometry.area, 2 * std::pow(0.75 * depth, 2), depth * rounding + 1e-9 * depth * depth);
    // and the old centroid proves the next contact without an LP
    const Outcome<3> warm = touch<3>(cube, octahedron, Matrix<3>::Identity(), offset, settings, cold.contact);
    EXPECT_EQ(warm.counters.lp_solves, 0);
    EXPECT_LT((warm.contact.geometry.point - cold.contact.geometry.point).norm(), rounding);

    const Outcome<2> flat = touch<2>(large, small, matrix(Rotation<2>{std::numbers::pi / 4}),
                                     Vector<2>(0, 3 + std::numbers::sqrt2 - depth), settings);
    ASSERT_TRUE(flat.contact.touching());
    EXPECT_NEAR(flat.contact.geometry.point[1], 3 - depth / 3, rounding);
  }
}

// ---- overlap by bracketing ------------------------------------------------------------------------------------------

template <int Dim>
void expect_same_overlap(std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 300; ++i) {
    const double scale = shapes::power_of_ten(random, -9, 3);
    HalfSpaces<Dim> planes = shapes::scaled<Dim>(shapes::random_planes<Dim>(random, 6, 1), scale);
    const int faces_a = shapes::integer(random, 1, static_cast<int>(planes.size()) - 1);
    shapes::shuffle(planes, random);
    const Vector<Dim> point = scale * shapes::uniform(random, 0, 0.59) * shapes::direction<Dim>(random);
    const Vector<Dim> normal = shapes::direction<Dim>(random);
    double closed = 0, bracketed = 0;
    int closed_a = -1, closed_b = -1, face_a = -1, face_b = -1;
    const bool ends = overlap_along<Dim>(planes, faces_a, point, normal, closed, closed_a, closed_b);
    // parts of one plane and more: half of them are open
    const bool found = overlap_by_bracketing<Dim>(planes, faces_a, point, normal, bracketed, face_a, face_b);
    ASSERT_EQ(found, ends);
    if (!ends) continue;
    // slack and slope have rounding, which a face seen at a grazing angle magnifies
    const double slope = std::min(planes[face_a].normal.dot(normal), -planes[face_b].normal.dot(normal));
    EXPECT_NEAR(bracketed, closed, 1e-15 * (scale + closed) / slope);
    EXPECT_EQ(face_a, closed_a);
    EXPECT_EQ(face_b, closed_b);
  }
}

// Eq. 3.37 against Eq. 3.36
TEST(Bracketing, EndsAsTheClosedFormDoes) {
  expect_same_overlap<3>(85);
  expect_same_overlap<2>(86);
}

TEST(Bracketing, MeetsCubesAndGrazingFaces) {
  double overlap = 0;
  int face_a = -1, face_b = -1;
  HalfSpaces<3> planes = shapes::cube<3>(1);
  for (const HalfSpace<3>& p : shapes::box<3>({-1, -1, 0.5}, {1, 1, 3}))
    planes.push_back(p);
  ASSERT_TRUE(overlap_by_bracketing<3>(planes, 6, {0, 0, 0.6}, {0, 0, 1}, overlap, face_a, face_b));
  EXPECT_NEAR(overlap, 0.5, 1e-15);
  EXPECT_EQ(planes[face_a].normal, Vector<3>::UnitZ());
  EXPECT_EQ(planes[face_b].normal, Vector<3>(-Vector<3>::UnitZ()));
  EXPECT_FALSE(overlap_by_bracketing<3>(planes, 6, {0, 0, 0.5}, {0, 0, 1}, overlap, face_a, face_b));

  // two planes inclined by a billionth of a radian end the part a billion times farther away than they are
  const double lean = 1e-9;
  const HalfSpaces<2> strip{{{1, lean}, 1}, {{-1, -lean}, 1}};
  ASSERT_TRUE(overlap_by_bracketing<2>(strip, 1, {0, 0}, {0, 1}, overlap, face_a, face_b));
  EXPECT_NEAR(overlap, 2 / lean, 1e-6);
}

TEST(Bracketing, GivesTheKernelTheSameContact) {
  Random random(87);
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const Polytope<3> a = unit_cube<3>(), b = shapes::centred_block<3>(shapes::random_planes<3>(random, 5, 0.5));
    const Matrix<3> turn = matrix(shapes::orientation<3>(random));
    const Vector<3> offset = Vector<3>(0.1, 0.1, 0.499) - lowest_corner<3>(b, turn);
    const Contact<3> closed = touch<3>(a, b, turn, offset).contact,
                     bracketed = touch<3>(a, b, turn, offset, {.overlap = OverlapSearch::bracketing}).contact;
    ASSERT_TRUE(closed.touching() && bracketed.touching());
    // another search also finds the centre differently, each to Newton's tolerance
    EXPECT_NEAR(bracketed.geometry.overlap, closed.geometry.overlap, point_tolerance * closed.geometry.overlap);
    EXPECT_EQ(bracketed.geometry.face_a, closed.geometry.face_a);
    EXPECT_EQ(bracketed.geometry.face_b, closed.geometry.face_b);
    compared += bracketed.geometry.overlap != closed.geometry.overlap;
  }
  EXPECT_GT(compared, 0) << "the setting has no effect";
}

// ---- a failing search for the centre --------------------------------------------------------------------------------

CentreResult<3> fails(const HalfSpaces<3>&, const CentreRequest<3>& request) {
  return {CentreStatus::singular, request.start, 3};
}

TEST(FailingSearch, LeavesANamedFailure) {
  const Polytope<3> cube = unit_cube<3>();
  const Pair<3> pair{&cube, &cube, Matrix<3>::Identity(), Matrix<3>::Identity(), {0.25, -0.5, 0.99}};
  const auto resolve = [&](const Solvers<3>& solvers, const ContactSettings& settings) {
    return contacts::resolve<3>(pair, settings, {}, solvers);
  };
  const Outcome<3> own = resolve({}, {});
  ASSERT_TRUE(own.contact.touching());
  EXPECT_EQ(resolve({.centre = &fails}, {}).contact.status, ContactStatus::centre_not_converged);
}

}  // namespace
}  // namespace voussoir::overlap_region_test
