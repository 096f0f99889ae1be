// Point, value, normal and overlap against closed forms; the end of each query; warm starts.
#include "core/potential/contact.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/potential/surface.hpp"
#include "core/testing/potential_pairs.hpp"
#include "core/testing/potential_referee.hpp"

namespace voussoir::contact_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int Dim>
PotentialShape<Dim> sphere(double radius) {
  PotentialShape<Dim> shape;
  shape.corner_radius = shape.sphericity = 1;
  shape.sphere_radius = radius;
  return shape;
}

// k = 1: on the line of centres, equally deep in both relative to their sizes; value (D / (R_A + R_B))² - 1
template <int Dim>
void expect_spheres() {
  shapes::Random random(286);
  PotentialWorkspace<Dim> workspace;
  for (int i = 0; i < 2000; ++i) {
    const double a = shapes::power_of_ten(random, -2, 0), b = shapes::power_of_ten(random, -2, 0), size = a + b;
    const PotentialShape<Dim> first = sphere<Dim>(a), second = sphere<Dim>(b);
    const double depth = shapes::power_of_ten(random, -9, -1) * size, distance = size - depth;
    const Vector<Dim> normal = shapes::direction<Dim>(random);
    const PotentialPair<Dim> pair{&first, &second, matrix(shapes::orientation<Dim>(random)), distance * normal};
    const PotentialContact<Dim> c = resolve<Dim>(pair, PotentialQuery::overlap, workspace);
    ASSERT_EQ(c.status, PotentialStatus::touching);
    const double ulps = 8 * epsilon * size;
    ASSERT_LE((c.point - a / size * pair.offset).norm(), ulps);
    // gradients turn, and values change, by the point's displacement over the radius
    ASSERT_LE((c.normal - normal).norm() * std::min(a, b), ulps);
    ASSERT_NEAR(c.overlap, depth, ulps);
    ASSERT_NEAR(c.value, (distance / size) * (distance / size) - 1, 2 * ulps / std::min(a, b));
  }
}
// Eq. A.3
TEST(PotentialContact, OfSpheresIsTheClosedForm) {
  expect_spheres<2>();
  expect_spheres<3>();
}

// Two equal cubes face to face along x, whose only curvature across is that of the spheres: by symmetry half way.
template <int Dim>
void expect_faces() {
  PotentialWorkspace<Dim> workspace;
  for (const double r : {1e-4, 1e-2, 0.3})
    for (const double k : {1e-4, 0.01, 0.3, 0.9}) {
      PotentialShape<Dim> cube{shapes::cube<Dim>(0.5), r, k};
      cube.sphere_radius = enclosing_radius<Dim>(cube.planes, r, Vector<Dim>::Zero());
      // the face's middle is at (1 - k) s² / r² + k (1/2 + s)² / R² = 1
      const double p = (1 - k) / (r * r), q = k / (cube.sphere_radius * cube.sphere_radius);
      const double s = (1 - q / 4) / (q / 2 + std::sqrt(q * q / 4 + (p + q) * (1 - q / 4)));
      const double depth = 0.1 * r;
      PotentialPair<Dim> pair{&cube, &cube};
      pair.offset[0] = 1 + 2 * s - depth;
      const PotentialContact<Dim> c = resolve<Dim>(pair, PotentialQuery::overlap, workspace);
      ASSERT_EQ(c.status, PotentialStatus::touching);
      EXPECT_LE((c.point - pair.offset / 2).norm(), 16 * epsilon);
      EXPECT_LE((c.normal - Vector<Dim>::Unit(0)).norm(), 16 * epsilon);
      EXPECT_NEAR(c.overlap, depth, 16 * epsilon);
      EXPECT_NEAR(c.ratio, 1, 16 * epsilon / r);
    }
}
// Eq. A.3
TEST(PotentialContact, OfTwoCubesFaceToFaceIsHalfWay) {
  expect_faces<2>();
  expect_faces<3>();
}

// k = 0, radii r_A and r_B: corner down on a face. Across both, Q = t²/r²: t_A : t_B = r_A : r_B, and the distance
// between the inner bodies' corner and face is G = t_A + t_B.
TEST(PotentialContact, OfACornerOnAFaceWithoutSpheres) {
  PotentialWorkspace<3> workspace;
  const Matrix<3> corner_down = matrix(rotation_onto(Vector<3>(1, 1, 1), Vector<3>(0, 0, -1)));
  for (const double r_a : {1e-3, 0.1})
    for (const double r_b : {1e-3, 0.02}) {
      const PotentialShape<3> block{shapes::box<3>({-2, -2, -1}, {2, 2, 0}), r_a, 0, 10, {0, 0, -0.5}};
      const PotentialShape<3> cube{shapes::cube<3>(0.5), r_b, 0, 10};
      const double depth = 0.1 * std::min(r_a, r_b), gap = r_a + r_b - depth;
      const PotentialPair<3> pair{&block, &cube, corner_down, {0.3, -0.2, gap + std::sqrt(0.75)}};
      const PotentialContact<3> c = resolve<3>(pair, PotentialQuery::overlap, workspace);
      ASSERT_EQ(c.status, PotentialStatus::touching);
      EXPECT_LE((c.point - Vector<3>(0.3, -0.2, gap * r_a / (r_a + r_b))).norm(), 1e-14);
      EXPECT_LE((c.normal - Vector<3>::UnitZ()).norm(), 1e-14 / r_b);
      EXPECT_NEAR(c.overlap, depth, 1e-14);
      EXPECT_NEAR(c.value, std::pow(gap / (r_a + r_b), 2) - 1, 1e-14 / std::min(r_a, r_b));
      EXPECT_NEAR(c.ratio, r_a / r_b, 1e-9 * c.ratio);
    }
}

// Face on face, r 1e-4 of the size, k = 0.01: the spheres push the point along the faces until it lies, to rounding, on
// the plane of a side, and there λ still has to change. A beam on its abutment from the case `potential_particles`.
TEST(PotentialContact, APlaneThatHoldsThePointIsNotPassedWhenTheRatioChanges) {
  const PotentialShape<2> abutment{{{{-1, 0}, 0.068997688629031162},
                                    {{0, -1}, 0.068997699782780697},
                                    {{0, 1}, 0.93099769978309821},
                                    {{1, 0}, 0.068997688629031134}},
                                   2.3e-6,
                                   0.01,
                                   0.50473825209168366,
                                   {0, 0.43100000000015881}};
  const PotentialShape<2> beam{{{{-1, 0}, 0.11499769883883276},
                                {{0, -1}, 0.022997689569126997},
                                {{0, 1}, 0.022997689569126997},
                                {{1, 6.123233995736766e-17}, 0.022997698838873936}},
                               2.3e-6,
                               0.01,
                               0.072731772575803308,
                               {-0.045999999999979412, 0}};
  PotentialPair<2> pair{&abutment, &beam, {}, {0.18399999959328758, 0.43099998141697304}};
  pair.rotation << 0.99999999999999467, 1.0313114255855637e-07, -1.0313114255855637e-07, 0.99999999999999467;
  PotentialWorkspace<2> workspace;
  const PotentialStart<2> before{{0.068999999188445696, 0.4081011607426171}, 0.99509193396233508};
  for (const PotentialStart<2>& start : {PotentialStart<2>{}, before}) {
    const PotentialContact<2> c = resolve<2>(pair, PotentialQuery::overlap, workspace, start);
    ASSERT_EQ(c.status, PotentialStatus::touching);
    const referee::Verdict<2> truth = referee::judge<2>(pair, c.point, c.ratio, 1e-20);
    ASSERT_TRUE(truth.proven);
    EXPECT_LE(truth.distance_to(c.point), 1e-16);
  }
}

// Inner bodies that overlap, so that λ is found in many changes: the tolerance of the descent between them halves each
// time, and finally falls below rounding. Pair 23842 of the long test, without the planes that have no effect.
TEST(PotentialContact, ADescentEndsAtRounding) {
  const PotentialShape<3> a{
      {{{1, 0, 0}, 1},
       {{-1, 0, 0}, 1},
       {{0, -1, 0}, 0.37156352854501928},
       {{0, 0, -1}, 0.063155847927303513},
       {{0.0019484921520787353, 0.18400838749799539, 0.98292274198368235}, 0.061278076185279931},
       {{-0.03323706829998254, -0.016854667612518789, -0.99930536747807652}, 0.054019393405831298}},
      0.0010621773734259083,
      0.065420170014490631,
      1.2489529903987535};
  const PotentialShape<3> b{
      {{{-1, 0, 0}, 1},
       {{0, 1, 0}, 0.69787948481279749},
       {{0, 0, 1}, 0.08542290080102756},
       {{0.73238549979389966, 0.017695618217658284, -0.68066022712329433}, 0.38839484821565501},
       {{-0.32377168731925487, -0.7315602215520115, 0.59999294723622743}, 0.45248368002250416},
       {{-0.041765930584278535, -0.049874389345790276, -0.99788183284886678}, 0.073911247917144152}},
      0.00075511124587342464,
      0.065113821756985366,
      1.4281180549737869};
  PotentialPair<3> pair{&a, &b, {}, {-1.4468415468662863, -1.3218054226147631, -0.62634410788117689}};
  pair.rotation << 0.22776258654039316, 0.94336058867622041, 0.24123640667379581,  //
      -0.77167091083682715, 0.32596914267192445, -0.5461392893703878,              //
      -0.59384190618437471, -0.061765020506639401, 0.80220749977865635;
  PotentialWorkspace<3> workspace;
  const PotentialContact<3> c = resolve<3>(pair, PotentialQuery::least, workspace);
  ASSERT_EQ(c.status, PotentialStatus::touching);
  const referee::Verdict<3> truth = referee::judge<3>(pair, c.point, c.ratio, 1e-26);
  ASSERT_TRUE(truth.proven);
  EXPECT_LE(truth.distance_to(c.point), 1e-14);
}

// Squares (cubes) face on face, side by side by some of their length, turned so far that the contact has come to one
// side of the second one's face and lies, to rounding, on the plane of that side: there the second derivative jumps.
template <int Dim>
struct TurnedOnItsSide {
  PotentialShape<Dim> cube;
  PotentialPair<Dim> pair;
  double depth;
  PotentialWorkspace<Dim> workspace;

  TurnedOnItsSide(shapes::Random& random) {
    cube.corner_radius = shapes::power_of_ten(random, -4, -1) / 2;
    cube.sphericity = shapes::power_of_ten(random, -2, -0.05);
    cube.planes = shapes::cube<Dim>(0.5 - cube.corner_radius);
    cube.sphere_radius = enclosing_radius<Dim>(cube.planes, cube.corner_radius, Vector<Dim>::Zero());
    pair = {&cube, &cube};
    pair.offset[1] = shapes::uniform(random, 0.2, 0.8);
    depth = shapes::power_of_ten(random, -4, 0) * cube.corner_radius;
  }
  void turn(double angle) {
    pair.rotation.template topLeftCorner<2, 2>() = Eigen::Rotation2Dd(angle).toRotationMatrix();
    PlacedPotential<Dim> turned;
    place<Dim>(cube, pair.rotation, Vector<Dim>::Zero(), turned);
    const Vector<Dim> ahead = Vector<Dim>::Unit(0);
    pair.offset[0] = find_support<Dim>(placed<Dim>(cube), ahead, workspace.ray).point[0] -
                     find_support<Dim>(turned, -ahead, workspace.ray).point[0] - depth;
  }
  // the distance of the contact beyond the second one's plane towards -y
  double beyond_side(double angle) {
    turn(angle);
    const PotentialContact<Dim> c = resolve<Dim>(pair, PotentialQuery::least, workspace);
    double slack = 0;
    for (std::size_t i = 0; i < cube.planes.size(); ++i)
      if (cube.planes[i].normal[1] < 0) slack = signed_distance<Dim>(workspace.b.planes[i], c.point);
    return slack;
  }
};

template <int Dim>
void expect_answers_where_a_plane_begins() {
  shapes::Random random(292);
  int found = 0;
  for (int i = 0; i < 40; ++i) {
    TurnedOnItsSide<Dim> c(random);
    double inside = 0, outside = 0.2;
    if (c.beyond_side(outside) < 0) outside = -outside;
    if (c.beyond_side(outside) < 0) continue;
    ++found;
    for (int k = 0; k < 50; ++k) {
      const double middle = (inside + outside) / 2;
      (c.beyond_side(middle) > 0 ? outside : inside) = middle;
    }
    PotentialStart<Dim> before;
    for (const double factor : {1 - 1e-3, 1 - 1e-9, 1.0, 1 + 1e-9}) {
      c.turn(factor * inside);
      for (const PotentialStart<Dim>& start : {PotentialStart<Dim>{}, before}) {
        const PotentialContact<Dim> one = resolve<Dim>(c.pair, PotentialQuery::least, c.workspace, start);
        ASSERT_NE(one.status, PotentialStatus::no_answer) << i << " " << factor;
        const referee::Verdict<Dim> truth = referee::judge<Dim>(c.pair, one.point, one.ratio, 1e-26);
        ASSERT_TRUE(truth.proven) << i << " " << factor;
        EXPECT_LE(truth.distance_to(one.point), 1e-9) << i << " " << factor;
        before = {one.point, one.ratio};
      }
    }
  }
  EXPECT_GT(found, 30);
}
TEST(PotentialContact, HasAResultOnAPlane) {
  expect_answers_where_a_plane_begins<2>();
  expect_answers_where_a_plane_begins<3>();
}

TEST(PotentialContact, OneCentreOnTheOtherHasNoNormal) {
  PotentialWorkspace<3> workspace;
  const PotentialShape<3> a = sphere<3>(1), b = sphere<3>(0.5);
  const PotentialPair<3> pair{&a, &b};
  EXPECT_EQ(resolve<3>(pair, PotentialQuery::overlap, workspace).status, PotentialStatus::no_normal);
  EXPECT_EQ(resolve<3>(pair, PotentialQuery::decision, workspace).status, PotentialStatus::touching);
}

TEST(PotentialContact, InnerBodiesThatOverlapHaveNoNormalWithoutSpheres) {
  PotentialWorkspace<3> workspace;
  const PotentialShape<3> cube{shapes::cube<3>(0.5), 1e-3, 0, 2};
  const PotentialPair<3> pair{&cube, &cube, Matrix<3>::Identity(), {0.9, 0.1, 0.2}};
  const PotentialContact<3> c = resolve<3>(pair, PotentialQuery::overlap, workspace);
  EXPECT_EQ(c.status, PotentialStatus::no_normal);
  EXPECT_NEAR(c.value, -1, epsilon);
}

template <int Dim>
void expect_overlap_on_the_surfaces() {
  shapes::Random random(287);
  PotentialWorkspace<Dim> workspace;
  for (int i = 0; i < 300; ++i) {
    const shapes::PotentialCase<Dim> c = shapes::random_potential_case<Dim>(random, 0.01);
    const PotentialContact<Dim> found = resolve<Dim>(c.pair(), PotentialQuery::overlap, workspace);
    ASSERT_EQ(found.status, c.depth > 0 ? PotentialStatus::touching : PotentialStatus::separated);
    if (c.depth < 0) continue;
    // both ends lie on the surfaces; the weighted gradients cancel; no line is shorter than the least depth, which is
    // no more than that along the normal the pair was made for
    const double ahead = distance_to_surface<Dim>(workspace.a, found.point, found.normal);
    const double behind = distance_to_surface<Dim>(workspace.b, found.point, -found.normal);
    ASSERT_EQ(found.overlap, ahead + behind);
    const Vector<Dim> end_a = found.point + ahead * found.normal, end_b = found.point - behind * found.normal;
    ASSERT_NEAR(value<Dim>(workspace.a, end_a), 0, 2 * value_rounding<Dim>(workspace.a, end_a));
    ASSERT_NEAR(value<Dim>(workspace.b, end_b), 0, 2 * value_rounding<Dim>(workspace.b, end_b));
    const Vector<Dim> of_a = derivatives<Dim>(workspace.a, found.point).gradient;
    const Vector<Dim> of_b = derivatives<Dim>(workspace.b, found.point).gradient;
    const double rounding = 8 * epsilon * (found.ratio * workspace.a.plane_weight + workspace.b.plane_weight);
    ASSERT_LE((found.ratio * of_a + of_b).norm(), 1e-9 * (found.ratio * of_a.norm() + of_b.norm()) + rounding);
  }
}
TEST(PotentialContact, OverlapEndsOnBothSurfacesAlongTheCommonGradient) {
  expect_overlap_on_the_surfaces<2>();
  expect_overlap_on_the_surfaces<3>();
}

// in either order: the same contact, with the normal turned round
template <int Dim>
void expect_exchange() {
  shapes::Random random(288);
  PotentialWorkspace<Dim> workspace;
  for (int i = 0; i < 300; ++i) {
    const shapes::PotentialCase<Dim> c = shapes::random_potential_case<Dim>(random, 0.01);
    const PotentialPair<Dim> other{&c.b, &c.a, c.rotation.transpose(), -c.rotation.transpose() * c.offset};
    const PotentialContact<Dim> one = resolve<Dim>(c.pair(), PotentialQuery::least, workspace);
    const PotentialContact<Dim> two = resolve<Dim>(other, PotentialQuery::least, workspace);
    ASSERT_EQ(one.status, two.status);
    ASSERT_LE((c.rotation * two.point + c.offset - one.point).norm(), 1e-9);
    ASSERT_NEAR(one.value, two.value, 1e-10 * (2 + one.value) + one.rounding + two.rounding);
  }
}
TEST(PotentialContact, IsTheSameWhicheverComesFirst) {
  expect_exchange<2>();
  expect_exchange<3>();
}

template <int Dim>
void expect_warm_starts() {
  shapes::Random random(289);
  PotentialWorkspace<Dim> workspace;
  int cold_total = 0, warm_total = 0;
  for (int i = 0; i < 300; ++i) {
    shapes::PotentialCase<Dim> c = shapes::random_potential_case<Dim>(random, 0.01);
    const PotentialContact<Dim> before = resolve<Dim>(c.pair(), PotentialQuery::least, workspace);
    c.offset += 0.01 * std::abs(c.depth) * shapes::direction<Dim>(random);
    const PotentialContact<Dim> cold = resolve<Dim>(c.pair(), PotentialQuery::least, workspace);
    const PotentialContact<Dim> warm =
        resolve<Dim>(c.pair(), PotentialQuery::least, workspace, {before.point, before.ratio});
    ASSERT_EQ(cold.status, warm.status);
    ASSERT_LE((cold.point - warm.point).norm(), 1e-9);
    ASSERT_NEAR(cold.value, warm.value, 1e-10 * (2 + cold.value) + cold.rounding);
    cold_total += cold.iterations;
    warm_total += warm.iterations;
  }
  EXPECT_LT(2 * warm_total, cold_total + 600);  // half of the work, apart from the two steps that confirm a result
}
TEST(PotentialContact, AWarmStartGivesTheSameInFewerSteps) {
  expect_warm_starts<2>();
  expect_warm_starts<3>();
}

TEST(PotentialContact, SeparatedPairsEndAtTheFirstProof) {
  shapes::Random random(290);
  PotentialWorkspace<3> workspace;
  int early = 0, full = 0;
  for (int i = 0; i < 200; ++i) {
    shapes::PotentialCase<3> c = shapes::random_potential_case<3>(random, 0);
    c.offset += 0.2 * c.normal;
    const PotentialContact<3> decided = resolve<3>(c.pair(), PotentialQuery::decision, workspace);
    const PotentialContact<3> least = resolve<3>(c.pair(), PotentialQuery::least, workspace);
    ASSERT_EQ(decided.status, PotentialStatus::separated);
    ASSERT_EQ(least.status, PotentialStatus::separated);
    ASSERT_LE(decided.bound, least.value + least.rounding);
    early += decided.iterations;
    full += least.iterations;
  }
  EXPECT_LT(2 * early, full);
}

TEST(PotentialContact, TouchingToRoundingIsUndecided) {
  PotentialWorkspace<2> workspace;
  const PotentialShape<2> a = sphere<2>(1), b = sphere<2>(3);
  const PotentialPair<2> pair{&a, &b, Matrix<2>::Identity(), {4, 0}};
  EXPECT_EQ(resolve<2>(pair, PotentialQuery::overlap, workspace).status, PotentialStatus::undecided);
}

}  // namespace
}  // namespace voussoir::contact_test
