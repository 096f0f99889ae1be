#include "reference/wedge/wedge.hpp"
#include "text/angle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

using Eigen::Matrix3d;
using Eigen::Vector3d;
using voussoir::degree;

namespace voussoir::reference::wedge_test {
namespace {

constexpr double rounding = 1e-11;  // a few hundred rounding units: sums of sines and one 3 x 3 solve

WedgePlane plane(double dip_deg, double dip_direction_deg, double friction_deg = 0) {
  return {dip_deg * degree, dip_direction_deg * degree, friction_deg * degree, 0, 0};
}

Wedge wedge(double dip_a, double direction_a, double dip_b, double direction_b, double friction_deg = 0) {
  return {plane(dip_a, direction_a, friction_deg), plane(dip_b, direction_b, friction_deg), 1, {}};
}

Wedge boon_wedge(double friction_deg = 0) {
  return wedge(40, 130, 60, 220, friction_deg);
}

Vector3d eigen(const Vector3& v) {
  return {v[0], v[1], v[2]};
}

// Plane through the block's foot by a strike and a pole, so that no formula is shared with the code.
Vector3d pole(const WedgePlane& p) {
  const Vector3d east(1, 0, 0), north(0, 1, 0), up(0, 0, 1);
  const Vector3d horizontal = std::cos(p.dip_direction) * north + std::sin(p.dip_direction) * east;
  const Vector3d dip_vector = std::cos(p.dip) * horizontal - std::sin(p.dip) * up;
  const Vector3d strike = horizontal.cross(up);  // right of the dip direction
  return strike.cross(dip_vector).z() > 0 ? strike.cross(dip_vector) : Vector3d(-strike.cross(dip_vector));
}

struct RandomWedges {
  boost::random::mt19937_64 engine{20130412};
  double uniform(double low, double high) { return boost::random::uniform_real_distribution<>(low, high)(engine); }
  Wedge next() { return wedge(uniform(5, 88), uniform(0, 360), uniform(5, 88), uniform(0, 360)); }
};

// --- worked values

TEST(Wedge, BoonSection48) {
  const WedgeSolution s = solve_wedge(boon_wedge());
  EXPECT_NEAR(*critical_friction(boon_wedge()) / degree, 33.357221408834, 1e-11);
  EXPECT_EQ(s.mode, WedgeMode::both_planes);
  EXPECT_EQ(describe(s.mode), "both planes");
  EXPECT_NEAR(s.line_plunge / degree, 37.058, 5e-4);
  EXPECT_NEAR(s.line_trend / degree, 155.848, 5e-4);
  EXPECT_NEAR(s.normal_force_a, 0.673312, 5e-7);
  EXPECT_NEAR(s.normal_force_b, 0.242106, 5e-7);
  EXPECT_NEAR(s.driving_force, 0.602627, 5e-7);
}

// Hoek & Bray's friction-only chart, example 40/165 and 70/285, friction 35 and 20: read off A = 1.5, B = 0.7, F
// = 1.30.
TEST(Wedge, HoekAndBrayChartExample) {
  Wedge w = wedge(40, 165, 70, 285);
  w.a.friction_angle = 35 * degree;
  w.b.friction_angle = 20 * degree;
  const WedgeSolution s = solve_wedge(w);
  EXPECT_NEAR(s.normal_force_a / s.driving_force, 1.5, 0.05);
  EXPECT_NEAR(s.normal_force_b / s.driving_force, 0.7, 0.05);
  EXPECT_NEAR(s.factor_of_safety, 1.30, 0.03);
}

// Wyllie & Mah (2004), Rock Slope Engineering, chapter 7: 45/105 and 70/235, face 65/185, top 12/195, H 40 m, c 24 and
// 48 kPa, friction 30 and 20, 25 and 9.81 kN/m3: F = .241 + .494 + .893 - .376 + .342 - .244 = 1.35 wet. X and Y are
// coded here from their angles.
TEST(Wedge, HoekAndBrayCohesionAndWater) {
  Wedge w = wedge(45, 105, 70, 235);
  const Vector3d n_a = pole(w.a), n_b = pole(w.b), face = pole(plane(65, 185)), top = pole(plane(12, 195));
  auto angle_cosine = [](const Vector3d& p, const Vector3d& q) { return p.normalized().dot(q.normalized()); };
  auto sine = [&](const Vector3d& p, const Vector3d& q) { return p.normalized().cross(q.normalized()).norm(); };
  const Vector3d line1 = n_a.cross(face), line2 = n_b.cross(face), line3 = n_a.cross(top), line4 = n_b.cross(top),
                 line5 = n_a.cross(n_b);
  const double x = std::abs(sine(line2, line4) / (sine(line4, line5) * angle_cosine(line2, n_a)));
  const double y = std::abs(sine(line1, line3) / (sine(line3, line5) * angle_cosine(line1, n_b)));
  EXPECT_NEAR(x, 3.336, 0.07);  // the book rounds its angles to whole degrees: half a degree in 25 is 2 %
  EXPECT_NEAR(y, 3.429, 0.07);

  const double unit_weight = 25, water = 9.81, height = 40;
  w.a.friction_angle = 30 * degree;
  w.b.friction_angle = 20 * degree;
  const double driving = solve_wedge(w).driving_force;
  w.a.cohesion_force = 24 * 3 * x / (unit_weight * height) * driving;
  w.b.cohesion_force = 48 * 3 * y / (unit_weight * height) * driving;
  const WedgeSolution dry = solve_wedge(w);
  EXPECT_NEAR(dry.normal_force_a / driving * std::tan(30 * degree), 0.893, 0.005);
  EXPECT_NEAR(dry.normal_force_b / driving * std::tan(20 * degree), 0.342, 0.005);
  w.a.uplift_force = water * x / (2 * unit_weight) * driving;
  w.b.uplift_force = water * y / (2 * unit_weight) * driving;
  EXPECT_NEAR(solve_wedge(w).factor_of_safety, 1.35, 0.01);
}

// --- limits

TEST(Wedge, SymmetricWedge) {
  // Both planes dip d, dip directions p either side of north: N = W cos(plunge) / (2 sin(xi/2)), xi between the faces.
  for (const double dip : {30.0, 50.0, 70.0})
    for (const double half : {20.0, 60.0, 80.0}) {
      const WedgeSolution s = solve_wedge(wedge(dip, half, dip, 360 - half));
      const double plunge = std::atan(std::tan(dip * degree) * std::cos(half * degree));
      const double half_xi = std::acos(std::sin(dip * degree) * std::sin(half * degree));
      EXPECT_NEAR(s.line_plunge, plunge, rounding);
      EXPECT_NEAR(std::sin(s.line_trend), 0, rounding);
      EXPECT_NEAR(s.normal_force_a, std::cos(plunge) / (2 * std::sin(half_xi)), rounding);
      EXPECT_NEAR(s.normal_force_b, s.normal_force_a, rounding);
      EXPECT_NEAR(s.driving_force, std::sin(plunge), rounding);
    }
}

TEST(Wedge, SinglePlaneSlidesDownItsDip) {
  // B dips the same way as A but more steeply: the block separates from B and slides down A.
  const Wedge w = wedge(35, 180, 70, 190);
  const WedgeSolution s = solve_wedge(w);
  EXPECT_EQ(s.mode, WedgeMode::plane_a);
  EXPECT_EQ(s.normal_force_b, 0);
  EXPECT_NEAR(*critical_friction(w) / degree, 35, rounding);
  EXPECT_NEAR((eigen(s.sliding_direction) - eigen(down_dip(35 * degree, 180 * degree))).norm(), 0, rounding);
  EXPECT_EQ(solve_wedge(wedge(70, 190, 35, 180)).mode, WedgeMode::plane_b);
}

TEST(Wedge, ExtremesOfStrengthAndLoad) {
  EXPECT_EQ(solve_wedge(boon_wedge(0)).factor_of_safety, 0);

  // horizontal line of intersection: no driving force
  const WedgeSolution ridge = solve_wedge(wedge(45, 90, 45, 270, 30));
  EXPECT_GT(ridge.factor_of_safety, 1e10);  // a rounding of the driving force may remain

  // a lift larger than the weight
  Wedge lifted = boon_wedge(30);
  lifted.extra_force = {0, 0, 2};
  EXPECT_EQ(solve_wedge(lifted).mode, WedgeMode::lifts_off);
  EXPECT_EQ(solve_wedge(lifted).factor_of_safety, 0);
  EXPECT_FALSE(critical_friction(lifted).has_value());

  // cohesion alone
  Wedge glued = boon_wedge();
  glued.a.cohesion_force = 1;
  EXPECT_EQ(*critical_friction(glued), 0);
}

TEST(Wedge, UpliftReducesItsOwnNormalForceOnly) {
  Wedge w = boon_wedge(40);
  const WedgeSolution dry = solve_wedge(w);
  w.a.uplift_force = 0.1;
  const WedgeSolution wet = solve_wedge(w);
  EXPECT_NEAR(wet.normal_force_a, dry.normal_force_a - 0.1, rounding);
  EXPECT_NEAR(wet.normal_force_b, dry.normal_force_b, rounding);
  EXPECT_NEAR(wet.driving_force, dry.driving_force, rounding);
}

// --- second derivations

// Hoek & Bray's wedge factor: F = [sin beta / sin(xi/2)] tan(phi) / tan(plunge), from angles in the section across the
// line.
TEST(Wedge, HoekAndBrayWedgeFactor) {
  RandomWedges random;
  int both = 0;
  for (int i = 0; i < 2000; ++i) {
    const Wedge w = random.next();
    const WedgeSolution s = solve_wedge(w);
    if (s.mode != WedgeMode::both_planes || s.line_plunge < 1 * degree) continue;
    ++both;
    const double trend = s.line_trend, plunge = s.line_plunge;
    const Vector3d line(std::cos(plunge) * std::sin(trend), std::cos(plunge) * std::cos(trend), -std::sin(plunge));
    const Vector3d across(std::cos(trend), -std::sin(trend), 0), section_up = across.cross(line);
    auto trace_angle = [&](const WedgePlane& p) {  // of the face's trace, going up, from `across`
      const Vector3d trace = pole(p).cross(line);
      const double sign = trace.dot(section_up) < 0 ? -1 : 1;
      return std::atan2(sign * trace.dot(section_up), sign * trace.dot(across));
    };
    const double first = trace_angle(w.a), second = trace_angle(w.b);
    const double xi = std::abs(first - second), beta = (first + second) / 2;
    const double factor = std::sin(beta) / std::sin(xi / 2);
    const double expected = std::atan(std::tan(plunge) / factor);
    EXPECT_NEAR(*critical_friction(w), expected, 1e-9) << i;
  }
  EXPECT_GT(both, 200);
}

// Equilibrium of forces as a 3 x 3 system in N_A, N_B and the mobilised strength, any friction, cohesion, water, load.
TEST(Wedge, EquilibriumSolvedNumerically) {
  RandomWedges random;
  int both = 0, one = 0, none = 0;
  for (int i = 0; i < 2000; ++i) {
    Wedge w = random.next();
    w.weight = random.uniform(0.5, 5);
    w.extra_force = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    for (WedgePlane* p : {&w.a, &w.b}) {
      p->friction_angle = random.uniform(5, 50) * degree;
      p->cohesion_force = random.uniform(0, 1);
      p->uplift_force = random.uniform(0, 1);
    }
    const WedgeSolution s = solve_wedge(w);
    const Vector3d n_a = pole(w.a), n_b = pole(w.b);
    const Vector3d active =
        Vector3d(0, 0, -w.weight) + eigen(w.extra_force) + w.a.uplift_force * n_a + w.b.uplift_force * n_b;
    if (s.mode == WedgeMode::both_planes) {
      ++both;
      Matrix3d columns;
      columns << n_a, n_b, -n_a.cross(n_b).normalized();
      const Vector3d forces = columns.fullPivLu().solve(-active);
      const double size = forces.norm();
      EXPECT_NEAR(s.normal_force_a, forces.x(), 1e-9 * size);
      EXPECT_NEAR(s.normal_force_b, forces.y(), 1e-9 * size);
      EXPECT_NEAR(s.driving_force, std::abs(forces.z()), 1e-9 * size);
      const double strength = w.a.cohesion_force + w.b.cohesion_force + forces.x() * std::tan(w.a.friction_angle) +
                              forces.y() * std::tan(w.b.friction_angle);
      EXPECT_NEAR(s.factor_of_safety * s.driving_force, strength, 1e-9 * (1 + strength));
    } else if (s.mode == WedgeMode::lifts_off) {
      ++none;
      EXPECT_GE(active.dot(n_a), 0);
      EXPECT_GE(active.dot(n_b), 0);
    } else {
      // sliding must move away from the other plane, and press on its own
      ++one;
      const bool on_a = s.mode == WedgeMode::plane_a;
      EXPECT_GE(eigen(s.sliding_direction).dot(on_a ? n_b : n_a), 0);
      EXPECT_NEAR(eigen(s.sliding_direction).dot(on_a ? n_a : n_b), 0, rounding);
      const Vector3d balance = active + (on_a ? s.normal_force_a * n_a : s.normal_force_b * n_b) -
                               s.driving_force * eigen(s.sliding_direction);
      EXPECT_NEAR(balance.norm(), 0, rounding * active.norm());
    }
  }
  EXPECT_GT(both, 100);
  EXPECT_GT(one, 100);
  EXPECT_GT(none, 10);
}

TEST(Wedge, CriticalFrictionGivesAFactorOfOne) {
  RandomWedges random;
  for (int i = 0; i < 500; ++i) {
    Wedge w = random.next();
    w.a.cohesion_force = random.uniform(0, 0.1);
    const double critical = *critical_friction(w);
    w.a.friction_angle = w.b.friction_angle = critical;
    EXPECT_TRUE(critical == 0 || std::abs(solve_wedge(w).factor_of_safety - 1) < 1e-10) << i;
  }
}

// --- scaling and symmetry

TEST(Wedge, IsIndependentOfWeightRotationAndNames) {
  RandomWedges random;
  for (int i = 0; i < 500; ++i) {
    const Wedge w = random.next();
    const double critical = *critical_friction(w);
    Wedge heavy = w;
    heavy.weight = 1e9;
    EXPECT_NEAR(*critical_friction(heavy), critical, 1e-10);
    Wedge turned = w;
    const double turn = random.uniform(-7, 7);
    turned.a.dip_direction += turn;
    turned.b.dip_direction += turn;
    EXPECT_NEAR(*critical_friction(turned), critical, 1e-9);
    const WedgeSolution straight = solve_wedge(w), swapped = solve_wedge({w.b, w.a, w.weight, {}});
    EXPECT_NEAR(swapped.normal_force_a, straight.normal_force_b, 1e-10);
    EXPECT_NEAR(swapped.normal_force_b, straight.normal_force_a, 1e-10);
    EXPECT_NEAR(swapped.line_plunge, straight.line_plunge, 1e-10);
  }
}

// --- classification and errors

TEST(Wedge, Classification) {
  EXPECT_TRUE(classify_wedge(boon_wedge()).non_degenerate);
  EXPECT_NE(classify_wedge(wedge(45, 90, 45, 268)).reason.find("plunges"), std::string::npos);
  EXPECT_FALSE(classify_wedge(wedge(45, 90, 50, 95)).non_degenerate);

  RandomWedges random;
  int kept_both = 0, kept_one = 0;
  for (int i = 0; i < 5000; ++i) {
    const Wedge w = random.next();
    const WedgeClass c = classify_wedge(w);
    EXPECT_EQ(c.non_degenerate, c.reason.empty());
    EXPECT_EQ(classify_wedge({w.b, w.a, 7.0, {}}).non_degenerate, c.non_degenerate);
    const WedgeSolution s = solve_wedge(w);
    if (!c.non_degenerate) continue;
    (s.mode == WedgeMode::both_planes ? kept_both : kept_one) += 1;
    EXPECT_GE(s.line_plunge, 15 * degree);
    EXPECT_GE(s.normal_force_a + s.normal_force_b, 0.05);
  }
  EXPECT_GT(kept_both, 500);
  EXPECT_GT(kept_one, 100);
}

TEST(Wedge, RefusesBadInput) {
  EXPECT_THROW(solve_wedge(wedge(40, 130, 40, 130)), std::invalid_argument);
  EXPECT_THROW(solve_wedge(wedge(100, 130, 40, 130)), std::invalid_argument);
  EXPECT_THROW(solve_wedge(wedge(40, 130, 60, 220, 90.1)), std::invalid_argument);
  Wedge w = boon_wedge();
  w.weight = 0;
  EXPECT_THROW(solve_wedge(w), std::invalid_argument);
  w.weight = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(solve_wedge(w), std::invalid_argument);
  w = boon_wedge();
  w.b.uplift_force = -1;
  EXPECT_THROW(solve_wedge(w), std::invalid_argument);
}

}  // namespace
}  // namespace voussoir::reference::wedge_test
