// The referee itself against closed forms, against Euler and against its own second method for the same result.
#include "core/testing/exact_referee.hpp"
#include "core/testing/exact_contacts.hpp"

#include <gtest/gtest.h>

#include "core/testing/shapes.hpp"

namespace voussoir::exact::exact_referee_test {
namespace {

using shapes::Random;

// closed forms of doubles whose own rounding is 1e-16
constexpr double closed_form = 1e-14;

TEST(ExactReferee, DecidesCasesThatRoundingCannot) {
  // two unit cubes a gap apart that no double of order one shows
  Planes planes = planes_of(shapes::cube<3>(0.5));
  const Rational gap = Rational(1) / Rational("1000000000000000000000000000000");
  for (Plane p : planes_of(shapes::cube<3>(0.5))) {
    p.offset += p.normal[0] * (1 + gap);
    planes.push_back(p);
  }
  EXPECT_EQ(feasibility(planes).value, gap / 2);
  planes.back().offset = 7;
  EXPECT_EQ(feasibility(planes).value, gap / 2);
}

TEST(ExactReferee, FindsOpenSolidsAndSections) {
  HalfSpaces<3> cube = shapes::cube<3>(0.5);
  const Plane middle{{0, 0, 1}, Rational(1, 4)};
  EXPECT_EQ(section_feasibility(planes_of(cube), middle).value, Rational(-1, 2) + Rational(1, 4));
  EXPECT_EQ(section_feasibility(planes_of(cube), {{0, 0, 1}, 2}).value, Rational(3, 2));
  cube.pop_back();
  EXPECT_EQ(solid(planes_of(shapes::cube<3>(0.5))).facets, 6);
  EXPECT_THROW(solid(planes_of(cube)), std::logic_error);
  EXPECT_TRUE(feasibility(planes_of(cube)).bounded);  // its inscribed ball touches the four sides
  EXPECT_FALSE(feasibility({{{0, 0, 1}, 1}}).bounded);
}

TEST(ExactReferee, HasTheValuesOfTheRegularSolids) {
  for (const shapes::Platonic& p : shapes::platonic_solids(1)) {
    const Solid s = solid(planes_of(p.planes));
    EXPECT_NEAR(to_double(s.volume) / p.volume, 1, closed_form) << p.name;
    // moments about an axis: the other two second moments
    EXPECT_NEAR(to_double(s.second_moment[0][0] + s.second_moment[1][1]) / p.inertia, 1, closed_form) << p.name;
    EXPECT_NEAR(to_double(s.second_moment[0][1]) / p.inertia, 0, closed_form) << p.name;
    EXPECT_EQ(s.facets, static_cast<int>(p.planes.size())) << p.name;
    EXPECT_LT(std::abs(to_double(s.centroid[0])), closed_form);
  }
}

TEST(ExactReferee, ClipsAndEnumeratesTheSameCorners) {
  Random random(301);
  for (int i = 0; i < 10; ++i) {
    const Planes planes = planes_of(
        shapes::placed<3>(shapes::random_planes<3>(random, 6, 1), matrix(shapes::orientation<3>(random)), {3, 4, 5}));
    const Solid s = solid(planes);
    const std::vector<Point> corners = vertices(planes);
    // three facets meet at each corner of a random solid; Euler
    EXPECT_EQ(s.vertices, 3 * static_cast<int>(corners.size()));
    EXPECT_EQ(static_cast<int>(corners.size()) - s.edges + s.facets, 2);
    for (const Point& c : corners) {
      const auto near = [&](const std::array<double, 3>& other) {
        return other[0] == c[0].get_d() && other[1] == c[1].get_d() && other[2] == c[2].get_d();
      };
      EXPECT_EQ(std::count_if(s.corners.begin(), s.corners.end(), near), 3);
    }
  }
}

TEST(ExactReferee, CountsCornersOfManyPlanes) {
  // octahedron: four planes through every corner; a plane that only touches a corner adds nothing
  HalfSpaces<3> planes;
  for (int signs = 0; signs < 8; ++signs)
    planes.push_back({Vector<3>(signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1), 1});
  planes.push_back({Vector<3>(0, 0, 1), 1});
  planes.push_back(planes[0]);
  const Solid s = solid(planes_of(planes));
  EXPECT_EQ(s.facets, 8);
  EXPECT_EQ(s.edges, 12);
  EXPECT_EQ(s.vertices, 24);
  EXPECT_EQ(vertices(planes_of(planes)).size(), 6u);
  EXPECT_NEAR(to_double(s.volume), 4.0 / 3, closed_form);
}

TEST(ExactReferee, MeasuresSections) {
  const Planes cube = planes_of(shapes::cube<3>(0.5));
  EXPECT_NEAR(to_double(section_area(cube, {0, 0, 0}, Vector<3>(1, 1, 1))), 3 * std::sqrt(3.0) / 4, closed_form);
  EXPECT_NEAR(to_double(section_area(cube, {0, 0, 0.25}, Vector<3>(0, 0, 2))), 1, closed_form);
  EXPECT_EQ(to_double(section_area(cube, {0.5, 0, 0.5}, Vector<3>(1, 0, 1))), 0);  // touches an edge only
  EXPECT_EQ(to_double(section_area(cube, {0, 0, 3}, Vector<3>(0, 0, 1))), 0);
}

TEST(ExactReferee, FindsTheGrowthOfASection) {
  // a square of edge 1 gains 4 of its edges when its planes move out; along a diagonal plane two of them are inclined
  const Planes cube = planes_of(shapes::cube<3>(0.5));
  const Section square = section(cube, {0, 0, Rational(1, 4)}, {0, 0, 2});
  EXPECT_NEAR(to_double(square.area), 1, closed_form);
  EXPECT_NEAR(to_double(square.sensitivity), 4, closed_form);
  const Section leaning = section(cube, {0, 0, 0}, {1, 0, 1});
  EXPECT_NEAR(to_double(leaning.area), std::sqrt(2.0), closed_form);
  // at two of its ends x and z meet at an edge: whichever bounds it, by sqrt(2); the other two ends are straight
  EXPECT_NEAR(to_double(leaning.sensitivity), 4 * std::sqrt(2.0), closed_form);
}

TEST(ExactReferee, FindsTheSupportOfASolid) {
  Random random(303);
  const Planes cube = planes_of(shapes::cube<3>(0.5));
  EXPECT_EQ(support(cube, {1, 2, -3}), Rational(3));
  EXPECT_EQ(least_slack(cube, {0, Rational(1, 4), 0}), Rational(1, 4));
  EXPECT_LT(least_slack(cube, {0, 1, 0}), Rational(0));
  for (int i = 0; i < 20; ++i) {
    const HalfSpaces<3> planes = shapes::random_planes<3>(random, 6, 1);
    const Planes exactly = planes_of(planes);
    const Point direction = point_of(shapes::direction<3>(random));
    const Rational reach = support(exactly, direction);
    int proofs = 0;
    for (int a = 0; a < 12; ++a)
      for (int b = a + 1; b < 12; ++b)
        for (int c = b + 1; c < 12; ++c)
          if (const std::optional<Rational> proven = proven_support(exactly, {a, b, c}, direction)) {
            EXPECT_EQ(*proven, reach);
            ++proofs;
          }
    EXPECT_EQ(proofs, 1);  // in general position one corner proves it
  }
}

TEST(ExactReferee, APairInThePlaneIsAPrism) {
  const Polytope<2> square = shapes::block<2>(shapes::cube<2>(0.5));
  const Pair<2> pair{&square, &square, Matrix<2>::Identity(), Matrix<2>::Identity(), Vector<2>(0.25, 1 - 0x1p-40)};
  const Planes planes = planes_of(pair);
  EXPECT_EQ(feasibility(planes).value, Rational(-0x1p-41));
  const Section middle = section(planes, {0, Rational(1, 2) - Rational(0x1p-41), 0}, {0, 1, 0});
  EXPECT_NEAR(to_double(middle.area) / (2 * lid_height(pair)), 0.75, closed_form);
}

TEST(ExactReferee, ConvergesToTheCentreOfAThinOverlap) {
  // two cubes share a box of 3/4 by 1/2 by 2^-30: its middle, its thickness, its section
  const Polytope<3> cube = shapes::block<3>(shapes::cube<3>(0.5));
  const double overlap = 0x1p-30;
  const Pair<3> pair{&cube, &cube, Matrix<3>::Identity(), Matrix<3>::Identity(), Vector<3>(0.25, -0.5, 1 - overlap)};
  const Point start{0, Rational(-1, 10), Rational(0.5) - Rational(overlap / 8)};
  const auto contact = converged_contact(planes_of(pair), 6, 6, start, 0.01);
  ASSERT_TRUE(contact);
  // by symmetry
  EXPECT_NEAR(to_double(contact->from_start[0]), 0.125, closed_form);
  EXPECT_NEAR(to_double(contact->from_start[1]), -0.15, closed_form);
  EXPECT_NEAR(to_double(contact->from_start[2]), -overlap * 3 / 8, 1e-9 * overlap);
  EXPECT_NEAR(to_double(contact->overlap), overlap, 1e-20);
  EXPECT_NEAR(to_double(contact->normal[2]), 1, closed_form);
  EXPECT_NEAR(to_double(contact->section.area), 0.375, closed_form);
  EXPECT_GT(to_double(contact->distance), 0.1);
  // outside there is no start for convergence
  EXPECT_FALSE(converged_contact(planes_of(pair), 6, 6, {0, 0, 0}, 0.01));
  // and from the centre itself it does not move
  Point centre;
  for (int k = 0; k < 3; ++k)
    centre[k] = start[k] + Rational(to_double(contact->from_start[k]));
  EXPECT_LT(to_double(converged_contact(planes_of(pair), 6, 6, centre, 0.01)->distance), 1e-6);
}

TEST(ExactReferee, ProvesBoundsFromABasis) {
  Random random(302);
  for (int i = 0; i < 20; ++i) {
    const HalfSpaces<3> planes = shapes::random_planes<3>(random, 8, 1);
    const std::array<int, 4> basis = solve_feasibility<3>(planes, {}).basis;
    const ProgramBounds bounds = feasibility_bounds(planes_of(planes), basis);
    const Rational value = feasibility(planes_of(planes)).value;
    ASSERT_TRUE(bounds.proven);
    EXPECT_LE(bounds.low, value);
    EXPECT_GE(bounds.high, value);
    EXPECT_LT(Rational(bounds.high - bounds.low).get_d(), closed_form);
    // another basis proves less, but nothing wrong
    std::array<int, 4> other{0, 1, 2, 4};
    const ProgramBounds weaker = feasibility_bounds(planes_of(planes), other);
    if (weaker.proven) {
      EXPECT_LE(weaker.low, value);
      EXPECT_GE(weaker.high, value);
    }
  }
}

TEST(ExactReferee, TheCentreOfABoxIsItsMiddle) {
  const HalfSpaces<3> box = shapes::box<3>({0, 0, 0}, {1, 2, 1e-9});
  EXPECT_LT(to_double(centre(box, {0.5, 1, 0.5e-9}).decrement), closed_form);
  EXPECT_FALSE(centre(box, {0.5, 1, 1e-9}).interior);
  // a tenth of the half width off: x = 0.1, gradient 2x/(1 - x²), Hessian 2(1 + x²)/(1 - x²)²
  const double off = to_double(centre(box, {0.55, 1, 0.5e-9}).decrement);
  EXPECT_NEAR(off, 0.2 / std::sqrt(2 * 1.01), 1e-12);
}

TEST(ExactReferee, NormalOfFacesAndRoots) {
  HalfSpaces<3> planes = shapes::cube<3>(0.5);
  for (const HalfSpace<3>& p : shapes::placed<3>(shapes::cube<3>(0.5), Matrix<3>::Identity(), {0.9, 0, 0}))
    planes.push_back(p);
  const Normal n = contact_normal(planes, 6, {0.45, 0, 0}, 0.1);
  EXPECT_EQ(to_double(n.normal[0]), 1);
  EXPECT_NEAR(to_double(n.gradient_a), 0.05, 1e-15);
  EXPECT_NEAR(to_double(root(Quad(2)) * root(Quad(2)) - 2) * 1e30, 0, 1e-2);
}

}  // namespace
}  // namespace voussoir::exact::exact_referee_test
