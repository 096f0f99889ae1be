// The joint law at its extremes: turns in any number of steps, forces of any size, paths of any kind. Suites named
// …Long contain the long siblings of the tests before them (`make test-long`).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/joint_laws/elastic_coulomb.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::law_extremes_test {
namespace {

using shapes::Random;

constexpr double pi = std::numbers::pi;
constexpr double ulp = std::numeric_limits<double>::epsilon();

// each step rounds a length a few times; independent roundings add up like a random walk
double walk(long long steps) {
  return 1e-12 + 4 * ulp * std::sqrt(static_cast<double>(steps));
}

// what rounding may leave outside the cone: the product limit/trial times the trial's components, and its norm
constexpr double cone_rounding = 4 * ulp;

// work on closed loops: some thousand products and sums
constexpr double work_tolerance = 1e-10;

// long double has the exponents that squares of 1e±300 need, and more digits than the numbers that it checks
template <int Dim>
long double length(const Vector<Dim>& v) {
  return v.template cast<long double>().norm();
}

template <int Dim>
JointKinematics<Dim> pressed(const Vector<Dim>& normal, double overlap, double area) {
  JointKinematics<Dim> k;
  k.normal = normal;
  k.overlap = overlap;
  k.area = area;
  k.slip.setZero();
  return k;
}

// ---- turns ----------------------------------------------------------------------------------------------------------

// a unit vector at an angle in the plane of two axes
template <int Dim>
Vector<Dim> at_angle(const Vector<Dim>& first, const Vector<Dim>& second, double angle) {
  return std::cos(angle) * first + std::sin(angle) * second;
}

// the joint is pressed and sticks; only its normal turns, once round, and the shear must come back as it was
template <int Dim>
void expect_full_turn(std::uint64_t seed, long long steps) {
  Random random(seed);
  const JointProperties joint{"joint", 2e9, 1e9, 0.5, false};
  const Vector<Dim> start = shapes::direction<Dim>(random);
  const Vector<Dim> second = perpendicular(start);
  Vector<Dim> first = 1e5 * second;
  if constexpr (Dim == 3) first = 1e5 * at_angle<3>(second, start.cross(second), 0.7);
  Vector<Dim> shear = first, normal = start;
  for (long long i = 1; i <= steps; ++i) {
    const Vector<Dim> next = at_angle<Dim>(start, second, 2 * pi * static_cast<double>(i) / static_cast<double>(steps));
    shear = carried(shear, normal, next, 0);
    elastic_coulomb<Dim>(joint, std::tan(0.5), 0, pressed<Dim>(next, 1e-3, 1), shear);
    normal = next;
  }
  EXPECT_LT(std::abs(static_cast<double>(length<Dim>(shear) / length<Dim>(first)) - 1), walk(steps)) << steps;
  EXPECT_LT((shear - first).norm(), 10 * walk(steps) * first.norm()) << steps;
}

TEST(LawExtremes, AFullTurnOfTheNormalInAnyNumberOfSteps) {
  for (const long long steps : {10LL, 100LL, 1'000LL, 10'000LL, 100'000LL, 1'000'000LL}) {
    expect_full_turn<2>(61, steps);
    expect_full_turn<3>(62, steps);
  }
}
TEST(LawExtremesLong, AFullTurnOfTheNormalIn1e7Steps) {
  expect_full_turn<2>(61, 10'000'000);
  expect_full_turn<3>(62, 10'000'000);
}

// a contact that does not move, or whose normal varies in its last digits
template <int Dim>
void expect_standing(std::uint64_t seed, long long steps) {
  Random random(seed);
  for (int trial = 0; trial < 2; ++trial) {
    const Vector<Dim> still = shapes::direction<Dim>(random), trembling = still * (1 + ulp);
    const Vector<Dim> first = 7 * perpendicular(still);
    for (const Vector<Dim>& other : {still, trembling}) {
      Vector<Dim> shear = first;
      for (long long i = 0; i < steps; ++i)
        shear = carried(shear, i % 2 ? other : still, i % 2 ? still : other, 0);
      EXPECT_LT((shear - first).norm(), walk(steps) * first.norm()) << still.transpose();
    }
  }
}

TEST(LawExtremes, AConstantNormalKeepsTheShear) {
  expect_standing<2>(63, 500'000);
  expect_standing<3>(64, 500'000);
}
TEST(LawExtremesLong, AConstantNormalKeepsTheShearFor1e7Steps) {
  expect_standing<2>(63, 10'000'000);
  expect_standing<3>(64, 10'000'000);
}

// the pair spins about the normal and the force turns with it
TEST(LawExtremes, TheForceFollowsTheSpinOfThePair) {
  constexpr double co_rotation = 1e-9;
  Random random(65);
  for (const long long steps : {1LL, 10LL, 1'000LL, 1'000'000LL})
    for (const double angle : {2 * pi, -2.5, 1e-9}) {
      const Vector<3> n = shapes::direction<3>(random);
      const Vector<3> across = perpendicular(n);
      Vector<3> shear = 1e5 * across;
      for (long long i = 0; i < steps; ++i)
        shear = carried(shear, n, n, angle / static_cast<double>(steps));
      const Vector<3> expected = 1e5 * at_angle<3>(across, n.cross(across), angle);
      EXPECT_LT((shear - expected).norm(), co_rotation * 1e5) << steps << " steps, " << angle << " rad";
    }
  // in the plane a spin does not turn a force
  EXPECT_EQ(carried(Vector<2>(0, 3), Vector<2>(1, 0), Vector<2>(1, 0), 0.5), Vector<2>(0, 3));
}

// ---- the return to the cone -----------------------------------------------------------------------------------------

template <int Dim>
void expect_exact_return(std::uint64_t seed) {
  Random random(seed);
  const JointProperties joint{"joint", 2e9, 1e9, 0.5, false};
  for (double excess = 1; excess < 2e12; excess *= 10)
    for (int i = 0; i < 200; ++i) {
      const Vector<Dim> n = shapes::direction<Dim>(random), across = perpendicular(n);
      const double friction = shapes::uniform(random, 0, 1.5), overlap = shapes::power_of_ten(random, -12, -2);
      JointKinematics<Dim> k = pressed<Dim>(n, overlap, shapes::power_of_ten(random, -6, 2));
      const double normal_force = joint.normal_stiffness * k.area * overlap, limit = std::tan(friction) * normal_force;
      // half of the trial is the old force, or all of it comes with the slip
      const double trial = excess * shapes::uniform(random, 1, 1.1) * limit, before = i % 2 ? 0 : trial / 2;
      k.slip = -(trial - before) / (joint.shear_stiffness * k.area) * across;
      Vector<Dim> shear = before * across;
      const JointForce<Dim> answer = elastic_coulomb<Dim>(joint, std::tan(friction), 0, k, shear);
      EXPECT_LE(length<Dim>(shear), limit * (1 + cone_rounding));
      EXPECT_LE((shear - limit * across).norm(), 2 * cone_rounding * limit);
      EXPECT_NEAR(answer.plastic_slip, (trial - limit) / (joint.shear_stiffness * k.area),
                  2 * cone_rounding * trial / (joint.shear_stiffness * k.area));
    }
}

TEST(LawExtremes, TheReturnIsExactFromAnyDistance) {
  expect_exact_return<2>(66);
  expect_exact_return<3>(67);
}

template <int Dim>
void expect_zero_cases(std::uint64_t seed) {
  Random random(seed);
  const Vector<Dim> n = shapes::direction<Dim>(random), across = perpendicular(n);
  JointProperties joint{"joint", 2e9, 1e9, 0.5, false};
  // nothing old, nothing new
  Vector<Dim> shear = Vector<Dim>::Zero();
  EXPECT_EQ(elastic_coulomb<Dim>(joint, std::tan(0.5), 0, pressed<Dim>(n, 1e-3, 1), shear).plastic_slip, 0);
  EXPECT_EQ(shear, Vector<Dim>(Vector<Dim>::Zero()));
  // no normal force, no friction, no area: there can be no shear force
  for (const auto& [friction, overlap, area] : {std::array{0.5, 0.0, 1.0}, {0.0, 1e-3, 1.0}, {0.5, 1e-3, 0.0}})
    for (const double slip : {0.0, 1e-300, 1e-3, 1e3}) {
      shear = 5 * across;
      JointKinematics<Dim> k = pressed<Dim>(n, overlap, area);
      k.slip = slip * across;
      const JointForce<Dim> answer = elastic_coulomb<Dim>(joint, std::tan(friction), 0, k, shear);
      EXPECT_EQ(shear, Vector<Dim>(Vector<Dim>::Zero()));
      EXPECT_TRUE(answer.force.allFinite());
      EXPECT_GE(answer.plastic_slip, 0);
    }
  // no stiffness along the joint: the old force stays within the cone and nothing slips
  joint.shear_stiffness = 0;
  shear = 5 * across;
  JointKinematics<Dim> k = pressed<Dim>(n, 1e-9, 1);
  k.slip = across;
  EXPECT_EQ(elastic_coulomb<Dim>(joint, std::tan(0.5), 0, k, shear).plastic_slip, 0);
  EXPECT_LE(length<Dim>(shear), std::tan(0.5) * 2 * (1 + cone_rounding));
}

TEST(LawExtremes, NothingIsDividedByZero) {
  expect_zero_cases<2>(68);
  expect_zero_cases<3>(69);
}

// ---- closed loops ---------------------------------------------------------------------------------------------------

// Slips there and back between ±amplitude, and once more. Sticking below the limit returns all work; above it every
// cycle dissipates 4 limit (amplitude - limit / stiffness), at any size of the steps.
template <int Dim>
void expect_triangle_loop(std::uint64_t seed, double amplitude_over_limit) {
  Random random(seed);
  const JointProperties joint{"joint", 2e9, 1e9, 0.5, false};
  const Vector<Dim> n = shapes::direction<Dim>(random), across = perpendicular(n);
  const double limit = std::tan(0.5) * joint.normal_stiffness * 1e-4, stiffness = joint.shear_stiffness;
  const double amplitude = amplitude_over_limit * limit / stiffness;
  for (const int quarter : {1, 7, 1000}) {
    Vector<Dim> shear = Vector<Dim>::Zero();
    double dissipated = 0;
    JointKinematics<Dim> k = pressed<Dim>(n, 1e-4, 1);
    const auto slip = [&](int steps, double towards) {
      for (int i = 0; i < steps; ++i) {
        k.slip = towards * amplitude / quarter * across;
        const JointForce<Dim> answer = elastic_coulomb<Dim>(joint, std::tan(0.5), 0, k, shear);
        dissipated += shear.norm() * answer.plastic_slip;
      }
    };
    slip(quarter, 1);
    const Vector<Dim> before = shear;
    dissipated = 0;
    for (int cycle = 0; cycle < 3; ++cycle) {
      slip(2 * quarter, -1);
      slip(2 * quarter, 1);
    }
    const double expected = 3 * 4 * limit * std::max(0.0, amplitude - limit / stiffness);
    EXPECT_NEAR(dissipated, expected, work_tolerance * limit * amplitude) << quarter;
    EXPECT_LE((shear - before).norm(), work_tolerance * limit);
    if (amplitude_over_limit < 1) {
      EXPECT_EQ(dissipated, 0);
    }
  }
}

TEST(LawExtremes, AClosedLoopDissipatesThePlasticWork) {
  for (const double amplitude : {0.5, 0.999, 1.001, 3.0, 1e4}) {
    expect_triangle_loop<2>(70, amplitude);
    expect_triangle_loop<3>(71, amplitude);
  }
}

// Slip round a circle of radius a, N chords a turn. In the steady state the plastic slip runs round a circle of radius
// ρ with a² = ρ² + r² + 2 ρ r sin(π/N), r = limit / stiffness (each chord lies along the force that follows it): a turn
// dissipates limit N 2 ρ sin(π/N), and limit 2 π sqrt(a² - r²) as N grows.
TEST(LawExtremes, ACircularLoopDissipatesThePlasticWork) {
  Random random(72);
  const JointProperties joint{"joint", 2e9, 1e9, 0.5, false};
  const Vector<3> n = shapes::direction<3>(random), first = perpendicular(n), second = n.cross(first);
  const double limit = std::tan(0.5) * joint.normal_stiffness * 1e-4, r = limit / joint.shear_stiffness;
  for (const int chords : {6, 50, 5000})
    for (const double radius : {1.5 * r, 20 * r}) {
      Vector<3> shear = Vector<3>::Zero(), place = radius * first;
      double dissipated = 0, work = 0;
      JointKinematics<3> k = pressed<3>(n, 1e-4, 1);
      const auto turn = [&] {
        dissipated = work = 0;
        for (int i = 1; i <= chords; ++i) {
          const Vector<3> next = radius * at_angle<3>(first, second, 2 * pi * i / chords);
          k.slip = next - place;
          place = next;
          const Vector<3> before = shear;
          const JointForce<3> answer = elastic_coulomb<3>(joint, std::tan(0.5), 0, k, shear);
          dissipated += shear.norm() * answer.plastic_slip;
          work -= 0.5 * (before + shear).dot(k.slip);
        }
      };
      for (int transient = 0; transient < 20; ++transient)
        turn();
      const double s = std::sin(pi / chords), rho = std::sqrt(r * r * s * s + radius * radius - r * r) - r * s;
      const double expected = limit * chords * 2 * rho * s;
      EXPECT_NEAR(dissipated, expected, work_tolerance * expected) << chords;
      if (chords == 5000) {
        const double smooth = limit * 2 * pi * std::sqrt(radius * radius - r * r);
        EXPECT_NEAR(dissipated, smooth, 3 * s * smooth);
        EXPECT_NEAR(work, smooth, 3 * s * smooth);
      }
    }
}

// ---- dissipation ----------------------------------------------------------------------------------------------------

// Random paths with friction that falls, normals that turn, areas and overlaps that change. The plastic slip is found
// again from the forces: total slip less the elastic change of the shear.
template <int Dim>
void expect_no_negative_dissipation(std::uint64_t seed, int paths) {
  Random random(seed);
  double lowest = 0;
  int outside = 0, slipped = 0;
  for (int path = 0; path < paths; ++path) {
    const JointProperties joint{"joint", shapes::power_of_ten(random, 6, 11), shapes::power_of_ten(random, 6, 11), 0,
                                false};
    Vector<Dim> normal = shapes::direction<Dim>(random), shear = Vector<Dim>::Zero();
    double friction = shapes::uniform(random, 0, 1.5), overlap = shapes::power_of_ten(random, -9, -3), area = 1;
    for (int step = 0; step < 8; ++step) {
      const Vector<Dim> next =
          (normal + shapes::power_of_ten(random, -8, 0) * shapes::direction<Dim>(random)).normalized();
      shear = carried(shear, normal, next, shapes::uniform(random, -1, 1));
      normal = next;
      friction *= shapes::uniform(random, 0.5, 1);
      area *= shapes::uniform(random, 0.5, 1.5);
      overlap *= shapes::uniform(random, 0, 2);
      JointKinematics<Dim> k = pressed<Dim>(normal, overlap, area);
      const Vector<Dim> motion = shapes::power_of_ten(random, -3, 2) * overlap * shapes::direction<Dim>(random);
      k.slip = motion - normal.dot(motion) * normal;
      const Vector<Dim> before = shear;
      const JointForce<Dim> answer = elastic_coulomb<Dim>(joint, std::tan(friction), 0, k, shear);

      const double stiffness = joint.shear_stiffness * area;
      const Vector<Dim> plastic = k.slip + (shear - before) / stiffness;
      const double size = shear.norm() * (before.norm() / stiffness + k.slip.norm());
      if (size > 0) lowest = std::min(lowest, -shear.dot(plastic) / size);
      outside += shear.norm() > std::tan(friction) * joint.normal_stiffness * area * overlap * (1 + cone_rounding);
      slipped += answer.plastic_slip > 0;
      ASSERT_GE(answer.plastic_slip, 0);
      ASSERT_NEAR(answer.plastic_slip, plastic.norm(), 8 * ulp * (before.norm() / stiffness + k.slip.norm()));
    }
  }
  EXPECT_GE(lowest, -8 * ulp);  // the sum above is rounded, the law's own number is never negative
  EXPECT_EQ(outside, 0);
  EXPECT_GT(slipped, paths);
}

TEST(LawExtremes, DissipationIsNeverNegative) {
  expect_no_negative_dissipation<2>(73, 100'000);
  expect_no_negative_dissipation<3>(74, 100'000);
}
TEST(LawExtremesLong, DissipationIsNeverNegativeOn1e6Paths) {
  expect_no_negative_dissipation<2>(75, 1'000'000);
  expect_no_negative_dissipation<3>(76, 1'000'000);
}

// ---- sizes ----------------------------------------------------------------------------------------------------------

template <int Dim>
void expect_any_size(std::uint64_t seed) {
  Random random(seed);
  for (double ratio = 1; ratio < 2e6; ratio *= 10)
    for (int power = -300; power <= 140; power += 10)  // N; beyond, the energy F²/k is no number
      for (int i = 0; i < 4; ++i) {
        const JointProperties joint{"joint", 1e10, 1e10 / ratio, 0, false};
        const Vector<Dim> n = shapes::direction<Dim>(random);
        const double normal_force = std::pow(10, power), friction = shapes::uniform(random, 0, 1.5);
        JointKinematics<Dim> k = pressed<Dim>(n, normal_force / joint.normal_stiffness, 1);
        // a slip about as large as the overlap, a thousand times as large, or none of it
        k.slip = std::array{0.0, 1e-3, 1.0, 1e3}[i] * k.overlap * perpendicular(n);
        Vector<Dim> shear = 0.3 * normal_force * perpendicular(n);
        shear = carried(shear, n, n, 0.1);
        const JointForce<Dim> answer = elastic_coulomb<Dim>(joint, std::tan(friction), 0, k, shear);
        ASSERT_TRUE(shear.allFinite() && answer.force.allFinite() && std::isfinite(answer.plastic_slip));
        const long double limit = std::tan(friction) * normal_force;
        ASSERT_LE(length<Dim>(shear), limit * (1 + cone_rounding)) << "1e" << power << " N, kn/ks " << ratio;
        ASSERT_GE(answer.plastic_slip, 0);
        // inside the cone nothing is lost
        if (i == 0 && limit > 0.31L * normal_force) {
          ASSERT_NEAR(static_cast<double>(length<Dim>(shear) / normal_force), 0.3, 10 * cone_rounding);
        }
      }
}

TEST(LawExtremes, ForcesOfAnySizeStayFiniteAndInsideTheCone) {
  expect_any_size<2>(77);
  expect_any_size<3>(78);
}

template <int Dim>
void expect_no_pull(std::uint64_t seed) {
  Random random(seed);
  const JointProperties joint{"joint", 2e9, 1e9, 0.5, false};
  int released = 0;
  for (const double ratio : {0.0, 1e-6, 0.1, 1.0, 10.0, 1000.0})
    for (int i = 0; i < 1000; ++i) {
      const Vector<Dim> n = shapes::direction<Dim>(random);
      JointKinematics<Dim> k = pressed<Dim>(n, shapes::power_of_ten(random, -12, -2), 1);
      k.closing_speed = shapes::uniform(random, -1, 1) * shapes::power_of_ten(random, -6, 3);
      k.slip = 1e-3 * shapes::power_of_ten(random, -6, 0) * perpendicular(n);
      const double dashpot = 2 * ratio * std::sqrt(joint.normal_stiffness * shapes::power_of_ten(random, -3, 9));
      Vector<Dim> shear = Vector<Dim>::Zero();
      const JointForce<Dim> answer = elastic_coulomb<Dim>(joint, std::tan(0.5), dashpot, k, shear);
      const Vector<Dim> along = answer.force - shear;
      EXPECT_GE(along.dot(n), 0);
      released += along.isZero(0);
      // when the dashpot would pull there is no force at all, shear included
      if (along.isZero(0)) {
        EXPECT_TRUE(shear.isZero(0));
      }
    }
  EXPECT_GT(released, 500);
}

TEST(LawExtremes, NoDashpotPulls) {
  expect_no_pull<2>(79);
  expect_no_pull<3>(80);
}

}  // namespace
}  // namespace voussoir::law_extremes_test
