#include "core/support/lining.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/joint_laws/joint_law.hpp"

namespace voussoir::lining_test {
namespace {

constexpr double pi = std::numbers::pi;

// a regular polygon about the origin that a circle touches, its first corner to the right
std::vector<LiningSide> polygon(int sides, double radius) {
  std::vector<LiningSide> all;
  const double length = 2 * radius * std::tan(pi / sides), reach = radius / std::cos(pi / sides);
  for (int k = 0; k < sides; ++k) {
    const double corner = 2 * pi * k / sides, middle = corner + pi / sides;
    all.push_back({.corner = {reach * std::cos(corner), reach * std::sin(corner)},
                   .normal = {std::cos(middle), std::sin(middle)},
                   .length = length});
  }
  return all;
}

std::vector<double> turns(int count, double first = 0) {
  std::vector<double> all;
  for (int k = 0; k < count; ++k)
    all.push_back(first + 2 * pi * k / count);
  return all;
}

const LiningProperties concrete{.name = "shell", .thickness = 0.3, .young_modulus = 25e9, .density = 2500};

TEST(Lining, HasTheLengthAndMassOfItsOutline) {
  const Lining ring = make_lining(concrete, polygon(12, 5), {0, 0}, turns(24), true);
  ASSERT_EQ(ring.nodes.size(), 24u);
  EXPECT_EQ(ring.beams(), 24);
  double length = 0, mass = 0;
  for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
    const LiningNode& node = ring.nodes[i];
    // every other node lies in a corner: half of it on either side
    EXPECT_EQ(node.side[0] == node.side[1], i % 2 == 1) << i;
    length += node.half_length[0] + node.half_length[1];
    mass += node.mass;
  }
  EXPECT_NEAR(length, 24 * 5 * std::tan(pi / 12), 1e-12);
  EXPECT_NEAR(mass, 2500 * 0.3 * length, 1e-9);
  EXPECT_NEAR(ring.properties.bending(), 56.25e6, 1e-6);

  const Lining arc = make_lining(concrete, polygon(12, 5), {0, 0}, {0.1, 0.5, 0.9, 1.3}, false);
  EXPECT_EQ(arc.beams(), 3);
  EXPECT_EQ(arc.nodes.front().half_length[0], 0);
  EXPECT_EQ(arc.nodes.back().half_length[1], 0);
  EXPECT_THROW(make_lining(concrete, polygon(12, 5), {0, 0}, {0, 0, 1}, false), std::invalid_argument);
}

const JointProperties contact{.name = "contact", .normal_stiffness = 1e9, .shear_stiffness = 5e8, .friction = 0.5};

// closure and slip to forces, and nothing when the rock is gone
TEST(Interface, PressesSlipsAndParts) {
  LiningContact at;
  const LiningJoint joint{contact, 0.5};
  constexpr double length = 0.2;
  LiningAnswer answer = interface_answer(joint, length, {.closure = 1e-3, .place = 0, .seconds = 1}, at);
  EXPECT_NEAR(at.normal, 1e9 * length * 1e-3, 1e-6);
  EXPECT_NEAR(answer.elastic, 0.5 * 1e9 * length * 1e-6, 1e-9);
  answer = interface_answer(joint, length, {.closure = 1e-3, .place = 1e-4, .seconds = 1}, at);
  EXPECT_NEAR(at.shear, -5e8 * length * 1e-4, 1e-6);
  EXPECT_EQ(answer.friction, 0);
  answer = interface_answer(joint, length, {.closure = 1e-3, .place = 1e-2, .seconds = 1}, at);
  const double limit = std::tan(0.5) * at.normal;
  EXPECT_NEAR(at.shear, -limit, 1e-6);
  EXPECT_GT(answer.friction, 0);
  const double held = 0.5 * limit * limit / (5e8 * length);
  answer = interface_answer(joint, length, {.closure = -1e-6, .place = 1e-2, .seconds = 1}, at);
  EXPECT_EQ(at.normal, 0);
  EXPECT_EQ(at.shear, 0);
  EXPECT_NEAR(answer.friction, held, 1e-9 * held) << "the energy of the shear spring is lost";
}

// The energy stored in a bond when it breaks is lost, and the interface does not pull any more.
TEST(Interface, PullsUntilItsBondBreaks) {
  JointProperties glued = contact;
  glued.tension = 2e5;
  glued.cohesion = 3e5;
  glued.laws.bond = true;
  const LiningJoint joint{glued, 0.5};
  constexpr double length = 0.2;
  LiningContact at{.bond = Bond::whole};
  const double strength = 2e5 / 1e9;  // m
  interface_answer(joint, length, {.closure = 0, .place = 0, .seconds = 1}, at);
  EXPECT_NEAR(at.normal, 0, 1e-6) << "it is cast without stress";
  interface_answer(joint, length, {.closure = -0.999 * strength, .place = 0, .seconds = 1}, at);
  EXPECT_NEAR(at.normal, -0.999 * 2e5 * length, 1e-3);
  EXPECT_EQ(at.bond, Bond::whole);
  const LiningAnswer broken =
      interface_answer(joint, length, {.closure = -1.001 * strength, .place = 0, .seconds = 1}, at);
  EXPECT_EQ(at.bond, Bond::lost);
  EXPECT_EQ(at.normal, 0);
  EXPECT_NEAR(broken.friction, 0.5 * 1e9 * length * std::pow(1.001 * strength, 2), 1e-9);
}

// Eqs I.1-I.3. An even pressure on a polygon causes moments on its sides, and none on the circle that it represents;
// pressures that differ from side to side by a cosine make the ring's moments.
TEST(Smoothing, LeavesTheMomentsOfARing) {
  constexpr int sides = 24, on_side = 8;
  constexpr double radius = 5, pressure = 1e5;
  // no node in a corner: the moments made here jump there with the pressure
  const Lining ring =
      make_lining(concrete, polygon(sides, radius), {0, 0}, turns(sides * on_side, pi / (sides * on_side)), true);
  for (const double wave : {0.0, 0.3}) {
    std::vector<SectionForces> forces(ring.nodes.size());
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const LiningNode& node = ring.nodes[i];
      const LiningSide& side = ring.sides[node.side[1]];
      const double x = side.along().dot(node.place - side.corner) / side.length;
      const double middle = std::atan2(side.normal[1], side.normal[0]);
      const double q = pressure * (1 + wave * std::cos(2 * middle));
      forces[i].moment = 0.5 * q * side.length * side.length * (x * (1 - x) - 1.0 / 6);
    }
    const std::vector<double> smoothed = smoothed_moments(ring, forces);
    ASSERT_EQ(smoothed.size(), forces.size());
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const double turn = std::atan2(ring.nodes[i].place[1], ring.nodes[i].place[0]);
      const double exact = pressure * wave * radius * radius / 3 * std::cos(2 * turn);
      // a cosine at equal angles is found exactly, and an even pressure has no waves
      EXPECT_NEAR(smoothed[i], exact, 1e-6 * pressure * radius * radius) << i;
    }
  }
  EXPECT_TRUE(
      smoothed_moments(make_lining(concrete, polygon(4, 5), {0, 0}, turns(40), true), std::vector<SectionForces>(40))
          .empty());
}

TEST(Utilisation, IsThatOfAnElasticSection) {
  LiningProperties p = concrete;
  EXPECT_FALSE(use_of(p, {.thrust = 1e6}).has_value());
  p.compressive_strength = 20e6;
  p.tensile_strength = 2e6;
  EXPECT_NEAR(*use_of(p, {.thrust = 20e6 * 0.3}), 1, 1e-12);
  EXPECT_NEAR(*use_of(p, {.thrust = -2e6 * 0.3}), 1, 1e-12);
  const double bending = 2e6 * 0.3 * 0.3 / 6;
  EXPECT_NEAR(*use_of(p, {.moment = -bending}), 1, 1e-12);
  EXPECT_NEAR(*use_of(p, {.thrust = 2e6 * 0.3, .moment = 2 * bending}), 1, 1e-12)
      << "thrust closes the side that bending opens";
}

}  // namespace
}  // namespace voussoir::lining_test
