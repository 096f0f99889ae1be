// One block under forces, bolts and water, against closed forms. Published wedges and pyramids: cases/key_blocks.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/joint_laws/barton_bandis.hpp"
#include "core/key_blocks/block_forces.hpp"
#include "core/testing/stated_block.hpp"
#include "text/angle.hpp"

namespace voussoir::verdict_test {
namespace {

const Vector<3> down(0, 0, -9.81), nothing(0, 0, 0);

double plunge(const Vector<3>& v) {
  return -std::asin(v.normalized()[2]) / degree;
}
double trend(const Vector<3>& v) {
  const double angle = std::atan2(v[0], v[1]) / degree;
  return angle < 0 ? angle + 360 : angle;
}

// Hoek & Bray (1981), comprehensive solution; Wyllie & Mah (2004), Appendix III, in feet and pounds
struct HoekAndBray {
  double area_a = 5565.007845, area_b = 6428.125399, crack = 1846.538547, weight = 28272195.4;
  Vector<3> a = above(45, 105), b = above(70, 235), c = above(70, 165);

  explicit HoekAndBray(double pressure) {
    block = block_of({{a, area_a, 20, 500}, {b, area_b, 30, 1000}, {c, crack, 0, 0}}, weight);
    block.water.force = pressure * (area_a * a + area_b * b + crack * c);
  }
  Block<3> block;
};

TEST(Verdict, TheLeastForceAsABoltAndTheCriticalWater) {
  const HoekAndBray wedge(1084.266440);
  const BoltedVerdict<3> bolted = judge_bolted(wedge.block, nothing, down);
  const std::optional<RequiredForce<3>> bolt = least_force(wedge.block, bolted, 1.5, down);
  ASSERT_TRUE(bolt);
  EXPECT_TRUE(bolt->least);
  EXPECT_NEAR(*judge(wedge.block, Vector<3>(bolted.load + bolt->force), down).factor(), 1.5, 1e-12);
  EXPECT_NEAR(*force_along(wedge.block, bolted, 1.5, Vector<3>(bolt->force.normalized()), down), bolt->force.norm(), 1);

  // the same bolt as passive reinforcement
  Block<3> bolted_block = wedge.block;
  bolted_block.bolts.push_back({0, Vector<3>(bolt->force.normalized()), Vector<3>::Zero(), 0, bolt->force.norm()});
  const BoltedVerdict<3> with = judge_bolted(bolted_block, nothing, down);
  EXPECT_NEAR(*with.factor, 1.5, 1e-9);
  EXPECT_NEAR(*with.factor_passive, 1.403436378, 1e-7);
  // a share of the water at which the factor is 1 lies above the stated water
  const double share = *critical_water(wedge.block, wedge.block.stated.force, down);
  EXPECT_GT(share, 1);
  EXPECT_NEAR(*judge(wedge.block, Vector<3>(wedge.block.stated.force + share * wedge.block.water.force), down).factor(),
              1, 1e-9);
}

TEST(Verdict, ABlockOnAPlaneWithABolt) {
  // 49.05 kN on 40 degrees, friction 30, a bolt of 20 kN at 45 degrees to the plane
  Block<3> block = block_of({{above(40, 90)}}, 49.05e3);
  const Vector<3> downhill(std::cos(40 * degree), 0, -std::sin(40 * degree)), n = above(40, 90);
  block.bolts.push_back({0, Vector<3>((-downhill - n).normalized()), Vector<3>::Zero(), 0, 20e3});
  const BoltedVerdict<3> bolted = judge_bolted(block, nothing, down);
  EXPECT_NEAR(*bolted.factor, 1.71733, 1e-5);
  EXPECT_NEAR(*bolted.factor_passive, 1.39558, 1e-5);
  block.bolts[0].pretension = 20e3;  // always a part of the load
  EXPECT_NEAR(*judge_bolted(block, nothing, down).factor_passive, 1.71733, 1e-5);
}

// Barton and Bandis' envelope on both faces of a wedge, each at its own normal stress
TEST(Verdict, RoughFacesHaveTheEnvelopeAtTheirStress) {
  JointProperties rough;
  rough.friction = 26 * degree;
  rough.laws.friction = FrictionLaw::barton_bandis;
  rough.barton_bandis = {.sample_jrc = 8, .sample_jcs = 50e6};
  scale_to_blocks(rough.barton_bandis);
  Block<3> wedge = block_of({{above(45, 105), 40}, {above(70, 235), 90}}, 50e6);
  for (RockFace<3>& face : wedge.faces)
    face.set_friction(rough);
  const auto resistance = [&](const Verdict<3>& verdict) {
    double sum = 0;
    for (int k = 0; k < verdict.loaded; ++k) {
      const double stress = verdict.forces[k] / wedge.faces[verdict.faces[k]].area;
      sum += verdict.forces[k] * std::tan((26 + 8 * std::log10(50e6 / stress)) * degree);
    }
    return sum;
  };
  const BoltedVerdict<3> bare = judge_bolted(wedge, nothing, down);
  ASSERT_EQ(bare.verdict.loaded, 2);
  EXPECT_NEAR(*bare.factor, resistance(bare.verdict) / bare.verdict.driving(), 1e-12);
  const std::optional<RequiredForce<3>> bolt = least_force(wedge, bare, 3, down);
  ASSERT_TRUE(bolt && bolt->force.norm() > 0) << *bare.factor;
  EXPECT_FALSE(bolt->least) << "the resistance is not linear in the force";
  EXPECT_NEAR(*judge(wedge, Vector<3>(bare.load + bolt->force), down).factor(), 3, 1e-9);

  // a bolt across both faces as passive reinforcement: its force is pressure, undivided
  wedge.bolts.push_back(
      {0, Vector<3>(-(wedge.normals[0] + wedge.normals[1]).normalized()), Vector<3>::Zero(), 0, 10e6});
  const BoltedVerdict<3> bolted = judge_bolted(wedge, nothing, down);
  ASSERT_EQ(bolted.verdict.loaded, 2);
  const double held = -bolt_capacity(wedge).dot(bare.verdict.direction());
  EXPECT_NEAR(*bolted.factor_passive, (resistance(bolted.verdict) + held) / bare.verdict.driving(), 1e-9);
}

TEST(Verdict, LeastForceOnAPlane) {
  Block<3> block = block_of({{above(35, 120), 1, 30, 0.05}}, 1);
  const BoltedVerdict<3> bolted = judge_bolted(block, nothing, down);
  const RequiredForce<3> bolt = *least_force(block, bolted, 1.5, down);
  EXPECT_NEAR(bolt.force.norm(), 0.209937300476, 1e-11);
  EXPECT_NEAR(plunge(bolt.force), -13.948276, 1e-6);
  EXPECT_NEAR(trend(bolt.force), 300, 1e-6);
  EXPECT_NEAR(*judge(block, Vector<3>(block.stated.force + bolt.force), down).factor(), 1.5, 1e-12);
}

TEST(Verdict, ABlockThatFallsStaysThatUnderBolts) {
  // three joints of a roof, 60/030, 60/150, 60/270: the block below all of them
  Block<3> block =
      block_of({{Vector<3>(-above(60, 30))}, {Vector<3>(-above(60, 150))}, {Vector<3>(-above(60, 270))}}, 10);
  EXPECT_EQ(judge(block, block.stated.force, down).kind, BlockKind::falls);
  EXPECT_EQ(*judge_bolted(block, nothing, down).factor, 0);
  EXPECT_NEAR(least_force(block, judge_bolted(block, nothing, down), 1.5, down)->force[2], 15, 1e-12);
  block.bolts.push_back({0, Vector<3>(0, 0, 1), Vector<3>::Zero(), 0, 10.1});
  const BoltedVerdict<3> bolted = judge_bolted(block, nothing, down);
  EXPECT_EQ(bolted.verdict.kind, BlockKind::falls);
  EXPECT_NEAR(*bolted.factor, 1.01, 1e-12);
  EXPECT_NEAR(*bolted.factor_passive, 1.01, 1e-12);
  Block<3> lifted = block_of({{Vector<3>(0, 0, 1)}}, 10);
  lifted.water.force = {0, 0, 30};
  EXPECT_EQ(judge(lifted, load_without_bolts(lifted), down).kind, BlockKind::lifts);
}

TEST(Verdict, AFactorMayRiseWhenAFaceIsRemoved) {
  const std::vector<StatedFace> faces{{Vector<3>(2, 3, -1).normalized(), 1, 35},
                                      {Vector<3>(4, -6, 8).normalized(), 1, 35},
                                      {Vector<3>(2, -8, 8).normalized(), 1, 35}};
  const Block<3> all = block_of(faces, 1), without = block_of({faces[0], faces[2]}, 1);
  EXPECT_NEAR(*judge(all, all.stated.force, down).factor(), 0.903995, 1e-6);
  EXPECT_NEAR(*judge(without, without.stated.force, down).factor(), 1.277553, 1e-6);
}

TEST(Verdict, ALineThatThreeFacesShareIsIndeterminate) {
  // a prism on three faces along y, which dips: the least resistance leaves out the rough one in between
  const double fall = 30 * degree;
  const Vector<3> along(0, std::cos(fall), -std::sin(fall)), up(0, std::sin(fall), std::cos(fall)), side(1, 0, 0);
  std::vector<StatedFace> faces;
  for (const double angle : {-50.0, 0.0, 50.0})
    faces.push_back(
        {Vector<3>(std::cos(angle * degree) * up + std::sin(angle * degree) * side), 1, angle == 0 ? 60.0 : 10.0});
  const Block<3> block = block_of(faces, 1);
  const Verdict<3> verdict = judge(block, block.stated.force, down);
  EXPECT_TRUE(verdict.indeterminate);
  EXPECT_LT((verdict.direction() - along).norm(), 1e-12);
  EXPECT_NEAR(*verdict.factor(), std::tan(10 * degree) / std::tan(fall) / std::cos(50 * degree), 1e-12);
  EXPECT_FALSE(judge(block_of({faces[1]}, 1), block.stated.force, down).indeterminate);
}

}  // namespace
}  // namespace voussoir::verdict_test
