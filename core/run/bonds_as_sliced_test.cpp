// A stated cohesion against limit equilibrium: a block on one plane. A wedge on two: cases/key_blocks.
#include "core/run/bonds_as_sliced.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/key_blocks/block_survey.hpp"
#include "core/run/block_theory.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::bonds_as_sliced_test {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Slope {
  int dimension = 2, points = 1;
  std::string law;     // keys of the joint's cohesion
  std::string stages;  // after the weight has come on

  std::string at(double x, double z) const {
    return dimension == 2 ? fmt::format("[{}, {}]", x, z) : fmt::format("[{}, 0, {}]", x, z);
  }
  // 20 degrees of slope, 15 of friction, a slab 2 m thick below a plane parallel to the joint
  std::string text() const {
    const std::string low = dimension == 2 ? "[-4, -6]" : "[-4, -1, -6]",
                      high = dimension == 2 ? "[4, 6]" : "[4, 1, 6]";
    return fmt::format(
               "dimension = {}\ngravity = {}\ndensity = 2500\n"
               "[domain]\nbox = {{ min = {}, max = {} }}\n"
               "planes = [{{ dip = 20, dip_direction = 90, point = {}, keep = \"below\" }}]\n"
               "[[joints]]\nname = \"plane\"\ndip = 20\ndip_direction = 90\npoint = {}\n"
               "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = "
               "15\n"
               "cohesion = 20e3\nsub_contacts = {}\n{}\n"
               "[[fix]]\nbelow = [\"plane\"]\n[[restrain]]\nabove = [\"plane\"]\nrotation = true\n"
               "[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.5\n",
               dimension, dimension == 2 ? "[0, -9.81]" : "[0, 0, -9.81]", low, high, at(0, 2 / std::cos(20 * degree)),
               at(0, 0), points, law) +
           stages + "[output]\nframes = false\n";
  }
  // (c A + W cos β tan φ)/(W sin β), W = γ t A
  double factor(double cohesion = 20e3) const {
    return cohesion / (2500 * 9.81 * 2 * std::sin(20 * degree)) + std::tan(15 * degree) / std::tan(20 * degree);
  }
};

const std::string search =
    "[[stage]]\nname = \"safety\"\nkind = \"reduce\"\nsearch = \"factor\"\nfrom_factor = 0.5\nto_factor = 4\n"
    "tolerance_factor = 0.001\nfailure_displacement = 0.02\n";

template <int Dim>
void expect_peak_strength(const std::string& law, int points) {
  const Slope slope{Dim, points, law, search};
  const Results results = whole_run(scene_of<Dim>(slope.text())).results;
  const Value* found = results.find("factor_of_safety");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->value, slope.factor(), *found->error_bar + 1e-9) << law << ", " << points;
  ASSERT_TRUE(results.bonds);
  EXPECT_EQ(results.bonds->broken, 0);
  ASSERT_EQ(results.cohesion.size(), 1u);
}

// under its weight a block has the factor of its peak strength, whatever slip leaves
TEST(BondsAsSliced, ABlockOnAnInclineHasTheFactorOfLimitEquilibrium) {
  EXPECT_GT(Slope{}.factor(), 1.7);
  for (const char* law : {"", "cohesion_law = \"softening\"\ncohesion_slip_m = 1e-3\nresidual_cohesion = 5e3",
                          "cohesion_law = \"softening\"\ncohesion_slip_m = 0", "cohesion_law = \"brittle\""})
    for (const int points : {1, 4}) {
      expect_peak_strength<2>(law, points);
      expect_peak_strength<3>(law, points);
    }
}

// A joint that was pulled apart, and blocks given directly, have none.
TEST(BondsAsSliced, WhatPartsOrMeetsLaterHasNone) {
  const std::string pulled =
      "[[stage]]\nname = \"pull\"\nkind = \"run\"\nduration_s = 0.02\nforce = [{ name = \"pull\", inside = [0, 1], "
      "force "
      "= [0, 4e6], times_s = [0, 0.01, 0.02], factors = [0, 1, 0] }]\n"
      "[[stage]]\nname = \"rest\"\nkind = \"settle\"\nstatics = \"local\"\nfriction_deg = 60\n" +
      search + "friction = [{ name = \"rock\", friction_deg = 15 }]\n";
  const Slope slope{2, 1, "", pulled};
  const Results results = whole_run(scene_of<2>(slope.text())).results;
  EXPECT_NEAR(results.find("factor_of_safety")->value, slope.factor(0), 2e-3);
  EXPECT_EQ(results.bonds->broken, 1);

  const std::string given =
      "dimension = 2\ngravity = [0, -9.81]\ndensity = 2500\n"
      "blocks = [{ name = \"ground\", box = { min = [-2, -1], max = [2, 0] }, fixed = true },\n"
      "          { name = \"stone\", box = { min = [-1, 0], max = [1, 1] } }]\n"
      "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = "
      "15\ncohesion "
      "= 20e3\n[[stage]]\nname = \"settle\"\nkind = \"settle\"\ngravity_ramp_s = 0.1\n";
  const Results apart = whole_run(scene_of<2>(given)).results;
  EXPECT_EQ(apart.bonds->made, 0);
  EXPECT_EQ(std::ranges::count_if(apart.warnings,
                                  [](const std::string& w) { return w.find("blocks given directly") != w.npos; }),
            1);
}

// stated by stage, a strength acts where a stage bonds
TEST(BondsAsSliced, ByStageNothingActsUntilAStageBonds) {
  Slope slope{2, 4, "bonds = \"by_stage\"", "friction_deg = 60\n" + search + "friction_deg = 15\n"};
  const Results without = whole_run(scene_of<2>(slope.text())).results;
  EXPECT_FALSE(without.bonds);
  EXPECT_NEAR(without.find("factor_of_safety")->value, slope.factor(0), 2e-3);
  const Results with = whole_run(scene_of<2>(slope.text(), {"stage.settle.bond=true"})).results;
  EXPECT_NEAR(with.find("factor_of_safety")->value, slope.factor(), 2e-3);
}

// one rule for `run` and `blocks`
TEST(BondsAsSliced, BlockTheoryCountsTheCohesionThatActs) {
  const Slope slope{2, 4, "bonds = \"by_stage\"", "friction_deg = 60\n" + search + "friction_deg = 15\n"};
  for (const bool bonded : {false, true}) {
    const std::vector<std::string> sets{bonded ? "stage.settle.bond=true" : "stage.settle.bond=false"};
    const Survey<2> survey = survey_blocks(scene_of<2>(slope.text(), sets), {});
    ASSERT_EQ(survey.rows.size(), 1u);
    EXPECT_NEAR(*survey.rows.front().bolted.factor, slope.factor(bonded ? 20e3 : 0), 1e-9);
    const auto says = [](const std::string& note) { return note.starts_with("the cohesion of 'rock' is not counted"); };
    EXPECT_EQ(std::ranges::count_if(survey.notes, says), bonded ? 0 : 1);
  }
}

// beside the factor of a search stands the price of its cohesion
TEST(BondsAsSliced, ASearchStatesTheFactorOfFrictionOnly) {
  for (const std::string law : {"plastic", "brittle", "softening"}) {
    const std::string keys =
        fmt::format("cohesion_law = \"{}\"{}", law, law == "softening" ? "\ncohesion_slip_m = 1e-3" : "");
    const Slope slope{2, 1, keys, search};
    const Prepared<2> scene = scene_of<2>(slope.text());
    Results results = whole_run(scene).results;
    add_block_theory(scene, results);
    ASSERT_TRUE(results.at_last_stable_state.back().block_theory);
    const BlockTheory& theory = *results.at_last_stable_state.back().block_theory;
    EXPECT_NEAR(theory.friction_only.value_or(0), slope.factor(0), 1e-9);
    EXPECT_NEAR(theory.critical.value_or(0), slope.factor(), 1e-9);
    EXPECT_EQ(theory.brittle.has_value(), law == "brittle");
    if (theory.brittle) {
      EXPECT_NEAR(*theory.brittle, slope.factor(), 1e-9) << "one joint: that of its peak";
    }
    const std::string text = text_of(theory, "1");
    EXPECT_NE(text.find(fmt::format("{:.5g} plastic, {:.5g} friction only, for the same blocks", slope.factor(),
                                    slope.factor(0))),
              std::string::npos)
        << text;
  }
}

// A cube, 2 m high, bonded to a floor, under inclined gravity, with every setting left alone. Its bonds are those of
// 4 x 4 points, an elastic section: the outer ones carry W (4.8 sin t - cos t)/A in tension, W sin t/A in shear, and
// hold as long as c - tan(60 deg) times that tension exceeds that shear. Without bonds it topples from 26.6 degrees on.
// Before its weight comes on, the face closes without force; what is first compressed is but the lower part of it.
TEST(BondsOfAStage, ABondedFaceIsBondedAsAWhole) {
  for (const std::string statics : {"newton", "adaptive"})
    for (const double tilt : {20.0, 30.0, 34.0, 37.0, 50.0}) {
      const double sine = std::sin(tilt * degree), cosine = std::cos(tilt * degree), weight = 2 * 2600 * 9.81;
      const bool stands = 2e5 - std::sqrt(3.0) * weight * (4.8 * sine - cosine) > weight * sine;
      EXPECT_EQ(stands, tilt < 35);
      const Results results =
          whole_run(scene_of<3>(fmt::format(
                        "dimension = 3\ngravity = [{:.17g}, 0, {:.17g}]\ndensity = 2600\nstatics = \"{}\"\n"
                        "[[blocks]]\nname = \"floor\"\nbox = {{ min = [-3, -3, -1], max = [3, 3, 0] }}\nfixed = true\n"
                        "[[blocks]]\nname = \"cube\"\nbox = {{ min = [-0.5, -0.5, 0], max = [0.5, 0.5, 2] }}\n"
                        "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
                        "friction_deg = 60\ncohesion = 200e3\ntension = 200e3\n"
                        "[[stage]]\nname = \"settle\"\nkind = \"settle\"\nbond = true\ngravity_ramp_s = 1\n"
                        "[output]\nframes = false\n",
                        9.81 * sine, -9.81 * cosine, statics)))
              .results;
      ASSERT_TRUE(results.bonds);
      EXPECT_EQ(results.bonds->made, 16) << statics << ", " << tilt;
      EXPECT_EQ(results.bonds->broken == 0, stands) << statics << ", " << tilt << ": " << results.message;
    }
}

TEST(BondsAsSliced, ACheckpointKeepsSlippedBonds) {
  const Slope slope{3, 2, "cohesion_law = \"softening\"\ncohesion_slip_m = 1e-3\nresidual_cohesion = 5e3", search};
  const Prepared<3> scene = scene_of<3>(slope.text());
  const Results whole = whole_run(scene).results;
  EXPECT_EQ(continued(scene, whole.counters.steps - 40).results.state_hash, whole.state_hash);
}

}  // namespace
}  // namespace voussoir::bonds_as_sliced_test
