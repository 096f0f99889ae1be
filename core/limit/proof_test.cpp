// Proved bounds of load factors: they enclose closed forms, and sums in rationals that share no code with them confirm
// them.
#include "core/limit/proof.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/testing/corner_scenes.hpp"
#include "core/testing/limit_models.hpp"
#include "text/angle.hpp"

namespace voussoir::proof_test {
namespace {

using namespace corner_scenes;
using Rational = boost::multiprecision::cpp_rational;
using Triple = std::array<Rational, 3>;

// ---- rationals in space; vectors of the plane have no third number, their moments and spins only that
// -----------------

Rational rational(double number) {
  int binary = 0;
  const auto digits = static_cast<long long>(std::frexp(number, &binary) * 9007199254740992.0);
  const int shift = binary - 53;
  const Integer power = Integer(1) << std::abs(shift);
  return shift >= 0 ? Rational(Integer(digits) * power) : Rational(Integer(digits), power);
}

Triple triple(const Vector<2>& v) {
  return {rational(v[0]), rational(v[1]), 0};
}
Triple triple(const Vector<3>& v) {
  return {rational(v[0]), rational(v[1]), rational(v[2])};
}
Triple triple(const Vector<1>& v) {
  return {0, 0, rational(v[0])};
}

void add(Triple& sum, const Triple& more, const Rational& factor = 1) {
  for (int k = 0; k < 3; ++k)
    sum[k] += factor * more[k];
}

Rational dot(const Triple& a, const Triple& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Triple arm_product(const Triple& from, const Triple& to, const Triple& force) {
  Triple sum;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    sum[k] = (to[i] - from[i]) * force[j] - (to[j] - from[j]) * force[i];
  }
  return sum;
}

// the exact force of a proof
template <int Dim>
Triple force_of(const LimitProof<Dim>& proof, std::size_t f, std::size_t k) {
  Triple force;
  const Integer power = Integer(1) << std::abs(proof.forces.unit);
  for (int i = 0; i < Dim; ++i)
    force[i] = proof.forces.unit < 0 ? Rational(proof.forces.at_corners[f][k][i], power)
                                     : Rational(Integer(proof.forces.at_corners[f][k][i] * power));
  return force;
}

template <int Dim>
void check_forces(const LimitProof<Dim>& proof) {
  std::vector<Triple> forces, moments;
  for (std::size_t b = 0; b < proof.assembly.bodies.size(); ++b) {
    forces.push_back(triple(proof.dead[b].force));
    moments.push_back(triple(proof.dead[b].moment));
    add(forces[b], triple(proof.live[b].force), rational(*proof.lower));
    add(moments[b], triple(proof.live[b].moment), rational(*proof.lower));
  }
  int outside = 0;
  for (std::size_t f = 0; f < proof.assembly.faces.size(); ++f) {
    const CornerFace<Dim>& face = proof.assembly.faces[f];
    const Triple normal = triple(face.normal);
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Triple force = force_of(proof, f, k), place = triple(face.corners[k]);
      for (const int side : {-1, 1}) {
        const int b = side > 0 ? face.body_b : face.body_a;
        add(forces[b], force, side);
        add(moments[b], arm_product(triple(proof.assembly.bodies[b].centroid), place, force), side);
      }
      // a unit normal would add 1e-15 of the cohesion
      const Rational along = dot(force, normal), size = dot(normal, normal),
                     most =
                         rational(proof.tangents[f]) * along + rational(proof.cohesion[f][k]) * (1 - rational(1e-15));
      outside += along < 0 || dot(force, force) * size - along * along > most * most;
    }
  }
  EXPECT_EQ(outside, 0);
  int unbalanced = 0;
  for (std::size_t b = 0; b < forces.size(); ++b)
    for (int k = 0; k < freedoms<Dim>; ++k)
      if (proof.assembly.bodies[b].free[k])
        unbalanced += k < Dim ? forces[b][k] != 0 : moments[b][Dim == 2 ? 2 : k - Dim] != 0;
  EXPECT_EQ(unbalanced, 0);
}

template <int Dim>
void check_velocities(const LimitProof<Dim>& proof) {
  Rational against, with;
  for (std::size_t b = 0; b < proof.velocities.size(); ++b) {
    const Triple velocity = triple(proof.velocities[b].velocity), spin = triple(proof.velocities[b].spin);
    against -= dot(triple(proof.dead[b].force), velocity) + dot(triple(proof.dead[b].moment), spin);
    with += dot(triple(proof.live[b].force), velocity) + dot(triple(proof.live[b].moment), spin);
    for (int k = 0; k < freedoms<Dim>; ++k)
      if (!proof.assembly.bodies[b].free[k])
        EXPECT_EQ(k < Dim ? proof.velocities[b].velocity[k] : proof.velocities[b].spin[k - Dim], 0);
  }
  ASSERT_GT(with, 0);
  int closing = 0;
  for (std::size_t f = 0; f < proof.assembly.faces.size(); ++f) {
    const CornerFace<Dim>& face = proof.assembly.faces[f];
    const Triple normal = triple(face.normal);
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      Triple opening{};
      for (const int side : {-1, 1}) {
        const int b = side > 0 ? face.body_b : face.body_a;
        const Triple centroid = triple(proof.assembly.bodies[b].centroid), place = triple(face.corners[k]),
                     spin = triple(proof.velocities[b].spin);
        add(opening, triple(proof.velocities[b].velocity), side);
        const Triple turned = arm_product(place, centroid, spin);  // (c - p) × w = w × (p - c)
        add(opening, turned, side);
      }
      const Rational along = dot(opening, normal), slip = dot(opening, opening) * dot(normal, normal) - along * along,
                     tangent = rational(proof.tangents[f]);
      closing += along < 0 || along * along < tangent * tangent * slip;
      const Rational ratio = slip / dot(normal, normal);
      // a root below the true one
      if (proof.cohesion[f][k] > 0)
        against += rational(proof.cohesion[f][k]) * rational(std::sqrt(static_cast<double>(ratio)) * (1 - 1e-15));
    }
  }
  EXPECT_EQ(closing, 0);
  EXPECT_LE(against, rational(*proof.upper) * with);
  EXPECT_GE(against, rational(*proof.upper - 1e-12 * (1 + std::abs(*proof.upper))) * with);
}

template <int Dim>
LimitProof<Dim> expect_proved(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live,
                              double known, double below = 2e-6, double above = 1e-6) {
  const LoadFactor<Dim> found = find_load_factor(assembly, dead, live);
  LimitProof<Dim> proof = prove_load_factor(assembly, dead, live, found);
  EXPECT_TRUE(proof.proved()) << proof.no_lower << proof.no_upper;
  if (!proof.proved()) return proof;
  EXPECT_LT(*proof.lower, known + 2e-9);
  EXPECT_GT(*proof.upper, known - 2e-9);
  EXPECT_LT(*proof.lower, *proof.upper);
  const double size = std::max(1.0, std::abs(known));
  EXPECT_GT(*proof.lower, known - below * size);
  EXPECT_LT(*proof.upper, known + above * size);
  EXPECT_LT(proof.forces.change, 1e-6);
  check_forces(proof);
  check_velocities(proof);
  return proof;
}

LimitProof<3> expect_proved(const CornerScene& scene, double known, double below = 2e-6, double above = 1e-6) {
  return expect_proved<3>(scene.assembly, scene.dead, scene.live, known, below, above);
}

// ---- in space
// -----------------------------------------------------------------------------------------------------------

TEST(LimitProof, EnclosesWhatPushesAWedgeOut) {
  const auto shallow = symmetric(25, 30), steep = symmetric(38, 45);
  for (const bool turns : {true, false})
    expect_proved(wedge(steep[0], steep[1], Plane{70, 0}.normal(), 35, turns), 0.290704400);
  expect_proved(wedge(shallow[0], shallow[1], Plane{60, 0}.normal(), 27, true), 0.845898008);
  expect_proved(wedge(Plane{40, 130}.normal(), Plane{60, 220}.normal(), Plane{70, 182}.normal(), 35, true),
                0.091071616);
}

TEST(LimitProof, EnclosesWallsAndTwist) {
  const LimitProof<3> along = expect_proved(wall(4, 3, 1, 0.5, 0.4, 35, {1, 0, 0}), 0.663710961);
  EXPECT_GE(along.forces.depth, 4);
  expect_proved(wall(6, 4, 0.5, 0.25, 0.3, 35, {1, 0, 0}), 0.615635676);
  expect_proved(wall(6, 4, 0.5, 0.25, 0.3, 25, {1, 0, 0}), std::tan(25 * degree));
  expect_proved(wall(4, 3, 1, 0.5, 0.4, 35, {0, 1, 0}), 0.2);
  CornerScene scene;
  const int block = scene.add({0, 0, 0.5}, 1, 0.87);
  scene.touch(0, block, rectangle(1, 1), {0, 0, 1}, 30);
  scene.live[block].moment = {0, 0, 1};
  expect_proved(scene, std::tan(30 * degree) / std::numbers::sqrt2);
}

// cohesion has a share at every corner, and its power enters the upper bound
TEST(LimitProof, CountsCohesion) {
  CornerScene scene;
  const int block = scene.add({0, 0, 0.2}, 1, 1.3);
  scene.touch(0, block, rectangle(2, 1.5), {0, 0, 1}, 20, 0.4);
  scene.push(block, {1, 0, 0}, {0, 0, 0});
  expect_proved(scene, 0.4 * 3 + std::tan(20 * degree));
  scene.assembly.faces[0].friction = 0;
  expect_proved(scene, 0.4 * 3);
  // without weight no corner is pressed: whatever closes the balance pulls at some of them
  scene.dead[block] = {};
  const LimitProof<3> weightless = prove_load_factor(scene.assembly, scene.dead, scene.live, scene.factor());
  EXPECT_FALSE(weightless.lower);
  ASSERT_TRUE(weightless.upper);
  EXPECT_NEAR(*weightless.upper, 0.4 * 3, 1e-5);
}

// a block on rails: a smooth face carries forces along its exact normal only
TEST(LimitProof, HandlesSmoothFacesAndHeldFreedoms) {
  CornerScene scene;
  const int block = scene.add({0, 0, 0.5}, 1, 0.87);
  scene.assembly.bodies[block].free = {true, true, true, false, false, false};
  const Point slope(std::sin(20 * degree), 0, std::cos(20 * degree));
  scene.touch(0, block, rectangle(1, 1), slope, 0);
  scene.touch(0, block, {{0.5, -0.5, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 1}, {0.5, -0.5, 1}}, {-1, 0.1, 0}, 30);
  scene.push(block, {0.1, 1, 0}, {0, 0, 0.5});
  const LoadFactor<3> found = scene.factor();
  ASSERT_EQ(found.status, LimitStatus::found);
  expect_proved(scene, found.factor);
}

TEST(LimitProof, SaysWhyThereIsNone) {
  const auto steep = symmetric(38, 45);
  const auto prove = [](const CornerScene& scene) {
    return prove_load_factor(scene.assembly, scene.dead, scene.live, scene.factor());
  };
  const LimitProof<3> falls = prove(wedge(steep[0], steep[1], Plane{70, 0}.normal(), 20, true));
  EXPECT_FALSE(falls.lower || falls.upper);
  EXPECT_NE(falls.no_lower.find("dead loads alone"), std::string::npos);
  const LimitProof<3> clamped = prove(drawer());
  EXPECT_FALSE(clamped.lower || clamped.upper);
  EXPECT_NE(clamped.no_upper.find("every factor"), std::string::npos);
  // without friction no force along the face closes the balance
  CornerScene smooth;
  const int block = smooth.add({0, 0, 0.5}, 1, 0.87);
  smooth.touch(0, block, rectangle(1, 1), {0, 0, 1}, 0);
  smooth.push(block, {0.3, 0, 1}, {0, 0, 0.5});
  const LimitProof<3> none = prove(smooth);
  EXPECT_FALSE(none.proved());
  if (!none.lower) EXPECT_NE(none.no_lower.find("leave their cones"), std::string::npos);
}

// blocks that the mechanism leaves still may be held by self-stress: they do not stand in the way of a proof
TEST(LimitProof, LeavesBlocksWithSelfStressStill) {
  CornerScene scene = drawer();
  scene.live[1] = {};
  const int column = scene.add({3, 0, 1}, 1, 1.15);
  scene.touch(0, column, {{2.75, -0.5, 0}, {3.25, -0.5, 0}, {3.25, 0.5, 0}, {2.75, 0.5, 0}}, {0, 0, 1}, 35);
  scene.push(column, {1, 0, 0}, {3, 0, 1});
  EXPECT_TRUE(expect_proved(scene, 0.25).still_held);
}

// ---- in the plane
// -------------------------------------------------------------------------------------------------------

LimitProof<2> expect_pushed(const Model<2>& model, double known) {
  const Vector<2> east(model.gravity.norm(), 0);
  return expect_proved<2>(limit_models::assembly_of(model), loads_of_acceleration(model, model.gravity),
                          loads_of_acceleration(model, east), known);
}

TEST(LimitProof, EnclosesColumnsInThePlane) {
  expect_pushed(limit_models::block_on_plate(0.5, 2, 0), 0.25);
  expect_pushed(limit_models::block_on_plate(2, 0.5, 0), std::tan(30 * degree));
  expect_pushed(limit_models::block_on_plate(1, 1, -10 * degree), std::tan(20 * degree));
  // two columns of three blocks that lean on each other
  std::vector<limit_models::TestBlock> blocks{{"floor", limit_models::box(-3, -1, 3, 0), true}};
  for (const double x : {0.0, 0.5})
    for (int course = 0; course < 3; ++course)
      blocks.push_back(
          {"b" + std::to_string(blocks.size()), limit_models::box(x, 0.5 * course, x + 0.5, 0.5 * (course + 1))});
  const Model<2> model = limit_models::model_of(blocks);
  const CornerAssembly<2> assembly = limit_models::assembly_of(model);
  const Loads<2> dead = loads_of_acceleration(model, model.gravity), live = loads_of_acceleration(model, {10, 0});
  expect_proved<2>(assembly, dead, live, find_load_factor(assembly, dead, live).factor);
}

}  // namespace
}  // namespace voussoir::proof_test
