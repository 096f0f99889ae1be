#include "reference/arch/arch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace voussoir::reference::arch_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(RigidArch, IsMilankovitchsForManyVoussoirs) {
  // 0.1075 is rounded to four digits; 1000 voussoirs are within 1e-6 of infinitely many
  EXPECT_NEAR(minimum_thickness({1000, 1, 1}), 0.1075, 5e-5);
  EXPECT_NEAR(minimum_thickness({1000, 1, 1}), minimum_thickness({500, 1, 1}), 1e-5);
}

// Five hinges: outside at the crown, inside at `haunch`, outside at the springing. The half arch turns about its ends:
// moments about them leave one equation for the thickness. Weights and centroids from the corners.
double five_hinge_misfit(const Arch& arch, double thickness, int haunch) {
  const double inside = arch.radius - 0.5 * thickness, outside = arch.radius + 0.5 * thickness;
  double weight = 0, moment = 0, weight_above = 0, moment_above = 0;
  for (int k = arch.voussoirs / 2; k < arch.voussoirs; ++k) {
    const std::vector<Corner> c = voussoir_corners(arch, thickness, k);
    double area = 0, first = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Corner &p = c[i], &q = c[(i + 1) % c.size()];
      area += 0.5 * (p.x * q.y - q.x * p.y);
      first += (p.x + q.x) * (p.x * q.y - q.x * p.y) / 6;
    }
    weight += arch.weight * area;
    moment += arch.weight * first;
    if (k - arch.voussoirs / 2 < haunch) weight_above = weight, moment_above = moment;
  }
  const double angle = haunch * pi / arch.voussoirs;
  // about the springing's outer end, (outside, 0): the thrust acts at the height `outside`
  const double thrust = (weight * outside - moment) / outside;
  return thrust * (outside - inside * std::cos(angle)) - (weight_above * inside * std::sin(angle) - moment_above);
}

TEST(RigidArch, StandsOnFiveHinges) {
  const Arch arch{10, 3, 7};
  const double thickness = minimum_thickness(arch);
  const double scale = arch.weight * std::pow(arch.radius, 3);
  EXPECT_NEAR(five_hinge_misfit(arch, thickness, 3) / scale, 0, 1e-12);  // the joint at 54 degrees
  EXPECT_GT(std::abs(five_hinge_misfit(arch, 1.001 * thickness, 3)) / scale, 1e-6);
}

TEST(RigidArch, HoldsItsThrustLineWhenThick) {
  const Arch arch{15, 5, 1};
  const double least = minimum_thickness(arch);
  EXPECT_GT(best_thrust_line(arch, 1.01 * least).margin, 0);
  EXPECT_LT(best_thrust_line(arch, 0.99 * least).margin, 0);
  EXPECT_NEAR(minimum_thickness({15, 50, 3}), 10 * least, 1e-10);
}

TEST(ElasticArch, TendsToTheRigidArchOnStiffJoints) {
  const Arch arch{11, 5, 25e3};
  const double rigid = minimum_thickness(arch);
  double last = 0;
  for (const double stiffness : {1e12, 1e13, 1e14}) {
    const double added = thinnest_elastic_arch(arch, {stiffness, stiffness}).thickness / rigid - 1;
    EXPECT_GT(added, 0);
    // a tenth of the stiffness adds 10^(1/3) times as much; the next power is relatively as large as the addition
    if (last > 0) {
      EXPECT_NEAR(last / added, std::cbrt(10.0), 2 * last * std::cbrt(10.0));
    }
    last = added;
  }
}

TEST(ElasticArch, DependsOnWeightOverStiffnessOnly) {
  const ElasticArch one = thinnest_elastic_arch({15, 5, 25e3}, {1e11, 1e11}),
                    other = thinnest_elastic_arch({15, 0.7, 50e3}, {2e11, 2e11});
  EXPECT_NEAR(one.thickness / 5, other.thickness / 0.7, 1e-10);
  EXPECT_NEAR(one.drop / 5, other.drop / 0.7, 1e-6);  // the thickness hardly depends on it there
}

TEST(ElasticArch, HasTheThrustOfTheRigidArch) {
  const Arch arch{15, 5, 25e3};
  const ElasticArch limit = thinnest_elastic_arch(arch, {1e14, 1e14});
  const ThrustLine line = best_thrust_line(arch, minimum_thickness(arch));
  EXPECT_NEAR(limit.thrust / line.thrust, 1, 0.005);  // 0.44 % thicker, by the contact length of its hinges
  for (std::size_t k = 0; k < line.radius.size(); ++k)
    EXPECT_NEAR(limit.joints[k].crossing, line.radius[line.radius.size() - 1 - k] - arch.radius,
                0.005 * limit.thickness);
}

TEST(ElasticArch, HasItsStableEquilibriumAboveTheLeastThicknessOnly) {
  const Arch arch{15, 5, 25e3};
  const ArchJoints joints{1e11, 1e11};
  const ElasticArch limit = thinnest_elastic_arch(arch, joints);
  const ElasticArch thicker = elastic_arch(arch, joints, 1.01 * limit.thickness);
  EXPECT_NEAR(thicker.thickness, 1.01 * limit.thickness, 1e-10);
  EXPECT_LT(thicker.drop, limit.drop);
  EXPECT_THROW(elastic_arch(arch, joints, 0.99 * limit.thickness), std::runtime_error);
  EXPECT_THROW(elastic_arch_path({10, 5, 25e3}, joints), std::invalid_argument);
}

TEST(ClosedArch, IsTheHalfArchWhenItsSupportsHaveNotMoved) {
  const Arch arch{15, 5, 25e3};
  const ArchJoints joints{1e11, 1e11};
  const ElasticArch half = elastic_arch(arch, joints, 0.75);
  const ClosedArch whole = closed_arch(arch, joints, 0.75, 0);
  EXPECT_NEAR(whole.thrust / half.thrust, 1, 1e-9);
  for (std::size_t k = 0; k < half.joints.size(); ++k)
    EXPECT_NEAR(whole.joints[k].crossing, half.joints[k].crossing, 1e-9 * arch.radius) << k;
}

// Rigid voussoirs turn about ends of joints: moments about the outer end at the springing and the inner one at the
// haunch give the thrust of the greatest thrust line.
TEST(ClosedArch, HasTheThrustOfItsHingesOnStiffJoints) {
  const Arch arch{20, 5, 25e3};
  const double thickness = 0.75, inside = arch.radius - 0.5 * thickness, outside = inside + thickness;
  const Voussoir stone = voussoir_of(arch, thickness);
  const auto thrust = [&](int haunch) {  // counted in joints from the springing
    double weight = 0, moment = 0;       // of the part between, about the outer end
    for (int k = 0; k < haunch; ++k) {
      weight += stone.weight;
      moment += stone.weight * (outside - stone.centroid * std::cos((k + 0.5) * pi / arch.voussoirs));
    }
    const double angle = haunch * pi / arch.voussoirs, x = outside - inside * std::cos(angle),
                 y = inside * std::sin(angle);
    const double above = 0.5 * arch.voussoirs * stone.weight - weight;
    return (above * x + moment) / y;
  };
  double least = thrust(1);
  for (int haunch = 2; haunch <= arch.voussoirs / 2; ++haunch)
    least = std::min(least, thrust(haunch));
  // A hinge with a rotation imposed by the closing has a contact length that falls with the power -1/2 of the
  // stiffness; the arch has also changed its shape, by the closing over the radius.
  const double closed = 0.002;
  double last = 0;
  for (const double stiffness : {1e12, 1e13, 1e14}) {
    const double off = 1 - closed_arch(arch, {stiffness, stiffness}, thickness, closed).thrust / least;
    EXPECT_GT(off, 0) << stiffness;
    if (last > 0) {
      EXPECT_LT(off, last / std::sqrt(10.0) + 2 * closed / arch.radius) << stiffness;
    }
    last = off;
  }
  EXPECT_LT(last, 0.003);
}

}  // namespace
}  // namespace voussoir::reference::arch_test
