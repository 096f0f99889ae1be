// Limit analysis of joints after Barton and Bandis against closed forms: F = Σ σ tan(φr + JRC log10(JCS/σ)) A over the
// load.
#include <gtest/gtest.h>

#include <cmath>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/limit/limit.hpp"
#include "core/testing/limit_models.hpp"
#include "text/angle.hpp"

namespace voussoir::envelope_test {
namespace {

constexpr double residual_deg = 26, jrc = 10, jcs = 30e6;

void make_rough(JointProperties& p) {
  p.friction = residual_deg * degree;
  p.laws.friction = FrictionLaw::barton_bandis;
  p.barton_bandis = {.sample_jrc = jrc, .sample_jcs = jcs};
  scale_to_blocks(p.barton_bandis);
}

// Pa
double strength(double stress) {
  return stress * std::tan(std::min(70.0, residual_deg + std::max(0.0, jrc * std::log10(jcs / stress))) * degree);
}

TEST(Envelope, OfABlockOnAnIncline) {
  for (const double height : {0.01, 0.1, 3.0, 200.0, 5000.0}) {  // from the cap of 70 degrees to beyond JCS
    Model<2> model = limit_models::block_on_plate(2, height, 40 * degree);
    make_rough(model.properties.front());
    for (Body<2>& body : model.bodies)
      body.free_rotation.fill(false);
    const double normal = 2000 * 10 * height * std::cos(40 * degree), shear = normal * std::tan(40 * degree);
    const CriticalStrength<2> found = limit_models::factor_of_safety(model);
    ASSERT_EQ(found.status, LimitStatus::found);
    EXPECT_TRUE(found.evidence.tangents_agree);
    EXPECT_GE(found.evidence.rounds_of_tangents, 1);
    EXPECT_LE(found.stands, found.collapses);
    EXPECT_NEAR(found.stands, strength(normal) / shear, 1e-6 * found.stands) << height;
  }
}

// Two blocks in a row, 3 m and 1 m high: the upper, heavier one is less rough under its own stress and leans on the
// lower one, through a smooth joint.
TEST(Envelope, OfTwoBlocksInARow) {
  Model<2> model = limit_models::model_of({{"plate", limit_models::box(-3, -1, 3, 0), true},
                                           {"high", limit_models::box(-1, 0, 0, 3)},
                                           {"low", limit_models::box(0, 0, 1, 1)}});
  model.gravity = 10 * Vector<2>(std::sin(50 * degree), -std::cos(50 * degree));
  // between the blocks, at x = 0
  const auto is_wall = [&](const Body<2>& body, const HalfSpace<2>& face) {
    const HalfSpace<2> placed = moved_origin<2>(face, -body.reference);
    return std::abs(placed.normal[0]) > 0.5 && std::abs(placed.offset + placed.normal[0] * model.origin[0]) < 1e-9;
  };
  for (Body<2>& body : model.bodies) {
    body.free_rotation.fill(false);
    for (std::size_t f = 0; f < body.parts.front().faces.size(); ++f)
      body.parts.front().joints[f] = is_wall(body, body.parts.front().faces[f]) ? 0 : no_joint;
  }
  model.joints = {{"wall", {Vector<2>::UnitX(), 0}, 1}};
  model.properties.push_back(model.properties.front());
  model.properties.back().name = "smooth";
  model.properties.back().friction = 0;
  make_rough(model.properties.front());
  const double weight = 2000 * 10, normal = weight * std::cos(50 * degree);
  const CriticalStrength<2> found = limit_models::factor_of_safety(model, {"rock"});
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_TRUE(found.evidence.tangents_agree);
  const double exact = (strength(3 * normal) + strength(normal)) / (4 * weight * std::sin(50 * degree));
  EXPECT_NEAR(found.stands, exact, 2e-6 * exact);

  // pushed up the plane, the higher one leaves the other behind
  const Loads<2> dead = loads_of_acceleration(model, model.gravity), live = loads_of_acceleration<2>(model, {-10, 0});
  const LoadFactor<2> pushed = find_load_factor(limit_models::assembly_of(model), dead, live);
  ASSERT_EQ(pushed.status, LimitStatus::found);
  EXPECT_NEAR(pushed.factor, std::sin(50 * degree) + strength(3 * normal) / (3 * weight), 1e-5);
}

// a block of 20 kN on 2 m², pushed aside and held by cohesion too
TEST(Envelope, InSpace) {
  CornerAssembly<3> assembly{{CornerBody<3>{Vector<3>::Zero(), 1, 1, {}}}, {}, {JointProperties{}}};
  make_rough(assembly.properties.front());
  const double weight = 20e3, area = 2;
  assembly.bodies.push_back({{0, 0, 0.1}, weight, 1, {true, true, true, true, true, true}});
  assembly.faces.push_back(
      {0, 1, {0, 0, 1}, {{-1, -0.5, 0}, {1, -0.5, 0}, {1, 0.5, 0}, {-1, 0.5, 0}}, 0, residual_deg * degree, 500});
  const std::vector<Load<3>> dead{{}, {{0, 0, -weight}, Vector<3>::Zero()}},
      live{{}, {{600, 800, 0}, {-0.1 * 800, 0.1 * 600, 0}}};  // at the level of the joint
  const LoadFactor<3> pushed = find_load_factor(assembly, dead, live);
  ASSERT_EQ(pushed.status, LimitStatus::found);
  EXPECT_TRUE(pushed.evidence.tangents_agree);
  EXPECT_NEAR(pushed.factor, area * (strength(weight / area) + 500) / 1000, 1e-6 * pushed.factor);

  std::vector<Load<3>> both = dead;
  both[1] += live[1];
  const CriticalStrength<3> found = find_factor_of_safety(assembly, both, {true});
  ASSERT_EQ(found.status, LimitStatus::found);
  EXPECT_NEAR(found.stands, pushed.factor, 1e-6 * pushed.factor);
}

TEST(Envelope, TangentsLieAboveIt) {
  JointProperties p;
  make_rough(p);
  for (const double at : {1e2, 2e3, 1e5, 5e6, 29e6, 40e6}) {
    const EnvelopeTangent tangent = envelope_tangent(p, at);
    EXPECT_NEAR(tangent.cohesion + at * std::tan(tangent.friction), strength(at), 1e-12 * strength(at));
    for (const double stress : {1e3, 1e4, 1e5, 1e6, 1e7})
      if (at < jcs) EXPECT_GE(tangent.cohesion + stress * std::tan(tangent.friction), strength(stress) * (1 - 1e-12));
  }
}

}  // namespace
}  // namespace voussoir::envelope_test
