// Volume, centroid and second moment against closed forms, and the bound against the true error.
#include "core/potential/mass.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/testing/potential_pairs.hpp"

namespace voussoir::mass_test {
namespace {

using std::numbers::pi;

template <int Dim>
void expect_mass(const PotentialShape<Dim>& shape, double tolerance, double volume, const Vector<Dim>& centroid,
                 const Vector<Dim>& second, const Vector<Dim>& half) {
  const PotentialMass<Dim> found = integrate<Dim>(shape, tolerance);
  EXPECT_LE(found.error, tolerance);
  // in units of the half extents the bound holds for every integral; about the origin the moments mix with the centre's
  const double reach = 1 + centroid.cwiseAbs().cwiseQuotient(half).maxCoeff();
  const double allowed = found.error * reach * reach + 1e-14;
  EXPECT_LE(std::abs(found.mass.volume / volume - 1), allowed);
  for (int k = 0; k < Dim; ++k) {
    EXPECT_LE(std::abs(found.mass.centroid[k] - centroid[k]), 2 * allowed * half[k]);
    EXPECT_LE(std::abs(found.mass.second_moment(k, k) - second[k]), 2 * allowed * volume * half[k] * half[k]);
    for (int l = 0; l < k; ++l)
      EXPECT_LE(std::abs(found.mass.second_moment(k, l) - volume * centroid[k] * centroid[l]),
                2 * allowed * volume * half[k] * half[l]);
  }
}

TEST(PotentialMass, OfSpheresAndDiscs) {
  PotentialShape<3> ball{{}, 1, 1, 2};
  ball.centre = {0.5, -0.25, 1};
  const double v = 4 * pi / 3 * 8;
  expect_mass<3>(ball, 1e-9, v, ball.centre, v * (Vector<3>::Constant(4 / 5.0) + ball.centre.cwiseAbs2()),
                 Vector<3>::Constant(2));
  PotentialShape<2> disc{{}, 1, 1, 3};
  expect_mass<2>(disc, 1e-12, 9 * pi, Vector<2>::Zero(), Vector<2>::Constant(81 * pi / 4), Vector<2>::Constant(3));
}

// k = 0 and right angles: a rectangle (box) with a disc (ball) moved along it. Of x² over quarter discs (edges,
// corners) at a distance h: ∫ (h + u)², with ∫ u and ∫ u² of the quarter (half of the wedge in space) disc.
TEST(PotentialMass, OfRoundedRectangles) {
  for (const double r : {1e-4, 0.02, 0.4}) {
    const Vector<2> h(1, 0.05);
    PotentialShape<2> shape{shapes::box<2>(-h, h), r, 0, 3};
    const double area = 4 * h[0] * h[1] + 4 * r * (h[0] + h[1]) + pi * r * r;
    Vector<2> second;
    for (int k = 0; k < 2; ++k) {
      const double a = h[k], b = h[1 - k];
      second[k] = 4 * b * a * a * a / 3 + 4 * r * a * a * a / 3 +                               // the box, caps along k
                  4 * b * (std::pow(a + r, 3) - a * a * a) / 3 +                                // caps beyond k
                  pi * r * r * a * a + 4 * (2 * a * r * r * r / 3 + pi * std::pow(r, 4) / 16);  // four quarters
    }
    expect_mass<2>(shape, 1e-7, area, Vector<2>::Zero(), second, h + Vector<2>::Constant(r));
  }
}

TEST(PotentialMass, OfRoundedBoxes) {
  for (const double r : {1e-4, 0.05, 0.5}) {
    const Vector<3> h(1, 0.5, 0.25);
    PotentialShape<3> shape{shapes::box<3>(-h, h), r, 0, 3};
    // a slice at height u above the box's face has the area of the rounded rectangle with radius w = sqrt(r² - u²)
    const auto slice = [&](double a, double b, double w) { return 4 * a * b + 4 * w * (a + b) + pi * w * w; };
    const double edges = pi * r * r / 4, corner = 2 * r * r * r / 3;  // ∫ w du, ∫ w² du, 0..r
    double volume = 8 * h.prod() + 8 * r * (h[0] * h[1] + h[1] * h[2] + h[2] * h[0]) + 2 * pi * r * r * h.sum() +
                    4 * pi / 3 * r * r * r;
    Vector<3> second;
    for (int k = 0; k < 3; ++k) {
      const double a = h[k], b = h[(k + 1) % 3], c = h[(k + 2) % 3];
      // ∫ (a + u)² slice du with ∫ u w = r³/3, ∫ u² w = π r⁴/16, ∫ u w² = r⁴/4, ∫ u² w² = 2 r⁵/15
      const double beyond = 4 * b * c * (std::pow(a + r, 3) - a * a * a) / 3 +
                            4 * (b + c) * (a * a * edges + 2 * a * r * r * r / 3 + pi * std::pow(r, 4) / 16) +
                            pi * (a * a * corner + a * std::pow(r, 4) / 2 + 2 * std::pow(r, 5) / 15);
      second[k] = 2 * a * a * a / 3 * slice(b, c, r) + 2 * beyond;
    }
    expect_mass<3>(shape, 1e-3, volume, Vector<3>::Zero(), second, h + Vector<3>::Constant(r));
  }
}

TEST(PotentialMass, ACornerThatNoFirstRayMeetsIsFound) {
  // a plane that cuts a cap of 1e-3 off a square's side, between the rays of the first cells
  PotentialShape<2> square{shapes::cube<2>(1), 1e-3, 0, 3};
  PotentialShape<2> cut = square;
  const Vector<2> normal = Vector<2>(1, 0.3).normalized();
  cut.planes.push_back({normal, normal.dot(Vector<2>(1, 1)) - 2e-3});
  const PotentialMass<2> of_square = integrate<2>(square, 1e-8), of_cut = integrate<2>(cut, 1e-8);
  const PotentialMass<2> coarse = integrate<2>(cut, 1e-4);
  EXPECT_LT(of_cut.mass.volume, of_square.mass.volume);
  EXPECT_LE(std::abs(coarse.mass.volume / of_cut.mass.volume - 1), coarse.error + of_cut.error);
}

TEST(PotentialMass, TheBoundHoldsIfACoarserAndAFinerResultDiffer) {
  shapes::Random random(285);
  for (int i = 0; i < 20; ++i) {
    const PotentialShape<2> shape = shapes::random_potential<2>(random, 0);
    const PotentialMass<2> coarse = integrate<2>(shape, 1e-4), fine = integrate<2>(shape, 1e-9);
    EXPECT_LE(std::abs(coarse.mass.volume / fine.mass.volume - 1), coarse.error + fine.error);
  }
  for (int i = 0; i < 3; ++i) {
    const PotentialShape<3> shape = shapes::random_potential<3>(random, 0);
    const PotentialMass<3> coarse = integrate<3>(shape, 1e-2), fine = integrate<3>(shape, 1e-3);
    EXPECT_LE(std::abs(coarse.mass.volume / fine.mass.volume - 1), coarse.error + fine.error);
  }
}

TEST(PotentialMass, AnErrorThatIsNotReachedIsStated) {
  const PotentialShape<3> shape{shapes::cube<3>(0.5), 0.1, 0, 2};
  const PotentialMass<3> found = integrate<3>(shape, 1e-12, 200);
  EXPECT_GT(found.error, 1e-12);
  const double volume = 1 + 0.6 + 3 * pi * 0.01 + 4 * pi / 3 * 1e-3;
  EXPECT_LE(std::abs(found.mass.volume / volume - 1), found.error);
}

}  // namespace
}  // namespace voussoir::mass_test
