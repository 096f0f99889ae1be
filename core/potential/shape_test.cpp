// The function, its derivatives, its reach, and which numbers make a particle.
#include <gtest/gtest.h>

#include <limits>

#include "core/potential/surface.hpp"
#include "core/testing/potential_pairs.hpp"

namespace voussoir::shape_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int Dim>
PotentialShape<Dim> rounded_cube(double half, double r, double k) {
  PotentialShape<Dim> shape{shapes::cube<Dim>(half), r, k};
  shape.sphere_radius = enclosing_radius<Dim>(shape.planes, r, Vector<Dim>::Zero());
  return shape;
}

// Eq. A.2 as printed, with its constants inside the brackets
template <int Dim>
double as_printed(const PotentialShape<Dim>& shape, const Vector<Dim>& x) {
  const double k = shape.sphericity, r = shape.corner_radius, big_r = shape.sphere_radius;
  double sum = 0;
  for (const HalfSpace<Dim>& plane : shape.planes)
    if (const double s = plane.normal.dot(x) - plane.offset; s > 0) sum += s * s / (r * r);
  return (1 - k) * (sum - 1) + k * ((x - shape.centre).squaredNorm() / (big_r * big_r) - 1);
}

template <int Dim>
void expect_function_and_derivatives() {
  shapes::Random random(280);
  for (int i = 0; i < 200; ++i) {
    PotentialShape<Dim> shape = shapes::random_potential<Dim>(random, 0);
    shape.centre = 0.01 * shapes::direction<Dim>(random);
    const PlacedPotential<Dim> own = placed<Dim>(shape);
    const Vector<Dim> x = shapes::uniform(random, 0, 2) * shapes::direction<Dim>(random);
    const double f = as_printed<Dim>(shape, x);
    const PotentialDerivatives<Dim> at = derivatives<Dim>(own, x);
    ASSERT_NEAR(value<Dim>(own, x), f, 1e-12 * (1 + std::abs(f)));
    ASSERT_EQ(at.value, value<Dim>(own, x));

    // at two step sizes, which shows if a plane begins to count in between
    const double h = 1e-6;
    const double stiffest = own.plane_weight * static_cast<double>(own.planes.size()) + own.sphere_weight;
    for (int k = 0; k < Dim; ++k) {
      const Vector<Dim> step = h * Vector<Dim>::Unit(k);
      const double slope = (value<Dim>(own, x + step) - value<Dim>(own, x - step)) / (2 * h);
      ASSERT_NEAR(at.gradient[k], slope, 2 * stiffest * h + 1e-8 * (1 + std::abs(f)));
      bool crosses = false;
      for (const HalfSpace<Dim>& plane : own.planes)
        crosses = crosses || std::abs(signed_distance<Dim>(plane, x)) <= h;
      const Vector<Dim> curvature =
          (derivatives<Dim>(own, x + step).gradient - derivatives<Dim>(own, x - step).gradient) / (2 * h);
      if (!crosses) {
        ASSERT_LE((at.hessian.col(k) - curvature).norm(), 1e-8 * (stiffest + at.gradient.norm()));
      }
    }
  }
}
// Eq. A.2
TEST(PotentialShape, IsEquationA2AndItsDerivatives) {
  expect_function_and_derivatives<2>();
  expect_function_and_derivatives<3>();
}

template <int Dim>
void expect_same_in_any_frame() {
  shapes::Random random(281);
  PlacedPotential<Dim> moved;
  for (int i = 0; i < 200; ++i) {
    const PotentialShape<Dim> shape = shapes::random_potential<Dim>(random, 0);
    const Matrix<Dim> turn = matrix(shapes::orientation<Dim>(random));
    const Vector<Dim> shift = 3 * shapes::direction<Dim>(random), x = shapes::direction<Dim>(random);
    place<Dim>(shape, turn, shift, moved);
    const Vector<Dim> there = turn * x + shift;
    const PlacedPotential<Dim> own = placed<Dim>(shape);
    const double allowed = value_rounding<Dim>(own, x) + value_rounding<Dim>(moved, there) +
                           4 * epsilon * derivatives<Dim>(own, x).gradient.norm() * (1 + there.norm());
    ASSERT_NEAR(value<Dim>(moved, there), value<Dim>(own, x), allowed);
  }
}
// Eqs A.4 and A.5
TEST(PotentialShape, HasTheSameValueAtAPointOfAMovedBody) {
  expect_same_in_any_frame<2>();
  expect_same_in_any_frame<3>();
}

template <int Dim>
void expect_support() {
  shapes::Random random(282);
  RayScratch scratch;
  for (int i = 0; i < 100; ++i) {
    const PotentialShape<Dim> shape = shapes::random_potential<Dim>(random, 0);
    const PlacedPotential<Dim> own = placed<Dim>(shape);
    const Vector<Dim> direction = shapes::direction<Dim>(random);
    const Support<Dim> support = find_support<Dim>(own, direction, scratch);
    const PotentialBox<Dim> box = bounding_box<Dim>(own, scratch);
    ASSERT_TRUE(support.converged);
    // on the surface, nowhere short of the bound, and the gradient along the direction
    const PotentialDerivatives<Dim> at = derivatives<Dim>(own, support.point);
    ASSERT_NEAR(at.value, 0, 2 * value_rounding<Dim>(own, support.point));
    ASSERT_NEAR(support.bound, direction.dot(support.point), 1e-11);
    ASSERT_GE(support.bound, direction.dot(support.point) - 8 * epsilon);
    ASSERT_NEAR(at.gradient.normalized().dot(direction), 1, 1e-9);
    // no ray from the centre ends beyond the bound, nor outside the box
    for (int j = 0; j < 50; ++j) {
      const Vector<Dim> ray = shapes::direction<Dim>(random);
      const Vector<Dim> end = distance_to_surface<Dim>(own, own.centre, ray) * ray;
      ASSERT_LE(direction.dot(end), support.bound + 8 * epsilon);
      ASSERT_TRUE(((box.high - end).array() >= -8 * epsilon).all() && ((end - box.low).array() >= -8 * epsilon).all());
    }
  }
}
TEST(PotentialSupport, BoundsTheBodyAndTouchesIt) {
  expect_support<2>();
  expect_support<3>();
}

TEST(PotentialSupport, OfARoundedCubeIsThatOfCubeAndBall) {
  // k = 0, right angles: the cube of half edge 0.5 and a ball of radius r, one moved along the other
  RayScratch scratch;
  shapes::Random random(283);
  for (const double r : {1e-4, 0.01, 0.5}) {
    const PlacedPotential<3> cube = placed<3>(rounded_cube<3>(0.5, r, 0));
    for (int i = 0; i < 20; ++i) {
      const Vector<3> u = shapes::direction<3>(random);
      const Support<3> support = find_support<3>(cube, u, scratch);
      const double reach = 0.5 * u.cwiseAbs().sum() + r;
      EXPECT_NEAR(u.dot(support.point), reach, 1e-14);
      // the excess of the bound: the rounding of slacks of up to r in coordinates of 1, over r
      EXPECT_GE(support.bound, reach - 4 * epsilon);
      EXPECT_LE(support.bound, reach + 16 * epsilon / r);
    }
  }
}

TEST(PotentialShape, EnclosingRadiusOfARoundedBox) {
  // the corner's ball reaches farthest along the diagonal
  const HalfSpaces<3> planes = shapes::box<3>({-3, -2, -1}, {3, 2, 1});
  EXPECT_NEAR(enclosing_radius<3>(planes, 0.1, Vector<3>::Zero()), std::sqrt(14.0) + 0.1, 1e-14);
  EXPECT_NEAR(enclosing_radius<2>(shapes::box<2>({0, 0}, {3, 4}), 0.5, Vector<2>::Zero()), 5.5, 1e-14);
  EXPECT_TRUE(std::isinf(enclosing_radius<2>({{{1, 0}, 1}, {{-1, 0}, 1}}, 0.1, Vector<2>::Zero())));
  EXPECT_EQ(enclosing_radius<2>(shapes::box<2>({1, 1}, {-1, -1}), 0.1, Vector<2>::Zero()), 0);
}

// ---- refusals -------------------------------------------------------------------------------------------------------

struct BadShape {
  const char* name;
  void (*spoil)(PotentialShape<3>&);
  ShapeProblem problem;
  const char* says;
};

const BadShape bad_shapes[] = {
    {"r zero", [](PotentialShape<3>& s) { s.corner_radius = 0; }, ShapeProblem::corner_radius, "r = 0 m"},
    {"r negative", [](PotentialShape<3>& s) { s.corner_radius = -1; }, ShapeProblem::corner_radius, "above 0"},
    {"k below 0", [](PotentialShape<3>& s) { s.sphericity = -0.1; }, ShapeProblem::sphericity, "k = -0.1"},
    {"k above 1", [](PotentialShape<3>& s) { s.sphericity = 1.5; }, ShapeProblem::sphericity, "0 to 1"},
    {"R zero", [](PotentialShape<3>& s) { s.sphere_radius = 0; }, ShapeProblem::sphere_radius, "R = 0 m"},
    {"R too small", [](PotentialShape<3>& s) { s.sphere_radius = 0.9; }, ShapeProblem::sphere_does_not_enclose,
     "R = 0.9 m does not enclose"},
    {"no planes", [](PotentialShape<3>& s) { s.planes.clear(); }, ShapeProblem::no_planes, "needs planes"},
    {"a slab", [](PotentialShape<3>& s) { s.planes.resize(2); }, ShapeProblem::open, "do not close"},
    {"a trough", [](PotentialShape<3>& s) { s.planes.pop_back(); }, ShapeProblem::open, "missing"},
    {"a normal of 2", [](PotentialShape<3>& s) { s.planes[3].normal *= 2; }, ShapeProblem::normal_not_unit, "plane 4"},
    {"no inside",
     [](PotentialShape<3>& s) {
       for (HalfSpace<3>& p : s.planes)
         p.offset = -0.5;
     },
     ShapeProblem::no_inside, "no point lies inside"},
    {"centre outside",
     [](PotentialShape<3>& s) {
       s.centre = {5, 0, 0}, s.sphere_radius = 10;
     },
     ShapeProblem::centre_outside, "the centre of the sphere"},
    {"not a number", [](PotentialShape<3>& s) { s.planes[0].offset = std::numeric_limits<double>::infinity(); },
     ShapeProblem::not_finite, "not finite"},
};

TEST(PotentialShape, BadNumbersAreRefusedByName) {
  EXPECT_TRUE(check_shape<3>(rounded_cube<3>(0.5, 0.1, 0.2)).ok());
  for (const BadShape& bad : bad_shapes) {
    PotentialShape<3> shape = rounded_cube<3>(0.5, 0.1, 0.2);
    bad.spoil(shape);
    const ShapeVerdict verdict = check_shape<3>(shape);
    EXPECT_EQ(verdict.problem, bad.problem) << bad.name;
    EXPECT_NE(describe<3>(verdict, shape).find(bad.says), std::string::npos)
        << bad.name << ": " << describe<3>(verdict, shape);
  }
}

TEST(PotentialShape, ASphereNeedsNoPlanesAndTheNamedRadiusIsEnough) {
  EXPECT_TRUE(check_shape<2>({{}, 1, 1, 2}).ok());
  PotentialShape<3> shape = rounded_cube<3>(0.5, 0.1, 0.2);
  shape.sphere_radius = 0.5;
  shape.sphere_radius = check_shape<3>(shape).least;
  EXPECT_TRUE(check_shape<3>(shape).ok());
}

TEST(PotentialShape, RandomShapesOfTheTestsAreValid) {
  shapes::Random random(284);
  for (int i = 0; i < 50; ++i) {
    EXPECT_TRUE(check_shape<2>(shapes::random_potential<2>(random, 0)).ok());
    EXPECT_TRUE(check_shape<3>(shapes::random_potential<3>(random, 0)).ok());
  }
}

}  // namespace
}  // namespace voussoir::shape_test
