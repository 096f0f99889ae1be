// The output and the warnings of `voussoir check`.
#include <algorithm>
#include <array>

#include "app/testing/checked_scene.hpp"

namespace voussoir::check_test {
namespace {

using namespace program;

std::string ground() {
  return "preset = \"thesis\"\n" + head_in_plane +
         "[[blocks]]\nname = \"ground\"\nbox = { min = [-5, -1], max = [15, 0] }\nfixed = true\n";
}

class Check : public CheckedScene {
 protected:
  void says(const std::string& scene, const std::string& part) const {
    const std::string out = check(scene);
    EXPECT_NE(out.find(part), std::string::npos) << part << "\n" << out;
  }
  void silent(const std::string& scene, const std::string& part) const {
    const std::string out = check(scene);
    EXPECT_EQ(out.find(part), std::string::npos) << part << "\n" << out;
  }
};

// Hoek & Bray's wedge: the closed form's least value at the stiffnesses of the scene
TEST_F(Check, GivesTheClosedFormOfBrittleBonds) {
  const std::string scene = "check " VOUSSOIR_SOURCE_DIR "/cases/key_blocks/hoek_and_bray.toml";
  const std::string brittle =
      " --set 'joint_properties.A.cohesion_law=\"brittle\"' --set "
      "'joint_properties.B.cohesion_law=\"brittle\"'";
  const std::string part =
      "has the least factor by the closed form at this shear_stiffness / normal_stiffness, 1.434 "
      "(1.736 if plastic, 1.107 by friction only)";
  EXPECT_NE(run(scene + brittle).out.find(part), std::string::npos) << run(scene + brittle).out;
  EXPECT_EQ(run(scene).out.find("by the closed form"), std::string::npos);
}

// ---- what is active -----------------------------------------------------------------------------------------------

TEST_F(Check, PrintsMotionsAndLoadsThatAStagePrescribes) {
  const std::string scene = ground() + box("stone", 0, 0) + rock_properties +
                            "[[stage]]\nname = \"shake\"\nkind = \"run\"\nduration_s = 1\nbond = true\n"
                            "[[stage.move]]\nbodies = [\"ground\"]\nvelocity = [0.1, 0]\ntranslation = [\"x\"]\n"
                            "frequency_hz = 2\n"
                            "[[stage.boundary]]\nbodies = [\"stone\"]\nstress = [5e4, 0, 0]\n"
                            "[[stage.force]]\nname = \"jack\"\nbodies = [\"stone\"]\nforce = [5e3, 0]\n"
                            "point = [0, 0.5]\nturns_with_body = true\n";
  says(scene, "moves blocks at (0.1, 0) m/s along x, times a sine of 2 Hz from 0 deg on");
  says(scene, "stress (xx, yy, xy) = (50, 0, 0) kPa on outer faces");
  says(scene, "force 'jack' = (5, 0) kN/m on blocks at (0, 0.5) m, turning with them");
  says(scene, "turning with them; bonds closed joints that have tension or cohesion; damping");
  says(ground() + box("stone", 0, 0) + rock_properties + settle_stage, "bonds, prescribed motion, boundary stress");
}

// dashpots in proportion to a stiffness damp in proportion to the frequency; a block of 2 t on 1 GN/m swings at 112.5
// Hz
TEST_F(Check, PrintsWhatDampsTrueMotion) {
  const std::string stone =
      ground() + box("stone", 0, 0) + rock_properties + "[[stage]]\nname = \"shake\"\nkind = \"run\"\nduration_s = 1\n";
  const std::string implicit = "time = { integration = \"implicit\" }\n";
  says(stone, "shake: no dashpot damps the motion (0 % of critical at 1 and 10 Hz); slip takes the rest");
  says(stone + implicit + "damping = { local = 0, joint_ratio = 0.02, joint_frequency_hz = 5 }\n",
       "shake: of critical damping: joint_ratio 0.4 % at 1 Hz, 4 % at 10 Hz; slip takes the rest");
  says(stone + "damping = { local = 0, viscous_ratio = 0.05 }\n",
       "viscous_ratio, normal to joints, at most 0.044 % at 1 Hz, 0.44 % at 10 Hz; slip");
  says(stone + "damping = { local = 0.1 }\n", "shake: of critical damping: local 3.2 %; slip takes the rest");
  silent(ground() + box("stone", 0, 0) + rock_properties + settle_stage, "takes the rest");
}

TEST_F(Check, PrintsLawsStrengthsAndSubContacts) {
  const std::string scene = ground() + box("stone", 0, 0) + rock_properties +
                            "sub_contacts = 3\nnormal_law = \"linear\"\nnormal_growth = 7e4\nshear_law = \"power\"\n"
                            "shear_exponent = 0.7\nfriction_law = \"softening\"\nsoftening_drop = 0.06\n"
                            "softening_slip_m = 0.35\ntension = 7e4\ncohesion = 8e5\n" +
                            settle_stage;
  for (const char* part : {"3 contact points per face", "normal stiffness + 70000/m", "(normal stress / 1 Pa)^0.7",
                           "softens by 0.06 within 0.35 m", "tension 70 kPa if bonded", "cohesion 800 kPa if bonded"})
    says(scene, part);
  says(ground() + box("stone", 0, 0) + rock_properties + settle_stage, "one contact point per face");
  const std::string rough =
      ground() + box("stone", 0, 0) + rock_properties +
      "normal_law = \"hyperbolic\"\nmaximum_closure_m = 2e-4\nirrecoverable_fraction = 0.4\ndilation_law = "
      "\"constant\"\ndilation_deg = 8\ndilation_until_m = 0.004\n" +
      settle_stage;
  says(rough, "hyperbolic up to a closure of 0.0002 m, of which 0.4 is not recovered");
  says(rough, "dilates at 8 deg up to 0.004 m of slip; no strength is added");
}

TEST_F(Check, PrintsBartonAndBandisLawOfTheBlocks) {
  const std::string law = "friction_law = \"barton_bandis\"\njrc = 15\njcs = 150e6\n";
  const std::string stone = ground() + box("stone", 0, 0) + rock_properties + law;
  const std::string scaled = stone +
                             "block_length_m = 1\nsample_length_m = 0.1\nmobilisation = \"table\"\n"
                             "dilation_share = 0\n" +
                             settle_stage;
  says(stone + settle_stage, "as stated: no scale correction without sample_length_m");
  says(stone + settle_stage, "without mobilisation: the peak strength at any slip");
  says(stone + settle_stage, "dilates at 0.5 of the mobilised roughness angle");
  says(scaled, "JRC 15, JCS 150000 kPa of a sample of 0.1 m; 7.518, ");
  says(scaled, "peak at 3.89 mm of plastic slip");
  says(scaled, "does not dilate");
  says("statics = \"newton\"\n" + scaled, "relaxation replaces Newton's method: rock softens beyond its peak");
  const std::string stages =
      stone + settle_stage + "friction_deg = 75\n[[stage]]\nname = \"slide\"\nkind = \"settle\"\n";
  says(stages, "Coulomb's friction of 75 deg replaces Barton and Bandis' law of 'rock' from stage");
  silent(stages, "acts again");
  says(stages + "friction_as_stated = true\n", "Barton and Bandis' law of 'rock' acts again from stage slide on");
}

TEST_F(Check, PrintsTheContactModelOfEachJoint) {
  const std::string whole = "[contact]\nface = \"integrated\"\n";
  const std::string stone = ground() + box("stone", 0, 0) + rock_properties;
  says(stone + whole + settle_stage, "  integrated face contact\n");
  says(stone + "sub_contacts = 3\n" + whole + settle_stage, "integrated face contact (sub_contacts = 3 is not used)");
  silent(stone + settle_stage, "integrated face contact");
  const auto beside = [&](const std::string& laws) {
    return stone +
           "[[joint_properties]]\nname = \"other\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = "
           "30\n" +
           laws + whole + settle_stage;
  };
  says(beside("cohesion = 1e5\n"), "not integrated: it can be bonded");
  says(beside("constant_stiffness = true\n"), "not integrated: constant_stiffness is independent of the area");
  says(beside("normal_law = \"linear\"\nnormal_growth = 7e4\n"),
       "not integrated: its laws depend on the history at each point");
}

TEST_F(Check, PrintsTheVolumeBelowWater) {
  const std::string lake = "[[water]]\nname = \"lake\"\n";
  const std::string scene = ground() + box("stone", 0, 0) + rock_properties + lake + "level = 0.25\n" + settle_stage;
  says(scene, "lake: 9.81 kN/m³ on all faces; 0.25 m² of the free blocks are below it, 25 %");
  says(scene, "its uplift on the free blocks is 2.4525 kN/m, 12.26 % of their weight");
  says(scene + "water = [{ name = \"lake\", level = 0.5, rate = 0.1 }]\n", "water 'lake' changes within 2.5 s");
  silent(scene, "wets none");
  says(ground() + box("stone", 0, 0) + rock_properties + lake + "level = -2\n" + settle_stage,
       "water.lake.level = -2: is below every");
  says(ground() + box("stone", 0, 0) + rock_properties + lake + "level = 300\n" + settle_stage,
       "299 m above every block");
  says(ground() + box("stone", 0, 0) + "density = 900\n" + rock_properties + lake + "level = 3\n" + settle_stage,
       "it floats");
  says(ground() + box("stone", 0, 0) + rock_properties + lake + "pressure = 5000\nfaces = \"outer\"\n" + settle_stage,
       "lake: 5 kPa on the faces of 0 joints and outside");
  says(ground() + box("stone", 0, 0) + rock_properties + settle_stage, "applied forces, water");
}

TEST_F(Check, NamesThePresentNameOfEveryKeyThatHadAnother) {
  const std::string stone = ground() + box("stone", 0, 0) + rock_properties + settle_stage;
  says(stone + "damping = { statics = \"newton\" }\n",
       fmt::format("renamed     scene.toml:{}: stage.rest.damping.statics is now stage.rest.statics",
                   std::ranges::count(stone, '\n') + 1));
  EXPECT_NE(check(stone, "--set damping.increments=2").find("damping.increments is now static_increments"),
            std::string::npos);
  silent(stone + "statics = \"newton\"\n", "renamed");
}

TEST_F(Check, PrintsTheExcavationForcesThatRemain) {
  const std::string dug =
      "dimension = 2\ngravity = [0, -10]\ndensity = 2000\ndomain = { box = { min = [0, 0], max = [6, 3] } }\n" +
      rock_properties +
      "[[joints]]\nname = \"floor\"\ndip = 0\npoint = [0, 1]\n[[joints]]\nname = \"bed\"\ndip = 0\npoint = [0, 2]\n"
      "[[fix]]\nbelow = \"floor\"\n[[excavations]]\nname = \"pit\"\noutline = true\n"
      "box = { min = [2, 1], max = [4, 2] }\n" +
      settle_stage + "[[stage]]\nname = \"dig\"\nkind = \"settle\"\nexcavate = \"pit\"\n";
  const std::string forces = "excavation_forces = { remaining = 0.4, duration_s = 1 }\n";
  says(dug + forces, "excavation_forces: remaining 0.40 (relaxed λ = 0.60) after the last stage, since stage dig");
  silent(dug + forces +
             "[[stage]]\nname = \"off\"\nkind = \"settle\"\nexcavation_forces = { remaining = 0, duration_s = 1 }\n",
         "after the last stage");
  silent(dug, "after the last stage");
  write("scene.toml", dug + forces);
  const Ended ended = run("run scene.toml --out out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("excavation_forces: remaining 0.40 (relaxed λ = 0.60) at the end"), std::string::npos)
      << ended.out;
  EXPECT_EQ(results("out")["excavation_forces"]["remaining"], 0.4);
}

// Every ramp of a stage is counted, and a warning is printed if the step limit ends the stage before it is complete.
TEST_F(Check, CountsEveryRampAndWarnsOfStepLimitsThatEndItEarly) {
  const std::string stone = ground() + box("stone", 0, 0) + rock_properties +
                            "[[water]]\nname = \"lake\"\nlevel = 0.1\n" + "[time]\nstep_s = 1e-4\n" + settle_stage;
  const auto rises = [&](const std::string& seconds) {
    return "water = [{ name = \"lake\", level = 0.3, duration_s = " + seconds + " }]\n";
  };
  says(stone + rises("10"), "1e+05 of them");
  says(stone + "step_limit = 50000\n" + rises("10"), "stage.rest.step_limit = 50000: its longest ramp, 10 s, takes");
  silent(stone + "step_limit = 500000\n" + rises("10"), "is not reached");
  const std::string windows = "[equilibrium]\nwindow = 1000\n";
  says(stone + "step_limit = 999\n" + windows, "equilibrium.window asks for 1000 successive steps in equilibrium");
  silent(stone + "step_limit = 1001\n" + windows, "equilibrium.window asks");
  const std::string search =
      "[[stage]]\nname = \"reduce\"\nkind = \"reduce\"\nfrom_deg = 30\nto_deg = 1\ntolerance_deg = 0.1\n";
  says(stone + search + "ramp_steps = 500\nstep_limit = 500\n", "stage.reduce.step_limit = 500: a trial lowers");
  silent(stone + search + "ramp_steps = 500\nstep_limit = 5000\n", "a trial lowers");
}

// Mapped joints without sizes are infinite and cut many more blocks than a table with sizes.
TEST_F(Check, ReportsThatATableOfJointsWithoutSizesIsEndless) {
  const std::string scene =
      "dimension = 2\ngravity = [0, -10]\ndensity = 2000\njoints_file = \"joints.csv\"\n"
      "domain = { box = { min = [0, 0], max = [10, 10] } }\nfix = [{ side = \"bottom\" }]\n" +
      rock_properties + settle_stage;
  std::string endless = "name,x_m,y_m,dip_deg,dip_direction_deg\n",
              ended = "name,x_m,y_m,dip_deg,dip_direction_deg,shape,length_m\n";
  for (int k = 1; k <= 50; ++k) {
    const std::string row =
        fmt::format("J{0},{1},{2},{3},{4}", k, 0.19 * k, 10 - 0.15 * k, 20 + 3 * (k % 12), k % 2 ? 90 : 270);
    endless += row + "\n";
    ended += row + ",trace,0.5\n";
  }
  write("joints.csv", endless);
  says(scene, "all 50 joints of 'joints.csv' are infinite");
  says(scene, "warning: scene.toml: all 50 joints");
  const Ended sliced = run("slice scene.toml --out sliced");
  const std::size_t at = sliced.out.find("they cut ");
  ASSERT_NE(at, std::string::npos) << sliced.out << sliced.err;
  EXPECT_EQ(std::stoul(sliced.out.substr(at + 9)), std::stoul(sliced.out)) << "the blocks that were written";
  write("joints.csv", ended);
  silent(scene, "are infinite");
}

// If a water table slopes, a sliding block leaves its water before the displacement that counts as failure.
TEST_F(Check, WarnsIfASearchLetsBlocksLeaveTheirWater) {
  const std::string search = settle_stage +
                             "[[stage]]\nname = \"reduce\"\nkind = \"reduce\"\nfrom_deg = 30\nto_deg = 1\n"
                             "tolerance_deg = 0.1\n";
  const std::string wet = ground() + box("stone", 0, 0) + rock_properties + "[[water]]\nname = \"lake\"\n";
  const char* const warning = "stage.reduce: before block stone has moved by 0.05 m and counts as failed";
  says(wet + "table = [[0, 0.5], [1, 0]]\n" + search, warning);
  silent(wet + "table = [[0, 0.5], [1, 0]]\n" + search + "failure_displacement = 0.0005\n", "counts as failed");
  silent(wet + "level = 0.5\n" + search, "counts as failed");
  const std::string required =
      wet + "table = [[0, 0.5], [1, 0]]\n" + search + "failure_criterion = \"required_strength\"\n";
  silent(required, "counts as failed");
  says(required, "failed by the strength that its motion requires, or after a tenth of the smallest inscribed radius");
}

// ---- blocks -------------------------------------------------------------------------------------------------------

TEST_F(Check, WarnsOfBlocksWithoutSupport) {
  // two on one another, in the air
  const std::string pair = box("lower", 0, 3) + box("upper", 0, 4);
  says(ground() + pair + rock_properties + settle_stage,
       "2 blocks, lower the first, are near one another, but no chain");
  silent(
      ground() + pair + box("leg 1", 0, 0) + box("leg 2", 0, 1) + box("leg 3", 0, 2) + rock_properties + settle_stage,
      "no chain");
  silent(ground() + pair + rock_properties + settle_stage + "[[restrain]]\nall = true\ntranslation = [\"y\"]\n",
         "no chain");
  says(ground() + box("alone", 0, 3) + rock_properties + settle_stage, "block alone has no neighbour");
}

TEST_F(Check, WarnsIfNothingWillMove) {
  const std::string space = "dimension = 2\ndensity = 2000\n" + rock_properties + box("ship", 0, 0) +
                            "[[stage]]\nname = \"fly\"\nkind = \"run\"\nduration_s = 1\n";
  says(space, "nothing will move");
  silent(space +
             "[[stage]]\nname = \"burn\"\nkind = \"run\"\nduration_s = 1\n"
             "[[stage.force]]\nname = \"thrust\"\nbodies = [\"ship\"]\nforce = [1e3, 0]\n",
         "nothing will move");
}

TEST_F(Check, WarnsOfBlocksInsideOneAnother) {
  says(ground() + box("one", 0, 0) + box("two", 0, 0) + rock_properties + settle_stage,
       "blocks one and two are inside one another");
  says(ground() + box("one", 0, 0) + box("two", 0.4, 0.4, 0.2) + rock_properties + settle_stage,
       "are inside one another");
  silent(ground() + box("one", 0, 0) + box("two", 1, 0) + rock_properties + settle_stage, "are inside one another");
}

TEST_F(Check, WarnsWhenAStageRemovesTheLastFreeBlock) {
  const std::string two = ground() + box("one", 0, 0) + box("two", 1, 0) + rock_properties + settle_stage;
  says(two + "remove = [{ bodies = [\"one\", \"two\"] }]\n", "stage.rest removes the last free block");
  says(two + "fix = [{ bodies = [\"one\", \"two\"] }]\n", "stage.rest fixes the last free block");
  silent(two + "remove = [{ bodies = [\"one\"] }]\n", "last free block");
}

TEST_F(Check, WarnsOfPilesOnOneContactPointPerFace) {
  const std::string pile =
      ground() + box("one", 0, 0) + box("two", 0, 0.99999) + box("three", 0, 1.99998) + rock_properties;
  says(pile + settle_stage, "3 free blocks rest on one another with one contact point per face");
  says(pile + settle_stage, "set contact.face = \"integrated\", or joint_properties.");
  silent(pile + "[contact]\nface = \"integrated\"\n" + settle_stage, "one another with one contact point");
  silent(pile + "sub_contacts = 2\n" + settle_stage, "one another with one contact point");
  silent(pile + settle_stage + "[[restrain]]\nall = true\nrotation = true\n", "one another with one contact point");
}

// ---- numbers ------------------------------------------------------------------------------------------------------

TEST_F(Check, WarnsOfDashpotsWithLongSteps) {
  const std::string scene = ground() + box("stone", 0, 0) + rock_properties +
                            "[[stage]]\nname = \"fall\"\nkind = \"run\"\nduration_s = 1\n[damping]\nlocal = 0\n"
                            "viscous_ratio = 0.2\n[time]\nfraction = ";
  says(scene + "0.2\n", "change the restitution of impacts by about 8 %");
  silent(scene + "0.1\n", "restitution");
}

// Implicit steps have no fraction of a stable step; many blocks that nothing presses yet are a hard start.
TEST_F(Check, JudgesImplicitStepsByWhatTheyNeed) {
  const std::string scene = R"(dimension = 2
gravity = [0, -9.81]
density = 2600
domain = { box = { min = [0, 0], max = [12, 12] } }
joints = [{ name = "base", dip = 0, dip_direction = 90, point = [0, 1] }]
joint_sets = [{ name = "flat", dip = 10, dip_direction = 90, spacing = 1 },
              { name = "steep", dip = 80, dip_direction = 270, spacing = 1 }]
joint_properties = [{ name = "rock", normal_stiffness = 1e9, shear_stiffness = 1e8, friction_deg = 30 }]
fix = [{ below = ["base"] }]
time = { fraction = 0.4, integration = "implicit" }
damping = { local = 0, viscous_ratio = 0.2 }
)";
  const std::string run = "[[stage]]\nname = \"move\"\nkind = \"run\"\nduration_s = 1\n",
                    settle = "[[stage]]\nname = \"rest\"\nkind = \"settle\"\n";
  says(scene + run, "stage.move: implicit steps begin with 224 blocks");
  silent(scene + settle + run, "implicit steps begin");
  silent(scene + run, "restitution");
  silent(scene + run, "stage.move: time.fraction");
}

TEST_F(Check, WarnsOfRampsThatActAsAnImpact) {
  std::string tower = ground();
  for (int k = 0; k < 20; ++k)
    tower += box(fmt::format("b{}", k), 0, k * 1.0);
  const std::string ramped = settle_stage + "statics = \"local\"\ngravity_ramp_s = ";
  // one block oscillates with a period of 9 ms, a column of twenty with 13 times as long
  says(tower + rock_properties + ramped + "0.1\n", "it acts as an impact");
  silent(tower + rock_properties + ramped + "0.5\n", "it acts as an impact");
  silent(ground() + box("stone", 0, 0) + rock_properties + ramped + "0.1\n", "it acts as an impact");
}

TEST_F(Check, IsSilentAboutOrdinaryDirectionsAndSpeeds) {
  const std::string block =
      "dimension = 3\ngravity = [0, 0, -10]\ndensity = 2000\ndomain = { box = { min = [-1, -1, -1], max = [1, 1, 1] } "
      "}\n"
      "[[joints]]\nname = \"A\"\ndip = 40\npoint = [0, 0, 0]\n" +
      rock_properties + "[[fix]]\nbelow = [\"A\"]\n" + settle_stage;
  const auto with_direction = [&](const std::string& direction) {
    return std::string(block).replace(block.find("point = [0, 0, 0]"), 0, "dip_direction = " + direction + "\n");
  };
  silent(with_direction("4.8"), "warning:");
  says(with_direction("4.71238898"), ": is 270 deg in radians");
  silent(ground() + box("stone", 0, 0) + "velocity = [1e-6, 0]\n" + rock_properties +
             "[[stage]]\nname = \"go\"\nkind = \"run\"\nduration_s = 1\n[time]\nfraction = 0.1\n[damping]\nlocal = 0\n",
         "is unusual");
}

TEST_F(Check, IsSilentAboutCorrectInput) {
  // a frame interval with a stage whose time is fictitious
  silent(ground() + box("stone", 0, 0) + rock_properties + settle_stage + "[output]\nframe_interval_s = 20\n",
         "frame_interval_s");
  // properties that no face has
  const std::string swapped =
      "[[joint_properties]]\nname = \"spare\"\nnormal_stiffness = 1e8\nshear_stiffness = 1e9\nfriction_deg = 30\n";
  const std::string named = std::string(rock_properties).replace(rock_properties.find("\"rock\""), 6, "\"default\"");
  silent(ground() + box("stone", 0, 0) + named + swapped + settle_stage, "warning:");
  says(ground() + box("stone", 0, 0) + named + swapped + settle_stage,
       "spare: normal 1e+08, shear 1e+09 Pa/m, friction 30 deg; no face");
  // the first of a regular series of joints
  std::string joints =
      "dimension = 2\ngravity = [0, -10]\ndensity = 2000\ndomain = { box = { min = [-40, -1], max = [40, 0] } }\n";
  for (int k = 1; k <= 4; ++k)
    joints +=
        fmt::format("[[joints]]\nname = \"j{0}\"\ndip = 90\ndip_direction = 90\npoint = [{1}, 0]\n", k, 5 * k - 4.95);
  joints += rock_properties + "[[fix]]\nabove = [\"j1\"]\n" + settle_stage;
  silent(joints, "was it given in km");
  says(std::string(joints).replace(joints.find("point = [5.05"), 13, "point = [6.05"), "was it given in km");
}

TEST_F(Check, CountsJointsThatMissTheDomain) {
  const std::string domain =
      "dimension = 2\ngravity = [0, -10]\ndensity = 2000\ndomain = { box = { min = [0, 0], max = [4, 4] } }\n" +
      rock_properties + settle_stage;
  const auto level = [](const std::string& name, double height, const std::string& more = "") {
    return fmt::format("[[joints]]\nname = \"{}\"\ndip = 0\npoint = [2, {}]\n{}", name, height, more);
  };
  const std::string held = "[[fix]]\nbelow = [\"in\"]\n";
  says(domain + level("in", 2) + held, "none of 1 stated joints misses the domain");
  says(domain + level("in", 2) + level("out", 5) + held, "1 of 2 stated joints misses the domain: out\n");
  const std::string aside = "within = { box = { min = [6, 0], max = [8, 4] } }\n";
  const std::string beyond = "[[joints]]\nname = \"short\"\ndip = 0\npoint = [9, 1]\nshape = \"trace\"\nlength = 2\n";
  says(domain + level("in", 2) + level("out", 5) + level("aside", 3, aside) + beyond + level("above", 6) + held,
       "4 of 5 stated joints miss the domain: out, aside, short and 1 more");
  says(domain + level("in", 2) + beyond + held, "1 of 2 stated joints misses the domain: short");
  says(domain + level("in", 2) + beyond + held + "[slicing]\nends = \"ignored\"\n", "none of 2 stated joints");
}

TEST_F(Check, ListsTheWorstBlocks) {
  const std::string scene = ground() + box("one", 0, 0) + box("small", 2, 0, 0.125) + box("middle", 4, 0, 0.5) +
                            box("two", 6, 0, 2) + rock_properties + settle_stage;
  says(scene, "smallest area: small 0.01562 m², middle 0.25 m², one 1 m²\n");
  says(scene, "shortest edge: small 0.125 m, middle 0.5 m, one 1 m\n");
  says(scene, "largest aspect ratio of the box along the axes: ground 20, ");
  // without a name, by its number and a joint it borders on; in space
  const std::string cube =
      "dimension = 3\ndensity = 2000\ndomain = { box = { min = [0, 0, 0], max = [2, 2, 2] } }\n"
      "[[joints]]\nname = \"bed\"\ndip = 0\npoint = [0, 0, 0.25]\n" +
      rock_properties + "[[fix]]\nbelow = [\"bed\"]\n" + settle_stage;
  says(cube, "smallest volume: block 0 (of joint bed) 1 m³, block 1 (of joint bed) 7 m³\n");
  says(cube, "shortest edge: block 0 (of joint bed) 0.25 m, block 1 (of joint bed) 1.75 m\n");
  says(cube, "aspect ratio of the box along the axes: block 0 (of joint bed) 8, block 1 (of joint bed) 1.143\n");
}

TEST_F(Check, CallsNoPartOfAWeldedBlockASliver) {
  // an excavation's face cuts 2 mm off a block that stays in one piece
  const std::string scene =
      "dimension = 2\ngravity = [0, -10]\ndensity = 2000\ndomain = { box = { min = [0, 0], max = [4, 4] } }\n"
      "[[joints]]\nname = \"bed\"\ndip = 0\npoint = [0, 2]\n"
      "[[joints]]\nname = \"weld\"\ndip = 90\ndip_direction = 90\npoint = [0.002, 0]\nkind = \"construction\"\n" +
      rock_properties + "[[fix]]\nbelow = [\"bed\"]\n" + settle_stage;
  silent(scene, "sliver");
  silent(scene, "wrong unit");
}

TEST_F(Check, JudgesASceneWithoutJointProperties) {
  silent("dimension = 2\ndensity = 2000\n" + box("stone", 0, 0) +
             "velocity = [0.1, 0]\n[time]\nstep_s = 0.01\n"
             "[[stage]]\nname = \"go\"\nkind = \"run\"\nduration_s = 1\n[damping]\nlocal = 0\n",
         "is unusual");
}

// By the formula of generation, |1 - k0| sin a cos a / (cos² a + k0 sin² a), 3 and 30 degrees ask for 30 degrees.
TEST_F(Check, JudgesStressesInSitu) {
  const auto pressed = [](double friction, double k0, double surface) {
    return "dimension = 2\ngravity = [0, -10]\ndensity = 2000\ndomain = { box = { min = [-4, -4], max = [4, 4] } }\n"
           "[[joints]]\nname = \"j\"\ndip = 30\ndip_direction = 90\npoint = [0, 0]\n" +
           rock_properties +
           fmt::format(
               "[[fix]]\nside = [\"bottom\"]\n[[stage]]\nname = \"press\"\nkind = \"settle\"\n"
               "friction_deg = {}\nboundary = [{{ side = [\"left\", \"right\"], in_situ = {{ surface = {}, k0 "
               "= {} }} }}]\n",
               friction, surface, k0);
  };
  says(pressed(25, 3, 4), "needs a friction of 30.0 deg but has 25.0");
  silent(pressed(30.1, 3, 4), "in-situ");
  silent(pressed(1, 1, 4), "in-situ");
  says(pressed(40, 3, -5), "below every block");
  says(pressed(40, 3, 4000), "above every block");
}

// The steps that check forecasts against those that are taken.
TEST_F(Check, ForecastsTheNumberOfSteps) {
  const std::string scene = ground() + box("stone", 0, 0) + rock_properties +
                            "[[stage]]\nname = \"rest\"\nkind = \"settle\"\ngravity_ramp_s = 0.2\n"
                            "[[stage]]\nname = \"go\"\nkind = \"run\"\nduration_s = 0.5\n[time]\nfraction = 0.1\n";
  const std::string out = check(scene);
  ASSERT_EQ(run("run scene.toml --out out").code, 0);
  const nlohmann::json stages = results("out")["stages"];
  const std::array<std::string, 2> words{"at least ", "about "};
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string name = stages[k]["name"];
    const std::size_t line = out.find(name + ": steps of"), word = out.find(words[k], line);
    ASSERT_NE(line, std::string::npos) << out;
    ASSERT_LT(word, out.find('\n', line)) << out;
    const double promised = std::stod(out.substr(word + words[k].size())), taken = stages[k]["steps"];
    // one digit is printed, and pairs that do not touch yet count with their greatest possible stiffness
    EXPECT_LT(promised, 3 * taken) << name << "\n" << out;
    EXPECT_GT(promised, taken / 3) << name << "\n" << out;
  }
}

// ---- accuracy -----------------------------------------------------------------------------------------------------

TEST_F(Check, AResultBelowTheAnglesThatALevelGuaranteesIsWarnedOf) {
  const auto scene = [](int dip) {
    return fmt::format(
               "dimension = 2\ngravity = [0, -10]\ndensity = 2000\naccuracy = {{ level = \"fast\" }}\n"
               "domain = {{ box = {{ min = [-1, -1], max = [1, 1] }} }}\n"
               "joints = [{{ name = \"A\", dip = {}, dip_direction = 90, point = [0, 0] }}]\n",
               dip) +
           rock_properties + "[[fix]]\nbelow = [\"A\"]\n[[restrain]]\nabove = [\"A\"]\nrotation = true\n" +
           settle_stage + "[[stage]]\nname = \"critical\"\nkind = \"reduce\"\nfrom_deg = 40\nto_deg = 2\n";
  };
  for (const int dip : {10, 25}) {
    write("scene.toml", scene(dip));
    const Ended ended = run("run scene.toml --overwrite --out out");
    ASSERT_EQ(ended.code, 0) << ended.err;
    const bool doubted =
        results("out")["warnings"].dump().find("has its accuracy for critical angles above 15") != std::string::npos;
    EXPECT_EQ(doubted, dip < 15) << results("out")["warnings"].dump(2);
    EXPECT_EQ(doubted, ended.err.find("above 15 deg") != std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace voussoir::check_test
