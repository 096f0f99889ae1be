// Contacts by the program's multipliers (ContactNormal): closed forms, and that their force has a potential.
#include <gtest/gtest.h>

#include <numbers>

#include "core/testing/contacts.hpp"

namespace voussoir::multipliers_test {
namespace {

using namespace contacts;
using shapes::Random;

const ContactSettings by_multipliers{.point = ContactPoint::chebyshev, .normal = ContactNormal::multipliers};
const ContactSettings smoothed{.point = ContactPoint::central_path, .normal = ContactNormal::multipliers};
const ContactSettings by_potential{.point = ContactPoint::chebyshev, .potential_radius = 0.3};

// rounding of the planes of blocks of 1 m, magnified by corners
constexpr double rounding = 1e-14;

// ---- closed forms ---------------------------------------------------------------------------------------------------

// half of the multipliers' sum on either side: only the faces are displaced
template <int Dim>
void expect_face_on_face() {
  const Polytope<Dim> cube = unit_cube<Dim>();
  for (const double depth : {1e-2, 1e-6, 1e-10}) {
    Vector<Dim> offset = Vector<Dim>::Constant(0.3);
    offset[Dim - 1] = 1 - depth;
    const Outcome<Dim> r = touch<Dim>(cube, cube, Matrix<Dim>::Identity(), offset, by_multipliers);
    ASSERT_TRUE(r.contact.touching());
    const ContactGeometry<Dim>& g = r.contact.geometry;
    EXPECT_NEAR(g.overlap, depth, rounding);
    EXPECT_NEAR(g.stiffness_factor, 1, rounding);
    EXPECT_LT((g.normal - Vector<Dim>::Unit(Dim - 1)).norm(), rounding);
    EXPECT_NEAR(g.area, Dim == 3 ? 0.49 : 0.7, area_tolerance);
    EXPECT_EQ(cube.faces[g.face_a].normal[Dim - 1], 1);
    EXPECT_EQ(cube.faces[g.face_b].normal[Dim - 1], -1);
    // the planes that were tight are so again: only a check is needed
    const Outcome<Dim> warm = touch<Dim>(cube, cube, Matrix<Dim>::Identity(), offset, by_multipliers, r.contact);
    EXPECT_LE(warm.counters.lp_pivots, 1);
    EXPECT_EQ(warm.contact.geometry.overlap, g.overlap);
  }
}

TEST(Multipliers, FaceOnFaceIsTheirDistance) {
  expect_face_on_face<3>();
  expect_face_on_face<2>();
}

// a corner in a large face, at any inclination: the face's normal, the corner's depth
template <int Dim>
void expect_corner_in_face(std::uint64_t seed) {
  Random random(seed);
  const Polytope<Dim> large = shapes::block<Dim>(shapes::cube<Dim>(3)), small = unit_cube<Dim>();
  for (int i = 0; i < 50; ++i) {
    const double depth = shapes::power_of_ten(random, -9, -2);
    const Matrix<Dim> turn = matrix(shapes::orientation<Dim>(random));
    Vector<Dim> offset = Vector<Dim>::Unit(Dim - 1) * (3 - depth) - lowest_corner<Dim>(small, turn);
    const Contact<Dim> contact = touch<Dim>(large, small, turn, offset, by_multipliers).contact;
    ASSERT_TRUE(contact.touching());
    const ContactGeometry<Dim>& g = contact.geometry;
    EXPECT_NEAR(g.overlap, depth, rounding);
    EXPECT_LT((g.normal - Vector<Dim>::Unit(Dim - 1)).norm(), rounding);
    EXPECT_LT(g.stiffness_factor, 1);
    EXPECT_EQ(large.faces[g.face_a].normal[Dim - 1], 1);

    // seen from the other
    const ContactGeometry<Dim> back =
        touch<Dim>(small, large, turn.transpose(), -turn.transpose() * offset, by_multipliers).contact.geometry;
    EXPECT_NEAR(back.overlap, g.overlap, rounding);
    EXPECT_NEAR(back.stiffness_factor, g.stiffness_factor, rounding);
    EXPECT_LT((turn * back.normal + g.normal).norm(), rounding);
  }
}

TEST(Multipliers, ACornerInAFaceIsItsDepth) {
  expect_corner_in_face<3>(91);
  expect_corner_in_face<2>(92);
}

TEST(Multipliers, CrossedEdgesAreTheDistanceOfTheirLines) {
  // both cubes stand on an edge, the upper one is tilted along its own: it crosses the lower one's away from every
  // corner
  const Polytope<3> cube = unit_cube<3>();
  const Matrix<3> on_edge = Eigen::AngleAxisd(std::numbers::pi / 4, Vector<3>::UnitX()).toRotationMatrix();
  const double half_diagonal = std::sqrt(0.5);
  Random random(93);
  for (int i = 0; i < 50; ++i) {
    const double depth = shapes::power_of_ten(random, -9, -2);
    const double angle = shapes::uniform(random, 0.3, std::numbers::pi - 0.3),
                 lean = shapes::uniform(random, -0.3, 0.3);
    const Matrix<3> upper = Eigen::AngleAxisd(angle, Vector<3>::UnitZ()).toRotationMatrix() *
                            Eigen::AngleAxisd(lean, Vector<3>::UnitY()).toRotationMatrix() * on_edge;
    // edges along x, in their cubes' frames turned on edge; the common perpendicular points from the lower to the upper
    const Vector<3> edge_a = Vector<3>::UnitX(), edge_b = upper * on_edge.transpose() * Vector<3>::UnitX();
    Vector<3> across = edge_a.cross(edge_b).normalized();
    if (across[2] < 0) across = -across;
    const Vector<3> below = upper * on_edge.transpose() * Vector<3>(0, 0, -half_diagonal);
    const Vector<3> offset = Vector<3>(0, 0, half_diagonal) - below - depth * across;
    const Contact<3> contact =
        touch<3>(cube, cube, on_edge.transpose() * upper, on_edge.transpose() * offset, by_multipliers).contact;
    ASSERT_TRUE(contact.touching());
    EXPECT_NEAR(contact.geometry.overlap, depth, rounding);
    EXPECT_LT((on_edge * contact.geometry.normal - across).norm(), rounding);
  }
}

// A needle's planes are active at its tip and all but cancel: the direction is that of the plane whose multiplier is
// nearly zero.
TEST(Multipliers, ANeedlesTipHasTheFacesNormal) {
  const Polytope<3> large = shapes::block<3>(shapes::cube<3>(3));
  for (const double slope : {1e-3, 1e-7}) {
    const double lean = 1 / std::hypot(1, slope), down = -slope * lean;
    const Polytope<3> needle = shapes::block<3>(
        {{{lean, 0, down}, 0}, {{-lean, 0, down}, 0}, {{0, lean, down}, 0}, {{0, -lean, down}, 0}, {{0, 0, 1}, 1}});
    const double depth = 0.3;
    for (const ContactSettings& settings : {by_multipliers, smoothed}) {
      const Contact<3> above = touch<3>(large, needle, Matrix<3>::Identity(), {0, 0, 3 - depth}, settings).contact,
                       below = touch<3>(needle, large, Matrix<3>::Identity(), {0, 0, depth - 3}, settings).contact;
      for (const auto& [contact, sign] : {std::pair(above, 1), std::pair(below, -1)}) {
        ASSERT_TRUE(contact.touching());
        EXPECT_LT((sign * contact.geometry.normal - Vector<3>::UnitZ()).norm(), 1e-6);
        // the ball in the tip is as far from the face as from the needle's planes
        EXPECT_LE(contact.geometry.overlap, depth * (1 + 2 * slope));
        EXPECT_GE(contact.geometry.overlap, (settings.point == ContactPoint::chebyshev ? 0.99 : 0.9) * depth);
        EXPECT_NEAR(contact.geometry.stiffness_factor, 4 * slope * slope, 0.1 * 4 * slope * slope);
      }
    }
  }
}

TEST(Multipliers, OneDeepInsideTheOtherHasNoNormal) {
  const Polytope<3> large = shapes::block<3>(shapes::cube<3>(3)), small = unit_cube<3>();
  Random random(94);
  const Matrix<3> turn = matrix(shapes::orientation<3>(random));
  EXPECT_EQ(touch<3>(large, small, turn, Vector<3>::Zero(), by_multipliers).contact.status, ContactStatus::no_normal);
}

// ---- on the central path --------------------------------------------------------------------------------------------

// the value of the program or of its barrier
template <int Dim>
double depth(const ContactGeometry<Dim>& g) {
  return 0.5 * g.overlap * std::sqrt(g.stiffness_factor);
}

// The smoothed overlap is never larger than the unsmoothed one and close to it, so that a force begins at zero.
template <int Dim>
void expect_less_by_the_smoothing(std::uint64_t seed, int pairs) {
  Random random(seed);
  int pressed = 0;
  for (int i = 0; i < pairs; ++i) {
    const Polytope<Dim> a = shapes::block<Dim>(shapes::random_planes<Dim>(random, shapes::integer(random, 0, 8), 0.5)),
                        b = shapes::block<Dim>(shapes::random_planes<Dim>(random, shapes::integer(random, 0, 8), 0.5));
    const Matrix<Dim> turn = matrix(shapes::orientation<Dim>(random));
    const Vector<Dim> along = shapes::direction<Dim>(random);
    const double outside = distance_of_touching<Dim>(a, b, turn, along);
    const double size = std::min(a.inscribed_radius, b.inscribed_radius);
    const Vector<Dim> offset = (outside - shapes::power_of_ten(random, -6, -0.5) * size) * along;
    const Contact<Dim> exact = touch<Dim>(a, b, turn, offset, by_multipliers).contact;
    if (!exact.touching()) continue;
    for (const double fraction : {1e-2, 1e-3, 1e-5}) {
      ContactSettings settings = smoothed;
      settings.smoothing = fraction;
      const Contact<Dim> contact = touch<Dim>(a, b, turn, offset, settings).contact;
      ASSERT_TRUE(contact.touching());
      EXPECT_GT(contact.proof.margin, 0);
      EXPECT_LE(depth<Dim>(contact.geometry), depth<Dim>(exact.geometry) + rounding);
      // each plane adds the logarithm of its distance over the part's diameter at most, near ones that of the smoothing
      const double planes = static_cast<double>(a.faces.size() + b.faces.size());
      EXPECT_GE(depth<Dim>(contact.geometry),
                depth<Dim>(exact.geometry) - fraction * size * (3 * planes + 4 * std::log(1 / fraction)));
      pressed += contact.geometry.overlap > 0;
    }
  }
  EXPECT_GT(pressed, pairs / 3);
}

TEST(CentralPathContact, IsLessDeepByTheSmoothing) {
  expect_less_by_the_smoothing<3>(97, 60);
  expect_less_by_the_smoothing<2>(98, 60);
}

TEST(CentralPathContactLong, IsLessDeepByTheSmoothing) {
  expect_less_by_the_smoothing<3>(97, 300);
  expect_less_by_the_smoothing<2>(98, 300);
}

TEST(CentralPathContact, FaceOnFaceActsInTheMiddleAndMovesAsItRocks) {
  const Polytope<3> cube = unit_cube<3>();
  const Vector<3> offset(0, 0, 0.99);
  const double weight = smoothed.smoothing * cube.inscribed_radius;
  double before = 0;
  for (const double fraction : {0.0, 0.1, 0.3, 1.0, 3.0, 10.0}) {
    const double angle = fraction * weight;
    const Matrix<3> turn = Eigen::AngleAxisd(angle, Vector<3>::UnitY()).toRotationMatrix();
    const ContactGeometry<3> g = touch<3>(cube, cube, turn, offset, smoothed).contact.geometry;
    // the sides have multipliers by their distances, which have no effect
    EXPECT_LT(g.stiffness_factor, 1);
    EXPECT_GT(g.stiffness_factor, 1 - 100 * weight - angle);
    EXPECT_LT((g.normal - Vector<3>::UnitZ()).norm(), angle + 1e-9);
    EXPECT_LE(g.overlap, 0.01 + angle);
    EXPECT_NEAR(g.point[1], 0, 1e-6);
    EXPECT_NEAR(g.area, 1, 0.01);
    // Turned about y, the upper cube's lower face is deepest at large x. The point moves there, until the barriers of
    // the two sides, 2 µ/t each, balance the gain by the tilt, half the sine.
    const double x = std::abs(g.point[0]);
    if (angle > 0) {
      EXPECT_NEAR(2 / (0.5 - x) - 2 / (0.5 + x), 0.5 * fraction, 0.05 * fraction);
      EXPECT_GT(x, before);
    } else {
      EXPECT_NEAR(x, 0, 1e-6);
    }
    before = x;
  }
}

TEST(CentralPathContact, WarmIsCold) {
  const auto solids = shapes::platonic_solids(0.3);
  Random random(99);
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Polytope<3> a = shapes::block<3>(solids[i].planes), b = shapes::block<3>(solids[0].planes);
    const Matrix<3> turn = matrix(shapes::orientation<3>(random));
    const Vector<3> along = shapes::direction<3>(random);
    Contact<3> warm;
    for (const double distance : {0.3, 0.29, 0.28}) {
      const Outcome<3> cold = touch<3>(a, b, turn, distance * along, smoothed),
                       next = touch<3>(a, b, turn, distance * along, smoothed, warm);
      ASSERT_TRUE(cold.contact.touching());
      EXPECT_EQ(next.counters.lp_solves, warm.touching() ? 0 : 1);
      warm = next.contact;
      EXPECT_NEAR(warm.geometry.overlap, cold.contact.geometry.overlap, 1e-9);
      EXPECT_LT((warm.geometry.point - cold.contact.geometry.point).norm(), 1e-6);
      EXPECT_LT((warm.geometry.normal - cold.contact.geometry.normal).norm(), 1e-6);
    }
  }
}

// ---- the force has a potential --------------------------------------------------------------------------------------

constexpr int steps = 8000;

// of the force that a spring of 1 N/m puts on B around a closed path, J
struct Loop {
  double work = 0;
  double with_equal_stiffness = 0;  // if the stiffness were the same for faces, edges and corners
  double force_times_path = 0;
};

// B moves along a small ellipse of translations, and of rotations if it turns, about its place in A
Loop loop_around(const Polytope<3>& a, const Polytope<3>& b, Random& random, double depth, double turning,
                 const ContactSettings& settings) {
  const Matrix<3> start = matrix(shapes::orientation<3>(random));
  const Vector<3> along = shapes::direction<3>(random);
  const double outside = distance_of_touching<3>(a, b, start, along);
  const Vector<3> centre = (outside - depth) * along;
  const Vector<3> u = 0.4 * depth * shapes::direction<3>(random), v = 0.4 * depth * shapes::direction<3>(random);
  const Vector<3> p = turning * shapes::direction<3>(random), q = turning * shapes::direction<3>(random);
  const auto place = [&](double phase) { return Vector<3>(centre + std::cos(phase) * u + std::sin(phase) * v); };
  const auto turned = [&](double phase) {
    const Vector<3> angle = std::cos(phase) * p + std::sin(phase) * q;
    const double size = angle.norm();
    return Matrix<3>(size > 0 ? Eigen::AngleAxisd(size, angle / size).toRotationMatrix() * start : start);
  };
  Loop loop;
  for (int k = 0; k < steps; ++k) {
    const double phase = 2 * std::numbers::pi * k / steps, half = std::numbers::pi / steps;
    const Contact<3> contact = touch<3>(a, b, turned(phase), place(phase), settings).contact;
    if (!contact.touching()) continue;
    // the motion of the contact's point as one of B
    const ContactGeometry<3>& g = contact.geometry;
    const Vector<3> seen = turned(phase).transpose() * (g.point - place(phase));
    const Vector<3> moved =
        place(phase + half) + turned(phase + half) * seen - place(phase - half) - turned(phase - half) * seen;
    loop.work += g.stiffness_factor * g.overlap * g.normal.dot(moved);
    loop.with_equal_stiffness += g.overlap * g.normal.dot(moved);
    loop.force_times_path += g.stiffness_factor * g.overlap * moved.norm();
  }
  return loop;
}

// all pairs of regular polyhedra once, their |work| summed
Loop loops(std::uint64_t seed, double turning, const ContactSettings& settings) {
  Random random(seed);
  const auto solids = shapes::platonic_solids(0.3);
  Loop sum;
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (std::size_t j = i; j < solids.size(); ++j) {
      const Polytope<3> a = shapes::block<3>(solids[i].planes), b = shapes::block<3>(solids[j].planes);
      const Loop loop = loop_around(a, b, random, 0.05, turning, settings);
      sum.work += std::abs(loop.work);
      sum.with_equal_stiffness += std::abs(loop.with_equal_stiffness);
      sum.force_times_path += loop.force_times_path;
    }
  return sum;
}

void expect_a_potential(double turning) {
  // between places where other planes become tight the force is smooth and its integral, by equal steps around a closed
  // path, exact to rounding; there it jumps, and the sum errs by half a step at most: some ten times a loop
  constexpr double allowed = 10 * 0.5 / steps;
  const Loop ours = loops(95, turning, by_multipliers), published = loops(95, turning, by_potential);
  ASSERT_GT(ours.force_times_path, 0);
  EXPECT_LT(ours.work, allowed * ours.force_times_path);
  EXPECT_GT(published.work, 10 * allowed * published.force_times_path);
  EXPECT_GT(ours.with_equal_stiffness, allowed * ours.force_times_path);
  // smoothed, it does not jump
  const Loop smooth = loops(95, turning, smoothed);
  ASSERT_GT(smooth.force_times_path, 0);
  EXPECT_LT(smooth.work, 1e-7 * smooth.force_times_path);
}

TEST(Multipliers, TheForceHasAPotential) {
  expect_a_potential(0);
}
TEST(Multipliers, AndSoHasItsMoment) {
  expect_a_potential(0.05);
}

}  // namespace
}  // namespace voussoir::multipliers_test
